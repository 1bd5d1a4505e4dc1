// Training allocates its memory before the first episode: none of it, Eigen's included, grows with their
// number.
#include <gtest/gtest.h>

#include <cstddef>

#include "dqn.hpp"
#include "fixtures.hpp"

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

TEST(Allocation, TrainingTakesNoMoreForMoreEpisodes) {
  const Config config = short_config(200);
  const auto allocations_of = [&config](int episodes) {
    const std::size_t before = allocations;
    const Training training =
        train(config, 1, [episodes](const EpisodeRow& row) { return row.episode + 1 < episodes; });
    EXPECT_EQ(training.rows.size(), static_cast<std::size_t>(episodes));
    return allocations - before;
  };
  const std::size_t few = allocations_of(50);
  EXPECT_GT(few, 0U);
  EXPECT_EQ(allocations_of(200), few);
}

}  // namespace
}  // namespace striker::training
