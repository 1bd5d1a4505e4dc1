// SPDX-License-Identifier: Apache-2.0
// Where an answer ends, on what a controller really says.
#include "sil/bus/end_of_tick.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "sil/bus/in_process_link.hpp"

namespace striker::sil {
namespace {

std::vector<can::Frame> answer_to(InProcessLink& link, std::uint32_t tick, can::SendCounter& counter) {
  std::vector<can::Frame> answer;
  link.send(tick, std::vector{can::send(can::Sync{.tick = static_cast<std::int32_t>(tick)}, counter)});
  link.collect(tick, answer);
  return answer;
}

TEST(EndOfTick, IsTheLastFrameOfEveryAnswerAndNoOther) {
  InProcessLink link;
  can::SendCounter counter;
  for (std::uint32_t tick = 0; tick < 40; ++tick) {
    const auto answer = answer_to(link, tick, counter);
    ASSERT_FALSE(answer.empty());
    for (std::size_t i = 0; i + 1 < answer.size(); ++i) {
      ASSERT_EQ(end_of_answer(answer[i], tick), AnswerEnd::no) << tick;
    }
    ASSERT_EQ(end_of_answer(answer.back(), tick), AnswerEnd::of_this_tick) << tick;
    ASSERT_EQ(end_of_answer(answer.back(), tick + 1), AnswerEnd::of_another_tick) << tick;
  }
}

TEST(EndOfTick, AMalformedOneEndsNoTick) {
  InProcessLink link;
  can::SendCounter counter;
  can::Frame last = answer_to(link, 0, counter).back();
  last.length = 1;
  EXPECT_NE(end_of_answer(last, 0), AnswerEnd::of_this_tick);
}

}  // namespace
}  // namespace striker::sil
