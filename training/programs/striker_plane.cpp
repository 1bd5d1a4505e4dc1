// SPDX-License-Identifier: Apache-2.0
// striker-plane: what a policy decides over two numbers of the relative state, in floats and in integers, beside the planner.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/command_line.hpp"
#include "firmware/host/files.hpp"
#include "firmware/host/progress.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/host/version.hpp"
#include "training/export/export.hpp"
#include "training/model/model.hpp"
#include "training/plane/plane.hpp"
#include "training/run/model_task.hpp"

namespace striker::training {

namespace {

struct Options {
  std::filesystem::path model;
  std::string network;
  std::filesystem::path config;
  std::string weights = "int16";
  std::string x = "ball_x_m=-1:3";
  std::string y = "ball_y_m=-2:2";
  std::vector<std::string> held;
  int cells = 81;
  std::filesystem::path json;
};

// What a number may be: the field's length, twice the speeds of a kick, the decisions of one.
struct Range {
  double least = 0.0;
  double greatest = 0.0;
};
constexpr std::array<Range, plane_number_names.size()> ranges = {
    {{-8.0, 8.0}, {-8.0, 8.0}, {-2.55, 2.55}, {-8.0, 8.0}, {-8.0, 8.0}, {1.0, 40.0}}};
// A ball that comes from ahead on the left, early enough.
constexpr PlaneState usual = {1.0, 0.5, 0.0, -0.5, -1.5, 30.0};

double value_in(const std::string& text, std::size_t number, const std::string& setting) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto [least, greatest] = ranges.at(number);
  if (error != std::errc{} || end != text.data() + text.size() || !(least <= value && value <= greatest)) {
    throw std::runtime_error(fmt::format("'{}': {} must be a number from {} to {}", setting,
                                         plane_number_names.at(number), least, greatest));
  }
  return value;
}

// "NAME=VALUE" as (number, value's text).
std::pair<std::size_t, std::string> split(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const auto* const name =
      std::find(plane_number_names.begin(), plane_number_names.end(), setting.substr(0, equals));
  if (equals == std::string::npos || name == plane_number_names.end()) {
    throw std::runtime_error(fmt::format("'{}': must be NAME=VALUE, where NAME is one of {}", setting,
                                         fmt::join(plane_number_names, ", ")));
  }
  return {static_cast<std::size_t>(name - plane_number_names.begin()), setting.substr(equals + 1)};
}

PlaneAxis axis_of(const std::string& setting) {
  const auto [number, range] = split(setting);
  const std::size_t colon = range.find(':');
  if (colon == std::string::npos) {
    throw std::runtime_error(fmt::format("'{}': must be NAME=FROM:TO", setting));
  }
  const PlaneAxis axis = {.number = static_cast<PlaneNumber>(number),
                          .from = value_in(range.substr(0, colon), number, setting),
                          .to = value_in(range.substr(colon + 1), number, setting)};
  if (!(axis.from < axis.to)) {
    throw std::runtime_error(fmt::format("'{}': FROM must be less than TO", setting));
  }
  return axis;
}

Plane plane_of(const Options& options) {
  Plane plane = {.x = axis_of(options.x), .y = axis_of(options.y), .held = usual, .cells = options.cells};
  if (plane.x.number == plane.y.number) {
    throw std::runtime_error("--x and --y: must be two different numbers of the state");
  }
  for (const std::string& setting : options.held) {
    const auto [number, value] = split(setting);
    plane.held.at(number) = value_in(value, number, setting);
  }
  auto& left = plane.held.at(static_cast<std::size_t>(PlaneNumber::decisions_left));
  left = std::round(left);
  return plane;
}

nlohmann::ordered_json json_of(const Plane& plane, const std::vector<PlaneCell>& cells) {
  nlohmann::ordered_json report;
  for (const auto& [key, axis] : {std::pair{"x", plane.x}, std::pair{"y", plane.y}}) {
    report[key] = {{"name", plane_number_names.at(static_cast<std::size_t>(axis.number))}};
    for (int cell = 0; cell < plane.cells; ++cell) {
      report[key]["values"].push_back(axis.at(cell, plane.cells));
    }
  }
  for (std::size_t number = 0; number < plane_number_names.size(); ++number) {
    const auto varied = static_cast<PlaneNumber>(number);
    if (varied != plane.x.number && varied != plane.y.number) {
      report["held"][std::string(plane_number_names.at(number))] = plane.held.at(number);
    }
  }
  for (const PlaneCell& cell : cells) {
    report["float_action"].push_back(cell.float_action);
    report["integer_action"].push_back(cell.integer_action);
    report["planner_action"].push_back(cell.planner_action);
    report["contact"].push_back(cell.contact);
    report["touches"].push_back(cell.touches);
    report["float_q"].push_back(cell.float_q);
    report["integer_q"].push_back(cell.integer_q);
    report["planned"].push_back(cell.planned);
  }
  return report;
}

int fill_plane(const Options& options) {
  const Plane plane = plane_of(options);
  const Model model = load_model(options.model, options.network);
  TaskConfig task = task_of(model, options.model, options.config);
  task.pose = sil::PoseMode::origin;  // the relative state is the same anywhere
  task.physics = Physics::planar;
  if (const std::string why = unfit_for_plane(task); !why.empty()) {
    throw std::runtime_error(fmt::format("{}: {}", options.model.string(), why));
  }
  const IntegerNetwork integers =
      integers_of(model, task, options.weights == "int8" ? WeightType::int8 : WeightType::int16);
  host::catch_stop_signals();
  host::ProgressLine line("row", plane.cells);
  int rows = 0;
  const auto cells = fill(plane, model.parameters, integers, task, [&] {
    if (line.due(++rows)) {
      line.show(rows, "");
    }
    return !host::stop_requested();
  });
  line.finish();
  if (host::stop_requested()) {
    fmt::print(stderr, "striker-plane: interrupted, nothing is written\n");
    return host::exit_interrupted;
  }
  nlohmann::ordered_json report = {{"policy", model_identity(model.parameters)},
                                   {"weights", options.weights}};
  report.update(json_of(plane, cells));
  host::stamp(report);
  host::write_file(options.json, report.dump() + "\n");
  const auto differ = std::count_if(cells.begin(), cells.end(), [](const PlaneCell& cell) {
    return cell.float_action != cell.integer_action;
  });
  fmt::print("{}: {} cells, float and integers differ in {}\n", options.json.string(), cells.size(), differ);
  return 0;
}

}  // namespace

}  // namespace striker::training

