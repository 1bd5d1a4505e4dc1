// SPDX-License-Identifier: Apache-2.0
// The command gate with a node behind it that sends whatever it likes, and a bus before it on which anybody does:
// what moves left only with a confirmed arm that the gate saw, fresh inputs, and within the limits.
#include "firmware/safety/command_gate.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

#include "firmware/can/drives/striker_drives.hpp"
#include "tests/fuzz/support/any_frame.hpp"

namespace striker::fuzz {
namespace {

constexpr safety::GateLimits limits = {.torque_mNm = 400, .slew_mNm = 800, .set_point_mm_s = 2550};

// When the newest correct frame of a kind was received. Nothing in this target lasts for 2^31 ticks.
class Seen {
 public:
  void see(const can::Frame& frame, std::uint32_t tick) {
    const std::int64_t received = std::int64_t{tick} - frame.age_ms;
    newest_ = ever_ ? std::max(newest_, received) : received;
    ever_ = true;
  }
  [[nodiscard]] bool within(std::uint32_t tick, std::uint32_t limit_ticks) const {
    return ever_ && tick - newest_ <= limit_ticks;
  }

 private:
  bool ever_ = false;
  std::int64_t newest_ = 0;
};

class GateRig {
 public:
  explicit GateRig(Bytes& bytes) : bytes_(bytes) {}

  void run() {
    while (!bytes_.done()) {
      operate(bytes_.u8() & 31U);
    }
    step();
  }

 private:
  using Gate = safety::CommandGate<can::StrikerDrives>;

  void operate(std::uint8_t operation) {
    switch (operation) {
      case letter('w'):
        return feed(1 + bytes_.u8() % 64);
      case letter('f'):
        return in_.push_back(forged_frame(bytes_));
      case letter('x'):
        return in_.push_back(raw_frame(bytes_));
      case letter('e'):
        age_ms_ = bytes_.u8();
        return;
      case letter('y'):
        return in_.push_back(
            can::send(can::ModeCommand{.mode = told_.mode, .challenge = told_.challenge}, mode_));
      case letter('d'):
        return in_.push_back(can::send(can::ModeCommand{}, mode_));
      case letter('n'):
        return in_.push_back(
            can::send(can::ModeCommand{.mode = static_cast<std::int32_t>(can::Mode::renew)}, mode_));
      case letter('s'):
        return in_.push_back(can::send(can::EmergencyStop{}, stop_));
      case letter('a'):
        return challenge(can::Mode::arm);
      case letter('c'):
        return challenge(can::Mode::clear);
      case letter('g'):
        return out_.add(forged_frame(bytes_));
      case letter('u'):
        return out_.add(raw_frame(bytes_));
      case letter('m'):
        return out_.add(
            can::send(can::WheelCommand{.left_torque_mNm = 100, .left_set_point_2mm_s = 500}, command_));
      case letter('j'):
        tick_ += bytes_.u16();
        return;
      case letter('r'):
        return restart();
      default:
        return step();
    }
  }

  // An honest tick or more: wheel states and pictures come.
  void feed(std::uint32_t ticks) {
    for (std::uint32_t i = 0; i < ticks; ++i) {
      in_.push_back(can::send(can::WheelState{}, wheels_));
      if (i % 8 == 0) {
        in_.push_back(can::send(can::VisionPose{}, pose_));
        in_.push_back(can::send(can::VisionBall{}, ball_));
      }
      step();
    }
  }

  void challenge(can::Mode mode) {
    told_ = {.mode = static_cast<std::int32_t>(mode), .challenge = 1 + bytes_.u8()};
    out_.add(can::send(told_, challenge_));
  }

  void restart() {
    gate_.restart();
    tick_ = stop_tick_ = 0;
    armed_ = false;
    open_.reset();
    wheels_seen_ = pose_seen_ = ball_seen_ = {};
    torque_ = {};
  }

  void step() {
    for (can::Frame& frame : in_) {
      frame.age_ms = age_ms_;
      see_received(frame);
    }
    end_orders();
    gate_.take(in_, tick_);
    const std::uint32_t blocked = gate_.blocked();
    const std::vector<can::Frame> wanted(out_.frames().begin(), out_.frames().end());
    gate_.check(out_, tick_);
    for (const can::Frame& frame : out_.frames()) {
      see_sent(frame);
    }
    if (gate_.blocked() != blocked) {
      blocked_ = true;
    }
    require(!blocked_ || gate_.has_blocked() || restarted_since_block(),
            "a block is remembered until a clear");
    in_.clear();
    out_.clear();
    age_ms_ = 0;
    ++tick_;
  }

  // A restart forgets that it blocked, but not to stay shut.
  [[nodiscard]] bool restarted_since_block() const { return !gate_.has_blocked() && !armed_; }

