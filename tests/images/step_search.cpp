// SPDX-License-Identifier: Apache-2.0
#include "tests/images/step_search.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "tests/images/instruction_counter.hpp"
#include "tests/loop/bench/consent.hpp"
#include "tests/policy/synthetic_policy.hpp"

namespace striker::images {

namespace {

using policy::SmallRandom;

// A node and everything that sends to it.
struct Scene {
  loop::GatedNode<loop::BuiltInNode> node{loop::built_in_robot};
  std::uint32_t tick = 0;
  std::int32_t picture = 0;
  can::SendCounter wheels, pose, ball, team, stop;
  loop::BenchOperator operators;
  bool has_team = false;
  can::FrameList sent;
  can::WheelState speeds;
  core::Vector robot_quarter_mm, ball_quarter_mm;
};

struct Frames {
  std::array<can::Frame, most_frames_a_tick> all{};
  std::size_t count = 0;
  void add(const can::Frame& frame) {
    if (count < all.size()) {
      all[count++] = frame;
    }
  }
};

bool one_in(SmallRandom& random, std::uint32_t chance) {
  return random.bits() % chance == 0;
}

// To a neighbour of `value`, as what jumps is implausible; rarely to an end of its range.
std::int32_t near(SmallRandom& random, std::int32_t value, std::int32_t limit) {
  const std::int32_t end = one_in(random, 2) ? limit : -limit;
  return one_in(random, 256) ? end : std::clamp(value + random.within(100), -limit, limit);
}

void add_wheels(Scene& scene, SmallRandom& random, Frames& frames) {
  const std::int32_t limit = one_in(random, 64) ? 4000 : 2550;
  scene.speeds = {.left_mm_s = near(random, scene.speeds.left_mm_s, limit),
                  .right_mm_s = near(random, scene.speeds.right_mm_s, limit)};
  frames.add(can::send(scene.speeds, scene.wheels));
}

void add_picture(Scene& scene, SmallRandom& random, Frames& frames) {
  constexpr std::int32_t limit = 32767;
  scene.picture = (scene.picture + (one_in(random, 16) ? 5 : 1)) & 0xF;
  scene.robot_quarter_mm = {near(random, scene.robot_quarter_mm.x, limit),
                            near(random, scene.robot_quarter_mm.y, limit)};
  scene.ball_quarter_mm = {near(random, scene.ball_quarter_mm.x, limit),
                           near(random, scene.ball_quarter_mm.y, limit)};
  frames.add(can::send(can::VisionPose{.frame = scene.picture,
                                       .x_quarter_mm = scene.robot_quarter_mm.x,
                                       .y_quarter_mm = scene.robot_quarter_mm.y,
                                       .heading = random.within(1000)},
                       scene.pose));
  frames.add(can::send(can::VisionBall{.frame = one_in(random, 16) ? scene.picture ^ 1 : scene.picture,
                                       .x_quarter_mm = scene.ball_quarter_mm.x,
                                       .y_quarter_mm = scene.ball_quarter_mm.y},
                       scene.ball));
}

// Three motions in four begin anew, which is more work than to go on.
void add_order(Scene& scene, SmallRandom& random, Frames& frames) {
  if (one_in(random, 4)) {
    frames.add(can::send(can::WheelOrder{.left_mm_s = random.within(8000), .right_mm_s = random.within(8000)},
                         scene.team));
  } else {
    const auto number = static_cast<std::int32_t>(random.bits() % core::motion_numbers);
    frames.add(can::send(can::MotionOrder{.number = number}, scene.team));
  }
}

void add_mode(Scene& scene, SmallRandom& random, Frames& frames) {
  can::Mode mode = one_in(random, 8) ? can::Mode::disarm : can::Mode::clear;
  if (scene.node.controller().state() == core::State::standby) {
    mode = can::Mode::arm;
  }
  frames.add(scene.operators.command(mode));
}

// Wrong in length, checksum, counter or range, of a message or of none.
void spoil(SmallRandom& random, can::Frame& frame) {
  switch (random.bits() % 5) {
    case 0:
      frame.length = static_cast<std::uint8_t>(random.bits() % 9);
      break;
    case 1:
      frame.data[random.bits() % 8] ^= static_cast<std::uint8_t>(1U << (random.bits() % 8));
      break;
    case 2:
      frame.id = static_cast<std::uint16_t>(random.bits() & 0x7FFU);
      break;
    case 3:
      frame.data[7] = 0xFF;
      break;
    default:
      break;
  }
}

Frames frames_of(Scene& scene, SmallRandom& random) {
  Frames frames;
  const std::uint32_t crowd = one_in(random, 16) ? 1 + random.bits() % most_frames_a_tick : 1;
  for (std::uint32_t i = 0; i < crowd; ++i) {
    if (!one_in(random, 256)) {
      add_wheels(scene, random, frames);
    }
    if (scene.tick % 50 == 0 || one_in(random, 128)) {
      add_picture(scene, random, frames);
    }
    if (scene.has_team && (scene.tick % 50 == 0 || one_in(random, 128))) {
      add_order(scene, random, frames);
    }
  }
  const bool wants_mode = scene.node.controller().state() == core::State::standby
                              ? scene.tick % 50 == 1
                              : scene.node.controller().state() == core::State::fault;
  if (wants_mode || one_in(random, 2048)) {
    add_mode(scene, random, frames);
  }
  if (const auto confirmation = scene.operators.answer(std::as_const(scene.sent).frames())) {
    frames.add(*confirmation);
  }
  if (one_in(random, 4096)) {
    frames.add(can::send(can::EmergencyStop{}, scene.stop));
  }
  if (one_in(random, 64)) {
    for (can::Frame& frame : std::span(frames.all).first(frames.count)) {
      spoil(random, frame);
    }
  }
  return frames;
}

void let_time_pass(Scene& scene, SmallRandom& random) {
  if (one_in(random, 512)) {
    scene.tick += random.bits() % 200;
  } else if (one_in(random, 512)) {
    scene.tick += 1000 - scene.tick % 1000;
  } else {
    scene.tick += 1;
  }
}

}  // namespace

SearchResult search_longest_step(std::uint32_t steps, std::uint32_t seed) {
  const CounterUnit unit = counter_unit();
  SmallRandom random(seed);
  SearchResult result;
  Scene scene;
  Scene longest = scene;
  std::uint32_t longest_counts = 0;
  for (std::uint32_t i = 0; i < steps; ++i) {
    if (one_in(random, 2000)) {
      scene = one_in(random, 2) ? longest : Scene{};
      scene.has_team = one_in(random, 2);
    }
    const Scene before = scene;
    const Frames frames = frames_of(scene, random);
    const loop::Tick tick{.number = scene.tick, .frames = std::span(frames.all).first(frames.count)};
    restart_counter();
    scene.node.step(tick, scene.sent);
    const std::uint32_t counts = counted() + 1;
    if (counts >= longest_counts) {
      longest_counts = counts;
      longest = before;
    }
    for (const can::Frame& frame : std::as_const(scene.sent).frames()) {
      result.decisions += static_cast<std::uint32_t>(can::is<can::Decision>(frame));
    }
    let_time_pass(scene, random);
  }
  result.greatest_instructions = static_cast<std::uint32_t>(
      (std::uint64_t{longest_counts} * unit.instructions + unit.counts - 1) / unit.counts);
  return result;
}

}  // namespace striker::images
