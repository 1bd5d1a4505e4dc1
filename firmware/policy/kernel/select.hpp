// The kernel for the target that is being compiled for, by the compiler's own macros. All give the same bits.
//
// Without optimisation the assembly's register demands cannot be met: then it is the portable one.
#pragma once

#include <cstdint>
#include <type_traits>

#if defined(__OPTIMIZE__) && defined(__arm__) && (__ARM_FEATURE_MVE & 1)
#include "firmware/policy/kernel/int16/helium.hpp"
#include "firmware/policy/kernel/int8/helium.hpp"
#elif defined(__OPTIMIZE__) && defined(__ARM_FEATURE_DSP)
#include "firmware/policy/kernel/int16/armv7em.hpp"
#include "firmware/policy/kernel/int8/armv7em.hpp"
#elif defined(__OPTIMIZE__) && defined(__arm__)
#include "firmware/policy/kernel/int16/armv6m_armv7m.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
#elif defined(__SSE2__)
#include "firmware/policy/kernel/int16/x86.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
#else
#include "firmware/policy/kernel/int16/portable.hpp"
#include "firmware/policy/kernel/int8/plain.hpp"
#endif

namespace striker::policy::kernel {

#if defined(__OPTIMIZE__) && defined(__arm__) && (__ARM_FEATURE_MVE & 1)
using Chosen = Mve;
using ChosenBytes = MveBytes;
#elif defined(__OPTIMIZE__) && defined(__ARM_FEATURE_DSP)
using Chosen = Dsp;
using ChosenBytes = DspBytes;
#elif defined(__OPTIMIZE__) && defined(__arm__)
using Chosen = Mla;
using ChosenBytes = Bytes;
#elif defined(__AVX2__)
using Chosen = Avx2;
using ChosenBytes = Bytes;
#elif defined(__SSE2__)
using Chosen = Sse2;
using ChosenBytes = Bytes;
#else
using Chosen = Portable;
using ChosenBytes = Bytes;
#endif

// By the type of a policy's weights.
template <class Weight>
using ChosenFor = std::conditional_t<std::is_same_v<Weight, std::int8_t>, ChosenBytes, Chosen>;

}  // namespace striker::policy::kernel
