// SPDX-License-Identifier: Apache-2.0
// The safetensors format (Hugging Face): 8 bytes of little-endian header length, a JSON header that gives
// each tensor's type, shape and place, then the data. float32 (F32) only: what this project reads and writes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace striker::training {

struct Tensor {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<float> values;  // row-major
};

struct SafeTensors {
  std::vector<Tensor> tensors;                  // in the order of their data
  std::map<std::string, std::string> metadata;  // the header's "__metadata__"
};

[[nodiscard]] std::string write_safetensors(const SafeTensors& content);

// Refuses with a one-line std::runtime_error that begins with `file`: a truncated file, a file of another
// format (file_kind.hpp names it), a header that is no JSON, has more than 8 MiB, lies deep in itself, names something
// twice, with control characters or at a length that no name has, or lacks a field; another
// type than F32, a shape that does not fit its data, data that overlap, leave gaps or lie outside the file,
// NaN or infinite values.
[[nodiscard]] SafeTensors read_safetensors(std::string_view bytes, const std::string& file);

}  // namespace striker::training
