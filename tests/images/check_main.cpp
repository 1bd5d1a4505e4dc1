// SPDX-License-Identifier: Apache-2.0
// The test image: the same checks, with the same output to the letter, on every target and on the host.
//
//   striker-check [recording FILE]
//
// Golden vectors; networks of many shapes, relative states and a recorded run of the simulator as a hash
// each, the run compared frame by frame too. Exit status 0 if nothing differed.
#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/can/codec.hpp"
#include "firmware/core/estimation/relative_state.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/frame_queue.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"
#include "firmware/policy/built_in.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/proof.hpp"
#include "tests/images/console.hpp"
#include "tests/images/recording.hpp"
#include "tests/policy/limit_policy.hpp"
#include "tests/policy/synthetic_policy.hpp"

namespace {

using namespace striker;
using namespace striker::core;
using namespace striker::policy;

constexpr const auto& trained = policy::built_in;

int failures = 0;

void check(const char* name, std::int64_t value, std::int64_t wanted) {
  images::console::print_line(name, value);
  if (value != wanted) {
    images::console::print_line("  but wanted", wanted);
    ++failures;
  }
}

std::int64_t passed_golden_vectors() {
  std::int64_t passed = 0;
  for (const auto& golden : trained.golden_vectors) {
    const auto q = infer<trained>(golden.raw);
    passed += static_cast<std::int64_t>(q.sums == golden.sums && q.action == golden.action);
  }
  return passed;
}

template <const auto& policy>
void hash_answers(proof::Fnv1a& hash) {
  SmallRandom random(7);
  std::array<std::int32_t, std::remove_cvref_t<decltype(policy)>::inputs> raw{};
  raw.fill(std::numeric_limits<std::int32_t>::max());
  for (int i = 0; i < 100; ++i) {
    const auto q = infer<policy>(raw);
    for (const std::int32_t sum : q.sums) {
      hash.add(sum);
    }
    hash.add(q.action);
    for (std::int32_t& element : raw) {
      element = draw_raw(random);
    }
  }
}

std::uint32_t hash_of_shapes() {
  proof::Fnv1a hash;
  hash_answers<trained>(hash);
  hash_answers<synthetic_smallest>(hash);
  hash_answers<synthetic_odd>(hash);
  hash_answers<synthetic_rest>(hash);
  hash_answers<synthetic_half>(hash);
  hash_answers<synthetic_paper>(hash);
  hash_answers<synthetic_wide>(hash);
  hash_answers<synthetic_int8_smallest>(hash);
  hash_answers<synthetic_int8_odd>(hash);
  hash_answers<synthetic_int8_rest>(hash);
  hash_answers<synthetic_int8_paper>(hash);
  hash_answers<synthetic_deep_narrow>(hash);
  hash_answers<synthetic_int8_deep>(hash);
  hash_answers<limit_one>(hash);
  hash_answers<limit_three>(hash);
  return hash.value();
}

std::uint32_t hash_of_relative_states() {
  constexpr std::int32_t field_um = 8'000'000;
  constexpr std::int32_t speed_mm_s = 8'000;
  SmallRandom random(11);
  proof::Fnv1a hash;
  for (int i = 0; i < 2'000; ++i) {
    const auto point = [&](std::int32_t limit) { return Vector{random.within(limit), random.within(limit)}; };
    const Estimate estimate{.robot_um = point(field_um),
                            .heading = wrap_angle(random.within(1 << 15)),
                            .robot_speed_mm_s = random.within(speed_mm_s),
                            .ball_um = point(field_um),
                            .ball_velocity_mm_s = point(i % 8 == 0 ? 2 * rest_speed_mm_s : speed_mm_s)};
    const RelativeState state = relative_state(estimate);
    for (const std::int32_t value : {state.ball_um.x, state.ball_um.y, state.robot_speed_mm_s,
                                     state.ball_velocity_mm_s.x, state.ball_velocity_mm_s.y}) {
      hash.add(value);
    }
    hash.add(state.ball_angle);
  }
  return hash.value();
}

void hash_frame(proof::Fnv1a& hash, const can::Frame& frame) {
  hash.add(frame.id);
  hash.add(frame.length);
  for (const std::uint8_t byte : frame.data) {
    hash.add(byte);
  }
}

// Ticks and decisions, the answers' hash, and the first tick whose answer differed.
void replay(images::Recording& recording) {
  loop::FrameQueue bus;
  loop::SyncTicks sync;
  loop::TickLoop<loop::BuiltInNode, loop::FrameQueue&, loop::SyncTicks&> loop(loop::built_in_robot, bus,
                                                                              sync);
  proof::Fnv1a hash;
  images::RecordedFrame recorded;
  std::int64_t ticks = 0;
  std::int64_t decisions = 0;
  std::int64_t first_difference = -1;
  std::size_t answered = 0;
  const auto differs = [&] {
    if (first_difference < 0) {
      first_difference = ticks;
    }
  };
  while (recording.next(recorded)) {
    if (recorded.answer) {
      const auto frames = bus.sent();
      if (answered >= frames.size() || frames[answered] != recorded.frame) {
        differs();
      }
      ++answered;
      continue;
    }
    const bool was_complete = answered == bus.sent().size();
    if (!was_complete && can::is<can::Sync>(recorded.frame)) {
      differs();
    }
    bus.push(recorded.frame);
    if (loop.turn()) {
      ++ticks;
      answered = 0;
      for (const can::Frame& frame : bus.sent()) {
        hash_frame(hash, frame);
        decisions += static_cast<std::int64_t>(can::is<can::Decision>(frame));
      }
    }
  }
  images::console::print_line("ticks", ticks);
  images::console::print_line("decisions", decisions);
  images::console::print_line("answers", hash.value());
  check("first differing tick", first_difference, -1);
}

}  // namespace

int main() {
  images::console::print_line("policy", trained.identity);
  check("golden vectors", passed_golden_vectors(), std::remove_cvref_t<decltype(trained)>::goldens);
  images::console::print_line("shapes", hash_of_shapes());
  images::console::print_line("relative states", hash_of_relative_states());
  if (const char* name = images::console::word_argument("recording"); name != nullptr) {
    images::Recording recording(name);
    if (recording.is_open()) {
      replay(recording);
    } else {
      images::console::print("no such recording\n");
      ++failures;
    }
  }
  images::console::exit(failures == 0 ? 0 : 1);
}
