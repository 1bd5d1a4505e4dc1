// SPDX-License-Identifier: Apache-2.0
// Faults that begin while a run goes on: none, and nothing is other than without; each lasts as long as it was asked for.
#include "sil/fault/live_faults.hpp"

#include <gtest/gtest.h>

#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

const KickPlan plan{.seed = 5, .episodes = 1};

// Answers each tick with the frames that it was sent.
class Echo final : public ControllerLink {
 public:
  void send(std::uint32_t, std::span<const can::Frame> frames) override {
    frames_.assign(frames.begin(), frames.end());
  }
  void collect(std::uint32_t, std::vector<can::Frame>& answer) override {
    answer.insert(answer.end(), frames_.begin(), frames_.end());
  }

 private:
  std::vector<can::Frame> frames_;
};

std::size_t echoed(ControllerLink& link, std::uint32_t tick) {
  const std::vector<can::Frame> sent(3, can::Frame{.id = 0x60, .length = 6});
  std::vector<can::Frame> answer;
  link.send(tick, sent);
  link.collect(tick, answer);
  return answer.size();
}

TEST(LiveFaults, WithNoneEveryFrameIsTheSame) {
  InProcessLink plain;
  InProcessLink behind;
  LiveFaults live(behind, &behind, true, 1);
  BusRecord one;
  BusRecord other;
  KickRig(plain).play(plan, {&one});
  KickRig(live).play(plan, {&other});
  expect_same(one.frames, other.frames);
}

TEST(LiveFaults, LastFromTheNextTickForAsLongAsTheyWereAskedFor) {
  Echo echo;
  LiveFaults live(echo, nullptr, false, 1);
  for (std::uint32_t tick = 0; tick < 3000; ++tick) {
    if (tick == 1000) {
      EXPECT_TRUE(live.begin(FaultKind::loss, 20));
    }
    EXPECT_EQ(echoed(live, tick), tick >= 1000 && tick < 1020 ? 0U : 3U) << tick;
  }
}

TEST(LiveFaults, AreBoundedAndForgottenWhenTheyAreOver) {
  Echo echo;
  LiveFaults live(echo, nullptr, false, 1);
  for (std::size_t i = 0; i < LiveFaults::most_at_once; ++i) {
    EXPECT_TRUE(live.begin(FaultKind::reorder, 1));
  }
  EXPECT_FALSE(live.begin(FaultKind::reorder, 1));
  for (std::uint32_t tick = 0; tick < 1100; ++tick) {
    EXPECT_EQ(echoed(live, tick), 3U);
  }
  EXPECT_TRUE(live.begin(FaultKind::reorder, 1));
}

TEST(LiveFaults, OfAllKindsBeginWhereTheyAreSaidToAndNowhereElse) {
  InProcessLink controller;
  Echo echo;
  for (const FaultKindInfo& info : fault_kinds()) {
    LiveFaults in_process(controller, &controller, true, 1);
    LiveFaults elsewhere(echo, nullptr, false, 1);
    EXPECT_EQ(in_process.begin(info.kind, 10), can_begin_live(info.kind, true)) << info.name;
    EXPECT_EQ(elsewhere.begin(info.kind, 10), can_begin_live(info.kind, false)) << info.name;
    EXPECT_FALSE(info.in_process && can_begin_live(info.kind, false)) << info.name;
  }
}

TEST(LiveFaults, ShowTheControllerBehindThem) {
  InProcessLink controller;
  LiveFaults live(controller, &controller, true, 1);
  Echo echo;
  EXPECT_EQ(controller_behind(live), &controller);
  EXPECT_EQ(controller_behind(controller), &controller);
  EXPECT_EQ(controller_behind(echo), nullptr);
}

}  // namespace
}  // namespace striker::sil
