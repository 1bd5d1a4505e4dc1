// SPDX-License-Identifier: Apache-2.0
// The files of a training in its directory, and what is written to them when.
//
// Each file is written whole or not at all. The checkpoint comes last, so that what it counts on is there: a
// training that ends at any moment, whatever the reason, can be resumed from the last one.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "training/learner/divergence.hpp"
#include "training/run/directory/episode_csv.hpp"
#include "training/run/training_run.hpp"

namespace striker::training {

// How a training begins in a directory that may hold another one's files.
enum class Start {
  fresh,   // only where there are none
  force,   // removes them first
  resume,  // goes on with that training
};

class RunDirectory {
 public:
  explicit RunDirectory(const std::filesystem::path& directory);

  // Prepares the files, and takes the checkpoint's state into `training` where it is resumed. Throws
  // std::runtime_error with one line that names the directory and the way out: there are files of a training and
  // `start` is fresh, or there is nothing to resume, or a file is damaged.
  void begin(Training& training, Start start);

  // A round's rows.
  void add(std::span<const CurveRow> rows, const Training& training);

  // A greedy evaluation; the best one's network is kept.
  void evaluate(Training& training);

  // Everything that resuming needs.
  void save(const Training& training);
  void finish(const Training& training, const Model& model);

  // Writes the tables up to the last whole episode, and no model. Returns one line: what happened, which files
  // are sound, and the way out.
  [[nodiscard]] std::string give_up(const Divergence& divergence, const Training& training);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::filesystem::path best_file() const { return directory_ / "best.safetensors"; }
  [[nodiscard]] std::filesystem::path model_file() const { return directory_ / "model.safetensors"; }
  [[nodiscard]] std::vector<std::filesystem::path> files_there() const;
  [[noreturn]] void refuse_used() const;
  void resume(Training& training);
  void write_tables(const Training& training);
  void add_speed(const Training& training);

  std::filesystem::path directory_;
  EpisodeCsv curve_;
  EpisodeCsv evaluations_;
  EpisodeCsv speed_;
  std::filesystem::path checkpoint_;
  Clock::time_point start_;
  int saved_episodes_ = 0;      // in the checkpoint; 0: there is none
  std::int64_t decisions_ = 0;  // when this process began
  std::int64_t gradient_steps_ = 0;
};

}  // namespace striker::training
