// SPDX-License-Identifier: Apache-2.0
// What a file is that is no safetensors file: by the first bytes of the formats that networks are saved in.
#pragma once

#include <string>
#include <string_view>

namespace striker::training {

// "a Python pickle (.pth, .pt): in Python, ..." : what it is, and how it becomes a model; empty if it is not known.
// To be asked once a file was found not to be safetensors, whose own first bytes are a length and may look like
// anything. Sources: PKWARE's APPNOTE (zip), Python's pickletools, the HDF5, NumPy, gzip and Git LFS specifications.
[[nodiscard]] std::string foreign_kind(std::string_view bytes);

}  // namespace striker::training
