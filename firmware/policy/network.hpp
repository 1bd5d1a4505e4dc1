// The Q network: int16 or int8 weights, int16 activations, 32-bit sums, ReLU, power-of-two rescaling, argmax.
//
// The arithmetic is the specification in policy.hpp, to the bit, whatever the kernel. The header's proof
// makes overflow impossible, so no sum is checked here. The instruction count does not depend on the input:
// saturation, ReLU and argmax are masks or saturating instructions, never branches (held by tests/ports and
// tests/policy).
//
// A kernel is a struct that says how activations and weights lie in memory and how a layer is computed:
//
//   Activations<N>                   N activations, with set(i, value)
//   pack_hidden(layer), pack_output(layer)   the layer as the kernel reads it, made by the compiler
//   hidden<shift>(layer, in, out)    a hidden layer: out = clamp((sums + 2^(shift - 1)) >> shift, 0, 32767)
//   sums(layer, in, out)             the output layer
//   scale<policy>(raw, inputs)       all inputs at once, where a kernel has a better way than one by one
//
// kernel/chosen.hpp picks one for the target and the weights' type. Only the packed weights reach the image:
// the header's own rows do not, as nothing refers to them at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "firmware/policy/kernel/scaling.hpp"
#include "firmware/policy/kernel/select.hpp"
#include "firmware/policy/policy.hpp"

namespace striker::policy {

template <std::size_t Actions>
struct QValues {
  std::array<std::int32_t, Actions> sums;  // in the output layer's scale: comparable with one another
  std::uint8_t action;                     // of the greatest sum; of equals, the lowest
};

template <const auto& policy>
using ChosenKernel = kernel::ChosenFor<typename std::remove_cvref_t<decltype(policy)>::Weight>;

// A policy's weights in a kernel's order.
template <const auto& policy, class Kernel = ChosenKernel<policy>>
struct Packed {
  static constexpr auto layer1 = Kernel::pack_hidden(policy.layer1);
  static constexpr auto layer2 = Kernel::pack_hidden(policy.layer2);
  static constexpr auto output = Kernel::pack_output(policy.output);

  static constexpr std::size_t bytes = sizeof(layer1) + sizeof(layer2) + sizeof(output);
};

// `policy` is a constant with static storage, as an exported header holds.
template <const auto& policy, class Kernel = ChosenKernel<policy>>
[[nodiscard, gnu::noinline]] constexpr auto infer(
    const std::array<std::int32_t, std::remove_cvref_t<decltype(policy)>::inputs>& raw) {
  using Shape = std::remove_cvref_t<decltype(policy)>;
  using Weights = Packed<policy, Kernel>;
  typename Kernel::template Activations<Shape::inputs> inputs;
  if constexpr (requires { Kernel::template scale<policy>(raw, inputs); }) {
    Kernel::template scale<policy>(raw, inputs);
  } else {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (inputs.set(i, kernel::scale_input<policy.input_scales[i]>(raw[i])), ...);
    }
    (std::make_index_sequence<Shape::inputs>{});
  }
  typename Kernel::template Activations<Shape::hidden1> hidden1;
  typename Kernel::template Activations<Shape::hidden2> hidden2;
  Kernel::template hidden<policy.layer1.shift>(Weights::layer1, inputs, hidden1);
  Kernel::template hidden<policy.layer2.shift>(Weights::layer2, hidden1, hidden2);
  QValues<Shape::actions> q;
  Kernel::sums(Weights::output, hidden2, q.sums);
  q.action = kernel::index_of_greatest(q.sums);
  return q;
}

}  // namespace striker::policy
