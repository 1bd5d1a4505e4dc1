// SPDX-License-Identifier: Apache-2.0
#include "training/model/onnx_size.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace striker::training {

namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

enum class Part : std::uint8_t { model, graph, node, attribute, tensor, numbers };

struct Field {
  Part of;
  int number;
  Part holds;
};

// Where a tensor's numbers are: float_data and raw_data, of initialisers and of constants. Source: onnx.proto 1.12.
constexpr std::array<Field, 7> fields = {{{Part::model, 7, Part::graph},
                                          {Part::graph, 1, Part::node},
                                          {Part::graph, 5, Part::tensor},
                                          {Part::node, 5, Part::attribute},
                                          {Part::attribute, 5, Part::tensor},
                                          {Part::tensor, 4, Part::numbers},
                                          {Part::tensor, 9, Part::numbers}}};

std::size_t bytes_of_numbers(std::string_view message, Part part) {
  if (part == Part::numbers) {
    return message.size();
  }
  CodedInputStream stream(reinterpret_cast<const std::uint8_t*>(message.data()),
                          static_cast<int>(message.size()));
  std::size_t numbers = 0;
  for (std::uint32_t tag = stream.ReadTag(); tag != 0; tag = stream.ReadTag()) {
    const bool has_length = WireFormatLite::GetTagWireType(tag) == WireFormatLite::WIRETYPE_LENGTH_DELIMITED;
    if (!has_length) {
      if (!WireFormatLite::SkipField(&stream, tag)) {
        break;
      }
      continue;
    }
    std::uint32_t length = 0;
    if (!stream.ReadVarint32(&length)) {
      break;
    }
    const auto at = static_cast<std::size_t>(stream.CurrentPosition());
    const int number = WireFormatLite::GetTagFieldNumber(tag);
    const auto* const field = std::ranges::find_if(
        fields, [&](const Field& known) { return known.of == part && known.number == number; });
    if (field != fields.end()) {
      numbers += bytes_of_numbers(message.substr(at, length), field->holds);
    }
    if (length > message.size() - at || !stream.Skip(static_cast<int>(length))) {
      break;
    }
  }
  return numbers;
}

}  // namespace

std::size_t onnx_bytes_beside_numbers(std::string_view file) {
  return file.size() - bytes_of_numbers(file, Part::model);
}

}  // namespace striker::training
