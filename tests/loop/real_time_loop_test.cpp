// SPDX-License-Identifier: Apache-2.0
// The real-time loop on a logical clock: stalls of k periods are skipped, counted, never run in a burst, and
// a fault at the limit; a flooded bus does not stretch a tick. No wall clock decides anything here.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

#include "firmware/ports/linux/bench_peer.hpp"
#include "firmware/ports/linux/in_process_bus.hpp"
#include "firmware/ports/linux/run_real_time.hpp"

namespace striker::linux_port {
namespace {

constexpr std::int64_t ms = 1'000'000;

// Wakes on time, but for the stalls that it was given; plays the bus's other end before it sleeps.
class LogicalClock final : public host::AbsoluteClock {
 public:
  std::map<std::uint32_t, std::int64_t> lateness_ns;  // by the number of the wake-up
  std::function<void(std::int64_t)> while_asleep;
  std::vector<std::int64_t> wakes_ns;

  std::int64_t now_ns() override { return now_ns_; }
  void sleep_until_ns(std::int64_t time_ns) override {
    if (while_asleep) {
      while_asleep(time_ns);
    }
    const auto late = lateness_ns.find(static_cast<std::uint32_t>(wakes_ns.size()));
    now_ns_ = std::max(now_ns_, time_ns) + (late == lateness_ns.end() ? 0 : late->second);
    wakes_ns.push_back(now_ns_);
  }

 private:
  std::int64_t now_ns_ = 5'000 * ms;
};

// What the controller put out in one wake-up.
struct Seen {
  std::size_t commands = 0;
  std::int32_t uptime_ms = -1;  // where a heartbeat was among it
  bool torque = false;
  core::Fault reported = core::Fault::none;
};

// The loop with a bench at its bus: after 600 wake-ups the controller drives.
class Loop {
 public:
  LogicalClock clock;
  RealTimeOptions options;
  LoopTiming timing;
  std::atomic<core::Fault> fault = core::Fault::none;
  std::vector<Seen> seen;

  void run(std::uint64_t wakes) {
    options.ticks = wakes;
    clock.while_asleep = [this](std::int64_t now_ns) {
      watch();
      peer_.tick(now_ns);
    };
    run_real_time(recorder_, clock, options, timing, fault);
    watch();
  }

 private:
  // Keeps what passes from the controller to the bench.
  struct Recorder {
    explicit Recorder(host::AbsoluteClock& clock) : bus(clock) {}
    InProcessBus bus;
    std::vector<can::Frame> sent;
    can::BusHealth now = can::BusHealth::active;
    std::size_t room = can::FrameList::capacity;  // that the bus takes in a tick
    void poll() {}
    std::size_t try_send(std::span<const can::Frame> frames) {
      const auto taken = frames.first(std::min(frames.size(), room));
      sent.insert(sent.end(), taken.begin(), taken.end());
      return bus.try_send(taken);
    }
    loop::Received<std::int64_t> receive(std::size_t most) { return bus.receive(most); }
    [[nodiscard]] can::BusHealth health() const { return now; }
    std::uint32_t lost() { return bus.lost(); }
  };

  void watch() {
    Seen now;
    for (const can::Frame& frame : recorder_.sent) {
      can::WheelCommand command;
      can::FaultReport report;
      can::Heartbeat heartbeat;
      if (can::is<can::WheelCommand>(frame) && can::receive(frame, command) == can::Verdict::accepted) {
        ++now.commands;
        now.torque = command.left_torque_mNm != 0 || command.right_torque_mNm != 0;
      } else if (can::is<can::FaultReport>(frame) && can::receive(frame, report) == can::Verdict::accepted) {
        now.reported = static_cast<core::Fault>(report.code);
      } else if (can::is<can::Heartbeat>(frame) && can::unpack(frame, heartbeat) == can::Verdict::accepted) {
        now.uptime_ms = heartbeat.uptime_ms;
      }
    }
    if (!recorder_.sent.empty()) {
      seen.push_back(now);
    }
    recorder_.sent.clear();
  }

