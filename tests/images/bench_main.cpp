// SPDX-License-Identifier: Apache-2.0
// The measuring image, for QEMU with semihosting and `-icount shift=0`: instructions of the network and of
// `step`.
//
//   striker-bench [inputs N] [plain N] [recording FILE] [ticks N] [search N] [directed N] [seed N]
//
// Prints "name number" lines for tools/bench-kernel. Every count is exact, from the first instruction of the
// counted function to its return, but those of the search and the directed step, which are exact to a count of the timer.
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "firmware/policy/built_in.hpp"
#include "firmware/policy/kernel/int16/portable.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/ports/bare_metal/memory.hpp"
#include "tests/images/console.hpp"
#include "tests/images/directed_step.hpp"
#include "tests/images/instruction_counter.hpp"
#include "tests/images/recording.hpp"
#include "tests/images/step_search.hpp"
#include "tests/policy/multiply_accumulates.hpp"
#include "tests/policy/synthetic_policy.hpp"

namespace {

using namespace striker;
using namespace striker::core;
using namespace striker::policy;

using Node = loop::GatedNode<loop::BuiltInNode>;

constexpr const auto& trained = policy::built_in;

template <const auto& policy>
using Raw = std::array<std::int32_t, ShapeOf<policy>::inputs>;
template <const auto& policy>
using Answer = QValues<ShapeOf<policy>::actions>;

struct Range {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t greatest = 0;
  void add(std::uint32_t value) {
    least = value < least ? value : least;
    greatest = value > greatest ? value : greatest;
  }
};

// Repetitions, at least 40, after which one instruction more is a whole number of counts more.
std::uint32_t exact_repetitions() {
  const auto [instructions, counts] = images::counter_unit();
  const std::uint32_t whole = instructions / std::gcd(instructions, counts);
  return whole >= 40 ? whole : 40;
}

std::uint32_t instructions(std::uint32_t counts, std::uint32_t repetitions) {
  const auto unit = images::counter_unit();
  return static_cast<std::uint32_t>(
      (std::uint64_t{counts} * unit.instructions + unit.counts * repetitions / 2) /
      (std::uint64_t{unit.counts} * repetitions));
}

// Takes one instruction, and any arguments.
extern "C" void return_at_once();
asm(".text\n\t.thumb_func\n\t.type return_at_once, %function\nreturn_at_once:\n\tbx lr\n");

template <const auto& policy>
using Function = Answer<policy> (*)(const Raw<policy>&);

// The same loop whatever it calls: that is not known when it is compiled.
template <const auto& policy>
[[gnu::noipa]] std::uint32_t count(Function<policy> function, const Raw<policy>& raw,
                                   std::uint32_t repetitions) {
  images::restart_counter();
  for (std::uint32_t i = 0; i < repetitions; ++i) {
    const Answer<policy> answer = function(raw);
    asm volatile("" : : "r"(&answer) : "memory");
  }
  return images::counted();
}

// What repetitions cost, without what is around them: two runs' difference.
template <const auto& policy>
std::uint32_t counts_of(Function<policy> function, std::uint32_t repetitions) {
  const std::uint32_t once = count<policy>(function, {}, repetitions);
  return count<policy>(function, {}, 2 * repetitions) - once;
}

template <const auto& policy, class Kernel = SelectedKernel<policy>>
Range count_inference(std::uint32_t inputs) {
  const std::uint32_t repetitions = exact_repetitions();
  const Function<policy> network = infer<policy, Kernel>;
  SmallRandom random(1);
  const std::uint32_t base =
      counts_of<policy>(network, repetitions) -
      counts_of<policy>(reinterpret_cast<Function<policy>>(&return_at_once), repetitions);
  const std::uint32_t first = count<policy>(network, {}, repetitions);
  Range range;
  for (std::uint32_t i = 0; i < inputs; ++i) {
    Raw<policy> raw{};
    if (i < ShapeOf<policy>::goldens) {
      raw = policy.golden_vectors[i].raw;
    } else {
      for (std::int32_t& element : raw) {
        element = draw_raw(random);
      }
    }
    range.add(instructions(base + count<policy>(network, raw, repetitions) - first, repetitions) + 1);
  }
  return range;
}

// A copy of the node takes each repetition: copying is counted on its own, and taken off.
[[gnu::noinline]] std::uint32_t count_steps(const Node& before, const loop::Tick& tick, can::FrameList& sent,
                                            std::uint32_t repetitions, bool steps) {
  images::restart_counter();
  for (std::uint32_t i = 0; i < repetitions; ++i) {
    Node node = before;
    asm volatile("" : : "r"(&node) : "memory");
    if (steps) {
      node.step(tick, sent);
    }
  }
  return images::counted();
}

void count_recorded_steps(images::Recording& recording, std::uint32_t most_ticks) {
  const std::uint32_t repetitions = exact_repetitions();
  Node node(loop::built_in_robot);
  can::FrameList sent;
  std::array<can::Frame, 32> frames{};
  std::size_t frame_count = 0;
  std::uint32_t tick = 0;
  Range self_test;  // a golden vector each
  Range with_decision;
  Range without;
  images::RecordedFrame recorded;
  while (tick < most_ticks && recording.next(recorded)) {
    if (recorded.answer) {
      continue;
    }
    if (!can::is<can::Sync>(recorded.frame)) {
      frames[frame_count++] = recorded.frame;
      continue;
    }
    const loop::Tick now{.number = tick++, .frames = std::span(frames).first(frame_count)};
    frame_count = 0;
    const std::uint32_t copying = count_steps(node, now, sent, repetitions, false);
    const std::uint32_t all = count_steps(node, now, sent, repetitions, true);
    const bool boots =
        node.controller().state() == State::boot || node.controller().state() == State::self_test;
    node.step(now, sent);
    bool decided = false;
    for (const can::Frame& frame : std::as_const(sent).frames()) {
      decided = decided || can::is<can::Decision>(frame);
    }
    (decided ? with_decision : boots ? self_test : without).add(instructions(all - copying, repetitions));
  }
  images::console::print_line("step ticks", tick);
  images::console::print_line("step in self-test max", self_test.greatest);
  images::console::print_line("step without decision min", without.least);
  images::console::print_line("step without decision max", without.greatest);
  images::console::print_line("step with decision min", with_decision.least);
  images::console::print_line("step with decision max", with_decision.greatest);
}

}  // namespace

