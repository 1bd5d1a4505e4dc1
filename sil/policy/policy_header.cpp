// SPDX-License-Identifier: Apache-2.0
// Reads an exported header: its one definition is made JSON, number by number, and read as that.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "firmware/host/files.hpp"
#include "sil/policy/loaded_policy.hpp"

namespace striker::sil {

namespace {

using Json = nlohmann::json;

bool is_word(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

// ".shift = 3" as "\"shift\": 3", "{{" as "[", StateElement::ball_x as "\"ball_x\"", 0x1FU as 31.
std::string json_of(std::string_view text) {
  std::string json;
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    const bool is_double = at + 1 < text.size() && text[at + 1] == letter;
    std::size_t end = at + 1;
    if (is_word(letter)) {
      end = static_cast<std::size_t>(
          std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), is_word) -
          text.begin());
      const std::string word(text.substr(at, end - at));
      const bool is_hexadecimal = word.starts_with("0x");
      const bool stays =
          std::isdigit(static_cast<unsigned char>(letter)) != 0 || word == "true" || word == "false";
      if (is_hexadecimal) {
        json += std::to_string(std::stoul(word, nullptr, 16));
      } else if (word != "StateElement") {
        json += stays ? word : '"' + word + '"';
      }
    } else if ((letter == '{' || letter == '}') && is_double) {
      json += letter == '{' ? '[' : ']';
      ++end;
    } else if (letter == ',') {
      const std::size_t next = text.find_first_not_of(" \n", end);
      json += next == std::string_view::npos || text[next] == '}' ? "" : ",";
    } else if (letter == '=') {
      json += ':';
    } else if (letter == '{' || letter == '}' || letter == '-') {
      json += letter;
    }
    at = end;
  }
  return json;
}

template <class Number>
Number whole(const Json& from) {
  const auto value = from.get<std::int64_t>();
  if (!from.is_number_integer() || value < std::numeric_limits<Number>::min() ||
      value > std::int64_t{std::numeric_limits<Number>::max()}) {
    throw std::out_of_range(fmt::format("{} is out of its type's range", from.dump()));
  }
  return static_cast<Number>(value);
}

std::vector<std::int32_t> numbers(const Json& from) {
  std::vector<std::int32_t> values;
  std::ranges::transform(from, std::back_inserter(values), whole<std::int32_t>);
  return values;
}

policy::StateElement element_named(const std::string& name) {
  for (const policy::StateElementRow& row : policy::state_elements) {
    if (row.name == name) {
      return row.element;
    }
  }
  throw std::out_of_range(fmt::format("{} is no element of this controller's state", name));
}

LoadedLayer layer_of(const Json& from) {
  LoadedLayer layer;
  std::ranges::transform(from.at("weights"), std::back_inserter(layer.weights), numbers);
  layer.biases = numbers(from.at("biases"));
  layer.shift = whole<std::uint8_t>(from.at("shift"));
  return layer;
}

constexpr std::string_view int8_suffix = ", std::int8_t";

// As the type has them: sizes of inputs and layers, golden vectors, and the weights' type.
std::string parameters_of(const LoadedPolicy& policy) {
  std::string text = std::to_string(policy.state.size());
  for (const LoadedLayer& layer : policy.layers) {
    text += fmt::format(", {}", layer.biases.size());
  }
  text += fmt::format(", {}", policy.golden_vectors.size());
  return text.append(policy.is_int8 ? int8_suffix : "");
}

// "inline constexpr Policy<PARAMETERS> NAME = BODY;" at the begin of a line (or Policy1, or Policy3); its name is empty if
// there is none.
struct Definition {
  std::vector<std::string> layers;  // as the type names them
  std::string_view parameters;
  std::string_view name;
  std::string_view body;
};

