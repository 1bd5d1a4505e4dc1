// SPDX-License-Identifier: Apache-2.0
#include "training/run/training_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <stdexcept>

#include "firmware/host/files.hpp"
#include "training/run/episode_csv.hpp"
#include "training/run/evaluation.hpp"
#include "training/task/episode_numbers.hpp"

namespace striker::training {

namespace {

constexpr int speed_period = 250;  // episodes

std::string curve_line(const CurveRow& row) {
  const EpisodeRow& episode = row.episode;
  return fmt::format("{},{},{:.6f},{:.6f},{},{:.6f},{:.6g},{:.6g},{:.6g},{:.6g}\n", episode.episode,
                     episode.decisions, episode.reward, row.moving_average, episode.success ? 1 : 0,
                     episode.epsilon, episode.learning_rate, episode.loss, episode.td_error, episode.q);
}

// On episodes that neither training nor evaluation meets.
double validation_mean(const Training& training, const Parameters& parameters) {
  const Config& config = training.config();
  return mean_reward(config.environments.front(), parameters, training.seed(), first_validation_episode,
                     config.run.validation_episodes);
}

// The files of a run, and what is written to them when.
class RunDirectory {
 public:
  explicit RunDirectory(const std::filesystem::path& directory)
      : directory_(directory),
        curve_(directory / "learning_curve.csv",
               "episode,steps,reward,moving_average_250,contact,epsilon,learning_rate,loss,td_error,q\n"),
        evaluations_(directory / "evaluations.csv", "episode,mean_reward,best\n"),
        speed_(directory / "speed.csv", "episode,elapsed_s,decisions_per_s,gradient_steps_per_s\n"),
        checkpoint_(directory / "checkpoint.safetensors"),
        start_(std::chrono::steady_clock::now()) {}

  void begin(Training& training, bool resume) {
    const bool unfinished = std::filesystem::exists(checkpoint_);
    if (unfinished && !resume) {
      throw std::runtime_error(
          fmt::format("{}: it holds an unfinished training; add --resume to go on with it, "
                      "or choose another directory",
                      directory_.string()));
    }
    if (resume) {
      if (!unfinished) {
        throw std::runtime_error(fmt::format(
            "{}: no checkpoint to resume from{}", directory_.string(),
            std::filesystem::exists(directory_ / "model.safetensors") ? "; the training is complete" : ""));
      }
      training.resume(checkpoint_);
      curve_.keep(training.episodes());
      evaluations_.keep_up_to(training.episodes());
      speed_.keep_up_to(training.episodes());
      if (training.state().best_episodes > 0) {
        save_model(best_model_of(training), best_file());  // a crash may have left a later one
      }
    }
    curve_.reserve(training.config().run.episodes);
    decisions_ = training.learner().state().decisions;
    gradient_steps_ = training.learner().state().gradient_steps;
  }

  void add(const CurveRow& row, const Training& training) {
    curve_.add(curve_line(row));
    if (training.episodes() % speed_period == 0) {
      add_speed(training);
    }
  }

  void evaluate(Training& training) {
    const Parameters parameters = training.learner().result();
    const double mean = validation_mean(training, parameters);
    const bool best = training.state().best_episodes == 0 || mean > training.state().best_mean;
    evaluations_.add(fmt::format("{},{:.6f},{}\n", training.episodes(), mean, best ? 1 : 0));
    if (best) {
      training.note_best(mean, parameters);
      save_model(best_model_of(training), best_file());
    }
  }

  // Everything that resuming needs; the checkpoint last, so that what it counts on is there.
  void save(const Training& training) {
    write_tables(training);
    training.save(checkpoint_);
  }

