// SPDX-License-Identifier: Apache-2.0
// What the real-time loop measures of itself, without allocation, and the report of it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/state.hpp"
#include "firmware/ports/linux/latency_histogram.hpp"

namespace striker::linux_port {

// Of one thread (getrusage RUSAGE_THREAD).
struct ResourceUse {
  std::int64_t minor_faults = 0;
  std::int64_t major_faults = 0;
  std::int64_t voluntary_switches = 0;
  std::int64_t involuntary_switches = 0;
};

[[nodiscard]] ResourceUse thread_resource_use();
[[nodiscard]] ResourceUse operator-(const ResourceUse& later, const ResourceUse& earlier);

struct LoopTiming {
  LatencyHistogram lateness;   // of the wake-up, after its deadline
  LatencyHistogram execution;  // of a tick: receive, step, send
  LatencyHistogram latency;    // from the oldest frame that a tick took to its command sent
  std::uint64_t ticks = 0;     // that ran
  std::uint64_t missed_periods = 0;
  std::uint32_t longest_stall_periods = 0;
  std::uint64_t received_frames = 0;
  std::uint64_t full_ticks = 0;  // that took as many frames as a tick may
  std::uint64_t dropped_frames = 0;
  core::Fault fault = core::Fault::none;  // the last one latched
  ResourceUse resources;                  // from the first deadline to the last
};

// One line for a terminal.
[[nodiscard]] std::string summary(const LoopTiming& timing);

struct PolicyLabel {
  std::string name;
  std::uint32_t identity = 0;
};

// JSON, written to a temporary file and renamed. `settings` are the lines that were printed at start. Throws
// std::runtime_error that names the file and the way out.
void write_json(const LoopTiming& timing, const PolicyLabel& policy, const std::vector<std::string>& settings,
                const std::filesystem::path& file);

}  // namespace striker::linux_port
