// SPDX-License-Identifier: Apache-2.0
// The kernel for the target that is being compiled for, by the compiler's own macros. All give the same bits.
//
// Without optimisation the assembly's demands on registers cannot be met: then the kernels are those in C++.
#pragma once

#include <cstdint>
#include <type_traits>

#if defined(__OPTIMIZE__) && defined(__arm__) && (__ARM_FEATURE_MVE & 1)
#include "firmware/policy/kernel/int16/helium.hpp"
#include "firmware/policy/kernel/int8/helium.hpp"
namespace striker::policy::kernel {
using SelectedInt16 = int16::Helium;
using SelectedInt8 = int8::Helium;
}  // namespace striker::policy::kernel
#elif defined(__OPTIMIZE__) && defined(__ARM_FEATURE_DSP)
#include "firmware/policy/kernel/int16/armv7em.hpp"
#include "firmware/policy/kernel/int8/armv7em.hpp"
namespace striker::policy::kernel {
using SelectedInt16 = int16::Armv7em;
using SelectedInt8 = int8::Armv7em;
}  // namespace striker::policy::kernel
#elif defined(__OPTIMIZE__) && defined(__arm__)
#include "firmware/policy/kernel/int16/armv6m_armv7m.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
namespace striker::policy::kernel {
using SelectedInt16 = int16::Armv6mArmv7m;
using SelectedInt8 = int8::Plain;
}  // namespace striker::policy::kernel
#elif defined(__SSE2__)
#include "firmware/policy/kernel/int16/x86.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
namespace striker::policy::kernel {
using SelectedInt16 = int16::Sse2;
using SelectedInt8 = int8::Plain;
}  // namespace striker::policy::kernel
#else
#include "firmware/policy/kernel/int16/portable.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
namespace striker::policy::kernel {
using SelectedInt16 = int16::Portable;
using SelectedInt8 = int8::Plain;
}  // namespace striker::policy::kernel
#endif

namespace striker::policy::kernel {

// By the type of a policy's weights.
template <class Weight>
using Selected = std::conditional_t<std::is_same_v<Weight, std::int8_t>, SelectedInt8, SelectedInt16>;

}  // namespace striker::policy::kernel
