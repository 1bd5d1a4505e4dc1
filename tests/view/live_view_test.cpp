// SPDX-License-Identifier: Apache-2.0
// A run with viewers: who only watches changes no frame of the bus; what is pressed is on it.
#include "sil/view/live_view.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/scenario/kick_rig.hpp"

namespace striker::sil {
namespace {

const KickPlan two_kicks{.pose = PoseMode::anywhere, .seed = 11, .episodes = 2};

// A kick run that is viewed, with a script: called at the end of each tick, in the run's thread.
struct Viewed {
  using Script = std::function<void(Viewed&, std::uint32_t tick)>;

  std::atomic<bool> stops = false;  // as by Ctrl-C
  ViewExchange exchange;
  LiveView view{exchange, {.speed = 0.0, .stop = [this] { return stops.load(); }}};
  BusRecord record;
  std::vector<KickOutcome> outcomes;

  void put(const ViewCommand& command) { EXPECT_TRUE(exchange.commands.put(command)); }

  void play(const KickPlan& plan, const Script& script) {
    InProcessLink link;
    LiveFaults faults(link, &link, true, plan.seed);
    KickRig rig(faults);
    view.begin_run({.seed = plan.seed,
                    .robots = 1,
                    .say = [&](std::size_t, const can::Frame& frame) { rig.say(frame); },
                    .faults = {&faults},
                    .controllers = {&link}});
    AtEndOfTick scripted([&](const Snapshot& snapshot) { script(*this, snapshot.tick); });
    outcomes = rig.play(plan, {&record, &scripted, &view},
                        [&] { return stops.load() || view.restart_seed().has_value(); });
  }

  [[nodiscard]] std::size_t count(std::uint16_t identifier) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        record.frames, [&](const StampedFrame& stamped) { return stamped.frame.id == identifier; }));
  }
  [[nodiscard]] std::uint32_t ticks() const {
    return static_cast<std::uint32_t>(count(can::layout<can::Sync>.info.id));
  }
};

std::vector<StampedFrame> unviewed(const KickPlan& plan) {
  InProcessLink link;
  BusRecord record;
  KickRig(link).play(plan, {&record});
  return record.frames;
}

TEST(LiveView, WatchingEachTickChangesNoFrame) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t) {
    self.exchange.wanted = true;
    static_cast<void>(self.exchange.states.take());
  });
  expect_same(run.record.frames, unviewed(two_kicks));
}

TEST(LiveView, ShowsTheRunAsItIs) {
  Viewed run;
  std::size_t shown = 0;
  run.play(two_kicks, [&](Viewed& self, std::uint32_t tick) {
    if (const LiveState* state = self.exchange.states.take()) {
      ++shown;
      EXPECT_EQ(state->tick + 1, tick);
      EXPECT_EQ(state->seed, two_kicks.seed);
      EXPECT_EQ(state->robots[0].messages[2].count, tick) << "a Sync each tick";
    }
    self.exchange.wanted = true;
  });
  EXPECT_EQ(shown, run.ticks() - 1);
}

TEST(LiveView, IsShownOnlyWhenItIsAskedFor) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t) { EXPECT_EQ(self.exchange.states.take(), nullptr); });
  EXPECT_NE(run.exchange.states.take(), nullptr) << "but the last one, at the run's end";
}

TEST(LiveView, AnEmergencyStopIsOneFrameOnTheBusAndEndsAKickRun) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
    if (tick == 1000) {
      self.put({.action = ViewAction::stop});
    }
  });
  EXPECT_EQ(run.count(can::layout<can::EmergencyStop>.info.id), 1U);
  EXPECT_TRUE(run.outcomes.empty());
  EXPECT_EQ(run.ticks(), 1003U) << "that of the stop, and one to disarm";
}

TEST(LiveView, AnEmergencyStopIsRepeatedUntilTheControllerHasIt) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
    if (tick == 1000) {
      self.put({.action = ViewAction::fault, .robot = 0, .kind = FaultKind::interface_down, .for_ms = 55});
      self.put({.action = ViewAction::stop});
    }
  });
  EXPECT_EQ(run.count(can::layout<can::EmergencyStop>.info.id), 7U);
  EXPECT_TRUE(run.outcomes.empty());
  EXPECT_EQ(run.ticks(), 1063U);
}

// From another thread, as a person would.
class Presser {
 public:
  explicit Presser(std::function<void()> press) : thread_(std::move(press)) {}
  ~Presser() { thread_.join(); }
  Presser(const Presser&) = delete;
  Presser& operator=(const Presser&) = delete;

 private:
  std::thread thread_;
};

void wait_a_while() {
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

// The tick of the first state that is shown from now on and is such.
std::uint32_t await(Viewed& run, const std::function<bool(const LiveState&)>& is_such) {
  for (;;) {
    run.exchange.wanted = true;
    wait_a_while();
    const LiveState* state = run.exchange.states.take();
    if (state != nullptr && is_such(*state)) {
      return state->tick;
    }
  }
}

bool is_paused(const LiveState& state) {
  return state.paused;
}

TEST(LiveView, APauseStandsStillAndStepsPassOneByOne) {
  Viewed run;
  std::uint32_t paused_at = 0;
  std::uint32_t later = 0;
  std::uint32_t stepped = 0;
  {
    Presser presser([&] {
      paused_at = await(run, is_paused);
      later = await(run, is_paused);
      run.put({.action = ViewAction::step, .ticks = 3});
      stepped = await(run, [&](const LiveState& state) { return state.tick >= later + 3; });
      run.put({.action = ViewAction::run});
    });
    run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
      if (tick == 700) {
        self.put({.action = ViewAction::pause});
      }
    });
  }
  EXPECT_EQ(paused_at, 700U);
  EXPECT_EQ(later, 700U);
  EXPECT_EQ(stepped, 703U);
  expect_same(run.record.frames, unviewed(two_kicks));
}

