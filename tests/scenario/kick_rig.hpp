// SPDX-License-Identifier: Apache-2.0
// A kick scenario in one call: robot 0 with its own drives and camera, behind any link.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sil/robot/striker_drives.hpp"
#include "sil/robot/variation.hpp"
#include "sil/scenario/kick_scenario.hpp"

namespace striker::sil {

class KickRig {
 public:
  // A forward, as it is varied.
  explicit KickRig(ControllerLink& link, PlantKind kind = PlantKind::drive, const Variation& variation = {})
      : variation_(variation),
        plants_(make_plants(kind, robot_spec(Role::forward), variation)),
        camera_(make_camera(variation, 1)),
        seat_({.plant = *plants_.back(), .drives = drives, .camera = *camera_, .link = link}) {}

  std::vector<KickOutcome> play(
      const KickPlan& plan, const std::vector<Observer*>& observers = {},
      const std::function<bool()>& stop = [] { return false; }) {
    KickPlan varied_plan = plan;
    varied_plan.place = {.robot = varied(plan.place.robot, variation_),
                         .ball_kept_after_1_s = ball_kept_after_1_s(variation_)};
    varied_plan.vision_latency_ticks = variation_.vision_latency_ms.value_or(0);
    varied_plan.camera_rate_Hz = variation_.camera_rate_Hz.value_or(plan.camera_rate_Hz);
    KickScenario scenario(varied_plan, seat_, observers);
    scenario.run(stop);
    undriven = scenario.undriven();
    return scenario.outcomes();
  }

  // Onto the bus with the next tick.
  void say(const can::Frame& frame) { seat_.queue(frame); }

  StrikerDrives drives;
  std::vector<std::uint64_t> undriven;  // of the last play

 private:
  Variation variation_;
  std::vector<std::unique_ptr<Plant>> plants_;
  std::unique_ptr<Camera> camera_;
  Seat seat_;
};

// Keeps every frame of the bus.
class BusRecord final : public Observer {
 public:
  std::vector<StampedFrame> frames;

  void end_tick(const Snapshot& snapshot) override {
    const auto seen = snapshot.robots.front().frames;
    frames.insert(frames.end(), seen.begin(), seen.end());
  }
};

// Calls a function at the end of every tick.
class AtEndOfTick final : public Observer {
 public:
  explicit AtEndOfTick(std::function<void(const Snapshot&)> call) : call_(std::move(call)) {}
  void end_tick(const Snapshot& snapshot) override { call_(snapshot); }

 private:
  std::function<void(const Snapshot&)> call_;
};

inline void expect_same(const std::vector<StampedFrame>& a, const std::vector<StampedFrame>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].frame, b[i].frame) << i;
    ASSERT_EQ(a[i].received_ns, b[i].received_ns) << i;
  }
}

}  // namespace striker::sil
