// SPDX-License-Identifier: Apache-2.0
// The task of a model, from the configuration that it holds or is given.
#include "training/run/model_task.hpp"

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

TEST(ModelTask, IsThatOfItsConfiguration) {
  const Model without{.parameters = some_parameters(1), .metadata = {}};
  EXPECT_EQ(task_of(without, {}).inputs, rcs_inputs());
  const Config acs = parse_config("[task]\ninputs = \"acs\"\n", "f");
  const Model with{.parameters = some_parameters(1, acs.shape), .metadata = {{"configuration", acs.text}}};
  EXPECT_EQ(task_of(with, {}).inputs, acs_inputs());
  const Model stranger{.parameters = some_parameters(1, acs.shape), .metadata = {}};
  EXPECT_THROW((void)task_of(stranger, {}), std::runtime_error);
  const TemporaryDirectory directory;
  write_to(directory / "acs.toml", "[task]\ninputs = \"acs\"\n");
  EXPECT_EQ(task_of(stranger, directory / "acs.toml").inputs, acs_inputs());
}

}  // namespace
}  // namespace striker::training
