// SPDX-License-Identifier: Apache-2.0
// Models as files: the project's own and other people's.
#include "training/model/model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "tests/training/fixtures.hpp"
#include "training/model/safetensors.hpp"

namespace striker::training {
namespace {

TEST(Model, ComesBackBitForBit) {
  const TemporaryDirectory directory;
  const Model model{.parameters = some_parameters(1), .metadata = {{"seed", "1"}}};
  save_model(model, directory / "model.safetensors");
  const Model read = load_model(directory / "model.safetensors");
  for (const std::vector<int>& hidden : {std::vector{64}, {1}, {8, 1, 10}}) {
    const Parameters parameters = some_parameters(1, {.hidden = hidden});
    save_model({.parameters = parameters, .metadata = {}}, directory / "other.safetensors");
    EXPECT_EQ(load_model(directory / "other.safetensors").parameters, parameters);
  }
  EXPECT_EQ(read.parameters, model.parameters);
  EXPECT_EQ(read.metadata, model.metadata);
  EXPECT_EQ(model_identity(read.parameters), model_identity(model.parameters));
  Parameters other = model.parameters;
  other.values(4000) = std::nextafter(other.values(4000), 1.0F);
  EXPECT_NE(model_identity(other), model_identity(model.parameters));
}

// PyTorch's layout: a row of "0.weight" holds what one neuron reads.
TEST(Model, WeightsAreNamedAndLaidOutAsInPyTorch) {
  const TemporaryDirectory directory;
  Parameters parameters({});
  parameters.weights(0)(3, 5) = 7.0F;
  parameters.biases(2)(2) = 9.0F;
  save_model({.parameters = parameters, .metadata = {}}, directory / "m");
  const SafeTensors content = read_safetensors(content_of(directory / "m"), "m");
  ASSERT_EQ(content.tensors.size(), 6U);
  EXPECT_EQ(content.tensors[0].name, "0.weight");
  EXPECT_EQ(content.tensors[0].shape, (std::vector<std::size_t>{64, 6}));
  EXPECT_EQ(content.tensors[0].values[3 * 6 + 5], 7.0F);
  EXPECT_EQ(content.tensors[5].name, "4.bias");
  EXPECT_EQ(content.tensors[5].values[2], 9.0F);
}

TEST(Model, OfAnotherShapeIsRefused) {
  const TemporaryDirectory directory;
  save_model({.parameters = some_parameters(1), .metadata = {}}, directory / "m");
  const SafeTensors good = read_safetensors(content_of(directory / "m"), "m");
  const auto complaint = [&](const SafeTensors& content) {
    write_to(directory / "bad", write_safetensors(content));
    try {
      (void)load_model(directory / "bad");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  SafeTensors missing = good;
  missing.tensors.pop_back();
  EXPECT_NE(complaint(missing).find("4.bias is missing"), std::string::npos);
  SafeTensors more = good;
  more.tensors.push_back({.name = "6.bias", .shape = {1}, .values = {0.0F}});
  EXPECT_NE(complaint(more).find("6.weight is missing"), std::string::npos);
  SafeTensors deeper = good;
  deeper.tensors.push_back({.name = "6.weight", .shape = {1, 3}, .values = {0.0F, 0.0F, 0.0F}});
  deeper.tensors.push_back({.name = "6.bias", .shape = {1}, .values = {0.0F}});
  EXPECT_EQ(complaint(deeper), "was read");  // three hidden layers
  deeper.tensors.push_back({.name = "8.weight", .shape = {1, 1}, .values = {0.0F}});
  deeper.tensors.push_back({.name = "8.bias", .shape = {1}, .values = {0.0F}});
  EXPECT_NE(complaint(deeper).find("5 layers; a kick model has one, two or three hidden layers"),
            std::string::npos);
  SafeTensors single = good;
  single.tensors.resize(2);
  EXPECT_NE(complaint(single).find("1 layer; a kick model has one, two or three hidden layers"),
            std::string::npos);
  SafeTensors two = good;
  two.tensors.push_back({.name = "b.0.weight", .shape = {1, 1}, .values = {0.0F}});
  EXPECT_NE(complaint(two).find("2 networks"), std::string::npos);
  SafeTensors stranger = good;
  stranger.tensors.push_back({.name = "optimiser", .shape = {1}, .values = {0.0F}});
  EXPECT_NE(complaint(stranger).find("tensor optimiser is no layer"), std::string::npos);
  SafeTensors turned = good;
  turned.tensors[0].shape = {6, 64};
  EXPECT_NE(complaint(turned).find("0.weight has shape [6, 64]"), std::string::npos);
}

std::string complaint_of(const std::vector<Tensor>& tensors, const std::string& network = "") {
  try {
    (void)parameters_of(tensors, "f", network);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "was read";
}

// A weight as Keras holds it, in any layer that is not square.
TEST(Model, ATransposedWeightIsCalledThat) {
  const Parameters parameters = some_parameters(1, {.inputs = 6, .hidden = {8, 10}, .actions = 3});
  for (const std::size_t at : {0U, 2U, 4U}) {
    std::vector<Tensor> tensors = tensors_of(parameters);
    std::vector<std::size_t>& shape = tensors[at].shape;
    const std::string right = fmt::format("here [{}, {}]", shape[0], shape[1]);
    std::swap(shape[0], shape[1]);
    const std::string message = complaint_of(tensors);
    EXPECT_NE(message.find("f: tensor " + tensors[at].name), std::string::npos) << message;
    EXPECT_NE(message.find("transposed"), std::string::npos) << message;
    EXPECT_NE(message.find(right), std::string::npos) << message;
  }
  std::vector<Tensor> tensors = tensors_of(parameters);
  tensors[0].shape = {4, 12};
  EXPECT_NE(complaint_of(tensors).find("[4, 12], not [8, inputs]: 0.bias has 8 values"), std::string::npos);
  tensors = tensors_of(parameters);
  tensors[1].shape = {8, 1};
  EXPECT_NE(complaint_of(tensors).find("0.bias has shape [8, 1]; a bias is a list"), std::string::npos);
}

// Several networks in a file, none of them called a target: one can be named.
TEST(Model, OneOfSeveralNetworksIsNamed) {
  const Parameters online = some_parameters(1);
  const Parameters old = some_parameters(2);
  std::vector<Tensor> tensors;
  const auto add = [&tensors](const Parameters& parameters, const std::string& prefix) {
    for (Tensor& tensor : tensors_of(parameters)) {
      tensor.name = prefix + tensor.name;
      tensors.push_back(tensor);
    }
  };
  add(online, "model.model.");
  add(old, "model_old.model.");
  const std::string message = complaint_of(tensors);
  EXPECT_NE(message.find(R"(2 networks ("model.model.", "model_old.model."))"), std::string::npos) << message;
  EXPECT_NE(message.find("--network \"model.model.\""), std::string::npos) << message;
  tensors.push_back({.name = "steps", .shape = {1}, .values = {3.0F}});
  for (const char* name : {"model", "model.", "model.model", "model.model."}) {
    EXPECT_EQ(parameters_of(tensors, "f", name), online) << name;
  }
  EXPECT_EQ(parameters_of(tensors, "f", "model_old"), old);
  EXPECT_NE(complaint_of(tensors, "mod").find("none of its networks"), std::string::npos);
  add(old, "model.other.");
  EXPECT_NE(complaint_of(tensors, "model").find("several of its networks"), std::string::npos);
  EXPECT_NE(complaint_of({}).find("no network"), std::string::npos);
}

TEST(Model, WithoutNumbersIsNotWritten) {
  const TemporaryDirectory directory;
  Parameters parameters = some_parameters(1);
  parameters.values(7) = std::nanf("");
  EXPECT_THROW(save_model({.parameters = parameters, .metadata = {}}, directory / "m"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(directory / "m"));
}

// As Stable-Baselines3 names them, target network and all; CleanRL's, whose layers count 0, 2, 4 too; and any
// order of the tensors.
TEST(Model, OtherPeoplesNamesAreRead) {
  const TemporaryDirectory directory;
  const Parameters parameters = some_parameters(1, {.inputs = 12, .hidden = {40, 24}, .actions = 5});
  const auto named = [&parameters](const std::string& prefix) {
    std::vector<Tensor> tensors = tensors_of(parameters);
    for (Tensor& tensor : tensors) {
      tensor.name = prefix + tensor.name;
    }
    std::reverse(tensors.begin(), tensors.end());
    return tensors;
  };
  for (const std::string prefix : {"q_net.q_net.", "network.", "net", ""}) {
    EXPECT_EQ(parameters_of(named(prefix), "f"), parameters) << prefix;
  }
  std::vector<Tensor> both = named("q_net.q_net.");
  for (Tensor& tensor : named("q_net_target.q_net.")) {
    tensor.values[0] += 1.0F;
    both.push_back(tensor);
  }
  EXPECT_EQ(parameters_of(both, "f"), parameters);
}

}  // namespace
}  // namespace striker::training
