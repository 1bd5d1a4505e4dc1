// Training allocates its memory before the first episode: none of it, Eigen's included, grows with their
// number.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "dqn.hpp"
#include "fixtures.hpp"

namespace {
std::size_t allocations = 0;
}

// The linker sends every malloc of this program here (--wrap=malloc), and gives these names.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" void* __real_malloc(std::size_t size);
extern "C" void* __wrap_malloc(std::size_t size);
extern "C" void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
// NOLINTEND(bugprone-reserved-identifier)

void* operator new(std::size_t size) {
  if (void* block = std::malloc(size)) {
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

namespace striker::training {
namespace {

TEST(Allocation, TrainingTakesNoMoreForMoreEpisodes) {
  const Config config = short_config(400);
  const auto allocations_of = [&config](int episodes) {
    const std::size_t before = allocations;
    const Training training =
        train(config, 1, [episodes](const EpisodeRow& row) { return row.episode + 1 < episodes; });
    EXPECT_EQ(training.rows.size(), static_cast<std::size_t>(episodes));
    return allocations - before;
  };
  const std::size_t few = allocations_of(100);
  EXPECT_GT(few, 0U);
  EXPECT_EQ(allocations_of(400), few);
}

}  // namespace
}  // namespace striker::training
