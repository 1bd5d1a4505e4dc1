// SPDX-License-Identifier: Apache-2.0
// The Q network: int16 or int8 weights, int16 activations, 32-bit sums, ReLU, power-of-two rescaling, argmax.
//
//   const auto q = infer<kick>({ball_x_um, ball_y_um, ...});    // q.action, q.sums
//
// The arithmetic is the specification in firmware/policy/policy.hpp, to the bit, whatever the kernel. The
// header's proof makes overflow impossible, so no sum is checked here, and every raw input is allowed. An
// inference takes the same number of instructions for every input. Its activations are on the stack, two to
// six bytes a neuron.
//
// kernel/select.hpp picks the kernel for the target and the weights' type; kernel/kernel.hpp says what one
// is. The compiler packs the weights in the kernel's order, and only those reach the image: the header's own
// rows do not, as nothing refers to them at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "firmware/policy/kernel/argmax.hpp"
#include "firmware/policy/kernel/kernel.hpp"
#include "firmware/policy/kernel/packing.hpp"
#include "firmware/policy/kernel/scaling.hpp"
#include "firmware/policy/kernel/select.hpp"
#include "firmware/policy/policy.hpp"

namespace striker::policy {

template <std::size_t Actions>
struct QValues {
  std::array<std::int32_t, Actions> sums;  // in the output layer's scale: comparable with one another
  std::uint8_t action;                     // of the greatest sum; of equals, the lowest
};

// In all that follows, `policy` is a constant with static storage, as an exported header holds.
template <const auto& policy>
using ShapeOf = std::remove_cvref_t<decltype(policy)>;

template <const auto& policy>
using SelectedKernel = kernel::Selected<typename ShapeOf<policy>::Weight>;

template <class Kernel, std::size_t n, class Policy>
constexpr auto pack_layer(const Policy& policy) {
  const auto& layer = policy.template layer<n>();
  if constexpr (n == Policy::hidden_layers) {
    return Kernel::template pack<kernel::Role::output>(layer, layer.biases);
  } else {
    return Kernel::template pack<kernel::Role::hidden>(
        layer, Kernel::rounds ? layer.biases : kernel::rounded_biases(layer));
  }
}

// As a function, since Clang 14 crashes where the size of a variable template of undeduced type is asked.
template <class Layer>
constexpr std::size_t bytes_of(const Layer& /*layer*/) {
  return sizeof(Layer);
}

// A policy's weights in a kernel's order, layer by layer; the last one is the output's.
template <const auto& policy, class Kernel = SelectedKernel<policy>>
struct Packed {
  static constexpr std::size_t layers = ShapeOf<policy>::hidden_layers + 1;

  template <std::size_t n>
  static constexpr auto layer = pack_layer<Kernel, n>(policy);

  static constexpr std::size_t bytes = []<std::size_t... n>(std::index_sequence<n...>) {
    return (bytes_of(layer<n>) + ...);
  }
  (std::make_index_sequence<layers>{});
};

// From the activations that layer n reads to the output layer's sums. Inlined in the callers, a layer at a time.
template <const auto& policy, class Kernel, std::size_t n = 0, class Activations>
[[gnu::always_inline]] constexpr void propagate(const Activations& in,
                                                std::array<std::int32_t, ShapeOf<policy>::actions>& sums) {
  using Shape = ShapeOf<policy>;
  constexpr const auto& layer = Packed<policy, Kernel>::template layer<n>;
  if constexpr (n == Shape::hidden_layers) {
    Kernel::sums(layer, in, sums);
  } else {
    typename Kernel::template Activations<Shape::widths[n + 1]> out;
    Kernel::template hidden<policy.template layer<n>().shift>(layer, in, out);
    propagate<policy, Kernel, n + 1>(out, sums);
  }
}

// The network's answer to raw inputs, in the order and units of `policy.state`.
template <const auto& policy,
          kernel::KernelFor<typename ShapeOf<policy>::Weight> Kernel = SelectedKernel<policy>>
[[nodiscard, gnu::noinline]] constexpr auto infer(
    const std::array<std::int32_t, ShapeOf<policy>::inputs>& raw) {
  using Shape = ShapeOf<policy>;
  typename Kernel::template Activations<Shape::inputs> inputs;
  // Each input has code of its own, made for its scale: hence a list of indices in place of a loop.
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (inputs.set(i, kernel::scale_input<policy.input_scales[i]>(raw[i])), ...);
  }
  (std::make_index_sequence<Shape::inputs>{});
  QValues<Shape::actions> q;
  propagate<policy, Kernel>(inputs, q.sums);
  q.action = kernel::index_of_greatest(q.sums);
  return q;
}

}  // namespace striker::policy
