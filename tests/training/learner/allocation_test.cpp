// SPDX-License-Identifier: Apache-2.0
// Training allocates its memory before the first episode: after that neither the learner nor its worlds,
// Eigen and ODE included, ask for more.
#include <gtest/gtest.h>

#include <cstddef>

#include "tests/training/fixtures.hpp"

namespace {
std::size_t allocations = 0;
}

// The linker sends every malloc and operator new of this program here (--wrap), and gives these names.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
void* __real_malloc(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
void* __real__Znwm(std::size_t size);
void* __wrap__Znwm(std::size_t size) {
  ++allocations;
  return __real__Znwm(size);
}
}
// NOLINTEND(bugprone-reserved-identifier)

namespace striker::training {
namespace {

TEST(Allocation, EpisodesTakeNone) {
  Config config = short_config(200);
  config.learner.prioritised = true;
  config.learner.clip_norm = 10.0;
  config.shape.dueling = true;
  config.optimiser.averaging = 0.9;
  Training training(config, 1);
  for (int i = 0; i < 50; ++i) {
    (void)training.play_round();
  }
  const std::size_t before = allocations;
  EXPECT_GT(before, 0U);
  while (!training.done()) {
    (void)training.play_round();
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace striker::training
