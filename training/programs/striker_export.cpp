// SPDX-License-Identifier: Apache-2.0
// striker-export: quantises a model, proves that it cannot overflow, and writes the firmware's header.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "training/export/export.hpp"
#include "training/export/export_report.hpp"
#include "training/run/model_task.hpp"

namespace striker::training {

namespace {

struct Options {
  std::filesystem::path model;
  std::string network;
  std::filesystem::path config;
  std::filesystem::path header;
  std::filesystem::path report;
  std::string name;
  std::string weights = "int16";
};

// With its progress on stderr; what is wrong with the model is told with its file.
Export export_with_progress(const Options& options, const Model& model, const TaskConfig& task) {
  const WeightType weights = options.weights == "int8" ? WeightType::int8 : WeightType::int16;
  host::ProgressLine line("episode", export_episodes, 0, std::chrono::seconds(1));
  int played = 0;
  try {
    Export exported = export_model(model, task, weights, [&] {
      if (line.due(++played)) {
        line.show(played, played <= export_calibration_episodes ? "calibration" : "float against integers");
      }
    });
    line.finish();
    return exported;
  } catch (const std::runtime_error& error) {
    line.finish();
    throw std::runtime_error(fmt::format("{}: {}", options.model.string(), error.what()));
  }
}

int export_to(const Options& options) {
  const std::string name =
      policy_name_of(options.name.empty() ? options.header : std::filesystem::path(options.name));
  const Model model = load_model(options.model, options.network);
  const Export exported = export_with_progress(options, model, task_of(model, options.model, options.config));
  host::write_file(options.header, header_of(exported, model, name));
  if (!options.report.empty()) {
    host::write_file(options.report, report_of(exported, model));
  }
  const Agreement& agreement = exported.agreement;
  fmt::print("{}: identity {:08x}, {} weights\n", options.header.string(), identity_of(exported.policy),
             options.weights);
  for (std::size_t l = 0; l < exported.quantised.layers.size(); ++l) {
    const LayerReport& layer = exported.quantised.layers[l];
    fmt::print("layer {}: range used {:.1f} %, headroom {:.2f} bits, mean error {:.5f}, greatest {:.4f}\n",
               l + 1, 100.0 * layer.range_used, layer.headroom_bits, layer.mean_error, layer.greatest_error);
  }
  fmt::print("against float, {} states: agreement {}, with a Q gap above {} {}, mean regret {}\n",
             agreement.states, share_text(agreement.agreement, 4), clear_gap,
             share_text(agreement.clear_agreement, 4), share_text(agreement.mean_regret, 5));
  const RewardDifference& reward = exported.reward;
  fmt::print(
      "in play, {} episodes of the servo plant: mean reward {:.3f}, float {:.3f}, difference {:+.4f} +- {:.4f}\n",
      reward.episodes, reward.integer_mean, reward.float_mean, reward.integer_mean - reward.float_mean,
      1.96 * reward.standard_error);
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Quantises a float model to the integer network of the firmware, proves for every possible\n"
      "input that no sum leaves 32 bits, and writes it as a C++ header with golden vectors. Prints\n"
      "range, headroom and error of each layer, and how far the integer network agrees with the float.",
      "striker-export");
  Options options;
  striker::host::reads_file(app.add_option("MODEL", options.model, "safetensors file"))->required();
  striker::host::writes_file(app.add_option("-o,--output", options.header, "the header to write"))
      ->required();
  app.add_option("--name", options.name, "the policy's name in C++ (default: that of the output file)");
  app.add_option(
      "--network", options.network,
      "which of several networks in the file: how its tensors' names begin, such as q_net or model");
  app.add_option("--config", options.config,
                 "the TOML file whose task it was trained for, if the model does not hold it");
  app.add_option("--weights", options.weights, "int16, or int8: half the flash, less precise")
      ->check(CLI::IsMember({"int16", "int8"}))
      ->capture_default_str();
  striker::host::writes_file(
      app.add_option("--report", options.report, "write the figures to this JSON file"));
  return striker::host::run(app, argc, argv, [&options] { return export_to(options); });
}
