// SPDX-License-Identifier: Apache-2.0
// What a kernel is: the inner products of a network, written for one type of weights and one instruction set.
//
// A kernel is a struct without state. It says how activations and weights lie in memory, and how a layer is
// computed from them:
//
//   name                             what programs print, "int16/armv7em" for kernel/int16/armv7em.hpp
//   rounds                           whether hidden() adds 2^(shift - 1) by itself; else pack() gets biases
//                                    that hold it, which saves an addition a neuron
//   Activations<N>                   N activations in [-32767, 32767], as hidden() and sums() load them;
//                                    set(i, value) is called once for each i, from 0 upwards
//   pack<role>(layer, biases)        the layer in the order in which the kernel reads it: run by the compiler
//                                    alone, so that it may be slow. Most kernels pack both roles alike
//   hidden<shift>(packed, in, out)   a hidden layer: out = clamp((sum + 2^(shift - 1)) >> shift, 0, 32767)
//   sums(packed, in, out)            the output layer: its sums as they are
//
// The header's proof (firmware/policy/proof.hpp) makes overflow impossible, so no kernel checks a sum. All
// give the same bits, and the number of instructions that one takes depends on the shape alone, never on a
// number: tests/policy and tests/ports hold both.
//
// A new kernel is a header in int16/ or int8/, a branch in select.hpp, and nothing else.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "firmware/policy/policy.hpp"

namespace striker::policy::kernel {

// What a layer is packed for.
enum class Role : std::uint8_t { hidden, output };

// A kernel for layers of this type of weights, as far as the compiler can tell from one of 3 inputs and 2
// outputs.
template <class Kernel, class Weight>
concept KernelFor = requires(const Layer<3, 2, Weight>& layer, const std::array<std::int32_t, 2>& biases,
                             typename Kernel::template Activations<3>& in,
                             typename Kernel::template Activations<2>& out,
                             std::array<std::int32_t, 2>& sums) {
  { Kernel::name } -> std::convertible_to<const char*>;
  { Kernel::rounds } -> std::convertible_to<bool>;
  in.set(std::size_t{0}, std::int32_t{0});
  Kernel::template hidden<1>(Kernel::template pack<Role::hidden>(layer, biases), in, out);
  Kernel::sums(Kernel::template pack<Role::output>(layer, biases), in, sums);
};

}  // namespace striker::policy::kernel