  void finish(const Training& training, const Model& model) {
    save_model(model, directory_ / "model.safetensors");
    write_tables(training);
    if (training.done()) {
      std::filesystem::remove(checkpoint_);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::filesystem::path best_file() const { return directory_ / "best.safetensors"; }

  void write_tables(const Training& training) {
    curve_.write();
    speed_.write();
    if (training.config().run.evaluation_period > 0) {
      evaluations_.write();
    }
  }

  void add_speed(const Training& training) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const LearnerState& learner = training.learner().state();
    speed_.add(fmt::format("{},{:.3f},{:.0f},{:.0f}\n", training.episodes(), elapsed_s,
                           static_cast<double>(learner.decisions - decisions_) / elapsed_s,
                           static_cast<double>(learner.gradient_steps - gradient_steps_) / elapsed_s));
  }

  std::filesystem::path directory_;
  EpisodeCsv curve_;
  EpisodeCsv evaluations_;
  EpisodeCsv speed_;
  std::filesystem::path checkpoint_;
  Clock::time_point start_;
  std::int64_t decisions_ = 0;  // when this process began
  std::int64_t gradient_steps_ = 0;
};

bool due(int episodes, int period) {
  return period > 0 && episodes % period == 0;
}

std::map<std::string, std::string> metadata_of(const Training& training, const Parameters& parameters,
                                               int episodes) {
  return {{"configuration", training.config().text},
          {"configuration_name", training.config().name},
          {"episodes", std::to_string(episodes)},
          {"identity", model_identity(parameters)},
          {"seed", std::to_string(training.seed())}};
}

std::vector<AnyEnvironment> make_environments(const Config& config) {
  std::vector<AnyEnvironment> environments;
  for (const TaskConfig& task : config.environments) {
    environments.push_back(make_environment(task));
  }
  return environments;
}

}  // namespace

Training::Training(const Config& config, std::uint64_t seed)
    : config_(config),
      seed_(seed),
      environments_(make_environments(config)),
      learner_(setup_of(config), seed) {
  state_.recent_rewards.reserve(moving_average_span);
}

CurveRow Training::play_episode() {
  const std::uint64_t number = first_training_episode + static_cast<std::uint64_t>(state_.episodes);
  CurveRow row;
  row.episode = std::visit(
      [&](auto& env) {
        env.reset(seed_, number);
        return learner_.play(env, state_.episodes);
      },
      environments_[number % environments_.size()]);
  ++state_.episodes;
  std::vector<double>& recent = state_.recent_rewards;
  if (recent.size() == moving_average_span) {
    recent.erase(recent.begin());
  }
  recent.push_back(row.episode.reward);
  row.moving_average =
      std::accumulate(recent.begin(), recent.end(), 0.0) / static_cast<double>(recent.size());
  return row;
}

void Training::note_best(double mean, const Parameters& parameters) {
  state_.best_episodes = state_.episodes;
  state_.best_mean = mean;
  state_.best_values = parameters.values;
}

void Training::save(const std::filesystem::path& checkpoint) const {
  save_checkpoint(checkpoint, config_, seed_, learner_, state_);
}

void Training::resume(const std::filesystem::path& checkpoint) {
  state_ = load_checkpoint(checkpoint, config_, seed_, learner_);
}

Model model_of(const Training& training) {
  const Parameters parameters = training.learner().result();
  return {.parameters = parameters, .metadata = metadata_of(training, parameters, training.episodes())};
}

Model best_model_of(const Training& training) {
  const RunState& state = training.state();
  Parameters parameters = training.learner().result();
  parameters.values = state.best_values;
  Model model{.parameters = parameters, .metadata = metadata_of(training, parameters, state.best_episodes)};
  model.metadata["mean_reward"] = fmt::format("{:.3f}", state.best_mean);
  return model;
}

TrainingResult train_into(const std::filesystem::path& directory, const Config& config, std::uint64_t seed,
                          bool resume, const TrainingProgress& progress) {
  host::require_writable(directory);
  Training training(config, seed);
  RunDirectory files(directory);
  files.begin(training, resume);
  TrainingResult result;
  while (!training.done() && !result.interrupted) {
    const CurveRow row = training.play_episode();
    result.moving_average = row.moving_average;
    files.add(row, training);
    if (config.run.validation_episodes > 0 && due(training.episodes(), config.run.evaluation_period)) {
      files.evaluate(training);
    }
    result.interrupted = !progress(row) && !training.done();
    if (result.interrupted || due(training.episodes(), config.run.checkpoint_period)) {
      files.save(training);
    }
  }
  Model model = model_of(training);
  if (config.run.validation_episodes > 0 && !result.interrupted) {
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
  return result;
}

}  // namespace striker::training