  void see_received(const can::Frame& frame) {
    can::ModeCommand command;
    if (can::StrikerDrives::sequence(frame) && can::StrikerDrives::owns(frame)) {
      wheels_seen_.see(frame, tick_);
    } else if (is_correct<can::VisionPose>(frame)) {
      pose_seen_.see(frame, tick_);
    } else if (is_correct<can::VisionBall>(frame)) {
      ball_seen_.see(frame, tick_);
    } else if (is_correct<can::EmergencyStop>(frame)) {
      stopped_ = true;
      stop_tick_ = tick_;
    } else if (holds(frame, command)) {
      see_order(command);
    }
  }

  void see_order(const can::ModeCommand& command) {
    const auto mode = static_cast<can::Mode>(command.mode);
    if (mode == can::Mode::disarm) {
      disarmed_ = true;
    } else if (mode == can::Mode::renew) {
      armed_tick_ = tick_;
    } else if (command.challenge != 0) {
      guessed_ = true;
      confirmed_ = open_ && open_->mode == command.mode && open_->challenge == command.challenge &&
                   tick_ - open_tick_ <= safety::challenge_limit_ticks;
    }
  }

  // What a tick's orders come to: the last confirmation counts, and a disarm beats it. A challenge is good in one tick.
  void end_orders() {
    if (confirmed_ && open_->mode == static_cast<std::int32_t>(can::Mode::arm)) {
      armed_ = !stopped_ && !blocked_;
      armed_tick_ = tick_;
    } else if (confirmed_ && open_->mode == static_cast<std::int32_t>(can::Mode::clear) &&
               (!stopped_ || tick_ - stop_tick_ > safety::stop_hold_ticks)) {
      stopped_ = blocked_ = false;
    }
    armed_ = armed_ && !disarmed_ && !stopped_ && !blocked_;
    if (guessed_) {
      open_.reset();
    }
    guessed_ = confirmed_ = disarmed_ = false;
  }

  void see_sent(const can::Frame& frame) {
    require(safety::may_send<can::StrikerDrives>(frame), "only what is on the whitelist goes out");
    can::Challenge told;
    if (can::is<can::FaultReport>(frame)) {
      armed_ = false;
    } else if (holds(frame, told)) {
      open_ = told;
      open_tick_ = tick_;
    } else if (can::is<can::WheelCommand>(frame)) {
      see_command(frame);
    }
  }

  void see_command(const can::Frame& frame) {
    can::WheelCommand command;
    if (can::unpack(frame, command) != can::Verdict::accepted) {
      torque_ = {};
      return;  // no drive takes it
    }
    if (moves(frame)) {
      require(armed_, "what moves was armed by a confirmation");
      require(!stopped_ && !blocked_, "what moves has no stop and no block behind it");
      require(tick_ - armed_tick_ <= safety::armed_limit_ticks, "what moves was armed or renewed in time");
      require(wheels_seen_.within(tick_, safety::wheels_limit_ticks), "what moves has wheel states");
      require(pose_seen_.within(tick_, safety::vision_limit_ticks), "what moves has poses");
      require(ball_seen_.within(tick_, safety::vision_limit_ticks), "what moves has balls");
    }
    check_wheel(command.left_torque_mNm, torque_.left_mNm, command.left_set_point_2mm_s);
    check_wheel(command.right_torque_mNm, torque_.right_mNm, command.right_set_point_2mm_s);
    const bool still = command.left_torque_mNm == 0 && command.right_torque_mNm == 0;
    torque_ =
        still ? core::WheelTorques{} : core::WheelTorques{command.left_torque_mNm, command.right_torque_mNm};
  }

  static void check_wheel(std::int32_t torque_mNm, std::int32_t before_mNm, std::int32_t set_point_2mm_s) {
    require(std::abs(torque_mNm) <= limits.torque_mNm, "no torque beyond the limit");
    require(torque_mNm == 0 || std::abs(torque_mNm - before_mNm) <= limits.slew_mNm,
            "no slew beyond the limit");
    require(2 * std::abs(set_point_2mm_s) <= limits.set_point_mm_s, "no set-point beyond the limit");
  }

  Bytes& bytes_;
  Gate gate_{limits};
  std::uint32_t tick_ = 0;
  std::uint8_t age_ms_ = 0;
  std::vector<can::Frame> in_;
  can::FrameList out_;
  can::SendCounter wheels_, pose_, ball_, mode_, stop_, challenge_, command_;
  can::Challenge told_;

  // This target's own account.
  std::optional<can::Challenge> open_;
  std::uint32_t open_tick_ = 0;
  std::uint32_t armed_tick_ = 0;
  std::uint32_t stop_tick_ = 0;
  bool guessed_ = false;    // in this tick: a confirmation came, right or wrong
  bool confirmed_ = false;  // the last one was right
  bool disarmed_ = false;
  bool armed_ = false;
  bool stopped_ = false;
  bool blocked_ = false;
  Seen wheels_seen_, pose_seen_, ball_seen_;
  core::WheelTorques torque_;
};

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  striker::fuzz::Bytes bytes(data, size);
  striker::fuzz::GateRig(bytes).run();
  return 0;
}
