#include "config.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "files.hpp"

namespace striker::training {

namespace {

// Reads each field once, checks it, and in the end refuses what nobody asked for.
class Reader {
 public:
  Reader(const toml::table& root, std::string file) : root_(root), file_(std::move(file)) {}

  void integer(const std::string& key, int& value, int least, int greatest) {
    const auto number = node(key).value_exact<std::int64_t>();
    if (!number || *number < least || *number > greatest) {
      fail(key, fmt::format("must be a whole number from {} to {}", least, greatest));
    }
    value = static_cast<int>(*number);
  }

  void number(const std::string& key, double& value, double least, double greatest) {
    const auto read = node(key).is_number() ? node(key).value<double>() : std::nullopt;
    if (!read || !(*read >= least && *read <= greatest)) {
      fail(key, fmt::format("must be a number from {} to {}", least, greatest));
    }
    value = *read;
  }

  void boolean(const std::string& key, bool& value) {
    const auto read = node(key).value_exact<bool>();
    if (!read) {
      fail(key, "must be true or false");
    }
    value = *read;
  }

  template <class Value>
  void choice(const std::string& key, Value& value,
              const std::vector<std::pair<std::string, Value>>& choices) {
    const auto read = node(key).value_exact<std::string>();
    std::string names;
    for (const auto& [name, choice_value] : choices) {
      if (read == name) {
        value = choice_value;
        return;
      }
      names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", name);
    }
    fail(key, "must be " + names);
  }

  void refuse_unknown() const {
    for (const auto& [name, value] : root_) {
      const toml::table* table = value.as_table();
      if (table == nullptr) {
        require_known(std::string(name.str()));
        continue;
      }
      for (const auto& [inner, ignored] : *table) {
        require_known(fmt::format("{}.{}", name.str(), inner.str()));
      }
    }
  }

 private:
  toml::node_view<const toml::node> node(const std::string& key) {
    known_.insert(key);
    const auto found = root_.at_path(key);
    if (!found) {
      throw std::runtime_error(
          fmt::format("{}: {} is missing; training/configs/paper.toml sets every key", file_, key));
    }
    return found;
  }

  [[noreturn]] void fail(const std::string& key, const std::string& rule) const {
    std::ostringstream value;
    value << root_.at_path(key);
    throw std::runtime_error(fmt::format("{}: {} = {}: {}", file_, key, value.str(), rule));
  }

  void require_known(const std::string& key) const {
    if (!known_.contains(key)) {
      throw std::runtime_error(
          fmt::format("{}: {} is not a key of a training configuration; it may be one of: {}", file_, key,
                      fmt::join(known_, ", ")));
    }
  }

  const toml::table& root_;
  std::string file_;
  std::set<std::string> known_;
};

std::vector<EnvConfig> read_environments(Reader& reader) {
  using enum Velocities;
  std::vector<Velocities> velocities;
  Equations equations = Equations::corrected;
  reader.choice<std::vector<Velocities>>(
      "task.velocities", velocities,
      {{"true", {exact}}, {"estimated", {estimated}}, {"both", {exact, estimated}}});
  reader.choice<Equations>("task.equations", equations,
                           {{"corrected", Equations::corrected}, {"printed", Equations::printed}});
  std::vector<EnvConfig> environments;
  environments.reserve(velocities.size());
  for (const Velocities choice : velocities) {
    environments.push_back({.velocities = choice, .equations = equations});
  }
  return environments;
}

void read_learner(Reader& reader, LearnerConfig& learner) {
  reader.number("learner.gamma", learner.gamma, 0.0, 1.0);
  reader.integer("learner.n_step", learner.n_step, 1, sil::kick_decisions);
  reader.boolean("learner.double_dqn", learner.double_dqn);
  reader.boolean("learner.huber", learner.huber);
  reader.boolean("learner.mirror", learner.mirror);
  reader.integer("learner.batch", learner.batch, 2, 4096);
  reader.integer("learner.replay_size", learner.replay_size, 1, 10'000'000);
  reader.integer("learner.warm_up", learner.warm_up, 1, 10'000'000);
  reader.integer("learner.target_period", learner.target_period, 1, 1'000'000);
  reader.integer("learner.gradient_steps", learner.gradient_steps, 0, 100);
}

}  // namespace

Config parse_config(std::string_view text, const std::string& file) {
  toml::table root;
  try {
    root = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(
        fmt::format("{}: line {}: {}", file, error.source().begin.line, error.description()));
  }
  Config config;
  config.name = std::filesystem::path(file).stem().string();
  config.text = text;
  Reader reader(root, file);
  reader.integer("run.episodes", config.episodes, 1, 10'000'000);
  reader.integer("run.validation_episodes", config.validation_episodes, 0, 1'000'000);
  config.environments = read_environments(reader);
  read_learner(reader, config.learner);
  reader.number("optimiser.learning_rate", config.optimiser.learning_rate, 1e-7, 1.0);
  reader.number("optimiser.final_fraction", config.optimiser.final_fraction, 0.0, 1.0);
  reader.number("exploration.epsilon_start", config.exploration.epsilon_start, 0.0, 1.0);
  reader.number("exploration.epsilon_end", config.exploration.epsilon_end, 0.0, 1.0);
  reader.integer("exploration.decay_episodes", config.exploration.decay_episodes, 1, 10'000'000);
  reader.refuse_unknown();
  return config;
}

Config load_config(const std::filesystem::path& file) {
  return parse_config(read_file(file), file.string());
}

}  // namespace striker::training
