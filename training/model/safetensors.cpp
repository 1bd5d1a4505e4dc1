// SPDX-License-Identifier: Apache-2.0
#include "training/model/safetensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "training/model/file_kind.hpp"
#include "training/model/shown.hpp"

namespace striker::training {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t length_bytes = 8;
constexpr std::size_t most_header_bytes = std::size_t{8} << 20U;  // it takes a hundred times as much as JSON
constexpr int greatest_depth = 8;                                 // of arrays and objects; the format has 3
constexpr std::size_t longest_name = 200;
constexpr const char* metadata_key = "__metadata__";

static_assert(std::endian::native == std::endian::little, "tensors are copied as they lie in memory");

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}; give a whole float32 safetensors model", file, shown(why)));
}

// That it is no safetensors file, and what it is instead if that is known.
[[noreturn]] void refuse_format(std::string_view bytes, const std::string& file, const std::string& why) {
  const std::string kind = foreign_kind(bytes);
  if (!kind.empty()) {
    throw std::runtime_error(fmt::format("{}: not safetensors, but {}", file, kind));
  }
  refuse(file, why);
}

// The header's JSON; discarded if it is none. JSON lets a name stand twice in an object, and parsers keep one of
// the two: of tensors nobody could say which is meant.
Json parse_header(std::string_view text, const std::string& file) {
  std::vector<std::set<std::string>> names;  // of the objects that are open, by depth
  std::string twice;
  const auto look = [&](int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > greatest_depth) {
      refuse(file, "the header's arrays and objects lie too deep in each other");
    }
    if (event == Json::parse_event_t::object_start) {
      names.resize(static_cast<std::size_t>(depth) + 1);
      names.back().clear();
    } else if (event == Json::parse_event_t::key) {
      const auto& name = parsed.get_ref<const std::string&>();
      if (name.size() > longest_name || shown(name) != name) {
        refuse(file, fmt::format("the header's name {} is too long, or has control characters", name));
      }
      names.resize(static_cast<std::size_t>(depth));
      if (!names.back().insert(name).second && twice.empty()) {
        twice = name;
      }
    }
    return true;
  };
  Json header = Json::parse(text, look, false);
  if (!header.is_discarded() && !twice.empty()) {
    refuse(file, fmt::format("the header names {} twice, so that it is not clear which one is meant", twice));
  }
  return header;
}

struct Place {
  Tensor tensor;
  std::size_t begin = 0;
  std::size_t end = 0;
};

Json header_of(std::string_view bytes, const std::string& file) {
  std::uint64_t length = 0;
  if (bytes.size() < length_bytes) {
    refuse_format(bytes, file, "truncated: shorter than a safetensors header");
  }
  std::memcpy(&length, bytes.data(), length_bytes);
  if (length > bytes.size() - length_bytes) {
    refuse_format(
        bytes, file,
        fmt::format("truncated or not safetensors: it begins with a header's length of {} bytes, and "
                    "has {}",
                    length, bytes.size()));
  }
  if (length > most_header_bytes) {
    refuse_format(bytes, file,
                  fmt::format("its header has {} bytes; at most {} are read", length, most_header_bytes));
  }
  Json header = parse_header(bytes.substr(length_bytes, length), file);
  if (!header.is_object()) {
    refuse_format(bytes, file, "not safetensors: the header is not a JSON object");
  }
  return header;
}

std::vector<std::size_t> sizes(const Json& entry, const char* field, const std::string& name,
                               const std::string& file) {
  std::vector<std::size_t> numbers;
  const auto found = entry.find(field);
  if (found == entry.end() || !found->is_array()) {
    refuse(file, fmt::format("tensor {} has no {}", name, field));
  }
  for (const Json& number : *found) {
    if (!number.is_number_unsigned()) {
      refuse(file, fmt::format("tensor {}: {} holds {}, not a size", name, field, number.dump()));
    }
    numbers.push_back(number.get<std::size_t>());
  }
  return numbers;
}