TEST(LiveView, AStopThatIsPressedInAPauseGoesOutAtOnce) {
  Viewed run;
  {
    Presser presser([&] {
      await(run, is_paused);
      run.put({.action = ViewAction::stop, .robot = 0});
    });
    run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
      if (tick == 700) {
        self.put({.action = ViewAction::pause});
      }
    });
  }
  EXPECT_EQ(run.count(can::layout<can::EmergencyStop>.info.id), 1U);
  EXPECT_EQ(run.ticks(), 703U);
}

TEST(LiveView, APauseAfterAStopHoldsNoStopBack) {
  Viewed run;
  std::uint32_t paused_at = 0;
  {
    Presser presser([&] {
      await(run, is_paused);
      paused_at = await(run, is_paused);
      run.stops = true;
    });
    run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
      if (tick == 700) {
        self.put({.action = ViewAction::stop});
        self.put({.action = ViewAction::pause});
      }
    });
  }
  EXPECT_EQ(paused_at, 701U) << "after the stop's tick";
  EXPECT_EQ(run.count(can::layout<can::EmergencyStop>.info.id), 1U);
}

TEST(LiveView, AStopSignalEndsAPause) {
  Viewed run;
  {
    Presser presser([&] {
      await(run, is_paused);
      run.stops = true;
    });
    run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
      if (tick == 700) {
        self.put({.action = ViewAction::pause});
      }
    });
  }
  EXPECT_EQ(run.ticks(), 703U);
}

TEST(LiveView, ARestartEndsTheRunAndSaysWithWhichSeed) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
    if (tick == 700) {
      self.put({.action = ViewAction::pause});
      self.put({.action = ViewAction::restart, .seed = 99});
    }
  });
  EXPECT_EQ(run.view.restart_seed(), 99U);
  EXPECT_EQ(run.ticks(), 703U);
}

TEST(LiveView, ARunThatIsBegunAnewHasNothingOfWhatWasPressedBefore) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
    if (tick == 700) {
      self.put(
          {.action = ViewAction::fault, .robot = 0, .kind = FaultKind::interface_down, .for_ms = 60'000});
      self.put({.action = ViewAction::stop});
    } else if (tick == 705) {
      self.put({.action = ViewAction::restart, .seed = two_kicks.seed});
    }
  });
  EXPECT_EQ(run.count(can::layout<can::EmergencyStop>.info.id), 1U);
  run.record.frames.clear();
  run.play(two_kicks, [](Viewed&, std::uint32_t) {});
  expect_same(run.record.frames, unviewed(two_kicks));
}

TEST(LiveView, AFaultIsOnTheBusForItsTimeAndTheControllerFindsIt) {
  Viewed run;
  const std::uint16_t wheel_command = can::layout<can::WheelCommand>.info.id;
  std::size_t before = 0;
  std::size_t behind = 0;
  run.play({.seed = 3, .episodes = 1}, [&](Viewed& self, std::uint32_t tick) {
    if (tick == 1000) {
      before = self.count(wheel_command);
      self.put({.action = ViewAction::fault, .robot = 0, .kind = FaultKind::interface_down, .for_ms = 100});
    } else if (tick == 1100) {
      behind = self.count(wheel_command);
    }
  });
  EXPECT_EQ(before, behind);
  EXPECT_GT(run.count(can::layout<can::FaultReport>.info.id), 0U);
}

TEST(LiveView, WhatCannotBeIsANoteAndNoMore) {
  Viewed run;
  run.play(two_kicks, [](Viewed& self, std::uint32_t tick) {
    if (tick == 500) {
      self.put({.action = ViewAction::fault, .robot = 7, .kind = FaultKind::loss, .for_ms = 100});
      self.put({.action = ViewAction::fault, .robot = 0, .kind = FaultKind::wheel_stuck, .for_ms = 100});
      self.put({.action = ViewAction::stop, .robot = 7});
    }
  });
  const LiveState* state = run.exchange.states.take();
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(state->note.number, 3U);
  EXPECT_STREQ(state->note.text.data(), "there is no robot 7");
  expect_same(run.record.frames, unviewed(two_kicks));
}

TEST(LiveView, OnTheWallClockTimeCannotBeStopped) {
  ViewExchange exchange;
  LiveView view(exchange, {.speed = 1.0, .has_time = false});
  view.begin_run({.seed = 1, .robots = 1, .say = [](std::size_t, const can::Frame&) {}});
  for (const ViewAction action : {ViewAction::pause, ViewAction::step, ViewAction::speed}) {
    ASSERT_TRUE(exchange.commands.put({.action = action}));
  }
  view.begin_tick();  // returns
  view.end_run();
  const LiveState* state = exchange.states.take();
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(state->note.number, 3U);
  EXPECT_FALSE(state->paused);
}

}  // namespace
}  // namespace striker::sil