int main(int argc, char** argv) {
  using namespace striker::training;
  CLI::App app(
      "Asks a float network, its integers as striker-export makes them, and the planner of striker-ceiling for their\n"
      "choices over a plane of the relative state: two numbers vary, the others are held. striker-plot-policy draws\n"
      "it. What is held unless --hold says otherwise: a ball 1 m ahead and 0.5 m to the left with (-0.5, -1.5) m/s, a\n"
      "robot at rest, 30 decisions left.",
      "striker-plane");
  Options options;
  striker::host::reads_file(app.add_option("MODEL", options.model, "safetensors file"))->required();
  app.add_option("--x", options.x, "what varies to the right, in units of its name")
      ->type_name("NAME=FROM:TO")
      ->capture_default_str();
  app.add_option("--y", options.y, "what varies upwards")->type_name("NAME=FROM:TO")->capture_default_str();
  app.add_option("--hold", options.held, "holds another number of the state at this value")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app.add_option("--cells", options.cells, "along each axis, 2 to 1000")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  app.add_option("--weights", options.weights, "int16 or int8, as striker-export's")
      ->check(CLI::IsMember({"int16", "int8"}))
      ->capture_default_str();
  app.add_option(
      "--network", options.network,
      "which of several networks in the file: how its tensors' names begin, such as q_net or model");
  app.add_option("--config", options.config,
                 "the TOML file whose task it was trained for, if the model does not hold it");
  striker::host::writes_file(app.add_option("-o,--output", options.json, "the JSON file to write"))
      ->required();
  return striker::host::run(app, argc, argv, [&options] { return fill_plane(options); });
}
