// The exported header: it compiles, proves itself, and says the same twice.
#include "export.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fixtures.hpp"

namespace striker::training {
namespace {

Model some_model() {
  return {.parameters = some_parameters(1),
          .metadata = {{"configuration", "text"}, {"configuration_name", "test"}, {"seed", "1"}}};
}

// Does a program with this header and these static assertions compile?
bool compiles(const std::string& header, const std::string& assertions, const TemporaryDirectory& directory) {
  write_to(directory / "policy.hpp", header);
  write_to(
      directory / "proof.cpp",
      "#include \"core/policy_proof.hpp\"\n#include \"policy.hpp\"\nusing namespace striker;\n" + assertions);
  const std::string command = fmt::format(
      "{} -std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Wshadow -Werror -I{} -I{} {} 2> {}",
      STRIKER_COMPILER, STRIKER_FIRMWARE, directory.string(), (directory / "proof.cpp").string(),
      (directory / "errors").string());
  return std::system(command.c_str()) == 0;
}

TEST(Export, TheHeaderProvesItself) {
  const TemporaryDirectory directory;
  const Model model = some_model();
  const Export exported = export_model(model);
  const std::string header = header_of(exported, model);
  EXPECT_TRUE(
      compiles(header,
               "static_assert(core::sums_fit(policy::trained));\n"
               "static_assert(core::scales_are_valid(policy::trained));\n"
               "static_assert(core::identity_of(policy::trained) == policy::trained.identity);\n"
               "static_assert(policy::trained.goldens == 16 && policy::trained.decision_period_ms == 50);\n"
               "static_assert(policy::trained.set_points[2].right_mm_s == -2550);\n",
               directory))
      << content_of(directory / "errors");
  EXPECT_FALSE(compiles(replaced(header, ".decision_period_ms = 50", ".decision_period_ms = 51"),
                        "static_assert(core::identity_of(policy::trained) == policy::trained.identity);\n",
                        directory));
}

TEST(Export, IsAFunctionOfTheModel) {
  const Model model = some_model();
  const std::string header = header_of(export_model(model), model);
  EXPECT_EQ(header_of(export_model(model), model), header);
  std::istringstream lines(header);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 110U) << line;
  }
}

TEST(Export, GoldenVectorsAreTheNetworksAnswersAndSaturateEveryInput) {
  const Export exported = export_model(some_model());
  const auto& goldens = exported.policy.golden_vectors;
  ASSERT_EQ(goldens.size(), 16U);
  std::array<int, state_elements> high{};
  std::array<int, state_elements> low{};
  for (const GoldenVector& golden : goldens) {
    const IntegerAnswer answer = evaluate(exported.policy.network, golden.raw);
    EXPECT_EQ(answer.sums, golden.answer.sums);
    EXPECT_EQ(answer.action, golden.answer.action);
    for (std::size_t i = 0; i < state_elements; ++i) {
      const bool angle = i + 1 == state_elements;
      high[i] += golden.raw[i] >= (angle ? 32767 : 100'000'000) ? 1 : 0;
      low[i] += golden.raw[i] <= (angle ? -32768 : -100'000'000) ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < state_elements; ++i) {
    EXPECT_GE(high[i], 1) << i;
    EXPECT_GE(low[i], 1) << i;
  }
}

TEST(Export, TheReportSaysWhatWasFound) {
  const Model model = some_model();
  const Export exported = export_model(model);
  const auto report = nlohmann::json::parse(report_of(exported, model));
  EXPECT_EQ(report.at("identity"), fmt::format("{:08x}", identity_of(exported.policy)));
  EXPECT_EQ(report.at("layers").size(), 3U);
  EXPECT_GE(report.at("clear_agreement").get<double>(), 0.995);
  EXPECT_LE(report.at("mean_regret").get<double>(), 0.01);
  EXPECT_GT(report.at("validation_states").get<int>(), 1000);
}

TEST(Export, PrintedEquationsAreNotForTheFirmware) {
  Model model = some_model();
  model.metadata["equations"] = "printed";
  EXPECT_THROW((void)export_model(model), std::runtime_error);
}

}  // namespace
}  // namespace striker::training
