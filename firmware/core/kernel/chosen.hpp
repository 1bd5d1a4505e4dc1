// The kernel for the target that is being compiled for, by the compiler's own macros. All give the same bits.
//
// Without optimisation the assembly's register demands cannot be met: then it is the portable one.
#pragma once

#if defined(__OPTIMIZE__) && defined(__arm__) && (__ARM_FEATURE_MVE & 1)
#include "core/kernel/mve.hpp"
#elif defined(__OPTIMIZE__) && defined(__ARM_FEATURE_DSP)
#include "core/kernel/dsp.hpp"
#elif defined(__OPTIMIZE__) && defined(__arm__)
#include "core/kernel/mla.hpp"
#elif defined(__SSE2__)
#include "core/kernel/x86.hpp"
#else
#include "core/kernel/portable.hpp"
#endif

namespace striker::core::kernel {

#if defined(__OPTIMIZE__) && defined(__arm__) && (__ARM_FEATURE_MVE & 1)
using Chosen = Mve;
#elif defined(__OPTIMIZE__) && defined(__ARM_FEATURE_DSP)
using Chosen = Dsp;
#elif defined(__OPTIMIZE__) && defined(__arm__)
using Chosen = Mla;
#elif defined(__AVX2__)
using Chosen = Avx2;
#elif defined(__SSE2__)
using Chosen = Sse2;
#else
using Chosen = Portable;
#endif

}  // namespace striker::core::kernel
