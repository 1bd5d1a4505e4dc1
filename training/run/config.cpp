#include "training/run/config.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "firmware/host/files.hpp"
#include "paper_toml.hpp"

namespace striker::training {

namespace {

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// Every key stands in the table, so that reading can only fail by the value.
class Reader {
 public:
  Reader(const toml::table& root, std::string file) : root_(root), file_(std::move(file)) {}

  void read(const std::string& key, int& value, int least, int greatest) const {
    value = whole(key, node(key), least, greatest);
  }

  void read(const std::string& key, double& value, double least, double greatest) const {
    value = number(key, node(key), least, greatest);
  }

  void read(const std::string& key, bool& value) const {
    const auto read = node(key).value_exact<bool>();
    if (!read) {
      fail(key, "must be true or false");
    }
    value = *read;
  }

  template <class Value>
  void read(const std::string& key, Value& value, const Choices<Value>& choices) const {
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

  // An array of `count` numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count, double least,
                                            double greatest) const {
    return numbers(key, node(key), count, least, greatest);
  }

  // An array of arrays of two numbers.
  [[nodiscard]] std::vector<std::vector<double>> pairs(const std::string& key, std::size_t least_count,
                                                       std::size_t greatest_count, double least,
                                                       double greatest) const {
    const toml::array* rows = node(key).as_array();
    if (rows == nullptr || rows->size() < least_count || rows->size() > greatest_count) {
      fail(key, fmt::format("must be a list of {} to {} pairs of numbers", least_count, greatest_count));
    }
    std::vector<std::vector<double>> result;
    for (const toml::node& row : *rows) {
      result.push_back(numbers(key, toml::node_view<const toml::node>(row), 2, least, greatest));
    }
    return result;
  }

  [[nodiscard]] toml::node_view<const toml::node> node(const std::string& key) const {
    return root_.at_path(key);
  }

  [[noreturn]] void fail(const std::string& key, const std::string& rule) const {
    std::ostringstream value;
    value << root_.at_path(key);
    throw std::runtime_error(fmt::format("{}: {} = {}: {}", file_, key, value.str(), rule));
  }

 private:
  using Node = toml::node_view<const toml::node>;

  int whole(const std::string& key, const Node& from, int least, int greatest) const {
    const auto read = from.value_exact<std::int64_t>();
    if (!read || *read < least || *read > greatest) {
      fail(key, fmt::format("must be a whole number from {} to {}", least, greatest));
    }
    return static_cast<int>(*read);
  }

  double number(const std::string& key, const Node& from, double least, double greatest) const {
    const auto read = from.is_number() ? from.value<double>() : std::nullopt;
    if (!read || !(*read >= least && *read <= greatest)) {
      fail(key, fmt::format("must be a number from {} to {}", least, greatest));
    }
    return *read;
  }

  std::vector<double> numbers(const std::string& key, const Node& from, std::size_t count, double least,
                              double greatest) const {
    const toml::array* array = from.as_array();
    if (array == nullptr || array->size() != count) {
      fail(key, fmt::format("must hold {} numbers from {} to {}", count, least, greatest));
    }
    std::vector<double> result;
    for (const toml::node& element : *array) {
      result.push_back(number(key, Node(element), least, greatest));
    }
    return result;
  }

