// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/line_episode.hpp"

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

sil::BallState rolled_for_a_decision(sil::BallState ball) {
  for (int i = 0; i < steps_per_decision; ++i) {
    auto& [position, velocity] = ball;
    position = {position.x + physics_step_s * velocity.x, position.y + physics_step_s * velocity.y};
    velocity = {sil::kept_in_10_ms * velocity.x, sil::kept_in_10_ms * velocity.y};
  }
  return ball;
}

// What the ball's place tells of its velocity, one vision frame after it was at `last_m`.
sil::Vec2 estimated_velocity_m_s(sil::Vec2 now_m, sil::Vec2 last_m) {
  return {(now_m.x - last_m.x) / sil::decision_period_s, (now_m.y - last_m.y) / sil::decision_period_s};
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

LineKick::LineKick(const TaskConfig& task) : task_(task) {
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

LineEpisode LineKick::draw(std::uint64_t seed, std::uint64_t number) const {
  const sil::KickStart start = sil::draw_kick(seed, number, task_.pose, task_.rules);
  LineEpisode episode{.track = ball_track(start), .features = {}};
  episode.features.resize(static_cast<Eigen::Index>(task_.inputs.size()), sil::kick_decisions);
  sil::Random none(0, 0, sil::random_stream::dummies);
  Features features(task_.inputs.size());
  History history;
  sil::BallState ball = start.ball;
  sil::Vec2 last_m = sil::ball_before(start, sil::decision_period_s).position_m;
  for (int decision = 0; decision < sil::kick_decisions; ++decision) {
    DecisionState state;
    state.decisions_left = sil::kick_decisions - decision;
    state.field = {.robot = start.robot, .robot_velocity_m_s = {}, .ball = ball};
    if (task_.velocities == Velocities::estimated) {
      state.field.ball.velocity_m_s = estimated_velocity_m_s(ball.position_m, last_m);
    }
    state.rcs = rcs_state(state.field, task_.equations);
    decision == 0 ? history.begin(state) : history.add(state);
    const bool mirror = task_.one_sided && state.rcs.ball_y_m < 0.0;
    write_features(task_.inputs, history, mirror, none, features);
    episode.features.col(decision) = features;
    episode.seen_ball_x_m[static_cast<std::size_t>(decision)] = state.rcs.ball_x_m;
    last_m = ball.position_m;
    ball = rolled_for_a_decision(ball);
  }
  return episode;
}

void LineKick::look(const LineEpisode& episode, const LineRobot& robot,
                    Eigen::Ref<Eigen::VectorXf> features) const {
  features = episode.features.col(robot.decision);
  for (const auto& [row, input] : moving_) {
    const auto [element, ago] = input;
    const LineState& then = ago == 0 ? robot.now : robot.before[static_cast<std::size_t>(ago - 1)];
    const double value =
        element == Element::robot_speed
            ? then.speed_m_s
            : episode.seen_ball_x_m[static_cast<std::size_t>(std::max(robot.decision - ago, 0))] -
                  then.position_m;
    features[row] = static_cast<float>(value / facts_of(element).unit);
  }
}

void LineKick::step(const LineEpisode& episode, LineRobot& robot, int action) const {
  std::shift_right(robot.before.begin(), robot.before.end(), 1);
  robot.before.front() = robot.now;
  const int first = robot.decision * steps_per_decision;
  for (int step = first; step < first + steps_per_decision; ++step) {
    if (episode.track.depth_m(step, robot.now.position_m) >= 0.0) {
      robot.over = robot.contact = true;
      robot.reward = contact_reward(episode.track, step, robot.now);
      return;
    }
    advance(robot.now, set_point_m_s(action));
  }
  ++robot.decision;
  if (robot.decision * steps_per_decision >= episode.track.end) {
    robot.over = true;
    robot.reward = no_contact_reward();
  }
}

double LineKick::contact_reward(const BallTrack& track, int step, const LineState& robot) const {
  const sil::KickRules& rules = task_.rules;
  const auto n = static_cast<std::size_t>(step);
  const double ahead_m = track.x_m[n] - robot.position_m;
  const double speed_m_s = rules.signed_speed ? robot.speed_m_s : std::abs(robot.speed_m_s);
  return rules.waiting_reward * (step / steps_per_decision) +
         rules.angle_reward * ahead_m / std::hypot(ahead_m, track.y_m[n]) + rules.speed_reward_s_m * speed_m_s;
}

double LineKick::most_reward(int decision) const {
  const sil::KickRules& rules = task_.rules;
  return rules.waiting_reward * decision + std::abs(rules.angle_reward) +
         std::abs(rules.speed_reward_s_m) * top_speed_m_s;
}

}  // namespace striker::training
