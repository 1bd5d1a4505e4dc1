// SPDX-License-Identifier: Apache-2.0
// What an exported header holds: an integer Q network with everything the controller needs to trust it.
//
//   #include "firmware/policy/exported/kick.hpp"      // defines striker::policy::kick
//   const auto q = policy::infer<policy::kick>(raw);  // network.hpp
//
// The format has no number of its own: a header of another format, like one that was altered, does not
// compile. When the format changes, every committed header is exported again in the same commit.
//
// The network is Inputs -> one to three hidden layers -> Actions, fully connected, ReLU between. All arithmetic
// is integer; ">>" is the arithmetic shift (floor):
//
//   input i   a = clamp((raw_i * multiplier_i + 2^(shift_i - 1)) >> shift_i, -32767, 32767)   (64-bit product)
//   hidden j  s = bias_j + sum_i weight_ji * a_i                                              (32-bit sum)
//             a = clamp((s + 2^(shift - 1)) >> shift, 0, 32767)
//   action k  q = bias_k + sum_i weight_ki * a_i                                              (32-bit sum)
//   choice    the k of the greatest q; of equals, the lowest k
//
// `proof.hpp` proves at compile time, from the weights, that no sum can leave 32 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/policy/state_elements.hpp"

namespace striker::policy {

// One input of the network: an element as it was so many decisions ago. Before the first decision after
// arming everything was as at the first.
struct StateInput {
  StateElement element;
  std::uint8_t decisions_ago;  // 0 to greatest_look_back
};

inline constexpr std::uint8_t greatest_look_back = 4;
inline constexpr std::size_t greatest_inputs = 32;
inline constexpr std::size_t greatest_hidden_layers = 3;
inline constexpr std::int32_t decisions_a_kick = 40;

struct InputScale {
  std::int32_t multiplier;  // 0 < multiplier <= 2^20
  std::uint8_t shift;       // 1 to 40
};

template <std::size_t Inputs, std::size_t Outputs, class Weight = std::int16_t>
struct Layer {
  static_assert(std::is_same_v<Weight, std::int16_t> || std::is_same_v<Weight, std::int8_t>);
  std::array<std::array<Weight, Inputs>, Outputs> weights;
  std::array<std::int32_t, Outputs> biases;
  std::uint8_t shift;  // hidden layers: 1 to 30. The output layer: sum >> shift is Q in 1/256
};

struct WheelSetPoint {
  std::int32_t left_mm_s;
  std::int32_t right_mm_s;
};

// A raw state, what the network must answer to it, bit for bit, and the action that follows.
template <std::size_t Inputs, std::size_t Actions>
struct GoldenVector {
  std::array<std::int32_t, Inputs> raw;
  std::array<std::int32_t, Actions> sums;
  std::uint8_t action;
};

// The weights of all layers are int16, or int8 for half the flash. Hidden: the neurons of each hidden layer.
template <class WeightType, std::size_t Goldens, std::size_t Inputs, std::size_t Actions,
          std::size_t... Hidden>
struct PolicyOf {
  using Weight = WeightType;
  static constexpr std::size_t inputs = Inputs;
  static constexpr std::size_t actions = Actions;
  static constexpr std::size_t goldens = Goldens;
  static constexpr std::size_t hidden_layers = sizeof...(Hidden);
  static_assert(hidden_layers >= 1 && hidden_layers <= greatest_hidden_layers && Inputs > 0 &&
                ((Hidden > 0) && ...));
  // Of the inputs and of each hidden layer: what the next layer reads. None of a layer that there is not.
  static constexpr std::array<std::size_t, greatest_hidden_layers + 1> widths = {Inputs, Hidden...};

  std::uint32_t identity;            // of everything below: proof.hpp recomputes it
  std::uint32_t configuration_hash;  // FNV-1a (32 bits) of the training configuration's text
  std::int32_t decision_period_ms;   // the period it was trained at
  std::array<StateInput, Inputs> state;
  // The network was trained with the ball on the robot's left only. Where it is on the right (ball_y < 0) the
  // controller reads the situation as in a mirror along the heading (`changes_sign`), and swaps the wheels.
  bool mirrored;
  std::array<InputScale, Inputs> input_scales;
  Layer<widths[0], widths[1], Weight> layer1;
  Layer<widths[1], widths[2], Weight> layer2 = {};
  Layer<widths[2], widths[3], Weight> layer3 = {};
  Layer<widths[hidden_layers], Actions, Weight> output;
  std::array<WheelSetPoint, Actions> set_points;
  std::array<GoldenVector<Inputs, Actions>, Goldens> golden_vectors;

  // Of the layers that there are, from 0 upwards; layer<hidden_layers>() is the output's.
  template <std::size_t n>
  [[nodiscard]] constexpr const auto& layer() const {
    static_assert(n <= hidden_layers);
    if constexpr (n == hidden_layers) {
      return output;
    } else if constexpr (n == 0) {
      return layer1;
    } else if constexpr (n == 1) {
      return layer2;
    } else {
      return layer3;
    }
  }
};

// As headers name them: of two hidden layers, of one, and of three.
template <std::size_t Inputs, std::size_t Hidden1, std::size_t Hidden2, std::size_t Actions,
          std::size_t Goldens, class Weight = std::int16_t>
using Policy = PolicyOf<Weight, Goldens, Inputs, Actions, Hidden1, Hidden2>;

template <std::size_t Inputs, std::size_t Hidden, std::size_t Actions, std::size_t Goldens,
          class Weight = std::int16_t>
using Policy1 = PolicyOf<Weight, Goldens, Inputs, Actions, Hidden>;

template <std::size_t Inputs, std::size_t Hidden1, std::size_t Hidden2, std::size_t Hidden3,
          std::size_t Actions, std::size_t Goldens, class Weight = std::int16_t>
using Policy3 = PolicyOf<Weight, Goldens, Inputs, Actions, Hidden1, Hidden2, Hidden3>;

}  // namespace striker::policy
