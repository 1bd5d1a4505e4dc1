// SPDX-License-Identifier: Apache-2.0
#include "training/run/directory/run_directory.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "training/run/evaluation.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {

namespace {

constexpr int speed_period = 250;  // episodes

// All that a training writes, and so all that `Start::force` may remove.
constexpr std::array names = {"model.safetensors",  "best.safetensors", "checkpoint.safetensors",
                              "learning_curve.csv", "evaluations.csv",  "speed.csv"};

std::string curve_line(const CurveRow& row) {
  const EpisodeRow& episode = row.episode;
  return fmt::format("{},{},{:.6f},{:.6f},{},{:.6f},{:.6g},{:.6g},{:.6g},{:.6g}\n", episode.episode,
                     episode.decisions, episode.reward, row.moving_average, episode.success ? 1 : 0,
                     episode.epsilon, episode.learning_rate, episode.loss, episode.td_error, episode.q);
}

}  // namespace

RunDirectory::RunDirectory(const std::filesystem::path& directory)
    : directory_(directory),
      curve_(directory / "learning_curve.csv",
             "episode,steps,reward,moving_average_250,contact,epsilon,learning_rate,loss,td_error,q\n"),
      evaluations_(directory / "evaluations.csv", "episode,mean_reward,best\n"),
      speed_(directory / "speed.csv", "episode,elapsed_s,decisions_per_s,gradient_steps_per_s\n"),
      checkpoint_(directory / "checkpoint.safetensors"),
      start_(Clock::now()) {}

std::vector<std::filesystem::path> RunDirectory::files_there() const {
  std::vector<std::filesystem::path> files;
  for (const char* name : names) {
    for (const char* suffix : {"", ".part"}) {
      const std::filesystem::path file = directory_ / (std::string(name) + suffix);
      if (std::filesystem::exists(std::filesystem::symlink_status(file))) {
        files.push_back(file);
      }
    }
  }
  return files;
}

void RunDirectory::refuse_used() const {
  throw std::runtime_error(fmt::format(
      "{}: it holds a training already ({}); add --resume to go on with it, --force to remove its "
      "files and begin anew, or choose another directory",
      directory_.string(), files_there().front().filename().string()));
}

void RunDirectory::begin(Training& training, Start start) {
  if (start == Start::fresh && !files_there().empty()) {
    refuse_used();
  }
  if (start == Start::force) {
    for (const std::filesystem::path& file : files_there()) {
      std::filesystem::remove(file);
    }
  }
  if (start == Start::resume) {
    resume(training);
  }
  curve_.reserve(training.config().run.episodes);
  decisions_ = training.decisions();
  gradient_steps_ = training.gradient_steps();
}

void RunDirectory::resume(Training& training) {
  if (!std::filesystem::exists(checkpoint_)) {
    throw std::runtime_error(fmt::format(
        "{}: no checkpoint to resume from; begin anew without --resume, with --force if it holds a "
        "training",
        directory_.string()));
  }
  training.resume(checkpoint_);
  if (training.done() && std::filesystem::exists(model_file())) {
    throw std::runtime_error(fmt::format(
        "{}: the training is complete, with {} episodes; --set run.episodes=N goes on to more, --force begins anew",
        directory_.string(), training.episodes()));
  }
  saved_episodes_ = training.episodes();
  curve_.keep(training.episodes());
  evaluations_.keep_up_to(training.episodes());
  speed_.keep_up_to(training.episodes());
  if (training.state().best_episodes > 0) {
    save_model(best_model_of(training), best_file());  // a crash may have left a later one
  }
}

void RunDirectory::add(std::span<const CurveRow> rows, const Training& training) {
  bool due = false;
  for (const CurveRow& row : rows) {
    curve_.add(curve_line(row));
    due = due || (row.episode.episode + 1) % speed_period == 0;
  }
  if (due) {
    add_speed(training);
  }
}

void RunDirectory::evaluate(Training& training) {
  const Parameters parameters = training.result();
  const double mean = validation_mean(training, parameters);
  const bool best = training.state().best_episodes == 0 || mean > training.state().best_mean;
  evaluations_.add(fmt::format("{},{:.6f},{}\n", training.episodes(), mean, best ? 1 : 0));
  if (best) {
    training.note_best(mean, parameters);
    save_model(best_model_of(training), best_file());
  }
}

void RunDirectory::save(const Training& training) {
  write_tables(training);
  training.save(checkpoint_);
  saved_episodes_ = training.episodes();
}

void RunDirectory::finish(const Training& training, const Model& model) {
  save(training);
  save_model(model, model_file());
}

std::string RunDirectory::give_up(const Divergence& divergence, const Training& training) {
  write_tables(training);
  std::string sound = saved_episodes_ > 0
                          ? fmt::format("checkpoint.safetensors is sound, of {} episodes", saved_episodes_)
                          : "there is no checkpoint";
  if (training.state().best_episodes > 0) {
    sound += fmt::format("; best.safetensors is sound, of {} episodes", training.state().best_episodes);
  }
  if (std::filesystem::exists(model_file())) {
    sound += "; model.safetensors is that of before";
  }
  const double rate = training.config().optimiser.learning_rate;
  return fmt::format(
      "{}: the training diverged: {}; no model of it was written; {}. Try a lower optimiser.learning_rate (it is "
      "{}), a lower learner.gamma or a learner.clip_norm, {}",
      directory_.string(), divergence.what(), sound, rate,
      saved_episodes_ > 0 ? "with --resume from the checkpoint or with --force from the start"
                          : "with --force");
}

void RunDirectory::write_tables(const Training& training) {
  curve_.write();
  speed_.write();
  if (training.config().run.evaluation_period > 0) {
    evaluations_.write();
  }
}

void RunDirectory::add_speed(const Training& training) {
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  speed_.add(fmt::format("{},{:.3f},{:.0f},{:.0f}\n", training.episodes(), elapsed_s,
                         static_cast<double>(training.decisions() - decisions_) / elapsed_s,
                         static_cast<double>(training.gradient_steps() - gradient_steps_) / elapsed_s));
}

}  // namespace striker::training
