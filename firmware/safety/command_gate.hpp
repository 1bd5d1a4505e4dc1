// SPDX-License-Identifier: Apache-2.0
// The command gate: the last thing between a controller and its bus, on every port. It knows frames and limits
// alone, keeps its own account of why the wheels may turn, and believes the controller in nothing.
//
// A drive command that moves goes out only if the gate itself saw, in frames received:
//   an arm command that confirms the challenge which it saw go out, and since then neither disarm nor stop nor
//   a fault of the controller's own; renewed within the dead man's time, by commands in sequence;
//   wheel states in sequence within `wheels_limit_ticks`, pictures in sequence within `vision_limit_ticks`.
// Otherwise the frame is made to say torque 0, counted, and the gate stays shut until a confirmed clear: the loop
// hands that to the controller as the fault gate_blocked. Torque, slew and set-points beyond the limits are cut to
// them: that is told (message Safety), and is no fault.
// What is not on the whitelist does not go out at all (whitelist.hpp).
//
// Drives of another make are spoken to with a frame a wheel, and are to be enabled. Enabling takes the same cause, with
// speeds of both wheels within `wheels_limit_ticks` in place of a sequence; torque also takes that both drives told, within
// `enabled_limit_ticks`, that they are enabled and have no error (drive_watch.hpp).
//
// It shares the CRC and the message table with the receiver, and nothing else: a sequence is fresh here after a
// streak of small steps (`Sequence`), there by a window of counts. Of consent in one tick both think alike: the last
// confirmation counts, a disarm beats an arm, a clear right after a stop clears nothing.
//
//   CommandGate<Drives> gate(limits);
//   gate.take(frames, tick);     // received in this tick, before the controller's step
//   gate.check(sent, tick);      // what the step wants to send
//
// Cost: a CRC for each frame from drives, camera and operator; one command unpacked a tick.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "firmware/can/codec.hpp"
#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/frame_list.hpp"
#include "firmware/can/messages.hpp"
#include "firmware/safety/drive_watch.hpp"
#include "firmware/safety/sequence.hpp"
#include "firmware/safety/whitelist.hpp"

namespace striker::safety {

struct GateLimits {
  std::int32_t torque_mNm;
  std::int32_t slew_mNm;  // change of a torque from one command to the next
  std::int32_t set_point_mm_s;
};

inline constexpr std::uint32_t wheels_limit_ticks = 25;
inline constexpr std::uint32_t enabled_limit_ticks = 35;
inline constexpr std::uint32_t vision_limit_ticks = 200;
inline constexpr std::uint32_t armed_limit_ticks = 10'100;
inline constexpr std::uint32_t challenge_limit_ticks = 600;
inline constexpr std::uint32_t stop_hold_ticks = 150;  // no clear so soon after a stop

template <can::DriveProtocol Drives>
class CommandGate {
 public:
  explicit constexpr CommandGate(const GateLimits& limits) : limits_(limits) {}

  void take(std::span<const can::Frame> frames, std::uint32_t tick) {
    confirmation_ = {};
    bool disarmed = false;
    if constexpr (is_foreign) {
      wheels_.begin_tick();
    }
    for (const can::Frame& frame : frames) {
      if (Drives::owns(frame)) {
        take_wheels(frame, tick - frame.age_ms);
      } else if (can::is<can::VisionPose>(frame)) {
        pose_.take(sequence_of<can::VisionPose>(frame), tick - frame.age_ms);
      } else if (can::is<can::VisionBall>(frame)) {
        ball_.take(sequence_of<can::VisionBall>(frame), tick - frame.age_ms);
      } else if (can::is<can::EmergencyStop>(frame)) {
        stop(sequence_of<can::EmergencyStop>(frame).has_value(), tick);
      } else if (can::is<can::ModeCommand>(frame)) {
        disarmed = take_mode(frame, tick) || disarmed;
      }
    }
    // As the controller has it: the last confirmation of a tick counts, and a disarm beats it.
    if (confirmation_.challenge != 0) {
      confirm(confirmation_, tick);
    }
    armed_ = armed_ && !disarmed && tick - armed_tick_ <= armed_limit_ticks;
  }

