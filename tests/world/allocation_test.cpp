// SPDX-License-Identifier: Apache-2.0
// A step allocates nothing once the world is warm: neither through operator new nor through ODE.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cstdlib>
#include <new>

#include "sil/world/planar_world.hpp"
#include "tests/world/match/drivers.hpp"
#include "tests/world/play.hpp"

namespace {

std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  return std::malloc(size);
}

void* counted_again(void* block, std::size_t /*old_size*/, std::size_t size) {
  ++allocations;
  return std::realloc(block, size);
}

void give_back(void* block, std::size_t /*size*/) {
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* block = counted(size)) {
    return block;
  }
  throw std::bad_alloc();
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t /*size*/) noexcept {
  std::free(block);
}

namespace striker::sil {
namespace {

template <typename AnyWorld>
void expect_none_when_warm(AnyWorld world) {
  const auto episodes = [&world](std::uint64_t first) {
    for (std::uint64_t i = first; i < first + 50; ++i) {
      KickEpisode episode;
      episode.begin(world, draw_kick(1, i, PoseMode::anywhere));
      drive_straight(world, 2.55);
      for (int step = 0; step < 200; ++step) {
        episode.step(world);
      }
    }
  };
  episodes(0);
  EXPECT_GT(allocations, 0U);
  allocations = 0;
  episodes(50);
  EXPECT_EQ(allocations, 0U);
}

void count_odes_too() {
  dSetAllocHandler(counted);
  dSetReallocHandler(counted_again);
  dSetFreeHandler(give_back);
}

TEST(Allocation, AWarmWorldStepsWithoutAny) {
  count_odes_too();
  expect_none_when_warm(World(kick_world(0.010)));
  expect_none_when_warm(PlanarWorld(0.010));
}

TEST(Allocation, AMatchStepsWithoutAnyAfterItsFirstSecond) {
  count_odes_too();
  const WorldConfig config = match_world(0.010);
  World world(config);
  run(world, 1.0);
  EXPECT_GT(allocations, 0U);
  allocations = 0;
  place_for_corner(world);
  press(world, config, 1.6, 1.0);
  press(world, config, -1.0, 1.0);
  EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace striker::sil
