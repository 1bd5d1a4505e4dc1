// SPDX-License-Identifier: Apache-2.0
// The exported header: it compiles, proves itself, and says the same twice.
#include "training/export/export.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/training/fixtures.hpp"
#include "training/export/export_report.hpp"

namespace striker::training {
namespace {

Model some_model(const Shape& shape = {}) {
  return {.parameters = some_parameters(1, shape),
          .metadata = {{"configuration_name", "test"}, {"seed", "1"}}};
}

// Twelve inputs and five actions, two of which turn.
TaskConfig another_task() {
  TaskConfig task;
  task.inputs = rcs_inputs();
  for (StateInput input : rcs_inputs()) {
    input.decisions_ago = 1;
    task.inputs.push_back(input);
  }
  task.inputs.back() = {.element = Element::decisions_left};
  task.one_sided = true;
  task.actions.push_back({.left_m_s = 2.0, .right_m_s = 1.0});
  task.actions.push_back({.left_m_s = 1.0, .right_m_s = 2.0});
  return task;
}

// Does a program with this header and these static assertions compile?
bool compiles(const std::string& header, const std::string& assertions, const TemporaryDirectory& directory) {
  write_to(directory / "policy.hpp", header);
  write_to(directory / "proof.cpp",
           "#include \"firmware/policy/proof.hpp\"\n#include \"policy.hpp\"\nusing namespace striker;\n" +
               assertions);
  const std::string command = fmt::format(
      "{} -std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Wshadow -Werror -I{} -I{} {} 2> {}",
      STRIKER_COMPILER, STRIKER_SOURCES, directory.string(), (directory / "proof.cpp").string(),
      (directory / "errors").string());
  return std::system(command.c_str()) == 0;
}

TEST(Export, TheHeaderProvesItself) {
  const TemporaryDirectory directory;
  const Model model = some_model();
  const Export exported = export_model(model, {});
  const std::string header = header_of(exported, model, "trained");
  EXPECT_TRUE(
      compiles(header,
               "static_assert(policy::sums_fit(policy::trained));\n"
               "static_assert(policy::scales_are_valid(policy::trained));\n"
               "static_assert(policy::identity_of(policy::trained) == policy::trained.identity);\n"
               "static_assert(policy::trained.goldens == 16 && policy::trained.decision_period_ms == 50);\n"
               "static_assert(policy::trained.set_points[2].right_mm_s == -2550);\n",
               directory))
      << content_of(directory / "errors");
  EXPECT_FALSE(compiles(replaced(header, ".decision_period_ms = 50", ".decision_period_ms = 51"),
                        "static_assert(policy::identity_of(policy::trained) == policy::trained.identity);\n",
                        directory));
}

TEST(Export, TheHeaderOfInt8WeightsProvesItself) {
  const TemporaryDirectory directory;
  const Model model = some_model();
  const Export exported = export_model(model, {}, WeightType::int8);
  const std::string header = header_of(exported, model, "trained");
  const std::string identity =
      "static_assert(policy::identity_of(policy::trained) == policy::trained.identity);\n";
  EXPECT_TRUE(compiles(header,
                       identity + "static_assert(policy::sums_fit(policy::trained));\n"
                                  "static_assert(policy::scales_are_valid(policy::trained));\n"
                                  "static_assert(sizeof(policy::trained.layer2.weights) == 64 * 64);\n",
                       directory))
      << content_of(directory / "errors");
  const int weight = exported.policy.network.layers[1].weights[0];
  const std::string first = ".layer2 = {\n        .weights = {{\n            {{";
  EXPECT_FALSE(compiles(replaced(header, first + std::to_string(weight), first + std::to_string(weight ^ 1)),
                        identity, directory));
  EXPECT_NE(header, header_of(export_model(model, {}), model, "trained"));
}

// Only what the file says and the weights confirm.
TEST(Export, TheHeaderClaimsOnlyWhatIsKnown) {
  Model model = some_model();
  const Export exported = export_model(model, {});
  const auto header = [&](const std::map<std::string, std::string>& metadata) {
    model.metadata = metadata;
    return header_of(exported, model, "trained");
  };
  const std::string foreign = header({});
  EXPECT_EQ(foreign.find("Trained by"), std::string::npos);
  EXPECT_EQ(foreign.find("unknown"), std::string::npos);
  EXPECT_EQ(foreign.find("Mean reward"), std::string::npos);
  EXPECT_NE(foreign.find("names no training of striker-train"), std::string::npos);
  EXPECT_NE(foreign.find(model_identity(model.parameters)), std::string::npos);
  EXPECT_EQ(foreign.find("PyTorch"), std::string::npos);
  EXPECT_NE(header({{"format", "pt"}}).find("PyTorch"), std::string::npos);
  std::map<std::string, std::string> own = {{"configuration_name", "kick"},
                                            {"seed", "3"},
                                            {"identity", model_identity(model.parameters)},
                                            {"mean_reward", "7.500"}};
  EXPECT_NE(header(own).find("// Trained by striker-train, configuration \"kick\", seed 3; the float"),
            std::string::npos);
  EXPECT_NE(header(own).find("servo plant: 7.500."), std::string::npos);
  own["identity"] = "00000000";
  EXPECT_EQ(header(own).find("Trained by"), std::string::npos);
  EXPECT_NE(header(own).find("whose weights were changed"), std::string::npos);
}

TEST(Export, IsAFunctionOfTheModel) {
  const Model model = some_model();
  const std::string header = header_of(export_model(model, {}), model, "trained");
  EXPECT_EQ(header_of(export_model(model, {}), model, "trained"), header);
  std::istringstream lines(header);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 110U) << line;
  }
}