  void check(can::FrameList& sent, std::uint32_t tick) {
    refused_ += sent.keep(may_send<Drives>);
    active_limits_ = 0;
    for (can::Frame& frame : sent.frames()) {
      if (can::is<can::FaultReport>(frame)) {
        armed_ = false;
      } else if (can::is<can::Challenge>(frame)) {
        const bool valid = can::receive(frame, challenge_) == can::Verdict::accepted;
        challenge_tick_ = valid ? tick : challenge_tick_;
      } else if (std::find(Drives::sends.begin(), Drives::sends.end(), frame.id) != Drives::sends.end()) {
        check_command(frame, tick);
      }
    }
  }

  // Logical time begins anew: consent ends, a stop does not.
  void restart() {
    const bool shut = shut_;
    const bool stopped = stopped_;
    *this = CommandGate(limits_);
    shut_ = shut;
    stopped_ = stopped;  // held from tick 0
  }

  // It stopped a command, and was not cleared since.
  [[nodiscard]] bool has_blocked() const { return blocked_since_clear_; }
  [[nodiscard]] std::uint32_t blocked() const { return blocked_; }
  [[nodiscard]] std::size_t refused() const { return refused_; }
  // can::limit_...: of the last tick.
  [[nodiscard]] std::uint32_t active_limits() const { return active_limits_; }

 private:
  static constexpr bool is_foreign = can::ForeignDrives<Drives>;
  static_assert(is_foreign || can::ProtectedDrives<Drives>);

  void take_wheels(const can::Frame& frame, std::uint32_t received_tick) {
    if constexpr (is_foreign) {
      wheels_.take(Drives::news_of(frame), received_tick);
    } else {
      wheels_.take(Drives::sequence(frame), received_tick);
    }
  }

  // The counter of a frame whose length and CRC are correct.
  template <class Message>
  static std::optional<std::uint8_t> sequence_of(const can::Frame& frame) {
    constexpr const can::MessageInfo& info = can::layout<Message>.info;
    return sequence_of(frame, info.length, info.data_ids);
  }
  [[gnu::noinline]] static std::optional<std::uint8_t> sequence_of(const can::Frame& frame,
                                                                   std::uint8_t length,
                                                                   can::DataIdList list) {
    return can::sound_counter(frame, length, list);
  }

  void stop(bool pressed, std::uint32_t tick) {
    shut_ = shut_ || pressed;
    stopped_ = stopped_ || pressed;
    stop_tick_ = pressed ? tick : stop_tick_;
  }

  // True for a disarm. A renewal counts in sequence alone: one that is repeated for ever renews nothing.
  [[gnu::noinline]] bool take_mode(const can::Frame& frame, std::uint32_t tick) {
    can::ModeCommand command;
    if (can::receive(frame, command) != can::Verdict::accepted) {
      return false;
    }
    operator_.take(can::counter_of(frame), tick);
    const auto mode = static_cast<can::Mode>(command.mode);
    if (mode == can::Mode::renew && operator_.goes_on()) {
      armed_tick_ = tick;
    } else if (command.challenge != 0) {
      confirmation_ = command;
    }
    return mode == can::Mode::disarm;
  }

  // A challenge is good once, and for the mode that was asked for.
  void confirm(const can::ModeCommand& command, std::uint32_t tick) {
    const bool fits = command.challenge == challenge_.challenge && command.mode == challenge_.mode &&
                      tick - challenge_tick_ <= challenge_limit_ticks;
    challenge_ = {};
    if (!fits) {
      return;
    }
    if (command.mode == static_cast<std::int32_t>(can::Mode::arm)) {
      armed_ = !shut_;
      armed_tick_ = tick;
    } else if (command.mode == static_cast<std::int32_t>(can::Mode::clear) &&
               (!stopped_ || tick - stop_tick_ > stop_hold_ticks)) {
      armed_ = armed_ && !shut_;
      shut_ = stopped_ = blocked_since_clear_ = false;
    }
  }

  [[nodiscard]] bool has_cause(std::uint32_t tick) const {
    return armed_ && !shut_ && tick - armed_tick_ <= armed_limit_ticks &&
           wheels_.fresh(tick, wheels_limit_ticks) && pose_.fresh(tick, vision_limit_ticks) &&
           ball_.fresh(tick, vision_limit_ticks);
  }

