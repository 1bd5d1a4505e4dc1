// SPDX-License-Identifier: Apache-2.0
#include "tests/images/directed_step.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "tests/images/instruction_counter.hpp"
#include "tests/images/step_search.hpp"
#include "tests/loop/bench/consent.hpp"
#include "tests/policy/synthetic_policy.hpp"

namespace striker::images {

namespace {

using policy::SmallRandom;

// After 49 days: a core that divides by shifting takes longest for the largest numbers. Every period of the message table
// divides it.
constexpr std::uint32_t first_tick = 4'294'960'000;
constexpr std::uint32_t picture_ticks = 50;
// Granted in the next one, when a status is due. Wheels are judged in windows of 16 ticks from the first wheel state on:
// without the next one the last tick ends such a window.
constexpr std::uint32_t arming_tick = first_tick + 149;
constexpr std::uint32_t without_wheels_tick = arming_tick + 2;
constexpr std::uint32_t early_ball_tick = first_tick + 985;  // of the picture whose poses come last
// Three wheel states are lost now and then: the receiver forgives that, and the gate believes none in between. At the end
// it has believed none for too long, and stops the command.
constexpr std::uint32_t first_gap_tick = first_tick + 975;
constexpr std::uint32_t last_tick = first_tick + 1000;  // every period of the message table divides it

// A node that is armed and has decided for a while, and what sends to it.
struct Stage {
  loop::GatedNode<loop::BuiltInNode> node{loop::built_in_robot};
  std::int32_t speed_mm_s =
      0;  // at which it is pushed along x, whatever its torque: that makes large numbers to divide
  std::int32_t way_um = 0;
  std::int32_t picture = 0;
  can::SendCounter wheels, pose, ball;
  loop::BenchOperator operators;
  can::FrameList sent;
};

struct Frames {
  std::array<can::Frame, most_frames_a_tick> all{};
  std::size_t count = 0;
  void add(const can::Frame& frame) { all[count++] = frame; }
  [[nodiscard]] std::span<const can::Frame> span() const { return std::span(all).first(count); }
};

void add_wheels(Stage& stage, Frames& frames, const can::WheelState& state) {
  frames.add(can::send(state, stage.wheels));
}

can::WheelState pushed(const Stage& stage, SmallRandom& random) {
  return {.left_mm_s = stage.speed_mm_s + random.within(20),
          .right_mm_s = stage.speed_mm_s + random.within(20)};
}

// The drives have cut the torque, and the wheels are at a policy's set-point, whatever they were a tick before: then the
// loops have nothing to wind up against.
can::WheelState at_set_point(SmallRandom& random) {
  constexpr std::array speeds_mm_s = {-loop::built_in_robot.top_rim_speed_mm_s, std::int32_t{0},
                                      loop::built_in_robot.top_rim_speed_mm_s};
  const auto speed_mm_s = [&] { return speeds_mm_s[random.bits() % speeds_mm_s.size()] + random.within(4); };
  const std::int32_t left_mm_s = speed_mm_s();
  return {.torque_cut = 1,
          .left_mm_s = left_mm_s,
          .right_mm_s = (random.bits() & 1U) != 0 ? left_mm_s : speed_mm_s()};
}

void add_pose(Stage& stage, SmallRandom& random, Frames& frames) {
  frames.add(
      can::send(can::VisionPose{.frame = stage.picture,
                                .x_quarter_mm = stage.way_um / can::um_per_quarter_mm + random.within(40),
                                .y_quarter_mm = random.within(40),
                                .heading = random.within(400)},
                stage.pose));
}

// It rolls, as a ball at rest has no direction to compute, on the right, as the policy mirrors that, and at last backward
// either way: a core that divides by shifting takes longer for negative numbers.
void add_ball(Stage& stage, Frames& frames) {
  const std::int32_t way_quarter_mm = 2000 * (stage.picture % 2);
  frames.add(can::send(can::VisionBall{.frame = stage.picture,
                                       .x_quarter_mm = 2000 - way_quarter_mm,
                                       .y_quarter_mm = -2000 - way_quarter_mm},
                       stage.ball));
}

void go_on(Stage& stage, SmallRandom& random, std::uint32_t tick) {
  Frames frames;
  stage.way_um += stage.speed_mm_s;
  if (tick == first_gap_tick || tick == first_gap_tick + 11 || tick == first_gap_tick + 22) {
    stage.wheels.next = (stage.wheels.next + 3U) % can::counter_modulus;
  }
  if (tick != without_wheels_tick) {
    add_wheels(stage, frames, pushed(stage, random));
  }
  if (tick % picture_ticks == 0 || tick == early_ball_tick) {
    stage.picture = (stage.picture + 1) & 0xF;
    add_ball(stage, frames);
  }
  if (tick % picture_ticks == 0) {
    add_pose(stage, random, frames);
  }
  if (tick == arming_tick || tick + 1 == last_tick) {
    frames.add(stage.operators.command(can::Mode::arm));
  }
  if (const auto confirmation = stage.operators.answer(std::as_const(stage.sent).frames())) {
    frames.add(*confirmation);
  }
  stage.node.step({.number = tick, .frames = frames.span()}, stage.sent);
}

// The timer's counts of the last step.
std::uint32_t finish(Stage stage, SmallRandom& random) {
  Frames frames;
  const std::uint32_t kind = random.bits();
  add_wheels(stage, frames, (kind & 1U) != 0 ? at_set_point(random) : pushed(stage, random));
  frames.add(stage.operators.command(can::Mode::arm));  // makes a challenge, though it is armed
  if (const auto confirmation =
          (kind & 2U) != 0 ? stage.operators.answer(std::as_const(stage.sent).frames()) : std::nullopt) {
    frames.add(*confirmation);
  }
  // On the smallest core a mode command costs more than a pose, and most of all one that confirms, be it for a challenge that
  // nobody sent.
  while ((kind & 4U) != 0 && frames.count + 1 < frames.all.size()) {
    frames.add(stage.operators.command(can::Mode::clear, 1));
  }
  // Each is older than the one before it, which the receiver has to tell from a silence.
  for (std::uint8_t age_ms = 0; frames.count < frames.all.size(); ++age_ms) {
    add_pose(stage, random, frames);
    frames.all[frames.count - 1].age_ms = age_ms;
  }
  const loop::Tick tick{.number = last_tick, .frames = frames.span()};
  restart_counter();
  stage.node.step(tick, stage.sent);
  return counted() + 1;
}

}  // namespace

std::uint32_t longest_directed_step(std::uint32_t tries, std::uint32_t seed) {
  constexpr std::uint32_t finishes = 20;  // of one stage
  const CounterUnit unit = counter_unit();
  SmallRandom random(seed);
  std::uint32_t longest = 0;
  Stage stage;
  for (std::uint32_t i = 0; i < tries; ++i) {
    if (i % finishes == 0) {
      stage = Stage{};
      stage.speed_mm_s =
          (static_cast<std::int32_t>(i / finishes % 3) - 1) * loop::built_in_robot.top_rim_speed_mm_s;
      // The check of the weights goes on with every step: a tick that comes again moves it alone.
      for (std::uint32_t again = 0; again < i / finishes % 4; ++again) {
        stage.node.step({.number = first_tick}, stage.sent);
      }
      for (std::uint32_t tick = first_tick; tick < last_tick; ++tick) {
        go_on(stage, random, tick);
      }
    }
    longest = std::max(longest, finish(stage, random));
  }
  return static_cast<std::uint32_t>((std::uint64_t{longest} * unit.instructions + unit.counts - 1) /
                                    unit.counts);
}

}  // namespace striker::images