int main() {
  images::console::print("kernel ");
  images::console::print(SelectedKernel<trained>::name);
  images::console::print("\n");
  images::console::print_line("multiply-accumulates", multiply_accumulates<trained>);
  images::console::print_line("weight bytes", Packed<trained>::bytes);
  images::console::print_line("node bytes", sizeof(Node));
  if (const std::uint32_t inputs = images::console::argument("inputs", 0); inputs > 0) {
    const Range range = count_inference<trained>(inputs);
    images::console::print_line("inference inputs", inputs);
    images::console::print_line("inference repetitions", exact_repetitions());
    images::console::print_line("inference min", range.least);
    images::console::print_line("inference max", range.greatest);
  }
  if (const std::uint32_t inputs = images::console::argument("plain", 0); inputs > 0) {
    const Range range = count_inference<trained, kernel::int16::Portable>(inputs);
    images::console::print_line("plain min", range.least);
    images::console::print_line("plain max", range.greatest);
  }
  if (const char* name = images::console::word_argument("recording"); name != nullptr) {
    images::Recording recording(name);
    count_recorded_steps(recording, images::console::argument("ticks", 2'000));
  }
  if (const std::uint32_t steps = images::console::argument("search", 0); steps > 0) {
    const images::SearchResult found =
        images::search_longest_step(steps, images::console::argument("seed", 1));
    images::console::print_line("search steps", steps);
    images::console::print_line("search decisions", found.decisions);
    images::console::print_line("search max", found.greatest_instructions);
  }
  if (const std::uint32_t tries = images::console::argument("directed", 0); tries > 0) {
    images::console::print_line("directed max",
                                images::longest_directed_step(tries, images::console::argument("seed", 1)));
  }
  images::console::print_line("stack high water", bare_metal::stack_high_water_bytes());
  images::console::exit(0);
}
