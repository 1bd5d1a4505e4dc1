// SPDX-License-Identifier: Apache-2.0
#include "training/rollout/rollouts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sil/world/random_streams.hpp"
#include "training/line/planner.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {

namespace {

template <class Values>
float gap_of(const Values& q, int greedy) {
  float second = -std::numeric_limits<float>::infinity();
  for (Eigen::Index a = 0; a < q.size(); ++a) {
    second = a == greedy ? second : std::max(second, q[a]);
  }
  return q[greedy] - second;
}

// The nominal ones, or drawn within ranges that grow with the training.
Conditions conditions_of(const RandomiseConfig& config, const RoundPlan& plan, int i) {
  const int episode = plan.first_episode + i;
  sil::Random random(plan.seed, first_training_episode + static_cast<std::uint64_t>(episode),
                     sil::random_stream::conditions);
  if (random.uniform() >= config.share) {
    return {};
  }
  const double strength =
      config.ramp_episodes == 0 ? 1.0 : std::min(1.0, static_cast<double>(episode) / config.ramp_episodes);
  return draw_conditions(config, strength, random);
}

// Differences below this are rounding.
constexpr float least_difference = 1e-6F;

}  // namespace

Rollouts::Rollouts(const Shape& shape, const RolloutConfig& config, const std::vector<TaskConfig>& tasks)
    : config_(config), kicks_(tasks.begin(), tasks.end()), greedy_plays_(shape) {
  if (config.guided_share > 0.0) {
    guide_.emplace(tasks.front());
  }
  visited_.resize(shape.inputs, static_cast<Eigen::Index>(config.round_episodes) * sil::kick_decisions);
}

std::vector<EpisodeRow> Rollouts::round(const Parameters& network, const RoundPlan& plan,
                                        sil::Random& exploring, LabelStore& labels) {
  begin(plan);
  play(network, plan.epsilon, exploring);
  if (!plan.by_plans) {
    choose_labelled(exploring);
  }
  label(network, plan.by_plans, labels);
  return rows(plan);
}

void Rollouts::begin(const RoundPlan& plan) {
  episodes_.clear();
  plays_.clear();
  explorations_.clear();
  visits_.clear();
  // The plays point to their episodes, which must not move.
  episodes_.reserve(static_cast<std::size_t>(plan.episodes));
  for (int i = 0; i < plan.episodes; ++i) {
    begin_episode(plan, i);
  }
}

void Rollouts::begin_episode(const RoundPlan& plan, int i) {
  const std::uint64_t number = first_training_episode + static_cast<std::uint64_t>(plan.first_episode + i);
  const LineKick& kick = kicks_[number % kicks_.size()];
  const Conditions conditions = conditions_of(kick.task().randomise, plan, i);
  episodes_.push_back(kick.draw(plan.seed, number, conditions));
  plays_.push_back({.kick = &kick, .episode = &episodes_.back(), .robot = {}});
  Exploration& exploration = explorations_.emplace_back();
  sil::Random random(plan.seed, number, sil::random_stream::guide);
  if (conditions == Conditions{} && random.uniform() < config_.guided_share) {
    exploration.guidance = guide_->lead(plan.seed, number, random);
  }
}

// An exploration holds a random action for a random time: single decisions against a plan are soon undone, and lead
// to nothing that the network would not have met.
int Rollouts::explored(Exploration& exploration, int greedy, int decision, double epsilon,
                       sil::Random& exploring) const {
  if (decision < exploration.guidance.decisions) {
    const int action = exploration.guidance.actions[static_cast<std::size_t>(decision)];
    exploration.last_decision = action == greedy ? exploration.last_decision : decision;
    return action;
  }
  if (exploration.held == 0 && exploring.uniform() < epsilon) {
    exploration.held =
        1 + static_cast<int>(exploring.below(static_cast<std::uint64_t>(config_.longest_hold)));
    exploration.action =
        static_cast<int>(exploring.below(static_cast<std::uint64_t>(kicks_.front().actions())));
  }
  if (exploration.held == 0) {
    return greedy;
  }
  --exploration.held;
  if (exploration.action != greedy) {
    exploration.last_decision = decision;
  }
  return exploration.action;
}

