// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/view/view_options.hpp"

#include <fmt/format.h>

#include <charconv>

#include "sil/view/command.hpp"

namespace striker::sil {

namespace {

std::optional<double> number_in(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_right = error == std::errc() && end == text.data() + text.size() &&
                        number >= least_view_speed && number <= greatest_view_speed;
  return is_right ? std::optional(number) : std::nullopt;
}

std::string speed_problem(const std::string& text) {
  return text == "max" || number_in(text) ? std::string()
                                          : fmt::format("'{}' is no speed: {} to {} times real time, or max",
                                                        text, least_view_speed, greatest_view_speed);
}

}  // namespace

void define_view(CLI::App& command, ViewOptions& options) {
  auto* const view = command.add_option(
      "--view", options.port,
      "a live page for a browser on this machine, on this port or any that is free; prints its address");
  view->expected(0, 1)->default_str("0")->type_name("[PORT]");
  command
      .add_option(
          "--view-bind", options.bind,
          "with --view: the address that is listened on; beyond 127.0.0.1 others see the page and its token")
      ->needs(view)
      ->capture_default_str();
  command
      .add_option("--view-speed", options.speed,
                  "with --view: times real time to begin with, 0.1 to 1000, or max")
      ->check(CLI::Validator(speed_problem, "X|max"))
      ->needs(view)
      ->capture_default_str();
}

double speed_of(const ViewOptions& options) {
  return options.speed == "max" ? 0.0 : number_in(options.speed).value_or(1.0);
}

}  // namespace striker::sil
