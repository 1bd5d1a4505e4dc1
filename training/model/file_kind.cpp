// SPDX-License-Identifier: Apache-2.0
#include "training/model/file_kind.hpp"

#include <array>

namespace striker::training {

namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view begins;
  const char* says;
};

// A pickle begins with its protocol, 2 to 5.
constexpr std::array kinds = {
    Kind{
        "PK\x03\x04"sv,
        "a zip archive, as torch.save writes it (.pth, .pt); convert it in Python: striker.export(torch.load(FILE, "
        "weights_only=True), \"model.safetensors\"), where that is a state_dict; a Stable-Baselines3 .zip holds such a "
        "policy.pth"},
    Kind{"\x80\x02"sv, nullptr},
    Kind{"\x80\x03"sv, nullptr},
    Kind{"\x80\x04"sv, nullptr},
    Kind{"\x80\x05"sv, nullptr},
    Kind{
        "\x89HDF\r\n\x1a\n"sv,
        "an HDF5 file, as Keras writes it (.h5); save each layer's weights, transposed to [outputs, inputs], and "
        "its bias with safetensors.numpy.save_file under names like 0.weight and 0.bias"},
    Kind{
        "\x93NUMPY"sv,
        "a NumPy array; save the layers with safetensors.numpy.save_file under names like 0.weight and 0.bias"},
    Kind{"\x1f\x8b"sv, "compressed with gzip; unpack it with gunzip"},
    Kind{"version https://git-lfs"sv, "a Git LFS pointer, not the file itself; fetch it with git lfs pull"},
    Kind{"{"sv,
         "JSON text; give the weights' file, not its index or configuration (model.safetensors, not "
         "model.safetensors.index.json)"},
};

constexpr const char* pickle_says =
    "a Python pickle, as torch.save wrote it before 1.6 (.pth, .pt); convert it in Python: "
    "striker.export(torch.load(FILE, weights_only=True), \"model.safetensors\"), where that is a state_dict";

}  // namespace

std::string foreign_kind(std::string_view bytes) {
  for (const Kind& kind : kinds) {
    if (bytes.starts_with(kind.begins)) {
      return kind.says == nullptr ? pickle_says : kind.says;
    }
  }
  // The version of its format, then a field that is not 0 (as a safetensors header's length is there).
  constexpr std::size_t enough = 3;
  if (bytes.size() >= enough && bytes[0] == '\x08' && bytes[2] != '\0') {
    return "what may be an ONNX file: name it .onnx";
  }
  return {};
}

}  // namespace striker::training