void Rollouts::play(const Parameters& network, double epsilon, sil::Random& exploring) {
  std::vector<std::uint32_t> active(plays_.size());
  for (std::uint32_t i = 0; i < active.size(); ++i) {
    active[i] = i;
  }
  while (!active.empty()) {
    greedy_plays_.ask(
        network, plays_, active, [&](std::uint32_t number, const auto& features, const auto& q) {
          LinePlay& play = plays_[number];
          const int greedy = greedy_action(q);
          visited_.col(static_cast<Eigen::Index>(visits_.size())) = features;
          visits_.push_back(
              {.play = number, .robot = play.robot, .greedy = greedy, .gap = gap_of(q, greedy)});
          const int action = explored(explorations_[number], greedy, play.robot.decision, epsilon, exploring);
          play.kick->step(*play.episode, play.robot, action);
          return !play.robot.over;
        });
  }
}

// A label costs a hundred times what a gradient by it does, and teaches most where the network is in doubt: there all
// states are labelled, elsewhere down to one in `focus`, which then weighs as much more. Doubt is a gap below the
// lower quartile of the round's.
void Rollouts::choose_labelled(sil::Random& exploring) {
  std::vector<float> gaps;
  for (const Visit& visit : visits_) {
    gaps.push_back(visit.gap);
  }
  const auto quartile = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 4);
  std::nth_element(gaps.begin(), quartile, gaps.end());
  const double doubt = std::max(static_cast<double>(*quartile), 1e-6);
  for (Visit& visit : visits_) {
    const double share =
        std::clamp(std::exp(1.0 - static_cast<double>(visit.gap) / doubt), 1.0 / config_.focus, 1.0);
    visit.weight = exploring.uniform() < share ? static_cast<float>(1.0 / share) : 0.0F;
  }
}

void Rollouts::label(const Parameters& network, bool by_plans, LabelStore& labels) {
  const auto actions = static_cast<Eigen::Index>(kicks_.front().actions());
  Eigen::MatrixXf values = Eigen::MatrixXf::Zero(actions, static_cast<Eigen::Index>(visits_.size()));
  std::vector<LinePlay> branches;
  std::vector<float*> places;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    const Visit& visit = visits_[i];
    const LinePlay& play = plays_[visit.play];
    const bool own = !by_plans && explorations_[visit.play].last_decision < visit.robot.decision;
    for (int action = 0; visit.weight > 0.0F && action < actions; ++action) {
      float& value = values(action, static_cast<Eigen::Index>(i));
      if (own && action == visit.greedy) {
        value = static_cast<float>(play.robot.reward);
        continue;
      }
      LinePlay branch{.kick = play.kick, .episode = play.episode, .robot = visit.robot};
      branch.kick->step(*branch.episode, branch.robot, action);
      value = static_cast<float>(branch.robot.reward);
      if (!branch.robot.over && by_plans) {
        value = static_cast<float>(plan_reward(*branch.kick, *branch.episode, branch.robot));
      } else if (!branch.robot.over) {
        branches.push_back(branch);
        places.push_back(&value);
      }
    }
  }
  greedy_plays_.finish(network, branches);
  for (std::size_t i = 0; i < branches.size(); ++i) {
    *places[i] = static_cast<float>(branches[i].robot.reward);
  }
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto of_state = values.col(column);
    if (visits_[i].weight > 0.0F && of_state.maxCoeff() - of_state.minCoeff() > least_difference) {
      labels.push(visited_.col(column), of_state, visits_[i].weight);
    }
  }
}

std::vector<EpisodeRow> Rollouts::rows(const RoundPlan& plan) const {
  std::vector<EpisodeRow> rows;
  for (std::size_t i = 0; i < plays_.size(); ++i) {
    const LineRobot& robot = plays_[i].robot;
    rows.push_back({.episode = plan.first_episode + static_cast<int>(i),
                    .decisions = robot.contact ? robot.decision + 1 : sil::kick_decisions,
                    .reward = robot.reward,
                    .success = robot.contact,
                    .epsilon = plan.epsilon});
  }
  return rows;
}

}  // namespace striker::training