  Recorder recorder_{clock};
  BenchPeer peer_{recorder_.bus};
};

class Stall : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Stall, IsSkippedAndCountedAndNeverRunsInABurst) {
  const std::uint32_t periods = GetParam();
  Loop loop;
  constexpr std::uint32_t at = 700;
  loop.clock.lateness_ns[at] = periods * ms + 300'000;
  loop.run(1500);
  EXPECT_EQ(loop.timing.missed_periods, periods);
  EXPECT_EQ(loop.timing.longest_stall_periods, periods);
  EXPECT_EQ(loop.timing.ticks, 1500U);
  EXPECT_EQ(loop.timing.lateness.max_ns(), periods * ms + 300'000);
  EXPECT_EQ(loop.timing.lateness.max_tick(), at + 1 + periods);
  ASSERT_EQ(loop.seen.size(), 1500U);
  EXPECT_EQ(loop.seen.back().commands, 2U);  // its own, and torque 0 at the stop
  for (std::uint32_t wake = 0; wake < 1499; ++wake) {
    ASSERT_EQ(loop.seen[wake].commands, 1U) << wake;
    if (loop.seen[wake].uptime_ms >= 0) {
      ASSERT_EQ(loop.seen[wake].uptime_ms, static_cast<std::int32_t>(wake + (wake >= at ? periods : 0)));
    }
  }
  const auto& wakes_ns = loop.clock.wakes_ns;
  for (std::uint32_t wake = 1; wake < 1500; ++wake) {
    const std::int64_t expected_ns = wake == at       ? (1 + periods) * ms + 300'000
                                     : wake == at + 1 ? 700'000
                                                      : ms;
    ASSERT_EQ(wakes_ns[wake] - wakes_ns[wake - 1], expected_ns) << wake;
  }
}

TEST_P(Stall, IsAFaultBeyondTheLimitAndNotAtIt) {
  const std::uint32_t periods = GetParam();
  constexpr std::uint32_t at = 700;
  for (const std::uint32_t limit : {periods, periods - 1}) {
    Loop loop;
    loop.options.overrun_limit = limit;
    loop.clock.lateness_ns[at] = periods * ms;
    loop.run(at + 20);
    const bool beyond = limit < periods;
    EXPECT_EQ(loop.timing.fault == core::Fault::overrun, beyond);
    for (std::uint32_t wake = 600; wake < at; ++wake) {
      ASSERT_EQ(loop.seen[wake].reported, core::Fault::none);
    }
    // In that very tick.
    EXPECT_EQ(loop.seen[at].reported == core::Fault::overrun, beyond);
    EXPECT_EQ(loop.seen[at].torque, !beyond && loop.seen[at].torque);
    EXPECT_EQ(loop.fault.load() == core::Fault::overrun, beyond);
  }
}

INSTANTIATE_TEST_SUITE_P(Periods, Stall, testing::Values(1U, 2U, 10U, 100U));

TEST(RealTimeLoop, DrivesOnTheBench) {
  Loop loop;
  loop.run(1000);
  const auto driven =
      std::count_if(loop.seen.begin(), loop.seen.end(), [](const Seen& seen) { return seen.torque; });
  EXPECT_GT(driven, 100);
  EXPECT_EQ(loop.timing.missed_periods, 0U);
  EXPECT_EQ(loop.timing.fault, core::Fault::none);
}

TEST(RealTimeLoop, SmallStallsAddUpWithinTheWindowAlone) {
  for (const std::uint32_t distance : {90U, 120U}) {
    Loop loop;
    loop.options.overrun_limit = 9;
    for (std::uint32_t wake = 100; wake < 3000; wake += distance) {
      loop.clock.lateness_ns[wake] = ms;
    }
    loop.run(3000);
    EXPECT_EQ(loop.timing.fault == core::Fault::overrun, distance == 90U) << distance;
  }
}

// While the fault is latched the controller repeats its report by itself; the port does not add one a tick.
TEST(RealTimeLoop, AnOverrunIsReportedAtItsPeriod) {
  Loop loop;
  loop.options.overrun_limit = 9;
  loop.clock.lateness_ns[500] = 20 * ms;
  loop.run(900);
  const auto reports = std::count_if(loop.seen.begin(), loop.seen.end(),
                                     [](const Seen& seen) { return seen.reported == core::Fault::overrun; });
  EXPECT_GE(reports, 2);
  EXPECT_LE(reports, 8);
}

TEST(RealTimeLoop, AFloodTakesAsManyFramesATickAsItMay) {
  LogicalClock clock;
  InProcessBus bus(clock);
  LoopTiming timing;
  std::atomic<core::Fault> fault = core::Fault::none;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(bus.send_to_controller({0x060, 6, {}}, clock.now_ns()));
  }
  run_real_time(bus, clock, {.frames_per_tick = 30, .ticks = 5}, timing, fault);
  EXPECT_EQ(timing.received_frames, 100U);
  EXPECT_EQ(timing.full_ticks, 3U);
}

TEST(RealTimeLoop, LatencyRunsFromTheOldestFrame) {
  Loop loop;
  loop.clock.lateness_ns[50] = 400'000;
  loop.run(100);
  EXPECT_EQ(loop.timing.latency.max_ns(), 400'000);
  EXPECT_EQ(loop.timing.latency.max_tick(), 51U);
  EXPECT_EQ(loop.timing.latency.count(), 100U);
}

TEST(RealTimeLoop, TheTimingFrameTellsTheMaximaSinceTheLast) {
  LogicalClock clock;
  InProcessBus bus(clock);
  LoopTiming timing;
  std::atomic<core::Fault> fault = core::Fault::none;
  std::vector<can::Timing> told;
  clock.lateness_ns[150] = 3 * ms + 123'456;
  clock.while_asleep = [&](std::int64_t) {
    while (const auto frame = bus.receive_from_controller()) {
      can::Timing measured;
      if (can::is<can::Timing>(*frame) && can::unpack(*frame, measured) == can::Verdict::accepted) {
        told.push_back(measured);
      }
    }
  };
  run_real_time(bus, clock, {.ticks = 400}, timing, fault);
  ASSERT_GE(told.size(), 4U);
  EXPECT_EQ(told[1].lateness_max_us, 0);
  EXPECT_EQ(told[2].lateness_max_us, 3123);
  EXPECT_EQ(told[2].overruns, 3);
  EXPECT_EQ(told[3].lateness_max_us, 0);
  EXPECT_EQ(told[3].overruns, 3);
}

TEST(LatencyHistogram, BinsCoverEverythingAndKeepTheOrder) {
  using Histogram = LatencyHistogram;
  for (std::size_t bin = 0; bin + 1 < Histogram::bins; ++bin) {
    ASSERT_LT(Histogram::lower_end_us(bin), Histogram::lower_end_us(bin + 1));
    ASSERT_EQ(Histogram::bin_of(Histogram::lower_end_us(bin)), bin);
    ASSERT_EQ(Histogram::bin_of(Histogram::lower_end_us(bin + 1) - 1), bin);
  }
  EXPECT_EQ(Histogram::lower_end_us(999), 999);
  EXPECT_EQ(Histogram::lower_end_us(1000), 1000);
  EXPECT_EQ(Histogram::lower_end_us(1008), 2000);
  EXPECT_EQ(Histogram::bin_of(std::int64_t{1} << 50), Histogram::bins - 1);
}

TEST(LatencyHistogram, PercentilesAndExtremes) {
  LatencyHistogram histogram;
  EXPECT_EQ(histogram.percentile_us(0.5), 0);
  for (int i = 1; i <= 1000; ++i) {
    histogram.add(i * 1000 - 1, static_cast<std::uint32_t>(i));
  }
  histogram.add(-5, 2000);
  EXPECT_EQ(histogram.count(), 1001U);
  EXPECT_EQ(histogram.min_ns(), 0);
  EXPECT_EQ(histogram.max_ns(), 999'999);
  EXPECT_EQ(histogram.max_tick(), 1000U);
  EXPECT_EQ(histogram.percentile_us(0.5), 499);
  EXPECT_EQ(histogram.percentile_us(0.999), 998);
  EXPECT_EQ(histogram.percentile_us(1.0), 999);
}

TEST(FrameRing, KeepsTheOrderAndDropsWhatDoesNotFit) {
  FrameRing ring;
  EXPECT_FALSE(ring.pop());
  std::uint16_t pushed = 0;
  while (ring.push({{pushed, 0, {}}, pushed})) {
    ++pushed;
  }
  EXPECT_EQ(pushed, 1024);
  for (std::uint16_t id = 0; id < pushed; ++id) {
    ASSERT_EQ(ring.pop()->frame.id, id);
  }
  EXPECT_FALSE(ring.pop());
  EXPECT_TRUE(ring.push({}));
}

}  // namespace
}  // namespace striker::linux_port
