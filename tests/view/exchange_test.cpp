// SPDX-License-Identifier: Apache-2.0
// What crosses between the run and the server: whole, the latest, in order, and nobody waits.
#include "sil/view/exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>

namespace striker::sil {
namespace {

using Page = std::array<std::uint64_t, 512>;

TEST(Latest, HasNothingUntilSomethingIsPublished) {
  Latest<int> latest;
  EXPECT_EQ(latest.take(), nullptr);
  latest.next() = 7;
  EXPECT_EQ(latest.take(), nullptr);
  latest.publish();
  ASSERT_NE(latest.take(), nullptr);
  EXPECT_EQ(latest.take(), nullptr) << "the same is taken once";
}

TEST(Latest, ShowsTheLastOfManyThatNobodyTook) {
  Latest<int> latest;
  for (int i = 0; i <= 100; ++i) {
    latest.next() = i;
    latest.publish();
  }
  const int* taken = latest.take();
  ASSERT_NE(taken, nullptr);
  EXPECT_EQ(*taken, 100);
}

TEST(Latest, WhatWasTakenStaysUntilTheNextIsTaken) {
  Latest<int> latest;
  latest.next() = 1;
  latest.publish();
  const int* taken = latest.take();
  for (int i = 2; i < 20; ++i) {
    latest.next() = i;
    latest.publish();
    ASSERT_EQ(*taken, 1);
  }
}

TEST(Latest, IsNeverTornBetweenTwoThreadsAndNeverGoesBack) {
  Latest<Page> latest;
  constexpr std::uint64_t last = 100'000;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= last; ++i) {
      latest.next().fill(i);
      latest.publish();
    }
  });
  std::uint64_t seen = 0;
  bool is_whole = true;
  bool rises = true;
  while (seen != last) {
    const Page* page = latest.take();
    if (page == nullptr) {
      std::this_thread::yield();
      continue;
    }
    is_whole = is_whole && std::ranges::all_of(*page, [&](auto value) { return value == page->front(); });
    rises = rises && page->front() > seen;
    seen = page->front();
  }
  writer.join();
  EXPECT_TRUE(is_whole);
  EXPECT_TRUE(rises);
}

TEST(CommandQueue, GivesWhatWasPutInItsOrderAndRefusesWhatHasNoRoom) {
  CommandQueue queue;
  EXPECT_FALSE(queue.take());
  std::uint64_t put = 0;
  while (queue.put({.seed = put})) {
    ++put;
    ASSERT_LE(put, 1000U) << "it has no end";
  }
  EXPECT_GE(put, 40U) << "as many as one viewer may send at once";
  for (std::uint64_t i = 0; i < put; ++i) {
    EXPECT_EQ(queue.take().value().seed, i);
  }
  EXPECT_FALSE(queue.take());
  EXPECT_TRUE(queue.put({.seed = put}));
  EXPECT_EQ(queue.take().value().seed, put);
}

TEST(CommandQueue, LosesNothingBetweenTwoThreads) {
  CommandQueue queue;
  constexpr std::uint64_t last = 5'000;
  std::thread writer([&] {
    for (std::uint64_t i = 0; i <= last; ++i) {
      while (!queue.put({.seed = i})) {
        std::this_thread::yield();
      }
    }
  });
  bool in_order = true;
  for (std::uint64_t i = 0; i <= last;) {
    if (const auto command = queue.take()) {
      in_order = in_order && command->seed == i++;
    } else {
      std::this_thread::yield();
    }
  }
  writer.join();
  EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace striker::sil
