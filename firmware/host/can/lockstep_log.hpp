// SPDX-License-Identifier: Apache-2.0
// A candump log of a run in lockstep, tick by tick: what went to the controller, and what it answered. A
// controller's answer is a function of those frames alone, so that a log is a test: give another controller the
// same frames, and compare: every frame of an answer but EndOfTick, to the bit, in the order of
// identifiers.
//
//   LockstepLog log("run.log", "");
//   const ReplayReport report = replay(log, [&](const LoggedTick& tick) { return answer_to(tick.inputs); });
//
// Not in a log, and so not repeated: what the port itself told the controller (a bus that was off, a queue that
// overflowed, a wait for SYNC that was too long). On a bus in time (`striker-sil kick --bitrate`) that is too slow for
// an answer to be through before the next SYNC, its frames count to the wrong tick, and differ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/can/frame.hpp"

namespace striker::host {

struct LoggedAnswer {
  can::Frame frame;
  std::uint64_t line = 0;
};

struct LoggedTick {
  std::uint32_t tick = 0;          // as its Sync says
  std::vector<can::Frame> inputs;  // Sync is the last
  std::vector<LoggedAnswer> answers;
  std::uint64_t line = 0;  // of its Sync
  bool is_last = false;    // its answer may have been cut off
};

class LockstepLog {
 public:
  // Of the log's frames only those on `interface`; empty: on the only one that is in it. Throws
  // std::runtime_error with one line that names the file, the line and the way out, as do `next` and a log
  // without a Sync.
  LockstepLog(const std::filesystem::path& file, std::string interface);

  // The next tick, or nothing at the end.
  [[nodiscard]] std::optional<LoggedTick> next();

  // Remote, extended, CAN FD and error frames so far: no controller receives them.
  [[nodiscard]] std::uint64_t foreign_frames() const { return foreign_frames_; }

 private:
  [[noreturn]] void fail(const std::string& what) const;
  LoggedTick tick_begun_by(const can::Frame& sync);
  std::optional<can::Frame> next_frame();
  void require_interface(std::string_view interface);

  std::string name_;
  std::ifstream stream_;
  std::string interface_;
  bool is_given_;
  std::uint64_t line_ = 0;
  std::uint64_t foreign_frames_ = 0;
  std::optional<LoggedTick> begun_;
  std::vector<can::Frame> inputs_;  // of the tick after that
};

struct AnswerDifference {
  std::uint32_t tick = 0;
  std::uint64_t line = 0;              // of the recorded frame, or of the tick's Sync
  std::optional<can::Frame> recorded;  // nothing: the answer has a frame more
  std::optional<can::Frame> answered;  // nothing: the answer has a frame less
};

struct ReplayReport {
  std::uint64_t ticks = 0;
  std::uint64_t not_compared = 0;  // of them: then unanswered, or the log's end cut the answer off
  std::uint64_t differing = 0;
  std::uint64_t torque_ticks = 0;  // in which the controller wanted torque now
  std::uint64_t foreign_frames = 0;
  std::optional<AnswerDifference> first;
};

// `answer_to` gives a controller's answer to a tick's inputs. Goes on after a difference. Stops early, after a whole
// tick, when `stop` says so.
[[nodiscard]] ReplayReport replay(LockstepLog& log,
                                  const std::function<std::vector<can::Frame>(const LoggedTick&)>& answer_to,
                                  const std::function<bool()>& stop);

// What a program prints of it, in lines.
[[nodiscard]] std::string format_report(const ReplayReport& report);

}  // namespace striker::host