  const toml::table& root_;
  std::string file_;
};

toml::table parse(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(
        fmt::format("{}: line {}: {}", file, error.source().begin.line, error.description()));
  }
}

std::vector<std::string> keys_of(const toml::table& root) {
  std::vector<std::string> keys;
  for (const auto& [name, value] : root) {
    for (const auto& [inner, ignored] : *value.as_table()) {
      keys.push_back(fmt::format("{}.{}", name.str(), inner.str()));
    }
  }
  return keys;
}

[[noreturn]] void refuse_key(const std::string& file, const std::string& key, const toml::table& known) {
  throw std::runtime_error(
      fmt::format("{}: {} is not a key of a training configuration; it may be one of: {}", file, key,
                  fmt::join(keys_of(known), ", ")));
}

// Puts the values of `from` in the place of those of `into`, which has every key that there may be.
void override_with(const toml::table& from, toml::table& into, const std::string& file) {
  for (const auto& [name, value] : from) {
    toml::table* const target = into[name.str()].as_table();
    const toml::table* const table = value.as_table();
    if (table == nullptr) {
      refuse_key(file, std::string(name.str()), into);
    }
    for (const auto& [inner, entry] : *table) {
      if (target == nullptr || !target->contains(inner.str())) {
        refuse_key(file, fmt::format("{}.{}", name.str(), inner.str()), into);
      }
      target->insert_or_assign(inner.str(), entry);
    }
  }
}

StateInput read_input(const Reader& reader, const std::string& name) {
  const auto at = name.find('@');
  const std::string element = name.substr(0, at);
  const auto elements = all_elements();
  const auto found = std::find_if(elements.begin(), elements.end(),
                                  [&element](const ElementFacts& facts) { return facts.name == element; });
  int ago = 0;
  if (at != std::string::npos) {
    const auto [end, error] = std::from_chars(name.data() + at + 1, name.data() + name.size(), ago);
    if (error != std::errc{} || end != name.data() + name.size() || ago < 1 || ago > greatest_look_back) {
      reader.fail("task.inputs", fmt::format("\"{}\": after @ stands how many decisions ago, 1 to {}", name,
                                             greatest_look_back));
    }
  }
  if (found == elements.end()) {
    reader.fail("task.inputs", fmt::format("\"{}\" is no element; paper.toml names all", name));
  }
  return {.element = static_cast<Element>(found - elements.begin()), .decisions_ago = ago};
}

StateInputs read_inputs(const Reader& reader) {
  StateInputs inputs;
  const auto node = reader.node("task.inputs");
  if (node.value_exact<std::string>() == "rcs") {
    inputs = rcs_inputs();
  } else if (node.value_exact<std::string>() == "acs") {
    inputs = acs_inputs();
  } else if (const toml::array* list = node.as_array(); list != nullptr && !list->empty()) {
    for (const toml::node& name : *list) {
      inputs.push_back(read_input(reader, name.value_exact<std::string>().value_or("")));
    }
  } else {
    reader.fail("task.inputs", "must be \"rcs\", \"acs\" or a list of element names");
  }
  int dummies = 0;
  reader.read("task.dummies", dummies, 0, 100);
  inputs.insert(inputs.end(), static_cast<std::size_t>(dummies), {.element = Element::dummy});
  return inputs;
}

EnvConfig read_task(const Reader& reader) {
  EnvConfig task;
  reader.read<World>("task.world", task.world, {{"fast", World::fast}, {"full", World::full}});
  reader.read<sil::PoseMode>("task.pose", task.pose,
                             {{"origin", sil::PoseMode::origin}, {"anywhere", sil::PoseMode::anywhere}});
  reader.read<Equations>("task.equations", task.equations,
                         {{"corrected", Equations::corrected}, {"printed", Equations::printed}});
  task.inputs = read_inputs(reader);
  reader.read("task.mirrored", task.mirrored);
  task.actions.clear();
  for (const auto& pair : reader.pairs("task.actions", 2, 16, -2.55, 2.55)) {
    task.actions.push_back({.left_m_s = pair[0], .right_m_s = pair[1]});
  }
  sil::KickRules& rules = task.rules;
  const auto speeds = reader.numbers("ball.speed_m_s", 2, 0.1, 6.0);
  if (speeds[0] > speeds[1]) {
    reader.fail("ball.speed_m_s", "must begin with the lower speed");
  }
  rules.slowest_ball_m_s = speeds[0];
  rules.fastest_ball_m_s = speeds[1];
  reader.read("ball.aim_radius_m", rules.aim_radius_m, 0.0, 2.0);
  reader.read("reward.waiting", rules.waiting_reward, -100.0, 100.0);
  reader.read("reward.angle", rules.angle_reward, -100.0, 100.0);
  reader.read("reward.speed", rules.speed_reward_s_m, -100.0, 100.0);
  reader.read<bool>("reward.contact_speed", rules.signed_speed, {{"signed", true}, {"unsigned", false}});
  reader.read<bool>("reward.contacts", rules.every_contact, {{"first", false}, {"every", true}});
  reader.read<bool>("reward.after_contact", task.goes_on, {{"end", false}, {"go on", true}});
  return task;
}

std::vector<EnvConfig> read_environments(const Reader& reader) {
  using enum Velocities;
  std::vector<Velocities> velocities;
  reader.read<std::vector<Velocities>>(
      "task.velocities", velocities,
      {{"true", {exact}}, {"estimated", {estimated}}, {"both", {exact, estimated}}});
  std::vector<EnvConfig> environments(velocities.size(), read_task(reader));
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    environments[i].velocities = velocities[i];
  }
  return environments;
}

