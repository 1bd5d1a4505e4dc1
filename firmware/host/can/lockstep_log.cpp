// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/can/lockstep_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/host/can/candump_line.hpp"

namespace striker::host {

namespace {

bool is_controllers(const can::Frame& frame) {
  bool sent = false;
  can::for_each_layout([&](const auto& message) {
    sent |= message.info.id == frame.id && message.info.sender == can::Node::controller;
  });
  return sent;
}

bool wants_torque(const std::vector<can::Frame>& frames) {
  return std::any_of(frames.begin(), frames.end(), [](const can::Frame& frame) {
    can::WheelCommand command;
    return can::is<can::WheelCommand>(frame) && can::unpack(frame, command) == can::Verdict::accepted &&
           (command.left_torque_mNm != 0 || command.right_torque_mNm != 0);
  });
}

bool is_cut_off(const LoggedTick& tick) {
  return tick.is_last &&
         std::none_of(tick.answers.begin(), tick.answers.end(),
                      [](const LoggedAnswer& answer) { return can::is<can::EndOfTick>(answer.frame); });
}

// A bus in time brings an answer's frames in the order of their identifiers, and without its end.
template <class Answer, class FrameOf>
void put_in_order(Answer& answer, FrameOf frame_of) {
  std::erase_if(answer, [&](const auto& one) { return can::is<can::EndOfTick>(frame_of(one)); });
  std::stable_sort(answer.begin(), answer.end(),
                   [&](const auto& one, const auto& other) { return frame_of(one).id < frame_of(other).id; });
}

std::optional<AnswerDifference> first_difference(const LoggedTick& recorded,
                                                 std::vector<can::Frame> answered) {
  std::vector<LoggedAnswer> answers = recorded.answers;
  put_in_order(answers, [](const LoggedAnswer& answer) { return answer.frame; });
  put_in_order(answered, [](const can::Frame& frame) { return frame; });
  for (std::size_t i = 0; i < std::max(answers.size(), answered.size()); ++i) {
    const bool was = i < answers.size();
    const bool is = i < answered.size();
    if (!was || !is || answers[i].frame != answered[i]) {
      return AnswerDifference{.tick = recorded.tick,
                              .line = was ? answers[i].line : recorded.line,
                              .recorded = was ? std::optional(answers[i].frame) : std::nullopt,
                              .answered = is ? std::optional(answered[i]) : std::nullopt};
    }
  }
  return std::nullopt;
}

// As candump writes it.
std::string text_of(const std::optional<can::Frame>& frame) {
  if (!frame) {
    return "no frame";
  }
  std::string text = fmt::format("{:03X}#", frame->id);
  for (std::size_t byte = 0; byte < frame->length; ++byte) {
    text += fmt::format("{:02X}", frame->data[byte]);
  }
  return text;
}

}  // namespace

LockstepLog::LockstepLog(const std::filesystem::path& file, std::string interface)
    : name_(file.string()), stream_(file), interface_(std::move(interface)), is_given_(!interface_.empty()) {
  if (!stream_) {
    throw std::runtime_error(fmt::format(
        "{}: cannot be read ({}): name a candump log, as 'striker-sil kick --log' and 'candump -L' write it",
        name_, std::strerror(errno)));
  }
  while (!begun_) {
    const auto frame = next_frame();
    if (!frame) {
      fail("no SYNC in it: only a run in lockstep can be repeated; record one with 'striker-sil kick --log'");
    }
    if (is_controllers(*frame)) {
      continue;  // of a tick that began before the log
    }
    inputs_.push_back(*frame);
    if (can::is<can::Sync>(*frame)) {
      begun_ = tick_begun_by(*frame);
    }
  }
}

std::optional<LoggedTick> LockstepLog::next() {
  while (begun_) {
    const auto frame = next_frame();
    if (!frame) {
      break;
    }
    if (is_controllers(*frame)) {
      begun_->answers.push_back({*frame, line_});
      continue;
    }
    inputs_.push_back(*frame);
    if (can::is<can::Sync>(*frame)) {
      return std::exchange(begun_, tick_begun_by(*frame));
    }
  }
  if (begun_) {
    begun_->is_last = true;
  }
  return std::exchange(begun_, std::nullopt);
}

LoggedTick LockstepLog::tick_begun_by(const can::Frame& sync) {
  can::Sync begun;
  static_cast<void>(can::unpack(sync, begun));  // the controller's answer shows whether it is valid
  return {.tick = static_cast<std::uint32_t>(begun.tick),
          .inputs = std::exchange(inputs_, {}),
          .answers = {},
          .line = line_};
}

std::optional<can::Frame> LockstepLog::next_frame() {
  for (std::string text; std::getline(stream_, text);) {
    ++line_;
    std::string_view line = text;
    line.remove_suffix(line.ends_with('\r') ? 1 : 0);
    const auto parsed = parse_candump_line(line);
    if (const char* const* const problem = std::get_if<const char*>(&parsed)) {
      fail(fmt::format("line {}: {}: mend or remove the line", line_, *problem));
    }
    const auto& logged = std::get<CandumpLine>(parsed);
    require_interface(logged.interface);
    if (logged.interface != interface_) {
      continue;
    }
    if (logged.kind == LoggedKind::data) {
      return logged.frame;
    }
    ++foreign_frames_;
  }
  if (stream_.bad()) {
    fail(fmt::format("line {}: cannot be read further ({})", line_ + 1, std::strerror(errno)));
  }
  return std::nullopt;
}

void LockstepLog::require_interface(std::string_view interface) {
  if (interface_.empty()) {
    interface_ = interface;
  }
  if (!is_given_ && interface != interface_) {
    fail(fmt::format("line {}: frames of {} and of {}: choose one with --interface", line_, interface_,
                     interface));
  }
}

void LockstepLog::fail(const std::string& what) const {
  throw std::runtime_error(fmt::format("{}: {}", name_, what));
}

ReplayReport replay(LockstepLog& log,
                    const std::function<std::vector<can::Frame>(const LoggedTick&)>& answer_to,
                    const std::function<bool()>& stop) {
  ReplayReport report;
  while (const auto tick = stop() ? std::nullopt : log.next()) {
    const std::vector<can::Frame> answered = answer_to(*tick);
    ++report.ticks;
    report.torque_ticks += wants_torque(answered) ? 1 : 0;
    if (tick->answers.empty() || is_cut_off(*tick)) {
      ++report.not_compared;
    } else if (const auto difference = first_difference(*tick, answered)) {
      ++report.differing;
      report.first = report.first ? report.first : difference;
    }
  }
  report.foreign_frames = log.foreign_frames();
  return report;
}

std::string format_report(const ReplayReport& report) {
  std::string text = fmt::format(
      "{} ticks: the answers of {} are the recorded ones, {} differ, {} were not answered then, or not to the end\n",
      report.ticks, report.ticks - report.differing - report.not_compared, report.differing,
      report.not_compared);
  if (report.foreign_frames != 0) {
    text += fmt::format("{} frames that are no classic data frames with 11-bit identifiers: left out\n",
                        report.foreign_frames);
  }
  if (report.first) {
    text += fmt::format("first difference in tick {}, line {}: {} then, {} now\n", report.first->tick,
                        report.first->line, text_of(report.first->recorded), text_of(report.first->answered));
  }
  return text + fmt::format("torque in {} ticks\n", report.torque_ticks);
}

}  // namespace striker::host
