// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/real_time.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace striker::linux_port {

namespace {

constexpr std::size_t touched_stack_bytes = std::size_t{256} * 1024;

class Asked {
 public:
  void note(bool granted, const std::string& what) {
    const std::string why = granted ? "" : fmt::format(" refused ({})", std::strerror(errno));
    result_.lines.push_back(what + why);
    result_.complete = result_.complete && granted;
  }
  [[nodiscard]] Granted result() { return std::move(result_); }

 private:
  Granted result_;
};

bool run_on(int cpu) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  return sched_setaffinity(0, sizeof set, &set) == 0;
}

bool set_fifo(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
}

// As in linux/sched/types.h, which does not go together with glibc's sched.h; glibc 2.36 has no wrapper
// either.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = 6;  // SCHED_DEADLINE
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime_ns = 0;
  std::uint64_t deadline_ns = 0;
  std::uint64_t period_ns = 0;
};

bool set_deadline(std::int64_t runtime_ns, std::int64_t period_ns) {
  SchedulingAttributes attributes;
  attributes.runtime_ns = static_cast<std::uint64_t>(runtime_ns);
  attributes.deadline_ns = static_cast<std::uint64_t>(period_ns);
  attributes.period_ns = static_cast<std::uint64_t>(period_ns);
  return syscall(SYS_sched_setattr, 0, &attributes, 0) == 0;
}

[[gnu::noinline]] void touch_stack() {
  std::array<unsigned char, touched_stack_bytes> stack;
  for (std::size_t i = 0; i < stack.size(); i += 4096) {
    *const_cast<volatile unsigned char*>(&stack[i]) = 0;
  }
}

// The request holds as long as the file is open (Documentation/power/pm_qos_interface.rst).
void forbid_deep_sleep(Asked& asked) {
  const int file = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) {
    asked.note(true, "no /dev/cpu_dma_latency in this kernel: it does not say how deep it sleeps");
    return;
  }
  const std::int32_t greatest_us = 0;
  const bool granted = file >= 0 && write(file, &greatest_us, sizeof greatest_us) == sizeof greatest_us;
  asked.note(granted, "no deep sleep (/dev/cpu_dma_latency 0)");
}

}  // namespace

Granted ask_for_real_time(const RealTimeSettings& settings) {
  Asked asked;
  if (settings.cpu >= 0) {
    asked.note(run_on(settings.cpu), fmt::format("processor {}", settings.cpu));
  }
  if (settings.scheduler == Scheduler::fifo) {
    asked.note(set_fifo(settings.priority), fmt::format("SCHED_FIFO priority {}", settings.priority));
  } else if (settings.scheduler == Scheduler::deadline) {
    asked.note(set_deadline(settings.runtime_ns, settings.period_ns),
               fmt::format("SCHED_DEADLINE {} us in every {} us", settings.runtime_ns / 1000,
                           settings.period_ns / 1000));
  } else {
    prctl(PR_SET_TIMERSLACK, 1);
    asked.note(true, "SCHED_OTHER, timer slack 1 ns");
  }
  asked.note(mlockall(MCL_CURRENT | MCL_FUTURE) == 0, "locked memory");
  touch_stack();
  asked.note(true, fmt::format("{} KiB of stack touched", touched_stack_bytes / 1024));
  forbid_deep_sleep(asked);
  return asked.result();
}

void stay_below(const RealTimeSettings& settings) {
  if (settings.cpu >= 0) {
    run_on(settings.cpu);
  }
  if (settings.scheduler != Scheduler::other && settings.priority > 1) {
    set_fifo(settings.priority - 1);
  }
}

}  // namespace striker::linux_port
