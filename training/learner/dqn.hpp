// The learner: a deep Q network (Mnih et al. 2015) as in the paper, with the options of the configuration.
// dqn.cpp holds all of it, from an episode's decisions down to the gradient step.
#pragma once

#include <cstdint>
#include <vector>

#include "sil/world/random.hpp"
#include "training/learner/network.hpp"
#include "training/learner/priorities.hpp"
#include "training/learner/replay_buffer.hpp"
#include "training/model/safetensors.hpp"
#include "training/run/config.hpp"

namespace striker::training {

// What one episode of training was like.
struct EpisodeRow {
  int episode = 0;
  int steps = 0;  // decisions until the contact, or 40
  double reward = 0.0;
  bool contact = false;
  double epsilon = 0.0;
  double learning_rate = 0.0;
  // Means over the episode's gradient steps, 0 if there were none.
  double loss = 0.0;
  double td_error = 0.0;  // its absolute value
  double q = 0.0;         // of the actions in the samples
};

// Everything that learns, and nothing else: save it at the end of an episode, restore it into a learner of
// the same configuration and seed, and it goes on to the same bits. Allocates nothing once made.
class Learner {
 public:
  Learner(const Config& config, std::uint64_t seed);

  // Plays training episode `episode` in `env`, which has been reset to its start, and learns from it.
  EpisodeRow play(KickEnv& env, int episode);

  // What is learnt so far: the network that the model will hold.
  [[nodiscard]] Parameters result() const;

  [[nodiscard]] std::int64_t decisions() const { return decisions_; }
  [[nodiscard]] std::int64_t gradient_steps() const { return gradient_steps_; }

  // For benchmarks: a gradient step by itself.
  void remember(const Features& state, int action, double reward, const Features& next, bool end);
  void learn(EpisodeRow& row);

  // In checkpoint.cpp.
  void save(SafeTensors& checkpoint) const;
  void restore(const SafeTensors& checkpoint);

 private:
  int choose(const Features& state, double epsilon);
  [[nodiscard]] bool warm() const;
  void sample();
  double differentiate(EpisodeRow& row);
  [[nodiscard]] float value_of_next(Eigen::Index i) const;
  void weigh_samples();
  void update_priorities();
  void follow();
  void round_online();
  // The online network as it plays and is differentiated.
  [[nodiscard]] const Parameters& played() const { return config_.int8_weights ? rounded_ : online_; }

  LearnerConfig config_;
  OptimiserConfig optimiser_;
  ExplorationConfig exploration_;
  int episodes_;

  Parameters online_;
  Parameters rounded_;
  Parameters target_;
  Parameters average_;
  Adam adam_;
  ReplayBuffer replay_;
  Priorities priorities_;
  NStep n_step_;
  sil::Random choosing_;
  bool exploring_ = false;  // the last choice was random
  sil::Random sampling_;
  std::int64_t decisions_ = 0;
  std::int64_t gradient_steps_ = 0;
  double progress_ = 0.0;  // of the training, 0 to 1

  // The room of a gradient step: a sample a column.
  std::vector<Eigen::Index> places_;
  std::vector<int> actions_;
  Eigen::MatrixXf states_, next_states_, q_gradient_;
  Eigen::VectorXf td_errors_, sample_weights_;
  Features mirror_factors_;
  std::vector<int> mirrored_actions_;
  Pass pass_, next_pass_, choosing_pass_;
  Eigen::VectorXf gradient_;
  Actor actor_;
  Features state_, next_state_;
};

// The weights that a training begins with: uniform, He et al. 2015; biases 0.
[[nodiscard]] Parameters initial_parameters(const Shape& shape, std::uint64_t seed);

}  // namespace striker::training