void read_learner(const Reader& reader, LearnerConfig& learner) {
  reader.read("learner.gamma", learner.gamma, 0.0, 1.0);
  reader.read("learner.n_step", learner.n_step, 1, sil::kick_decisions);
  reader.read("learner.cut_at_exploration", learner.cut_at_exploration);
  reader.read("learner.double_dqn", learner.double_dqn);
  reader.read("learner.huber", learner.huber);
  reader.read("learner.mirror", learner.mirror);
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

Shape read_shape(const Reader& reader, const EnvConfig& task) {
  Shape shape;
  shape.inputs = static_cast<int>(task.inputs.size());
  shape.actions = static_cast<int>(task.actions.size());
  const auto hidden = reader.numbers("network.hidden", 2, 1.0, 1024.0);
  if (std::any_of(hidden.begin(), hidden.end(), [](double size) { return size != std::floor(size); })) {
    reader.fail("network.hidden", "must hold whole numbers");
  }
  shape.hidden1 = static_cast<int>(hidden[0]);
  shape.hidden2 = static_cast<int>(hidden[1]);
  reader.read("network.dueling", shape.dueling);
  return shape;
}

void require_mirror_image(const Reader& reader, const std::string& key, const EnvConfig& task) {
  if ((mirror_factors(task.inputs).array() == 0.0F).any()) {
    reader.fail(key, "the inputs hold field_ elements, which have no mirror image");
  }
}

void require_mirror_actions(const Reader& reader, const EnvConfig& task) {
  for (int action = 0; action < static_cast<int>(task.actions.size()); ++action) {
    if (mirrored_action(task.actions, action) < 0) {
      reader.fail("learner.mirror", "task.actions holds an action whose mirror image is none of them");
    }
  }
}

}  // namespace

std::string_view default_configuration() {
  return paper_toml;
}

Config parse_config(std::string_view text, const std::string& file, const std::vector<std::string>& changes) {
  toml::table root = parse(paper_toml, "paper.toml");
  override_with(parse(text, file), root, file);
  for (const std::string& change : changes) {
    override_with(parse(change, "--set " + change), root, "--set " + change);
  }
  std::ostringstream every_key;
  every_key << root << '\n';
  Config config;
  config.name = std::filesystem::path(file).stem().string();
  config.text = every_key.str();
  const Reader reader(root, file);
  reader.read("run.episodes", config.run.episodes, 1, 10'000'000);
  reader.read("run.evaluation_period", config.run.evaluation_period, 0, 10'000'000);
  reader.read("run.validation_episodes", config.run.validation_episodes, 0, 1'000'000);
  reader.read("run.checkpoint_period", config.run.checkpoint_period, 0, 10'000'000);
  config.environments = read_environments(reader);
  config.shape = read_shape(reader, config.environments.front());
  read_learner(reader, config.learner);
  if (config.environments.front().mirrored) {
    require_mirror_image(reader, "task.mirrored", config.environments.front());
  }
  if (config.learner.mirror) {
    require_mirror_image(reader, "learner.mirror", config.environments.front());
    require_mirror_actions(reader, config.environments.front());
  }
  reader.read("optimiser.learning_rate", config.optimiser.learning_rate, 1e-7, 1.0);
  reader.read("optimiser.final_fraction", config.optimiser.final_fraction, 0.0, 1.0);
  reader.read<Course>("optimiser.schedule", config.optimiser.schedule,
                      {{"linear", Course::linear}, {"cosine", Course::cosine}});
  reader.read("optimiser.averaging", config.optimiser.averaging, 0.0, 0.999999);
  reader.read("exploration.epsilon_start", config.exploration.epsilon_start, 0.0, 1.0);
  reader.read("exploration.epsilon_end", config.exploration.epsilon_end, 0.0, 1.0);
  reader.read("exploration.decay_episodes", config.exploration.decay_episodes, 1, 10'000'000);
  reader.read<Course>("exploration.schedule", config.exploration.schedule,
                      {{"linear", Course::linear}, {"exponential", Course::exponential}});
  return config;
}

Config load_config(const std::filesystem::path& file, const std::vector<std::string>& changes) {
  return parse_config(host::read_file(file), file.string(), changes);
}

}  // namespace striker::training