Definition find_definition(std::string_view text) {
  constexpr std::string_view begins = "\ninline constexpr Policy";
  constexpr std::size_t longest = 200;  // parameters and name
  const std::size_t begin = text.find(begins);
  if (begin == std::string_view::npos) {
    return {};
  }
  const std::string_view type = text.substr(begin + begins.size(), 2);
  const std::size_t hidden = type.starts_with("<") ? 2 : type == "1<" ? 1 : type == "3<" ? 3 : 0;
  if (hidden == 0) {
    return {};
  }
  const std::string_view rest = text.substr(text.find('<', begin) + 1);
  const std::string_view first = rest.substr(0, longest);
  const std::size_t parameters_end = first.find("> ");
  const std::size_t name_end = first.find(" = ");
  if (name_end == std::string_view::npos || parameters_end >= name_end) {
    return {};
  }
  const std::string_view name = first.substr(parameters_end + 2, name_end - parameters_end - 2);
  if (!std::ranges::all_of(name, is_word)) {
    return {};
  }
  const std::string_view body = rest.substr(name_end + 3);
  std::vector<std::string> layers;
  for (std::size_t number = 1; number <= hidden; ++number) {
    layers.push_back(fmt::format("layer{}", number));
  }
  layers.emplace_back("output");
  return {.layers = std::move(layers),
          .parameters = first.substr(0, parameters_end),
          .name = name,
          .body = body.substr(0, body.find("\n};") + 2)};
}

LoadedPolicy policy_of(const Json& from, const std::vector<std::string>& layers) {
  constexpr std::size_t fields = 8;  // beside the layers
  if (from.size() != fields + layers.size()) {
    throw std::out_of_range(fmt::format("it has {} fields, not {}", from.size(), fields + layers.size()));
  }
  LoadedPolicy policy;
  policy.identity = whole<std::uint32_t>(from.at("identity"));
  policy.configuration_hash = whole<std::uint32_t>(from.at("configuration_hash"));
  policy.decision_period_ms = whole<std::int32_t>(from.at("decision_period_ms"));
  for (const Json& input : from.at("state")) {
    policy.state.push_back({.element = element_named(input.at("element")),
                            .decisions_ago = whole<std::uint8_t>(input.at("decisions_ago"))});
  }
  policy.mirrored = from.at("mirrored");
  for (const Json& scale : from.at("input_scales")) {
    policy.input_scales.push_back({.multiplier = whole<std::int32_t>(scale.at("multiplier")),
                                   .shift = whole<std::uint8_t>(scale.at("shift"))});
  }
  for (const std::string& name : layers) {
    policy.layers.push_back(layer_of(from.at(name)));
  }
  for (const Json& point : from.at("set_points")) {
    policy.set_points.push_back({.left_mm_s = whole<std::int32_t>(point.at("left_mm_s")),
                                 .right_mm_s = whole<std::int32_t>(point.at("right_mm_s"))});
  }
  for (const Json& golden : from.at("golden_vectors")) {
    policy.golden_vectors.push_back({.raw = numbers(golden.at("raw")),
                                     .sums = numbers(golden.at("sums")),
                                     .action = whole<std::uint8_t>(golden.at("action"))});
  }
  return policy;
}

}  // namespace

LoadedPolicy read_policy_header(const std::filesystem::path& file) {
  const std::string text = host::read_file(file, host::most_text_bytes);
  const Definition found = find_definition(text);
  if (found.name.empty()) {
    throw std::runtime_error(
        fmt::format("{}: no policy is in it: give a header that striker-export wrote", file.string()));
  }
  LoadedPolicy policy;
  try {
    policy = policy_of(Json::parse(json_of(found.body)), found.layers);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("{}: it is damaged, or of another version: {:.300}", file.string(), error.what()));
  }
  policy.name = found.name;
  policy.is_int8 = found.parameters.ends_with(int8_suffix);
  if (found.parameters != parameters_of(policy)) {
    throw std::runtime_error(
        fmt::format("{}: it is Policy<{}>, which its layers do not fit: export the model again",
                    file.string(), found.parameters));
  }
  require_sound(policy, file.string());
  return policy;
}

}  // namespace striker::sil
