// SPDX-License-Identifier: Apache-2.0
// What an ONNX file would take in memory, before it is parsed: an empty node is two bytes in a file, and some hundred
// as an object.
#pragma once

#include <cstddef>
#include <string_view>

namespace striker::training {

// The bytes of a file that are not its tensors' numbers: names, shapes, nodes, documentation. A kick network has some
// thousand of them. Parsed they take a hundred times as much at most, and the numbers as much as in the file. Of a damaged
// file those before the damage count. Cost: a pass over its fields, without their content.
[[nodiscard]] std::size_t onnx_bytes_beside_numbers(std::string_view file);

}  // namespace striker::training
