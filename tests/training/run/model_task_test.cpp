// SPDX-License-Identifier: Apache-2.0
// The task of a model, from the configuration that it holds or is given.
#include "training/run/model_task.hpp"

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

TEST(ModelTask, IsThatOfItsConfiguration) {
  const Model without{.parameters = some_parameters(1), .metadata = {}};
  EXPECT_EQ(task_of(without, "m", {}).inputs, rcs_inputs());
  const Config acs = parse_config("[task]\ninputs = \"acs\"\n", "f");
  const Model with{.parameters = some_parameters(1, acs.shape), .metadata = {{"configuration", acs.text}}};
  EXPECT_EQ(task_of(with, "m", {}).inputs, acs_inputs());
  const Model stranger{.parameters = some_parameters(1, acs.shape), .metadata = {}};
  EXPECT_THROW((void)task_of(stranger, "m", {}), std::runtime_error);
  const TemporaryDirectory directory;
  write_to(directory / "acs.toml", "[task]\ninputs = \"acs\"\n");
  EXPECT_EQ(task_of(stranger, "m", directory / "acs.toml").inputs, acs_inputs());
}

// The actions stay: a robot that does not reach them is refused.
TEST(ModelTask, MayBePlayedByAnotherRobot) {
  const TaskConfig own = parse_config("", "f").environments.front();
  core::RobotDescription heavier = core::forward;
  heavier.body_mass_g = 2500;
  EXPECT_EQ(with_robot(own, heavier).robot, heavier);
  EXPECT_EQ(with_robot(own, heavier).actions, own.actions);
  EXPECT_THROW((void)with_robot(own, core::goalkeeper), std::runtime_error);
}

// What a training can begin from: the widths must be the configuration's, and the task where the model names it.
TEST(ModelTask, ATrainingBeginsFromWhatFits) {
  const auto complaint = [](const Model& model, const std::string& config) {
    try {
      require_fits(model, parse_config(config, "f"), "m.safetensors");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("fits");
  };
  const Model model{.parameters = some_parameters(1), .metadata = {}};
  EXPECT_EQ(complaint(model, ""), "fits");
  EXPECT_NE(complaint(model, "[network]\nhidden = [8, 8]\n").find("m.safetensors: "), std::string::npos);
  EXPECT_NE(
      complaint(model, "[network]\nhidden = [8, 8]\n").find("is 6-64-64-3, the configuration's 6-8-8-3"),
      std::string::npos);
  EXPECT_NE(complaint(model, "[network]\ndueling = true\n").find("network.dueling"), std::string::npos);
  const Model own{.parameters = some_parameters(1),
                  .metadata = {{"configuration", parse_config("[task]\nmirrored = true\n", "f").text}}};
  EXPECT_NE(complaint(own, "").find("task.mirrored is another"), std::string::npos);
  EXPECT_EQ(complaint(own, "[task]\nmirrored = true\n"), "fits");
}

}  // namespace
}  // namespace striker::training
