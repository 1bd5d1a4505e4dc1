// SPDX-License-Identifier: Apache-2.0
#include "training/run/task_reader.hpp"

#include <algorithm>
#include <charconv>

#include "firmware/core/robot_ranges.hpp"
#include "sil/world/robot_specs.hpp"

namespace striker::training {

namespace {

StateInput read_input(const TomlReader& reader, const std::string& name) {
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

StateInputs read_inputs(const TomlReader& reader) {
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

// The aimed kick is paid by sil::aimed_reward, once.
void require_no_contact_rewards(const TomlReader& reader, const TaskConfig& task) {
  const sil::KickRules& rules = task.rules;
  constexpr sil::KickRules official;
  for (const auto& [key, is_default] :
       {std::pair("reward.angle", rules.angle_reward == official.angle_reward),
        std::pair("reward.speed", rules.speed_reward_s_m == official.speed_reward_s_m),
        std::pair("reward.contact_speed", rules.signed_speed == official.signed_speed),
        std::pair("reward.contacts", rules.every_contact == official.every_contact),
        std::pair("reward.after_contact", !task.goes_on)}) {
    if (!is_default) {
      reader.fail(key, "only task.kind = \"kick\" reads it: leave it out, or change task.kind");
    }
  }
}

// The tables that only a kick has.
void read_kick(const TomlReader& reader, TaskConfig& task) {
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
  reader.read<sil::KickReward>("task.kind", rules.reward,
                               {{"kick", sil::KickReward::contact}, {"aimed", sil::KickReward::aimed}});
  if (rules.reward == sil::KickReward::aimed) {
    require_no_contact_rewards(reader, task);
  }
}

// Two numbers, the lower one first.
Range read_range(const TomlReader& reader, const std::string& key, double least, double greatest) {
  const auto ends = reader.numbers(key, 2, least, greatest);
  if (ends[0] > ends[1]) {
    reader.fail(key, "must begin with the lower number");
  }
  return {.low = ends[0], .high = ends[1]};
}

RandomiseConfig read_randomise(const TomlReader& reader) {
  RandomiseConfig randomise;
  reader.read("randomise.share", randomise.share, 0.0, 1.0);
  reader.read("randomise.ramp_episodes", randomise.ramp_episodes, 0, 10'000'000);
  randomise.mass = read_range(reader, "randomise.mass", -0.9, 9.0);
  randomise.torque = read_range(reader, "randomise.torque", -0.9, 9.0);
  randomise.friction = read_range(reader, "randomise.friction", -0.95, 9.0);
  randomise.ball_damping = read_range(reader, "randomise.ball_damping", -1.0, 9.0);
  randomise.command_delay_ms = read_range(reader, "randomise.command_delay_ms", 0.0, sil::decision_period_ms);
  randomise.vision_noise_mm = read_range(reader, "randomise.vision_noise_mm", 0.0, 100.0);
  randomise.vision_late_ms = read_range(reader, "randomise.vision_late_ms", 0.0, sil::decision_period_ms);
  return randomise;
}

TaskConfig read_task(const TomlReader& reader) {
  TaskConfig task{.robot = read_robot_table(reader)};
  reader.read<TaskKind>("task.kind", task.kind, {{"kick", TaskKind::kick}, {"aimed", TaskKind::kick}});
  reader.read<Physics>("task.world", task.physics, {{"fast", Physics::planar}, {"full", Physics::full}});
  reader.read<sil::PoseMode>("task.pose", task.pose,
                             {{"origin", sil::PoseMode::origin}, {"anywhere", sil::PoseMode::anywhere}});
  reader.read<Equations>("task.equations", task.equations,
                         {{"corrected", Equations::corrected}, {"printed", Equations::printed}});
  task.inputs = read_inputs(reader);
  reader.read("task.mirrored", task.one_sided);
  task.actions.clear();
  const double top_m_s = sil::spec_of(task.robot).max_rim_speed_m_s;
  for (const auto& pair : reader.pairs("task.actions", 2, 16, -top_m_s, top_m_s)) {
    task.actions.push_back({.left_m_s = pair[0], .right_m_s = pair[1]});
  }
  read_kick(reader, task);
  task.randomise = read_randomise(reader);
  return task;
}

void require_mirror_image(const TomlReader& reader, const std::string& key, const TaskConfig& task) {
  if ((mirror_factors(task.inputs).array() == 0.0F).any()) {
    reader.fail(key, "the inputs hold field_ elements, which have no mirror image");
  }
}

void require_mirror_actions(const TomlReader& reader, const TaskConfig& task) {
  for (int action = 0; action < static_cast<int>(task.actions.size()); ++action) {
    if (mirrored_action(task.actions, action) < 0) {
      reader.fail("learner.mirror", "task.actions holds an action whose mirror image is none of them");
    }
  }
}

}  // namespace

core::RobotDescription read_robot_table(const TomlReader& reader) {
  core::RobotDescription robot = core::forward;
  for (const core::RobotKey& key : core::robot_keys) {
    reader.read(fmt::format("robot.{}", key.name), robot.*key.member, key.least, key.greatest);
  }
  if (!core::loops_fit(core::profile_of(robot))) {
    reader.fail("robot.torque_limit_mNm",
                "with these masses and wheels the wheel loops would not fit 32 bits, or have no gain at all");
  }
  return robot;
}

std::vector<TaskConfig> read_environments(const TomlReader& reader) {
  using enum Velocities;
  std::vector<Velocities> velocities;
  reader.read<std::vector<Velocities>>(
      "task.velocities", velocities,
      {{"true", {exact}}, {"estimated", {estimated}}, {"both", {exact, estimated}}});
  std::vector<TaskConfig> environments(velocities.size(), read_task(reader));
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    environments[i].velocities = velocities[i];
  }
  return environments;
}

void require_mirror_images(const TomlReader& reader, const TaskConfig& task, bool augment_mirrored) {
  if (task.one_sided) {
    require_mirror_image(reader, "task.mirrored", task);
  }
  if (augment_mirrored) {
    require_mirror_image(reader, "learner.mirror", task);
    require_mirror_actions(reader, task);
  }
}

}  // namespace striker::training
