// SPDX-License-Identifier: Apache-2.0
// Activations in memory, for kernels that read them in words or vectors, or by assembly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace striker::policy::kernel {

// Room for activations in words of their own, or two in a word, as the kernel says. LDRD and LDM read it.
template <std::size_t Words>
struct alignas(8) WordBuffer {
  std::array<std::uint32_t, Words> words;
};

// Makes the compiler finish its stores to a buffer, before assembly or loads of another width read it. It
// costs no instruction.
template <class Buffer>
[[gnu::always_inline]] inline void finish_stores(const Buffer& buffer) {
  asm volatile("" : : "r"(&buffer) : "memory");
}

}  // namespace striker::policy::kernel
