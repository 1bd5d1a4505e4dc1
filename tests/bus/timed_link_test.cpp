// The bit-timed bus in the loop: deterministic, one frame at a time, and no decision later than its bound.
#include "sil/bus/timed_link.hpp"

#include <gtest/gtest.h>

#include "sil/budget/decision_deadline.hpp"
#include "sil/budget/message_set.hpp"
#include "sil/bus/frame_bits.hpp"
#include "sil/bus/in_process_link.hpp"
#include "sil/scenario/kick_run.hpp"

namespace striker::sil {
namespace {

struct Played {
  std::vector<StampedFrame> bus;
  std::vector<KickOutcome> outcomes;
  TimedBusReport report;
  can::Fault fault = can::Fault::none;
};

Played play(const KickRunOptions& options, const TimedBusOptions& bus) {
  Played played;
  InProcessLink controller;
  TimedLink link(controller, bus);
  KickRunner runner(options, link,
                    {.begin_tick = {},
                     .end_tick =
                         [&](const TickRecord& record) {
                           played.bus.insert(played.bus.end(), link.seen().begin(), link.seen().end());
                           if (record.deciding && played.fault == can::Fault::none) {
                             played.fault = controller.controller().fault();
                           }
                         },
                     .end_episode = {},
                     .stop = {}});
  runner.run();
  played.outcomes = runner.outcomes();
  played.report = link.report();
  return played;
}

TEST(TimedLink, TheSameSeedGivesTheSameStamps) {
  const KickRunOptions options{.seed = 5, .episodes = 2};
  const Played once = play(options, {});
  const Played again = play(options, {});
  ASSERT_EQ(once.bus.size(), again.bus.size());
  for (std::size_t i = 0; i < once.bus.size(); ++i) {
    ASSERT_EQ(once.bus[i].received_ns, again.bus[i].received_ns);
    ASSERT_EQ(once.bus[i].frame, again.bus[i].frame);
  }
  const Played slower = play(options, {.bit_ns = 2000});
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
  EXPECT_EQ(played.fault, can::Fault::none);
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
  return decision_deadline(messages, analyse(messages, bus), controller)->total_ns();
}

TEST(TimedLink, NoDecisionIsLaterThanItsBound) {
  for (const std::int64_t bit_ns : {1000, 1250, 2000}) {
    std::int64_t latest_ns = 0;
    std::uint64_t decisions = 0;
    const std::int64_t bound_ns = decision_bound_ns({.bit_ns = bit_ns});
    for (std::int64_t phase_ns = 0; phase_ns < 1'000'000; phase_ns += 40'000) {
      const TimedBusOptions options{.bit_ns = bit_ns, .vision_phase_ns = phase_ns};
      const Played played = play(
          {.plant = PlantKind::servo, .seed = static_cast<std::uint64_t>(phase_ns), .episodes = 2}, options);
      ASSERT_LE(played.report.decision_latency_max_ns, bound_ns) << phase_ns;
      latest_ns = std::max(latest_ns, played.report.decision_latency_max_ns);
      decisions += played.report.decisions;
    }
    RecordProperty("bound_us_at_bit_ns_" + std::to_string(bit_ns), std::to_string(bound_ns / 1000));
    RecordProperty("latest_us_at_bit_ns_" + std::to_string(bit_ns), std::to_string(latest_ns / 1000));
    EXPECT_GT(decisions, 25U * 2U * 38U);
    EXPECT_GT(latest_ns, tick_period_ns + 2 * worst_case_frame_bits(6) * bit_ns);
  }
}

}  // namespace
}  // namespace striker::sil
