// SPDX-License-Identifier: Apache-2.0
// Q networks as ONNX files (onnx.ai): the chain of fully connected layers that PyTorch, Keras and others write for one.
//
// Read: one input and one output; Gemm (alpha and beta 1, transB 0 or 1), or MatMul and then Add, with Relu between two
// of them; Flatten (axis 1) and Identity change nothing. Weights and biases are initialisers or constants in the file
// itself, FLOAT; an Identity of one is one. Every value has a name of its own, and what is beside the numbers has 1 MiB at
// most: an object that is two bytes in the file takes a hundred in memory (onnx_size.hpp). Source: onnx/docs/Operators.md, Gemm-13, MatMul-13; onnx.proto 1.12.
#pragma once

#include <string>
#include <string_view>

#include "training/model/safetensors.hpp"

namespace striker::training {

// The layers under the names that a safetensors file of the same network has ("0.weight" [outputs, inputs], "0.bias",
// "2.weight", ...), and the file's metadata_props. Throws std::runtime_error with one line that begins with `file`,
// names the node or tensor, and says what is read, for anything else.
[[nodiscard]] SafeTensors read_onnx(std::string_view bytes, const std::string& file);

}  // namespace striker::training
