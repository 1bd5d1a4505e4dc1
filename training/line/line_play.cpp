// SPDX-License-Identifier: Apache-2.0
#include "training/line/line_play.hpp"

#include <algorithm>
#include <limits>

#include "sil/world/field_specs.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::training {

namespace {

constexpr double half_side_m = 0.5 * sil::robot_side_m;

constexpr double nothing = -std::numeric_limits<double>::infinity();

double reach_m(double ball_y_m) {
  const double beside = std::max(std::abs(ball_y_m) - half_side_m, 0.0);
  const double left = sil::ball_radius_m * sil::ball_radius_m - beside * beside;
  return left < 0.0 ? -1.0 : half_side_m + std::sqrt(left);
}

// How a decision of a plan ends. `spoiled`: the contact, or a near miss, is within the margin.
enum class PlanEnding { none, contact, spoiled };

// Where a plan that is carried out has come to.
struct PlanProgress {
  LineState robot;
  int step = 0;
  double reward = 0.0;
};

// Carries out one decision. A contact that cannot beat the best is given its bound.
PlanEnding carry_out(PlanProgress& progress, const LineDrive& drive, const BallTrack& track, int action,
                     double margin_m, const PlanValue& best) {
  const double set_point_m_s = drive.set_points_m_s.at(static_cast<std::size_t>(action));
  for (int i = 0; i < steps_per_decision; ++i, ++progress.step) {
    const double depth = track.depth_m(progress.step, progress.robot.position_m);
    if (depth >= 0.0) {
      progress.reward = contact_reward(drive, track, progress.step, progress.robot, set_point_m_s,
                                       best.contact ? best.reward : nothing);
      return depth < margin_m ? PlanEnding::spoiled : PlanEnding::contact;
    }
    if (depth > -margin_m) {
      return PlanEnding::spoiled;
    }
    advance(progress.robot, set_point_m_s, drive.gain_limit_m_s);
  }
  return PlanEnding::none;
}

}  // namespace

LineDrive line_drive(const core::RobotDescription& robot, sil::KickReward reward) {
  const sil::RobotSpec spec = sil::spec_of(robot);
  const double top_m_s = spec.max_rim_speed_m_s;
  return {.top_speed_m_s = top_m_s,
          .gain_limit_m_s = sil::straight_gain_limit_m_s(
              sil::planar_model(spec), {.torque_ceiling_Nm = spec.max_wheel_torque_Nm}, physics_step_s),
          .set_points_m_s = {top_m_s, 0.0, -top_m_s},
          .reward = reward,
          .bodies = bodies_of(robot)};
}

BallTrack ball_track(sil::BallState ball, int steps, double kept) {
  BallTrack track;
  track.first = steps;
  std::fill(track.x_m.begin() + steps, track.x_m.end(), 0.0);
  std::fill(track.y_m.begin() + steps, track.y_m.end(), 0.0);
  std::fill(track.reach_m.begin() + steps, track.reach_m.end(), -1.0);
  for (int i = 0; i < steps; ++i) {
    const auto n = static_cast<std::size_t>(i);
    track.x_m[n] = ball.position_m.x;
    track.y_m[n] = ball.position_m.y;
    track.reach_m[n] = reach_m(ball.position_m.y);
    track.velocity_m_s[n] = ball.velocity_m_s;
    if (track.reach_m[n] >= 0.0) {
      track.first = std::min(track.first, i);
      track.end = i + 1;
    }
    roll_on(ball, kept);
  }
  track.first = std::min(track.first, track.end);
  return track;
}

BallTrack ball_track(const sil::KickStart& start, int begun) {
  const double c = std::cos(start.robot.heading_rad);
  const double s = std::sin(start.robot.heading_rad);
  const auto in_frame = [&](sil::Vec2 a) { return sil::Vec2{c * a.x + s * a.y, c * a.y - s * a.x}; };
  const auto& [position, velocity] = start.ball;
  sil::BallState ball = {.position_m = in_frame({position.x - start.robot.x_m, position.y - start.robot.y_m}),
                         .velocity_m_s = in_frame(velocity)};
  for (int step = 0; step < begun; ++step) {
    roll_on(ball);
  }
  BallTrack track = ball_track(ball, task_steps - begun);
  track.begun = begun;
  return track;
}

PlanValue best_plan(const LineDrive& drive, const BallTrack& track, const LineState& robot, int decisions,
                    double margin_m) {
  PlanValue best;
  // Later decisions change nothing: the ball has left the line's neighbourhood.
  const int useful = std::min(decisions, (track.end + steps_per_decision - 1) / steps_per_decision);
  const auto consider = [&best](PlanEnding how, const PlanProgress& progress, const Plan& plan) {
    if (how == PlanEnding::contact && (!best.contact || progress.reward > best.reward)) {
      best = {.plan = plan, .reward = progress.reward, .contact = true};
    }
  };
  PlanEnding reversing = PlanEnding::none;
  PlanProgress reversed{.robot = robot};
  for (int reverse = 0; reversing == PlanEnding::none && reverse <= std::min(most_reverse, useful);
       ++reverse) {
    PlanEnding waiting = PlanEnding::none;
    PlanProgress waited = reversed;
    for (int wait = 0; waiting == PlanEnding::none && reverse + wait <= useful; ++wait) {
      const Plan plan{.reverse = reverse, .wait = wait};
      PlanEnding ending = PlanEnding::none;
      PlanProgress forward = waited;
      for (int i = reverse + wait; ending == PlanEnding::none && i < useful; ++i) {
        ending = carry_out(forward, drive, track, 0, margin_m, best);
      }
      consider(ending, forward, plan);
      if (reverse + wait < useful) {
        waiting = carry_out(waited, drive, track, 1, margin_m, best);
        consider(waiting, waited, {.reverse = reverse, .wait = wait + 1});
      }
    }
    if (reverse < useful) {
      reversing = carry_out(reversed, drive, track, 2, margin_m, best);
      consider(reversing, reversed, {.reverse = reverse + 1, .wait = 0});
    }
  }
  return best;
}

}  // namespace striker::training
