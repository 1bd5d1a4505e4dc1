// The quantiser: the proof holds, the ranges are kept, and the choices stay.
#include "quantise.hpp"

#include <cmath>

#include "agreement.hpp"
#include "fixtures.hpp"

namespace striker::training {
namespace {

const StateInputs inputs = rcs_inputs();

std::vector<RawState> some_states(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::vector<RawState> states;
  states.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    states.push_back(some_state(random));
  }
  return states;
}

class Quantise : public testing::TestWithParam<float> {};

// From tiny to large weights: what is proved, and what firmware/core/policy.hpp allows.
TEST_P(Quantise, FitsTheFirmwaresArithmetic) {
  const Parameters parameters = scaled(some_parameters(1), GetParam());
  const Quantised quantised = quantise(parameters, inputs, some_states(2, 500));
  for (const LayerBound& bound : bound_layers(quantised.network)) {
    EXPECT_TRUE(bound.fits());
  }
  for (const InputScale& scale : quantised.network.input_scales) {
    EXPECT_GT(scale.multiplier, 0);
    EXPECT_LE(scale.multiplier, 1 << 20);
    EXPECT_GE(scale.shift, 1);
    EXPECT_LE(scale.shift, 40);
  }
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_GE(quantised.network.layers[l].shift, l < 2 ? 1 : 0);
    EXPECT_LE(quantised.network.layers[l].shift, 30);
    EXPECT_LE(quantised.layers[l].range_used, 1.0);
    EXPECT_GE(quantised.layers[l].headroom_bits, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Weights, Quantise, testing::Values(0.2F, 0.7F, 1.0F, 1.5F));

TEST(Quantise, AgreesWithFloatOnStatesItHasNotSeen) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Parameters parameters = some_parameters(seed);
    const Quantised quantised = quantise(parameters, inputs, some_states(seed, 2000));
    Actor actor(parameters.shape());
    std::vector<Decision> decisions;
    double greatest_error = 0.0;
    for (const RawState& state : some_states(seed + 100, 2000)) {
      const IntegerAnswer answer = evaluate(quantised.network, state);
      decisions.push_back({.state = state, .action = static_cast<int>(answer.action)});
      const Eigen::VectorXf q = actor.values(parameters, features_of(inputs, state));
      for (int k = 0; k < q.size(); ++k) {
        const double integer =
            std::ldexp(answer.sums[static_cast<std::size_t>(k)], -quantised.network.layers[2].shift - 8);
        greatest_error = std::max(greatest_error, std::abs(integer - static_cast<double>(q(k))));
      }
    }
    const Agreement result = agreement(parameters, inputs, decisions);
    EXPECT_GE(result.clear_agreement, 0.995);
    EXPECT_LE(result.mean_regret, 1e-3);
    EXPECT_LT(greatest_error, 0.05);
    EXPECT_LT(quantised.layers[2].mean_error, 0.01);
  }
}

// Large weights leave few bits. Plain rounding misses Q by 0.016 here, in the mean.
TEST(Quantise, ErrorFeedbackRoundsLargeWeightsWell) {
  const Parameters parameters = scaled(some_parameters(1), 3.0F);
  const Quantised quantised = quantise(parameters, inputs, some_states(2, 2000));
  EXPECT_LT(quantised.layers[2].mean_error, 0.008);
}

TEST(Quantise, ScalesAreTheGreatestThatHold) {
  const Quantised quantised = quantise(some_parameters(1), inputs, some_states(2, 500));
  // Activations: one more bit would leave int16, with the margin; the weights: or the proof would fail.
  for (std::size_t l = 0; l < 2; ++l) {
    EXPECT_GT(2.0 * 1.1 * quantised.layers[l].range_used, 0.999);
  }
  for (const LayerReport& layer : quantised.layers) {
    EXPECT_LT(layer.headroom_bits, 1.05);
  }
}

TEST(Quantise, WeightsBeyondEveryScaleAreRefused) {
  Parameters parameters({});
  parameters.values.setConstant(1e9F);
  EXPECT_THROW((void)quantise(parameters, inputs, some_states(1, 10)), std::runtime_error);
}

}  // namespace
}  // namespace striker::training
