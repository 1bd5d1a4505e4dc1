// SPDX-License-Identifier: Apache-2.0
// A kick episode on one line, that can be played from any of its decisions on, by many robots at once: what the
// rollouts of a learner are played in. The robot drives straight, so that nothing but its place and speed on the line
// changes until the contact (line_play.hpp); all that the ball does is computed once an episode.
//
//   LineKick kick(task);
//   LineEpisode episode = kick.draw(seed, number);
//   LineRobot robot;
//   while (!robot.over) {
//     kick.look(episode, robot, features);           // what KickEnvironment::features() says
//     kick.step(episode, robot, choose(features));   // what KickEnvironment::step pays, in robot.reward
//   }
//
// The robot, the ball and the camera may be others than the nominal ones (conditions.hpp).
// tests/training/line/line_episode_test.cpp holds the nominal play against KickEnvironment. A step takes about 20 ns, a
// contact of the aimed kick 30 us.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "training/line/conditions.hpp"
#include "training/line/line_play.hpp"
#include "training/task/task_config.hpp"

namespace striker::training {

// What is drawn and computed before the first decision.
struct LineEpisode {
  BallTrack track;
  double gain_limit_m_s = 0.0;  // of the robot's speed in a physics step
  Bodies bodies;
  int command_delay_steps = 0;
  int vision_late_frames = 0;
  std::array<double, sil::kick_decisions> seen_ball_x_m{};  // from where the robot's centre was at the start
  // What the network would read if the robot stood still: an input a row, a decision a column.
  Eigen::MatrixXf features;
};

// Where one play of an episode has come to: a value, so that a play can be branched.
struct LineRobot {
  LineState now;
  // What was seen one decision ago, two, ...; one more than a network may read, as its picture may be late.
  std::array<LineState, greatest_look_back + 1> before{};
  double set_point_m_s = 0.0;       // the last decision's ...
  double last_set_point_m_s = 0.0;  // ... and the one before
  int decision = 0;
  bool over = false;     // the contact, or no contact is possible any more
  bool contact = false;  // over by a contact
  double reward = 0.0;   // once it is over: of the whole episode
};

class LineKick {
 public:
  // Throws std::invalid_argument unless `unfit` has nothing to say.
  explicit LineKick(const TaskConfig& task);

  // Why a task cannot be played on a line: "KEY: what it must be"; empty if it can be.
  [[nodiscard]] static std::string unfit(const TaskConfig& task);

  // The start is that of the nominal episode, whatever the conditions.
  [[nodiscard]] LineEpisode draw(std::uint64_t seed, std::uint64_t episode,
                                 const Conditions& conditions = {}) const;
  // Writes one value an input.
  void look(const LineEpisode& episode, const LineRobot& robot, Eigen::Ref<Eigen::VectorXf> features) const;
  // One decision of a robot that is not over. For who looks for the best only: a contact that cannot pay more than
  // `to_beat` is paid as something up to that, which spares the collision of the aimed kick.
  void step(const LineEpisode& episode, LineRobot& robot, int action,
            double to_beat = -std::numeric_limits<double>::infinity()) const;

  [[nodiscard]] const TaskConfig& task() const { return task_; }
  [[nodiscard]] int actions() const { return static_cast<int>(set_points_m_s_.size()); }
  [[nodiscard]] double set_point_m_s(int action) const {
    return set_points_m_s_[static_cast<std::size_t>(action)];
  }
  [[nodiscard]] double no_contact_reward() const { return sil::kick_decisions * task_.rules.waiting_reward; }
  // The most that a contact in this decision can pay.
  [[nodiscard]] double most_reward(int decision) const;

 private:
  // An input that the robot's movement changes.
  struct MovingInput {
    Eigen::Index row = 0;
    StateInput input;
  };

  [[nodiscard]] double contact_reward(const LineEpisode& episode, int step, const LineRobot& playing,
                                      Push push, double to_beat) const;
  [[nodiscard]] LineState led_through_delay(const LineRobot& robot) const;

  TaskConfig task_;
  double top_speed_m_s_;
  double described_gain_limit_m_s_;
  DescribedDelays delays_;
  Bodies bodies_;                       // the nominal ones
  std::vector<double> set_points_m_s_;  // an action each, both wheels alike
  std::vector<MovingInput> moving_;
};

}  // namespace striker::training