  void check_command(can::Frame& frame, std::uint32_t tick) {
    if constexpr (is_foreign) {
      check_enabling(frame, tick);
    }
    const core::DriveCommand wanted = Drives::command_of(frame);
    if (wanted == core::DriveCommand{}) {
      remember(frame, {});
      return;
    }
    const core::DriveCommand passed = may_move(tick) ? limited(wanted, before(frame)) : block();
    remember(frame, passed.torque);
    if (!(passed == wanted)) {
      recode(frame, passed);
    }
  }

  void check_enabling(can::Frame& frame, std::uint32_t tick) {
    if (Drives::enables(frame) && !has_cause(tick)) {
      block();
      Drives::disable(frame);
    }
  }
  [[nodiscard]] bool may_move(std::uint32_t tick) const {
    if constexpr (is_foreign) {
      return has_cause(tick) && wheels_.enabled(tick, enabled_limit_ticks);
    } else {
      return has_cause(tick);
    }
  }

  // The torques that a command follows: those that its frame has.
  [[nodiscard]] core::WheelTorques before(const can::Frame& frame) const {
    if constexpr (is_foreign) {
      return can::left_wheel == Drives::wheel_of(frame) ? core::WheelTorques{torque_.left_mNm, 0}
                                                        : core::WheelTorques{0, torque_.right_mNm};
    } else {
      return torque_;
    }
  }
  void remember(const can::Frame& frame, const core::WheelTorques& torque) {
    if constexpr (is_foreign) {
      if (const auto wheel = Drives::wheel_of(frame)) {
        torque_ = *wheel == can::left_wheel ? core::WheelTorques{torque.left_mNm, torque_.right_mNm}
                                            : core::WheelTorques{torque_.left_mNm, torque.right_mNm};
      }
    } else {
      torque_ = torque;
    }
  }

  [[gnu::noinline]] static void recode(can::Frame& frame, const core::DriveCommand& command) {
    Drives::recode(frame, command);
  }

  core::DriveCommand block() {
    shut_ = true;
    blocked_since_clear_ = true;
    blocked_ = std::min<std::uint32_t>(blocked_ + 1, 255);
    return {};
  }

  // Apart: a step limits a command or recodes it, which bounds it (tools/step_bound/facts.toml).
  [[gnu::noinline]] core::DriveCommand limited(const core::DriveCommand& wanted,
                                               const core::WheelTorques& last) {
    return {
        .torque = {limited(wanted.torque.left_mNm, last.left_mNm),
                   limited(wanted.torque.right_mNm, last.right_mNm)},
        .set_point = {bounded(wanted.set_point.left_mm_s, limits_.set_point_mm_s, can::limit_set_point),
                      bounded(wanted.set_point.right_mm_s, limits_.set_point_mm_s, can::limit_set_point)}};
  }
  std::int32_t limited(std::int32_t wanted_mNm, std::int32_t before_mNm) {
    const std::int32_t torque_mNm = bounded(wanted_mNm, limits_.torque_mNm, can::limit_torque);
    const std::int32_t from_mNm = within(before_mNm, limits_.torque_mNm);
    return from_mNm + bounded(torque_mNm - from_mNm, limits_.slew_mNm, can::limit_slew);
  }
  // What the gate keeps may change by itself: neither a remembered torque nor a limit that became negative leads beyond
  // what a limit allows.
  static std::int32_t within(std::int32_t value, std::int32_t limit) {
    return limit < 0 ? 0 : std::clamp(value, -limit, limit);
  }
  std::int32_t bounded(std::int32_t value, std::int32_t limit, std::uint32_t name) {
    const std::int32_t inside = within(value, limit);
    active_limits_ |= inside == value ? 0 : name;
    return inside;
  }

  GateLimits limits_;
  std::conditional_t<is_foreign, DriveWatch, Sequence<12, 4>> wheels_;
  Sequence<3, 3> pose_;
  Sequence<3, 3> ball_;
  Sequence<3, 3> operator_;
  can::ModeCommand confirmation_;  // the last one of the tick
  can::Challenge challenge_;
  std::uint32_t challenge_tick_ = 0;
  std::uint32_t armed_tick_ = 0;
  std::uint32_t stop_tick_ = 0;
  core::WheelTorques torque_;  // of the last command
  bool armed_ = false;
  bool shut_ = false;  // a stop or a blocked command: until a confirmed clear
  bool stopped_ = false;
  bool blocked_since_clear_ = false;
  std::uint32_t active_limits_ = 0;
  std::uint32_t blocked_ = 0;
  std::size_t refused_ = 0;
};

}  // namespace striker::safety