TEST(Export, GoldenVectorsAreTheNetworksAnswersAndSaturateEveryInput) {
  const Export exported = export_model(some_model(), {});
  const auto& goldens = exported.policy.golden_vectors;
  ASSERT_EQ(goldens.size(), 16U);
  std::array<int, 6> high{};
  std::array<int, 6> low{};
  for (const GoldenVector& golden : goldens) {
    const IntegerAnswer answer = evaluate(exported.policy.network, golden.raw);
    EXPECT_EQ(answer.sums, golden.answer.sums);
    EXPECT_EQ(answer.action, golden.answer.action);
    for (std::size_t i = 0; i < high.size(); ++i) {
      const bool angle = i + 1 == high.size();
      high[i] += golden.raw[i] >= (angle ? 32767 : 100'000'000) ? 1 : 0;
      low[i] += golden.raw[i] <= (angle ? -32768 : -100'000'000) ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < high.size(); ++i) {
    EXPECT_GE(high[i], 1) << i;
    EXPECT_GE(low[i], 1) << i;
  }
}

TEST(Export, TheReportSaysWhatWasFound) {
  const Model model = some_model();
  const Export exported = export_model(model, {});
  const auto report = nlohmann::json::parse(report_of(exported, model));
  EXPECT_EQ(report.at("identity"), fmt::format("{:08x}", identity_of(exported.policy)));
  EXPECT_EQ(report.at("weights"), "int16");
  EXPECT_EQ(report.at("layers").size(), 3U);
  EXPECT_GE(report.at("clear_agreement").get<double>(), 0.995);
  EXPECT_LE(report.at("mean_regret").get<double>(), 0.01);
  const auto& reward = report.at("reward");
  const double lost = reward.at("float_mean").get<double>() - reward.at("integer_mean").get<double>();
  EXPECT_LE(std::abs(lost), 0.05 + 3.0 * reward.at("standard_error").get<double>());
  EXPECT_GT(report.at("validation_states").get<int>(), 1000);
}

TEST(Export, TheReportSaysHowFarEightBitsAgree) {
  const Model model = some_model();
  const auto report = nlohmann::json::parse(report_of(export_model(model, {}, WeightType::int8), model));
  EXPECT_EQ(report.at("weights"), "int8");
  EXPECT_GE(report.at("clear_agreement").get<double>(), 0.95);
  EXPECT_LE(report.at("mean_regret").get<double>(), 0.01);
}

// The header follows the task: its inputs, their past, its actions, the network's shape.
TEST(Export, AnotherTasksHeaderProvesItself) {
  const TemporaryDirectory directory;
  const Model model = some_model({.inputs = 12, .hidden = {32, 16}, .actions = 5});
  const std::string header = header_of(export_model(model, another_task()), model, "trained");
  EXPECT_TRUE(
      compiles(header,
               "static_assert(policy::sums_fit(policy::trained));\n"
               "static_assert(policy::scales_are_valid(policy::trained));\n"
               "static_assert(policy::inputs_are_known(policy::trained));\n"
               "static_assert(policy::identity_of(policy::trained) == policy::trained.identity);\n"
               "static_assert(policy::trained.inputs == 12 && policy::trained.widths[1] == 32);\n"
               "static_assert(policy::trained.widths[2] == 16 && policy::trained.actions == 5);\n"
               "static_assert(policy::trained.state[6].decisions_ago == 1 && policy::trained.mirrored);\n"
               "static_assert(policy::trained.state[11].element == policy::StateElement::decisions_left);\n"
               "static_assert(policy::trained.set_points[3].left_mm_s == 2000);\n"
               "static_assert(policy::trained.set_points[3].right_mm_s == 1000);\n",
               directory))
      << content_of(directory / "errors");
}

// Of one hidden layer, with weights of eight bits, and of three, one of which is as narrow as can be.
TEST(Export, HeadersOfOneAndThreeHiddenLayersProveThemselves) {
  const TemporaryDirectory directory;
  const std::string sound =
      "static_assert(policy::sums_fit(policy::trained) && policy::scales_are_valid(policy::trained));\n"
      "static_assert(policy::identity_of(policy::trained) == policy::trained.identity);\n";
  const auto expect_sound = [&](const std::vector<int>& hidden, WeightType weights, const std::string& type) {
    const Model model = some_model({.hidden = hidden});
    const std::string header = header_of(export_model(model, {}, weights), model, "trained");
    EXPECT_NE(header.find("constexpr " + type + " trained = "), std::string::npos);
    EXPECT_TRUE(compiles(header, sound, directory)) << content_of(directory / "errors");
    EXPECT_FALSE(compiles(replaced(header, ".layer1", ".layer2"), sound, directory));
  };
  expect_sound({48}, WeightType::int8, "Policy1<6, 48, 3, 16, std::int8_t>");
  expect_sound({32, 1, 20}, WeightType::int16, "Policy3<6, 32, 1, 20, 3, 16>");
}

TEST(Export, WhatTheFirmwareCannotServeIsRefused) {
  TaskConfig printed;
  printed.equations = Equations::printed;
  EXPECT_THROW((void)export_model(some_model(), printed), std::runtime_error);
  TaskConfig field;
  field.inputs = acs_inputs();
  EXPECT_THROW((void)export_model(some_model({.inputs = 10}), field), std::runtime_error);
}

std::string refusal_of(const std::string& name) {
  try {
    EXPECT_EQ(policy_name_of(name), name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(PolicyName, IsRefusedWhereCppHasAnotherMeaningForIt) {
  for (const char* name : {"kick", "kick_2", "kick_dqn", "aimed", "policy", "internal", "classes", "ints"}) {
    EXPECT_EQ(refusal_of(name), "") << name;
  }
  for (const char* name : {"int", "class", "co_await", "char8_t", "and_eq", "infer", "built_in", "kernel",
                           "linux", "two__parts"}) {
    EXPECT_NE(refusal_of(name).find("means something else already: give another one as --name"),
              std::string::npos)
        << name;
  }
}

}  // namespace
}  // namespace striker::training
