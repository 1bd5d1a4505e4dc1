// SPDX-License-Identifier: Apache-2.0
// The network with the kernel that a test or benchmark is about: AVX2's where it is compiled for AVX2 and the
// weights are int16, else the one that the firmware takes.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware/policy/network.hpp"
#ifdef __AVX2__
#include "tests/policy/avx2_kernel.hpp"
#endif

namespace striker::policy {

#ifdef __AVX2__

template <const auto& policy>
using TestedKernel = std::conditional_t<std::is_same_v<typename ShapeOf<policy>::Weight, std::int16_t>,
                                        avx2::Kernel, SelectedKernel<policy>>;

template <const auto& policy>
auto tested_infer(const std::array<std::int32_t, ShapeOf<policy>::inputs>& raw) {
  if constexpr (std::is_same_v<TestedKernel<policy>, avx2::Kernel>) {
    return avx2::infer<policy>(raw);
  } else {
    return infer<policy>(raw);
  }
}

#else

template <const auto& policy>
using TestedKernel = SelectedKernel<policy>;

template <const auto& policy>
auto tested_infer(const std::array<std::int32_t, ShapeOf<policy>::inputs>& raw) {
  return infer<policy>(raw);
}

#endif

}  // namespace striker::policy
