// SPDX-License-Identifier: Apache-2.0
#include "training/run/directory/train_into.hpp"

#include <fmt/format.h>

#include "firmware/host/files.hpp"

namespace striker::training {

namespace {

bool due(int episodes, int period) {
  return period > 0 && episodes % period == 0;
}

// Up to the last episode, or to where `progress` ends it.
void play_all(Training& training, RunDirectory& files, const TrainingProgress& progress,
              TrainingResult& result) {
  const RunConfig& run = training.config().run;
  while (!training.done() && !result.interrupted) {
    const CurveRow row = training.play_episode();
    result.moving_average = row.moving_average;
    files.add(row, training);
    if (run.validation_episodes > 0 && due(training.episodes(), run.evaluation_period)) {
      files.evaluate(training);
    }
    result.interrupted = !progress(row) && !training.done();
    if (!result.interrupted && !training.done() && due(training.episodes(), run.checkpoint_period)) {
      files.save(training);
    }
  }
}

void finish(const Training& training, RunDirectory& files, TrainingResult& result) {
  Model model = model_of(training);
  if (training.config().run.validation_episodes > 0 && !result.interrupted) {
    const double mean = validation_mean(training, model.parameters);
    result.mean_reward = mean;
    model.metadata["mean_reward"] = fmt::format("{:.3f}", mean);
  }
  files.finish(training, model);
  result.episodes = training.episodes();
  result.decisions = training.learner().state().decisions;
  result.gradient_steps = training.learner().state().gradient_steps;
  if (training.state().best_episodes > 0) {
    result.best_mean_reward = training.state().best_mean;
  }
}

}  // namespace

TrainingResult train_into(const std::filesystem::path& directory, const Config& config, std::uint64_t seed,
                          Start start, const TrainingProgress& progress, const Parameters* initial) {
  host::require_writable(directory);
  Training training(config, seed);
  if (initial != nullptr) {
    training.begin_from(*initial);
  }
  RunDirectory files(directory);
  files.begin(training, start);
  TrainingResult result;
  try {
    play_all(training, files, progress, result);
  } catch (const Divergence& divergence) {
    throw TrainingDiverged(files.give_up(divergence, training));
  }
  finish(training, files, result);
  return result;
}

}  // namespace striker::training
