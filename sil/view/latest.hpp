// SPDX-License-Identifier: Apache-2.0
// The latest value, from one writing thread to one reading thread. Neither ever waits for the other: each has a place of
// its own, and swaps it for the third, where the latest lies. What the reader was too slow for is written over.
//
//   Latest<LiveState> latest;
//   latest.next() = state;                               // writer: any value may lie there before
//   latest.publish();
//   if (const LiveState* fresh = latest.take()) { ... }  // reader: its own until it takes again
//
// Cost: one atomic exchange each.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace striker::sil {

template <class Value>
class Latest {
 public:
  // For the writer: what the next `publish` shows.
  [[nodiscard]] Value& next() { return values_[writers_]; }
  void publish() { writers_ = middle_.exchange(writers_ | fresh, std::memory_order_acq_rel) & place; }

  // For the reader: what was published last, or nothing if it has that already.
  [[nodiscard]] const Value* take() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) == 0) {
      return nullptr;
    }
    readers_ = middle_.exchange(readers_, std::memory_order_acq_rel) & place;
    return &values_[readers_];
  }

 private:
  static constexpr std::uint32_t place = 3;
  static constexpr std::uint32_t fresh = 4;
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

  std::array<Value, 3> values_ = {};
  std::uint32_t writers_ = 0;
  std::uint32_t readers_ = 1;
  alignas(64) std::atomic<std::uint32_t> middle_ = 2;
};

}  // namespace striker::sil
