// SPDX-License-Identifier: Apache-2.0
// The bit-timed bus in the loop: deterministic, one frame at a time, and no decision later than its bound.
#include "sil/bus/timed_link.hpp"

#include <gtest/gtest.h>

#include "sil/budget/decision_deadline.hpp"
#include "sil/budget/message_set.hpp"
#include "sil/bus/frame_bits.hpp"
#include "sil/bus/in_process_link.hpp"
#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

struct Played {
  std::vector<StampedFrame> bus;
  std::vector<KickOutcome> outcomes;
  TimedBusReport report;
  core::Fault fault = core::Fault::none;
};

Played play(const KickPlan& plan, const TimedBusOptions& bus, PlantKind plant = PlantKind::drive) {
  Played played;
  InProcessLink controller;
  TimedLink link(controller, bus);
  BusRecord record;
  AtEndOfTick first_fault([&](const Snapshot& snapshot) {
    if (snapshot.deciding && played.fault == core::Fault::none) {
      played.fault = controller.controller().fault();
    }
  });
  played.outcomes = KickRig(link, plant).play(plan, {&record, &first_fault});
  played.bus = record.frames;
  played.report = link.report();
  return played;
}

// Counts the calls that reach the controller.
class CountingLink final : public ControllerLink {
 public:
  int sent = 0;
  int collected = 0;

  void send(std::uint32_t, std::span<const can::Frame>) override { ++sent; }
  void collect(std::uint32_t, std::vector<can::Frame>&) override { ++collected; }
};

TEST(TimedLink, SendingReachesTheControllerAndDoesNotWaitForIt) {
  CountingLink controller;
  TimedLink link(controller, {});
  can::SendCounter counter;
  link.send(0, std::vector{can::send(can::Sync{}, counter)});
  EXPECT_EQ(controller.sent, 1);
  EXPECT_EQ(controller.collected, 0);
  std::vector<can::Frame> answer;
  link.collect(0, answer);
  EXPECT_EQ(controller.collected, 1);
  EXPECT_TRUE(answer.empty());
}

TEST(TimedLink, TheSameSeedGivesTheSameStamps) {
  const KickPlan plan{.seed = 5, .episodes = 2};
  const Played once = play(plan, {});
  ASSERT_NO_FATAL_FAILURE(expect_same(once.bus, play(plan, {}).bus));
  const Played slower = play(plan, {.bit_ns = 2000});
  EXPECT_NE(once.bus.back().received_ns, slower.bus.back().received_ns);
}

TEST(TimedLink, FramesTakeTheirTimeOneAfterTheOther) {
  const Played played = play({.seed = 5, .episodes = 1}, {.bit_ns = 2000});
  ASSERT_GT(played.bus.size(), 5000U);
  for (std::size_t i = 1; i < played.bus.size(); ++i) {
    ASSERT_GE(played.bus[i].received_ns - played.bus[i - 1].received_ns,
              frame_bits(played.bus[i].frame) * 2000);
  }
}

// SYNC leads the tick, and the states of the same millisecond come after the controller has stepped.
TEST(TimedLink, PriorityOrdersEveryTick) {
  const Played played = play({.seed = 5, .episodes = 1}, {});
  std::vector<std::uint16_t> tick;
  for (const StampedFrame& seen : played.bus) {
    if (seen.received_ns / 1'000'000 == 77) {
      tick.push_back(seen.frame.id);
    }
  }
  EXPECT_EQ(tick,
            (std::vector<std::uint16_t>{can::layout<can::Sync>.info.id, can::layout<can::WheelState>.info.id,
                                        can::layout<can::WheelCommand>.info.id}));
}

TEST(TimedLink, TheControllerStillKicksAt1Mbit) {
  const Played played = play({.seed = 1, .episodes = 20}, {});
  EXPECT_EQ(played.report.replaced, 0U);
  EXPECT_EQ(played.fault, core::Fault::none);
  EXPECT_GT(played.report.decisions, 20U * 40U);
  double reward = 0.0;
  for (const KickOutcome& outcome : played.outcomes) {
    reward += outcome.reward / 20.0;
  }
  EXPECT_GT(reward, 5.0);
}

TEST(TimedLink, AnOverloadedBusStarvesTheLowestPriorities) {
  const Played played = play({.seed = 1, .episodes = 1}, {.bit_ns = 5000});
  EXPECT_GT(played.report.replaced, 1000U);
  EXPECT_GT(played.report.busy_share, 0.99);
  EXPECT_EQ(played.report.decisions, 0U);
}

// Queueing of the simulator's frames has no jitter; the controller's have SYNC's response and the step.
std::int64_t decision_bound_ns(const TimedBusOptions& options) {
  const BusAssumptions bus{.bit_ns = options.bit_ns};
  auto messages = table_messages();
  const ControllerTime controller{.lateness_ns = sync_lateness_ns(messages, bus, 0).value(),
                                  .step_ns = options.step_ns};
  set_jitter(messages, {.controller_ns = controller.lateness_ns + controller.step_ns, .others_ns = 0});
  return decision_deadline(messages, response_times(messages, bus), controller)->total_ns();
}

TEST(TimedLink, NoDecisionIsLaterThanItsBound) {
  for (const std::int64_t bit_ns : {1000, 1250, 2000}) {
    std::int64_t latest_ns = 0;
    std::uint64_t decisions = 0;
    const std::int64_t bound_ns = decision_bound_ns({.bit_ns = bit_ns});
    for (std::int64_t phase_ns = 0; phase_ns < 1'000'000; phase_ns += 40'000) {
      const TimedBusOptions options{.bit_ns = bit_ns, .vision_phase_ns = phase_ns};
      const Played played =
          play({.seed = static_cast<std::uint64_t>(phase_ns), .episodes = 2}, options, PlantKind::servo);
      ASSERT_LE(played.report.decision_latency_max_ns, bound_ns) << phase_ns;
      latest_ns = std::max(latest_ns, played.report.decision_latency_max_ns);
      decisions += played.report.decisions;
    }
    RecordProperty("bound_us_at_bit_ns_" + std::to_string(bit_ns), std::to_string(bound_ns / 1000));
    RecordProperty("latest_us_at_bit_ns_" + std::to_string(bit_ns), std::to_string(latest_ns / 1000));
    EXPECT_GT(decisions, 25U * 2U * 38U);
    EXPECT_GT(latest_ns, loop::tick_period_ns + 2 * worst_case_frame_bits(6) * bit_ns);
  }
}

}  // namespace
}  // namespace striker::sil
