// SPDX-License-Identifier: Apache-2.0
// One round of a learner from its own rollouts: the network plays some episodes, now and then against its own choice,
// and every action of the states that it met is labelled with what the network gets that goes on greedily after it.
// The world is deterministic and the play is exact, so that a label is no estimate: it is what the environment pays.
// (Policy iteration with rollouts: Lagoudakis and Parr 2003.)
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sil/world/random.hpp"
#include "training/learner/dqn.hpp"
#include "training/rollout/greedy_plays.hpp"
#include "training/rollout/guide.hpp"
#include "training/rollout/label_store.hpp"

namespace striker::training {

struct RoundPlan {
  std::uint64_t seed = 0;
  int first_episode = 0;  // of the training
  int episodes = 0;
  double epsilon = 0.0;   // of each decision: the probability that an exploration begins
  bool by_plans = false;  // labels are what the planner gets after the action, not the network
};

class Rollouts {
 public:
  // The tasks are played in turn, episode by episode. Throws std::invalid_argument for one that is not on a line.
  Rollouts(const Shape& shape, const RolloutConfig& config, const std::vector<TaskConfig>& tasks);

  // Adds a label for each state whose actions differ. A row an episode, without what concerns learning.
  std::vector<EpisodeRow> round(const Parameters& network, const RoundPlan& plan, sil::Random& exploring,
                                LabelStore& labels);

 private:
  // A state that was met.
  struct Visit {
    std::uint32_t play = 0;
    LineRobot robot;
    int greedy = 0;    // the network's choice
    float gap = 0.0F;  // by how much it preferred it
    float weight = 1.0F;
  };
  // What an episode's exploration is at.
  struct Exploration {
    Guidance guidance;
    int held = 0;  // so many decisions are left of a random action
    int action = 0;
    int last_decision = -1;  // that was not the network's choice
  };

  void begin(const RoundPlan& plan);
  void begin_episode(const RoundPlan& plan, int i);
  void play(const Parameters& network, double epsilon, sil::Random& exploring);
  int explored(Exploration& exploration, int greedy, int decision, double epsilon,
               sil::Random& exploring) const;
  void choose_labelled(sil::Random& exploring);
  void label(const Parameters& network, bool by_plans, LabelStore& labels);
  [[nodiscard]] std::vector<EpisodeRow> rows(const RoundPlan& plan) const;

  RolloutConfig config_;
  std::vector<LineKick> kicks_;
  GreedyPlays greedy_plays_;
  std::optional<Guide> guide_;  // if there is any share for it

  std::vector<LineEpisode> episodes_;
  std::vector<LinePlay> plays_;
  std::vector<Exploration> explorations_;
  std::vector<Visit> visits_;
  Eigen::MatrixXf visited_;  // the features of each visit, a column
};

}  // namespace striker::training
