// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>

#include "sil/fault/plan/plan_file.hpp"

namespace striker::sil {

namespace {

// A basic string of TOML.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c == '"' || c == '\\' ? "\\" : "";
      result += c;
    }
  }
  return result + "\"";
}

// Enough digits that the same number is read again, and a point, so that it is one with a fraction.
std::string number(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string setup_text(const FaultSetup& setup) {
  std::string text;
  if (setup.plant) {
    text += fmt::format("plant = \"{}\"\n", name_of(*setup.plant));
  }
  if (setup.anywhere) {
    text += fmt::format("pose = \"{}\"\n", *setup.anywhere ? "anywhere" : "origin");
  }
  if (setup.seed) {
    text += fmt::format("seed = {}\n", *setup.seed);
  }
  if (setup.episode) {
    text += fmt::format("episode = {}\n", *setup.episode);
  }
  if (setup.torque_scale != 1.0) {
    text += fmt::format("torque_scale = {}\n", number(setup.torque_scale));
  }
  return text;
}

std::string fault_text(const Fault& fault) {
  const FaultKindInfo& info = info_of(fault.kind);
  const std::string_view unit = fault.absolute ? "tick" : "ms";
  std::string text = fmt::format("\n[[case.fault]]\nkind = \"{}\"\nfrom_{} = {}\nuntil_{} = {}\n", info.name,
                                 unit, fault.from_ms, unit, fault.until_ms);
  if (info.message != MessageParameter::none) {
    text += fmt::format("message = \"{}\"\n", fault.message ? message_name(*fault.message) : "all");
  }
  if (fault.kind == FaultKind::masquerade) {
    text += fmt::format("as = \"{}\"\n", message_name(fault.as));
  }
  if (info.wheel) {
    text += fmt::format("wheel = \"{}\"\n", faulty_wheel_names[static_cast<std::size_t>(fault.wheel)]);
  }
  if (info.probability.known()) {
    text += fmt::format("probability = {}\n", number(fault.probability));
  }
  if (info.count.known()) {
    text += fmt::format("count = {}\n", fault.count);
  }
  if (info.value.known()) {
    text += fmt::format("{} = {}\n", info.value_key, number(fault.value));
  }
  return text + fmt::format("stream = {}\n", fault.stream);
}

}  // namespace

std::string plan_text(const FaultPlan& plan) {
  std::string text =
      "# A plan of faults: striker-sil faults --plan FILE; sil/fault/README.md says what stands in it.\n";
  for (const FaultCase& one : plan.cases) {
    text += fmt::format("\n[[case]]\nname = {}\n{}", toml_string(one.name), setup_text(one.setup));
    for (const Fault& fault : one.faults) {
      text += fault_text(fault);
    }
  }
  return text;
}

}  // namespace striker::sil
