// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/loop_timing.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/utsname.h>

#include <nlohmann/json.hpp>

#include "firmware/host/files.hpp"
#include "firmware/host/version.hpp"

namespace striker::linux_port {

namespace {

nlohmann::ordered_json histogram_json(const LatencyHistogram& histogram) {
  nlohmann::ordered_json bins = nlohmann::ordered_json::array();
  for (std::size_t bin = 0; bin < LatencyHistogram::bins; ++bin) {
    if (histogram.count_in(bin) != 0) {
      bins.push_back({LatencyHistogram::lower_end_us(bin), LatencyHistogram::lower_end_us(bin + 1),
                      histogram.count_in(bin)});
    }
  }
  return {{"count", histogram.count()},
          {"min_us", static_cast<double>(histogram.min_ns()) / 1e3},
          {"mean_us", histogram.mean_ns() / 1e3},
          {"p50_us", histogram.percentile_us(0.5)},
          {"p99_us", histogram.percentile_us(0.99)},
          {"p99_9_us", histogram.percentile_us(0.999)},
          {"p99_99_us", histogram.percentile_us(0.9999)},
          {"max_us", static_cast<double>(histogram.max_ns()) / 1e3},
          {"max_tick", histogram.max_tick()},
          {"bins_us", std::move(bins)}};
}

std::string kernel() {
  utsname name{};
  uname(&name);
  return fmt::format("{} {} {} {}", name.sysname, name.release, name.version, name.machine);
}

}  // namespace

ResourceUse thread_resource_use() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return {usage.ru_minflt, usage.ru_majflt, usage.ru_nvcsw, usage.ru_nivcsw};
}

ResourceUse operator-(const ResourceUse& later, const ResourceUse& earlier) {
  return {later.minor_faults - earlier.minor_faults, later.major_faults - earlier.major_faults,
          later.voluntary_switches - earlier.voluntary_switches,
          later.involuntary_switches - earlier.involuntary_switches};
}

std::string summary(const LoopTiming& timing) {
  return fmt::format(
      "stopped after {} ticks; {} periods missed; lateness mean {:.1f} us, 99.9 % within {} us, max {:.1f} us; "
      "execution mean {:.1f} us, max {:.1f} us; {} + {} page faults; {} frames dropped",
      timing.ticks, timing.missed_periods, timing.lateness.mean_ns() / 1e3,
      timing.lateness.percentile_us(0.999), static_cast<double>(timing.lateness.max_ns()) / 1e3,
      timing.execution.mean_ns() / 1e3, static_cast<double>(timing.execution.max_ns()) / 1e3,
      timing.resources.minor_faults, timing.resources.major_faults, timing.dropped_frames);
}

void write_json(const LoopTiming& timing, const PolicyLabel& policy, const std::vector<std::string>& settings,
                const std::filesystem::path& file) {
  nlohmann::ordered_json json = {{"program", "striker-firmware"},
                                 {"policy_name", policy.name},
                                 {"policy", fmt::format("{:08x}", policy.identity)},
                                 {"kernel", kernel()},
                                 {"settings", settings},
                                 {"ticks", timing.ticks},
                                 {"missed_periods", timing.missed_periods},
                                 {"longest_stall_periods", timing.longest_stall_periods},
                                 {"received_frames", timing.received_frames},
                                 {"full_ticks", timing.full_ticks},
                                 {"dropped_frames", timing.dropped_frames},
                                 {"fault", core::name_of(timing.fault)},
                                 {"minor_faults", timing.resources.minor_faults},
                                 {"major_faults", timing.resources.major_faults},
                                 {"voluntary_switches", timing.resources.voluntary_switches},
                                 {"involuntary_switches", timing.resources.involuntary_switches},
                                 {"lateness", histogram_json(timing.lateness)},
                                 {"execution", histogram_json(timing.execution)},
                                 {"receive_to_command", histogram_json(timing.latency)}};
  host::stamp(json);
  host::write_file(file, json.dump(1) + '\n');
}

}  // namespace striker::linux_port
