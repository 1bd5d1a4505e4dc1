// SPDX-License-Identifier: Apache-2.0
// Real-time factors of a match's world on one core: `times_real_time` is simulated over processor time.
//   ninja -C build match_benchmark && build/bin/match_benchmark
#include <benchmark/benchmark.h>

#include "tests/world/match/drivers.hpp"

namespace striker::sil {
namespace {

double step_s(const benchmark::State& state) {
  return static_cast<double>(state.range(0)) / 1e3;
}

void report(benchmark::State& state, double simulated_s) {
  state.counters["times_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
}

void drive_about(benchmark::State& state) {
  const WorldConfig config = match_world(step_s(state));
  World world(config);
  RandomDrivers drivers(world, config, 1);
  double simulated_s = 0.0;
  for (auto unused : state) {
    drivers.step();
    simulated_s += config.step_s;
  }
  report(state, simulated_s);
}

// The mean of 6 s from apart to jammed, again and again.
void corner(benchmark::State& state, bool cut) {
  WorldConfig config = match_world(step_s(state));
  config.crowds_are_cut = cut;
  World world(config);
  double simulated_s = 0.0;
  for (auto unused : state) {
    place_for_corner(world);
    press(world, config, 1.6, 6.0);
    simulated_s += 6.0;
  }
  report(state, simulated_s);
}

BENCHMARK(drive_about)->Arg(10)->Arg(5)->Arg(1);
BENCHMARK_CAPTURE(corner, cut, true)->Arg(10)->Arg(5)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(corner, exact, false)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace striker::sil

BENCHMARK_MAIN();
