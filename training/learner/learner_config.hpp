// SPDX-License-Identifier: Apache-2.0
// Everything that a learner is made from. training/configs/paper.toml says what each number means to a user,
// and holds the defaults: a configuration sets all of them, these are only zeros.
#pragma once

#include <vector>

#include "training/learner/network.hpp"
#include "training/task/state.hpp"

namespace striker::training {

// How a number goes from its first value to its last one.
enum class Course { linear, cosine, exponential };

// `learner.kind`: DQN (dqn.hpp), or from own rollouts (training/rollout/rollout_learner.hpp).
enum class LearnerKind { dqn, rollout };

struct LearnerConfig {
  LearnerKind kind = LearnerKind::dqn;
  double gamma = 0.0;               // discount of a reward one decision later, 0 to 1
  int n_step = 0;                   // decisions whose rewards are summed before the target network's value
  bool cut_at_exploration = false;  // that sum ends before a random action (Watkins's rule)
  bool time_limit = false;  // the last decision's next state has a value, too; `learner.time_limit` in TOML
  bool double_dqn = false;  // the online network chooses the next action, the target network values it
  bool huber = false;       // linear loss beyond a TD error of 1
  bool augment_mirrored = false;  // half of the samples are seen in a mirror; `learner.mirror` in TOML
  int batch = 0;                  // transitions a gradient step
  int replay_size = 0;            // transitions
  int warm_up = 0;                // decisions before the first gradient step
  int target_period = 0;          // gradient steps between two updates of the target network
  double target_rate = 0.0;       // the share of the way that it then goes; 1 copies
  int gradient_steps = 0;         // a decision
  double clip_norm = 0.0;         // longest gradient (Euclidean norm); 0: any
  bool int8_weights = false;      // plays and differentiates with rounded weights
  bool prioritised = false;
  double priority_exponent = 0.0;    // alpha of Schaul et al. 2016
  double priority_correction = 0.0;  // beta at the start; 1 at the end
};

// What only the learner from own rollouts has.
struct RolloutConfig {
  int round_episodes = 0;       // played at once, then learnt from; `rollout.round`
  int planner_episodes = 0;     // labels are the planner's in the first so many episodes
  int longest_hold = 0;         // decisions that an exploration holds its action
  double guided_share = 0.0;    // of the nominal episodes, that begin by the exact search's sequence
  double passes = 0.0;          // how often each label is drawn, on the average
  double focus = 0.0;           // so many times as many labels where actions are near each other, at the most
  double pairwise_share = 0.0;  // of the training, with the pairwise loss; then with the expected regret, ...
  double pairwise_rest = 0.0;   // ... beside which the pairwise loss keeps this weight
  double temperature = 0.0;     // of the softmax, in units of the reward
  double greatest_regret = 0.0;  // a worse action counts as much
  double value_weight = 0.0;     // of the error of the greatest output as a value
};

struct OptimiserConfig {
  double learning_rate = 0.0;   // of Adam
  double final_fraction = 0.0;  // of it, at the last episode
  Course schedule = Course::linear;
  double averaging = 0.0;  // of the weights: about 1 / (1 - this) gradient steps; 0: none
};

struct ExplorationConfig {
  double epsilon_start = 0.0;  // probability of a random action
  double epsilon_end = 0.0;
  int decay_episodes = 0;
  Course schedule = Course::linear;
};

// The task's symmetry: factors of the inputs, and the action that is each action's image (-1: it has none).
struct MirrorImage {
  Features factors;
  std::vector<int> actions;
};

struct LearnerSetup {
  Shape shape;
  LearnerConfig learner;
  RolloutConfig rollout = {};
  OptimiserConfig optimiser;
  ExplorationConfig exploration;
  int planned_episodes = 0;  // the schedules end with them
  MirrorImage mirror;        // for `augment_mirrored`
};

}  // namespace striker::training
