// SPDX-License-Identifier: Apache-2.0
#include "training/run/learner_reader.hpp"

#include <array>
#include <string>

#include "sil/task/kick_task.hpp"
#include "training/line/line_episode.hpp"
#include "training/rollout/guide.hpp"

namespace striker::training {

namespace {

constexpr std::array dqn_keys = {"learner.gamma",
                                 "learner.n_step",
                                 "learner.time_limit",
                                 "learner.cut_at_exploration",
                                 "learner.double_dqn",
                                 "learner.huber",
                                 "learner.mirror",
                                 "learner.target_period",
                                 "learner.target_rate",
                                 "learner.gradient_steps",
                                 "learner.clip_norm",
                                 "learner.int8_weights",
                                 "learner.prioritised",
                                 "learner.priority_exponent",
                                 "learner.priority_correction"};
constexpr std::array rollout_keys = {
    "rollout.round",           "rollout.planner_episodes", "rollout.longest_hold",  "rollout.passes",
    "rollout.focus",           "rollout.pairwise_share",   "rollout.pairwise_rest", "rollout.temperature",
    "rollout.greatest_regret", "rollout.value_weight",     "rollout.guided_share",  "randomise.share"};

std::string value_of(const TomlReader& reader, const std::string& key) {
  std::ostringstream text;
  text << reader.node(key);
  return text.str();
}

}  // namespace

void read_learner(const TomlReader& reader, LearnerConfig& learner) {
  reader.read<LearnerKind>("learner.kind", learner.kind,
                           {{"dqn", LearnerKind::dqn}, {"rollout", LearnerKind::rollout}});
  reader.read("learner.gamma", learner.gamma, 0.0, 1.0);
  reader.read("learner.n_step", learner.n_step, 1, sil::kick_decisions);
  reader.read("learner.cut_at_exploration", learner.cut_at_exploration);
  reader.read("learner.time_limit", learner.time_limit);
  reader.read("learner.double_dqn", learner.double_dqn);
  reader.read("learner.huber", learner.huber);
  reader.read("learner.mirror", learner.augment_mirrored);
  reader.read("learner.batch", learner.batch, 2, 4096);
  reader.read("learner.replay_size", learner.replay_size, 1, 10'000'000);
  reader.read("learner.warm_up", learner.warm_up, 1, 10'000'000);
  reader.read("learner.target_period", learner.target_period, 1, 1'000'000);
  reader.read("learner.target_rate", learner.target_rate, 1e-6, 1.0);
  reader.read("learner.gradient_steps", learner.gradient_steps, 0, 100);
  reader.read("learner.int8_weights", learner.int8_weights);
  reader.read("learner.clip_norm", learner.clip_norm, 0.0, 1e6);
  reader.read("learner.prioritised", learner.prioritised);
  reader.read("learner.priority_exponent", learner.priority_exponent, 0.0, 1.0);
  reader.read("learner.priority_correction", learner.priority_correction, 0.0, 1.0);
}

void read_rollout(const TomlReader& reader, RolloutConfig& rollout) {
  reader.read("rollout.round", rollout.round_episodes, 1, 100'000);
  reader.read("rollout.planner_episodes", rollout.planner_episodes, 0, 10'000'000);
  reader.read("rollout.longest_hold", rollout.longest_hold, 1, sil::kick_decisions);
  reader.read("rollout.guided_share", rollout.guided_share, 0.0, 1.0);
  reader.read("rollout.passes", rollout.passes, 0.01, 1000.0);
  reader.read("rollout.focus", rollout.focus, 1.0, 100.0);
  reader.read("rollout.pairwise_share", rollout.pairwise_share, 0.0, 1.0);
  reader.read("rollout.pairwise_rest", rollout.pairwise_rest, 0.0, 100.0);
  reader.read("rollout.temperature", rollout.temperature, 0.001, 100.0);
  reader.read("rollout.greatest_regret", rollout.greatest_regret, 0.001, 1000.0);
  reader.read("rollout.value_weight", rollout.value_weight, 0.0, 100.0);
}

void read_optimiser(const TomlReader& reader, OptimiserConfig& optimiser) {
  reader.read("optimiser.learning_rate", optimiser.learning_rate, 1e-7, 1.0);
  reader.read("optimiser.final_fraction", optimiser.final_fraction, 0.0, 1.0);
  reader.read<Course>("optimiser.schedule", optimiser.schedule,
                      {{"linear", Course::linear}, {"cosine", Course::cosine}});
  reader.read("optimiser.averaging", optimiser.averaging, 0.0, 0.999999);
}

void read_exploration(const TomlReader& reader, ExplorationConfig& exploration) {
  reader.read("exploration.epsilon_start", exploration.epsilon_start, 0.0, 1.0);
  reader.read("exploration.epsilon_end", exploration.epsilon_end, 0.0, 1.0);
  reader.read("exploration.decay_episodes", exploration.decay_episodes, 1, 10'000'000);
  reader.read<Course>("exploration.schedule", exploration.schedule,
                      {{"linear", Course::linear}, {"exponential", Course::exponential}});
}

void require_no_other_learners_keys(const TomlReader& reader, const TomlReader& defaults, LearnerKind kind) {
  const auto require_default = [&](const std::string& key, const std::string& others_kind) {
    if (value_of(reader, key) != value_of(defaults, key)) {
      reader.fail(
          key, "only learner.kind = \"" + others_kind + "\" reads it: leave it out, or change learner.kind");
    }
  };
  if (kind == LearnerKind::rollout) {
    for (const char* key : dqn_keys) {
      require_default(key, "dqn");
    }
  } else {
    for (const char* key : rollout_keys) {
      require_default(key, "rollout");
    }
  }
}

void require_line_task(const TomlReader& reader, const TaskConfig& task, const RolloutConfig& rollout) {
  const auto require_fit = [&](const std::string& why, const std::string& with) {
    if (!why.empty()) {
      const auto colon = why.find(':');
      reader.fail(why.substr(0, colon), "with " + with + " " + why.substr(colon + 2));
    }
  };
  require_fit(LineKick::unfit(task), "learner.kind = \"rollout\"");
  if (rollout.guided_share > 0.0) {
    require_fit(Guide::unfit(task), "rollout.guided_share");
  }
}

}  // namespace striker::training