Place place_of(const std::string& name, const Json& entry, std::size_t data_bytes, const std::string& file) {
  const std::string dtype = entry.is_object() ? entry.value("dtype", Json()).dump() : "nothing";
  if (dtype != "\"F32\"") {
    refuse(file, fmt::format("tensor {} has dtype {}, not F32", name, dtype));
  }
  Place place{.tensor = {.name = name, .shape = sizes(entry, "shape", name, file), .values = {}}};
  const auto offsets = sizes(entry, "data_offsets", name, file);
  if (offsets.size() != 2 || offsets[0] > offsets[1] || offsets[1] > data_bytes) {
    refuse(file, fmt::format("tensor {}: its data lie outside the file (truncated?)", name));
  }
  place.begin = offsets[0];
  place.end = offsets[1];
  std::size_t bytes = sizeof(float);
  for (const std::size_t size : place.tensor.shape) {
    bytes = size > data_bytes ? data_bytes + 1 : std::min(bytes * size, data_bytes + 1);
  }
  if (bytes != place.end - place.begin) {
    refuse(file, fmt::format("tensor {}: shape [{}] does not fit its {} bytes of data", name,
                             fmt::join(place.tensor.shape, ", "), place.end - place.begin));
  }
  return place;
}

// The format allows neither overlaps nor gaps: each tensor begins where the one before it ended.
void require_contiguous(const std::vector<Place>& places, std::size_t data_bytes, const std::string& file) {
  std::size_t end = 0;
  for (const Place& place : places) {
    if (place.begin != end) {
      refuse(file, fmt::format("tensor {}: its data overlap another's or leave a gap", place.tensor.name));
    }
    end = place.end;
  }
  if (end != data_bytes) {
    refuse(file, fmt::format("{} bytes of data belong to no tensor", data_bytes - end));
  }
}

}  // namespace

std::string write_safetensors(const SafeTensors& content) {
  Json header = Json::object();
  header[metadata_key] = content.metadata;
  std::size_t offset = 0;
  for (const Tensor& tensor : content.tensors) {
    const std::size_t end = offset + tensor.values.size() * sizeof(float);
    header[tensor.name] = {{"dtype", "F32"}, {"shape", tensor.shape}, {"data_offsets", {offset, end}}};
    offset = end;
  }
  std::string text = header.dump();
  text.resize((text.size() + length_bytes - 1) / length_bytes * length_bytes, ' ');  // aligns the data
  const std::uint64_t length = text.size();
  std::string bytes(length_bytes, '\0');
  std::memcpy(bytes.data(), &length, length_bytes);
  bytes += text;
  for (const Tensor& tensor : content.tensors) {
    const std::size_t at = bytes.size();
    bytes.resize(at + tensor.values.size() * sizeof(float));
    std::memcpy(bytes.data() + at, tensor.values.data(), bytes.size() - at);
  }
  return bytes;
}

SafeTensors read_safetensors(std::string_view bytes, const std::string& file) {
  const Json header = header_of(bytes, file);
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), length_bytes);
  const std::string_view data = bytes.substr(length_bytes + length);

  SafeTensors content;
  std::vector<Place> places;
  for (const auto& [name, entry] : header.items()) {
    if (name == metadata_key) {
      for (const auto& [key, value] : entry.items()) {
        content.metadata[key] = value.is_string() ? value.get<std::string>() : value.dump();
      }
    } else {
      places.push_back(place_of(name, entry, data.size(), file));
    }
  }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  require_contiguous(places, data.size(), file);
  for (Place& place : places) {
    Tensor& tensor = place.tensor;
    tensor.values.resize((place.end - place.begin) / sizeof(float));
    std::memcpy(tensor.values.data(), data.data() + place.begin, place.end - place.begin);
    if (!std::all_of(tensor.values.begin(), tensor.values.end(), [](float v) { return std::isfinite(v); })) {
      refuse(file, fmt::format("tensor {} holds NaN or infinite values", tensor.name));
    }
    content.tensors.push_back(std::move(tensor));
  }
  return content;
}

}  // namespace striker::training
