// SPDX-License-Identifier: Apache-2.0
#include "training/run/directory/train_into.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "firmware/host/files.hpp"

namespace striker::training {

namespace {

// Of what is done every `period` episodes: is it, among these rows?
bool due(std::span<const CurveRow> rows, int period) {
  return period > 0 && std::any_of(rows.begin(), rows.end(), [period](const CurveRow& row) {
           return (row.episode.episode + 1) % period == 0;
         });
}

// Up to the last episode, or to the end of the round in which `progress` ends it.
void play_all(Training& training, RunDirectory& files, const TrainingProgress& progress,
              TrainingResult& result) {
  const RunConfig& run = training.config().run;
  while (!training.done() && !result.interrupted) {
    const std::span<const CurveRow> rows = training.play_round();
    result.moving_average = rows.back().moving_average;
    files.add(rows, training);
    if (run.validation_episodes > 0 && due(rows, run.evaluation_period)) {
      files.evaluate(training);
    }
    const bool go_on = std::all_of(rows.begin(), rows.end(), progress);
    result.interrupted = !go_on && !training.done();
    if (!result.interrupted && !training.done() && due(rows, run.checkpoint_period)) {
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
  result.decisions = training.decisions();
  result.gradient_steps = training.gradient_steps();
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
