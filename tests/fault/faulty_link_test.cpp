// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/faulty_link.hpp"

#include <gtest/gtest.h>

namespace striker::sil {
namespace {

// Answers every tick with the frames that it got.
class EchoLink final : public ControllerLink {
 public:
  int ticks = 0;
  std::vector<can::Frame> got;

  void send(std::uint32_t tick, std::span<const can::Frame> frames) override {
    ++ticks;
    got.assign(frames.begin(), frames.end());
    seen_.clear();
    for (const can::Frame& frame : frames) {
      seen_.push_back({frame, tick * std::int64_t{1000}});
    }
  }
  void collect(std::uint32_t, std::vector<can::Frame>& answer) override {
    answer.insert(answer.end(), got.begin(), got.end());
  }
  [[nodiscard]] std::optional<std::span<const StampedFrame>> timed_traffic() const override { return seen_; }

 private:
  std::vector<StampedFrame> seen_;
};

const std::vector<can::Frame> frames = {{0x100, 0, {}}, {0x200, 0, {}}, {0x100, 0, {}}};

std::size_t answers(ControllerLink& link, std::uint32_t tick) {
  std::vector<can::Frame> answer = {{0x100, 0, {}}};  // an answer is appended to what is there
  link.send(tick, frames);
  link.collect(tick, answer);
  return answer.size() - 1;
}

TEST(FaultyLink, WithoutAFaultItIsNotThere) {
  EchoLink echo;
  FaultyLink link(echo, {});
  EXPECT_EQ(answers(link, 0), 3U);
  EXPECT_EQ(echo.got, frames);
}

TEST(FaultyLink, LosesAnIdentifierFromATickToATick) {
  EchoLink echo;
  FaultyLink link(echo, {{.from = 5, .until = 7, .lost_identifier = 0x100}});
  EXPECT_EQ(answers(link, 4), 3U);
  EXPECT_EQ(answers(link, 5), 1U);
  EXPECT_EQ(echo.got.front().id, 0x200);
  EXPECT_EQ(answers(link, 6), 1U);
  EXPECT_EQ(answers(link, 7), 3U);
}

// Answers with a frame that it was not sent.
class OneFrameLink final : public ControllerLink {
 public:
  void send(std::uint32_t, std::span<const can::Frame>) override {}
  void collect(std::uint32_t, std::vector<can::Frame>& answer) override { answer.push_back({0x300, 0, {}}); }
};

TEST(FaultyLink, LosesWhatTheControllerSaysToo) {
  OneFrameLink one;
  FaultyLink link(one, {{.from = 1, .until = 2, .lost_identifier = 0x300}});
  EXPECT_EQ(answers(link, 0), 1U);
  EXPECT_EQ(answers(link, 1), 0U);
}

TEST(FaultyLink, ADeadControllerIsNotCalledAndIsPoweredOnOnceWhenItComesBack) {
  EchoLink echo;
  int power_ons = 0;
  FaultyLink link(echo, {{.from = 2, .until = 4}}, [&] { ++power_ons; });
  for (std::uint32_t tick = 0; tick < 8; ++tick) {
    EXPECT_EQ(answers(link, tick), tick == 2 || tick == 3 ? 0U : 3U) << tick;
    EXPECT_EQ(power_ons, tick < 4 ? 0 : 1) << tick;
    EXPECT_EQ(link.timed_traffic()->empty(), tick == 2 || tick == 3) << tick;
  }
  EXPECT_EQ(echo.ticks, 6);
}

}  // namespace
}  // namespace striker::sil
