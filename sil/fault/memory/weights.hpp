// SPDX-License-Identifier: Apache-2.0
// The built-in policy's packed weights as this process reads them, to be damaged: they are constants, so their
// pages are made writable first. Every controller in the process has the same ones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace striker::sil {

// Layer by layer. Throws std::runtime_error if their pages cannot be made writable.
[[nodiscard]] std::vector<std::span<std::byte>> writable_weights();

}  // namespace striker::sil
