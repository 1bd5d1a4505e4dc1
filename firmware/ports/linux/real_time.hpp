// SPDX-License-Identifier: Apache-2.0
// What a Linux process can ask of the kernel to be on time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace striker::linux_port {

enum class Scheduler : std::uint8_t { fifo, deadline, other };

struct RealTimeSettings {
  Scheduler scheduler = Scheduler::fifo;
  int priority = 80;            // SCHED_FIFO
  std::int64_t runtime_ns = 0;  // SCHED_DEADLINE: reserved in every period
  std::int64_t period_ns = 0;   // SCHED_DEADLINE
  int cpu = -1;                 // the only processor to run on; -1: any
};

// One line a measure, for a terminal and the timing report: what was granted, and what was refused and why.
struct Granted {
  std::vector<std::string> lines;
  bool complete = true;
};

// For the calling thread: processor, scheduling policy. For the process: all memory locked, now and to come,
// and the stack touched; for the machine, while the process lives: no deep sleep (/dev/cpu_dma_latency).
[[nodiscard]] Granted ask_for_real_time(const RealTimeSettings& settings);

// Best effort for a helper thread: just below the loop's priority, and on its processor. (Two processors that
// wake in every tick keep each other, and on a virtual machine its host, from being on time.)
void stay_below(const RealTimeSettings& settings);

}  // namespace striker::linux_port
