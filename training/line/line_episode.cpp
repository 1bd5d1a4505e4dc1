// SPDX-License-Identifier: Apache-2.0
#include "training/line/line_episode.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sil/world/random_streams.hpp"

namespace striker::training {

namespace {

constexpr std::array moving_elements = {Element::ball_x, Element::robot_speed};

bool moves(Element element) {
  return std::find(moving_elements.begin(), moving_elements.end(), element) != moving_elements.end();
}

// What the ball's place tells of its velocity, one vision frame after it was at `last_m`.
sil::Vec2 estimated_velocity_m_s(sil::Vec2 now_m, sil::Vec2 last_m) {
  return {(now_m.x - last_m.x) / sil::decision_period_s, (now_m.y - last_m.y) / sil::decision_period_s};
}

// What the camera sees of ball and robot, while the robot stands still: a frame a decision, from some before the first
// decision on.
constexpr int frames_before = 2;
struct Picture {
  sil::Vec2 ball_m, robot_m;
  sil::Vec2 true_velocity_m_s;
};
using Pictures = std::array<Picture, sil::kick_decisions + frames_before>;

// Each is `latency_steps` old when its decision is made.
Pictures pictures_of(const sil::KickStart& start, double kept, double noise_m, int latency_steps,
                     sil::Random& random) {
  Pictures pictures;
  sil::BallState ball = start.ball;
  int step = 0;  // of `ball`
  for (int frame = 0; frame < static_cast<int>(pictures.size()); ++frame) {
    const int taken = (frame - frames_before) * steps_per_decision - latency_steps;
    for (; step < taken; ++step) {
      roll_on(ball, kept);
    }
    const sil::BallState seen = taken < 0 ? sil::ball_before(start, -taken * physics_step_s) : ball;
    Picture& picture = pictures[static_cast<std::size_t>(frame)];
    picture = {.ball_m = seen.position_m, .robot_m = {}, .true_velocity_m_s = seen.velocity_m_s};
    if (noise_m > 0.0) {
      picture.robot_m = {noise_m * sil::normal(random), noise_m * sil::normal(random)};
      picture.ball_m.x += noise_m * sil::normal(random);
      picture.ball_m.y += noise_m * sil::normal(random);
    }
  }
  return pictures;
}

}  // namespace

std::string LineKick::unfit(const TaskConfig& task) {
  if (task.kind != TaskKind::kick || task.physics != Physics::planar) {
    return "task.world: must be \"fast\"";
  }
  if (task.pose != sil::PoseMode::origin) {
    return "task.pose: must be \"origin\": the RCS state is the same anywhere";
  }
  if (task.equations != Equations::corrected) {
    return "task.equations: must be \"corrected\"";
  }
  if (task.rules.every_contact) {
    return "reward.contacts: must be \"first\"";
  }
  if (task.goes_on) {
    return "reward.after_contact: must be \"end\"";
  }
  const auto controllers = [](const StateInput& input) {
    return facts_of(input.element).raw_per_value != 0.0;
  };
  if (!std::all_of(task.inputs.begin(), task.inputs.end(), controllers)) {
    return "task.inputs: must be elements that the controller has";
  }
  const auto straight = [](const SetPoint& action) { return action.left_m_s == action.right_m_s; };
  if (!std::all_of(task.actions.begin(), task.actions.end(), straight)) {
    return "task.actions: both wheels must be set alike: plays are on a line";
  }
  return "";
}

LineKick::LineKick(const TaskConfig& task)
    : task_(task),
      top_speed_m_s_(line_drive(task.robot).top_speed_m_s),
      described_gain_limit_m_s_(line_drive(task.robot).gain_limit_m_s),
      delays_(described_delays(task.robot)),
      bodies_(bodies_of(task.robot)) {
  if (const std::string why = unfit(task); !why.empty()) {
    throw std::invalid_argument("LineKick: " + why);
  }
  for (const SetPoint& action : task.actions) {
    set_points_m_s_.push_back(action.left_m_s);
  }
  for (std::size_t i = 0; i < task.inputs.size(); ++i) {
    if (moves(task.inputs[i].element)) {
      moving_.push_back({.row = static_cast<Eigen::Index>(i), .input = task.inputs[i]});
    }
  }
}

LineEpisode LineKick::draw(std::uint64_t seed, std::uint64_t number, const Conditions& conditions) const {
  const sil::KickStart start = sil::draw_kick(seed, number, task_.pose, task_.rules);
  LineEpisode episode{.track = ball_track(start.ball, task_steps, ball_kept(conditions)),
                      .gain_limit_m_s = gain_limit_m_s(task_.robot, conditions),
                      .bodies = bodies_of(task_.robot, conditions),
                      .command_delay_steps = delays_.command_steps + conditions.command_delay_steps,
                      .vision_late_frames = conditions.vision_late_frames,
                      .features = {}};
  episode.features.resize(static_cast<Eigen::Index>(task_.inputs.size()), sil::kick_decisions);
  sil::Random random(seed, number, sil::random_stream::vision_noise);
  const Pictures pictures =
      pictures_of(start, ball_kept(conditions), conditions.vision_noise_m, delays_.picture_steps, random);
  // A camera that errs or lags knows no true velocity.
  const bool estimated = task_.velocities == Velocities::estimated || conditions.vision_noise_m > 0.0 ||
                         conditions.vision_late_frames > 0;
  Features features(task_.inputs.size());
  History history;
  for (int decision = 0; decision < sil::kick_decisions; ++decision) {
    const auto frame = static_cast<std::size_t>(decision + frames_before - conditions.vision_late_frames);
    const Picture& seen = pictures[frame];
    DecisionState state;
    state.decisions_left = std::max(sil::kick_decisions - decision - delays_.decisions_begun(), 0);
    state.field.robot = {.x_m = seen.robot_m.x, .y_m = seen.robot_m.y, .heading_rad = 0.0};
    state.field.ball = {.position_m = seen.ball_m,
                        .velocity_m_s = estimated
                                            ? estimated_velocity_m_s(seen.ball_m, pictures[frame - 1].ball_m)
                                            : seen.true_velocity_m_s};
    for (int i = 0; i < delays_.picture_steps + delays_.command_steps; ++i) {
      roll_on(state.field.ball);
    }
    state.rcs = rcs_state(state.field, task_.equations);
    decision == 0 ? history.begin(state) : history.add(state);
    const bool mirror = task_.one_sided && state.rcs.ball_y_m < 0.0;
    write_features(task_.inputs, history, mirror, random, features);
    episode.features.col(decision) = features;
    episode.seen_ball_x_m[static_cast<std::size_t>(decision)] = state.rcs.ball_x_m;
  }
  return episode;
}

void LineKick::look(const LineEpisode& episode, const LineRobot& robot,
                    Eigen::Ref<Eigen::VectorXf> features) const {
  features = episode.features.col(robot.decision);
  const LineState led = led_through_delay(robot);
  const auto then = [&](int ago) -> const LineState& {
    return ago == 0 ? led : robot.before[static_cast<std::size_t>(ago - 1)];
  };
  for (const auto& [row, input] : moving_) {
    const auto [element, ago] = input;
    double value = then(ago).speed_m_s;  // the wheels tell it at once
    if (element == Element::ball_x) {
      value = episode.seen_ball_x_m[static_cast<std::size_t>(std::max(robot.decision - ago, 0))] -
              then(ago + episode.vision_late_frames).position_m;
    }
    features[row] = static_cast<float>(value / facts_of(element).unit);
  }
}

// As the controller does, which knows its description and what it has ordered.
LineState LineKick::led_through_delay(const LineRobot& robot) const {
  LineState led = robot.now;
  for (int i = 0; i < delays_.command_steps; ++i) {
    advance(led, robot.set_point_m_s, described_gain_limit_m_s_);
  }
  return led;
}

void LineKick::step(const LineEpisode& episode, LineRobot& robot, int action, double to_beat) const {
  std::shift_right(robot.before.begin(), robot.before.end(), 1);
  robot.before.front() = led_through_delay(robot);
  const Push push{.set_point_m_s = set_point_m_s(action),
                  .last_set_point_m_s = robot.set_point_m_s,
                  .one_before_m_s = robot.last_set_point_m_s,
                  .late_steps = episode.command_delay_steps};
  const int first = robot.decision * steps_per_decision;
  for (int i = 0; i < steps_per_decision; ++i) {
    if (episode.track.depth_m(first + i, robot.now.position_m) >= 0.0) {
      robot.over = robot.contact = true;
      robot.reward = contact_reward(episode, first + i, robot, push, to_beat);
      return;
    }
    advance(robot.now, push.at(i), episode.gain_limit_m_s);
  }
  robot.last_set_point_m_s = robot.set_point_m_s;
  robot.set_point_m_s = push.set_point_m_s;
  ++robot.decision;
  if (robot.decision * steps_per_decision >= episode.track.end) {
    robot.over = true;
    robot.reward = no_contact_reward();
  }
}

double LineKick::contact_reward(const LineEpisode& episode, int step, const LineRobot& playing, Push push,
                                double to_beat) const {
  const sil::KickRules& rules = task_.rules;
  const BallTrack& track = episode.track;
  const LineState& robot = playing.now;
  if (rules.reward == sil::KickReward::aimed) {
    push.late_steps -= step % steps_per_decision;
    const Waited waited{.reward_a_decision = rules.waiting_reward, .decisions = step / steps_per_decision};
    return aimed_contact_reward(episode.bodies, robot, track.ball(step), push, waited, to_beat);
  }
  const auto n = static_cast<std::size_t>(step);
  const double ahead_m = track.x_m[n] - robot.position_m;
  const double speed_m_s = rules.signed_speed ? robot.speed_m_s : std::abs(robot.speed_m_s);
  const int decisions = step / steps_per_decision;
  return rules.waiting_reward * decisions + rules.angle_reward * ahead_m / std::hypot(ahead_m, track.y_m[n]) +
         rules.speed_reward_s_m * speed_m_s;
}

double LineKick::most_reward(int decision) const {
  const sil::KickRules& rules = task_.rules;
  if (rules.reward == sil::KickReward::aimed) {
    // The ball comes as fast as it may both ways, over a corner.
    const double fastest_m_s = rules.fastest_ball_m_s;
    const sil::BallState ball{.position_m = {0.0, 0.5 * sil::robot_side_m + 1e-3},
                              .velocity_m_s = {-fastest_m_s, -fastest_m_s}};
    return most_aimed_reward(bodies_, top_speed_m_s_, ball,
                             {.reward_a_decision = rules.waiting_reward, .decisions = decision});
  }
  return rules.waiting_reward * decision + std::abs(rules.angle_reward) +
         std::abs(rules.speed_reward_s_m) * top_speed_m_s_;
}

}  // namespace striker::training
