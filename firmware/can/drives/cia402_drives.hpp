// SPDX-License-Identifier: Apache-2.0
// Two drives of the profile CiA 402 (IEC 61800-7-201 and -301) on CANopen (CiA 301), in its smallest useful form: each with
// two PDOs, in cyclic synchronous torque mode. The controller is the NMT master and the producer of SYNC.
//
//   0x000         NMT             start node; when a heartbeat tells that it is not operational
//   0x080         SYNC            every tick but those of a start: the drives measure
//   0x200 + node  RPDO1, 5 bytes  6040h control word, 6071h target torque (int16, per mille of 6076h), 6060h mode 10;
//                                 transmission type 255: acts as it comes, whatever becomes of SYNC
//   0x180 + node  TPDO1, 6 bytes  6041h status word, 606Ch velocity (int32); transmission type 1: on every SYNC
//   0x080 + node  EMCY            an error code but 0 counts as an error
//   0x700 + node  heartbeat       NMT state; producer time (1017h) 10 ms
//
// Settings of each drive (SDO, or its maker's tool): the mapping above (1600h, 1A00h), 1400h:2 = 255, 1800h:2 = 1, 1017h = 10,
// and a time-out of the RPDO (1400h:5) with torque 0 as its reaction (6007h, 605Eh): without it the wheel goes on turning
// when commands stop. With an RPDO that waits for SYNC (1400h:2 = 1) a lost SYNC would hold the torque, a fault's 0 and an
// emergency stop too, and none would come late enough for a time-out. firmware/can/drives/cia402.eds has the entries.
//
// States: the status word leads through switch on disabled, ready to switch on, switched on, operation enabled, one control
// word a step, when the controller becomes active; a fault is reset then, once. Otherwise it is shutdown: no torque.
//
// Rounding: a torque is cut to the per mille below it, a velocity rounded to the nearest um/s, then mm/s. The gate reads a
// per mille as the whole mNm above it, so that it never sees less than the drive is told.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/can/drives/drive_pair.hpp"
#include "firmware/can/drives/drive_protocol.hpp"
#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/can/drives/little_endian.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::can {

namespace cia402 {

inline constexpr std::uint16_t nmt = 0x000;
inline constexpr std::uint16_t sync = 0x080;
inline constexpr std::uint16_t emergency = 0x080;  // these four: + node
inline constexpr std::uint16_t tpdo1 = 0x180;
inline constexpr std::uint16_t rpdo1 = 0x200;
inline constexpr std::uint16_t heartbeat = 0x700;

inline constexpr std::uint8_t nmt_start = 1;
inline constexpr std::uint8_t operational = 5;
inline constexpr std::uint8_t cyclic_synchronous_torque = 10;

enum class State : std::uint8_t {
  other,
  fault,
  switch_on_disabled,
  ready_to_switch_on,
  switched_on,
  enabled
};

[[nodiscard]] constexpr State state_of(std::uint32_t status_word) {
  switch (status_word & 0x4FU) {
    case 0x08:
      return State::fault;
    case 0x40:
      return State::switch_on_disabled;
    default:
      break;
  }
  switch (status_word & 0x6FU) {
    case 0x21:
      return State::ready_to_switch_on;
    case 0x23:
      return State::switched_on;
    case 0x27:
      return State::enabled;
    default:
      return State::other;
  }
}

inline constexpr std::uint16_t shutdown = 0x06;
inline constexpr std::uint16_t switch_on = 0x07;
inline constexpr std::uint16_t enable_operation = 0x0F;
inline constexpr std::uint16_t fault_reset = 0x80;  // on its rising edge

// The control word that leads one state on.
[[nodiscard]] constexpr std::uint16_t control_word_after(State state) {
  return state == State::fault                                    ? fault_reset
         : state == State::ready_to_switch_on                     ? switch_on
         : state == State::switched_on || state == State::enabled ? enable_operation
                                                                  : shutdown;
}

}  // namespace cia402

template <DriveWiring wiring>
class Cia402Drives {
 public:
  static_assert(wiring.left_node >= 1 && wiring.right_node >= 1 && wiring.left_node <= 127 &&
                    wiring.right_node <= 127,
                "STRIKER DRIVES: a CANopen node is 1 to 127");

  static constexpr std::uint16_t id(std::size_t wheel, std::uint16_t function) {
    return static_cast<std::uint16_t>(function + wiring.node(wheel));
  }
  static constexpr std::array<std::uint16_t, 4> sends = {
      id(left_wheel, cia402::rpdo1), id(right_wheel, cia402::rpdo1), cia402::sync, cia402::nmt};
  static constexpr std::array<std::uint16_t, 6> receives = {
      id(left_wheel, cia402::tpdo1),     id(right_wheel, cia402::tpdo1),
      id(left_wheel, cia402::emergency), id(right_wheel, cia402::emergency),
      id(left_wheel, cia402::heartbeat), id(right_wheel, cia402::heartbeat)};
  static constexpr std::size_t most_frames = 3;

  // CiA 301's predefined connection set: NMT, SYNC, TIME, LSS, and each node's own.
  [[nodiscard]] static constexpr bool claims(std::uint16_t identifier) {
    const std::uint32_t node = identifier & 0x7FU;
    const bool is_theirs = static_cast<std::int32_t>(node) == wiring.left_node ||
                           static_cast<std::int32_t>(node) == wiring.right_node;
    return identifier == cia402::nmt || identifier == cia402::sync || identifier == 0x100 ||
           identifier == 0x7E4 || identifier == 0x7E5 ||
           (is_theirs && identifier >= 0x080 && identifier < 0x780);
  }
  [[nodiscard]] static bool owns(const Frame& frame) { return is_among(receives, frame.id); }

  [[nodiscard]] Verdict take(const Frame& frame, std::uint32_t tick, DriveReport& report) {
    const Verdict verdict = pair_.take(news_of(frame), tick - frame.age_ms, report);
    Wheel& wheel = wheels_[wheel_at(frame.id)];
    if (verdict == Verdict::accepted && is_tpdo(frame)) {
      wheel.state = cia402::state_of(little_endian_16(frame, 0));
    } else if (verdict == Verdict::accepted && is_heartbeat(frame)) {
      wheel.has_to_start = frame.data[0] != cia402::operational;
    }
    return verdict;
  }
  [[nodiscard]] bool invalid() const { return pair_.invalid(); }
  [[nodiscard]] core::Faults judge(std::uint32_t tick) { return pair_.judge(tick); }

  void enable(bool wanted) {
    if (pair_.enable(wanted)) {
      wheels_[left_wheel].may_reset = wheels_[right_wheel].may_reset = wanted;
    }
  }

  void put(const core::DriveCommand& command, FrameList& frames) {
    const core::WheelTorques torque = pair_.follows() ? command.torque : core::WheelTorques{};
    frames.add(command_frame(left_wheel, control_word(left_wheel), torque.left_mNm));
    frames.add(command_frame(right_wheel, control_word(right_wheel), torque.right_mNm));
    no_start_ticks_ -= no_start_ticks_ > 0 ? 1 : 0;
    for (const std::size_t i : {left_wheel, right_wheel}) {
      if (wheels_[i].has_to_start && no_start_ticks_ == 0) {
        wheels_[i].has_to_start = false;
        no_start_ticks_ = state_period_ticks;
        frames.add(start_frame(i));
        return;
      }
    }
    frames.add({.id = cia402::sync});
  }

  // For the command gate. Not inlined: an image holds them once.
  [[nodiscard, gnu::noinline]] static DriveNews news_of(const Frame& frame) {
    DriveNews news = {.wheel = wheel_at(frame.id)};
    if (frame.length != (is_tpdo(frame) ? 6 : is_heartbeat(frame) ? 1 : 8)) {
      news.verdict = Verdict::wrong_length;
    } else if (is_tpdo(frame)) {
      news.speed_mm_s = speed_of(news.wheel, little_endian_32(frame, 2));
      news.verdict = news.speed_mm_s ? Verdict::accepted : Verdict::out_of_range;
      news.is_enabled = cia402::state_of(little_endian_16(frame, 0)) == cia402::State::enabled;
      news.rests = !*news.is_enabled;
    } else if (is_heartbeat(frame) ? frame.data[0] != cia402::operational : little_endian_16(frame, 0) != 0) {
      news.is_enabled = false;
    }
    return news;
  }

  [[nodiscard, gnu::noinline]] static bool may_send(const Frame& frame) {
    if (frame.id == cia402::sync) {
      return frame.length == 0;
    }
    if (frame.id == cia402::nmt) {
      return frame.length == 2 && frame.data[0] == cia402::nmt_start &&
             (frame.data[1] == wiring.left_node || frame.data[1] == wiring.right_node);
    }
    return is_command(frame) && frame.length == 5 && frame.data[4] == cia402::cyclic_synchronous_torque;
  }

  [[nodiscard]] static std::optional<std::size_t> wheel_of(const Frame& frame) {
    return is_command(frame) ? std::optional(wheel_at(frame.id)) : std::nullopt;
  }
  [[nodiscard, gnu::noinline]] static core::DriveCommand command_of(const Frame& frame) {
    core::DriveCommand command;
    if (is_command(frame)) {
      const std::size_t wheel = wheel_at(frame.id);
      (wheel == left_wheel ? command.torque.left_mNm : command.torque.right_mNm) =
          wiring.sign(wheel) * torque_mNm(static_cast<std::int16_t>(little_endian_16(frame, 2)));
    }
    return command;
  }
  static void recode(Frame& frame, const core::DriveCommand& command) {
    if (is_command(frame)) {
      const std::size_t wheel = wheel_at(frame.id);
      frame = command_frame(wheel, little_endian_16(frame, 0),
                            wheel == left_wheel ? command.torque.left_mNm : command.torque.right_mNm);
    }
  }
  // Bit 3 of the control word: no other one enables.
  [[nodiscard]] static bool enables(const Frame& frame) {
    return is_command(frame) && (frame.data[0] & 0x08U) != 0;
  }
  static void disable(Frame& frame) { frame = command_frame(wheel_at(frame.id), cia402::shutdown, 0); }

 private:
  struct Wheel {
    cia402::State state = cia402::State::other;
    bool has_to_start = false;
    bool may_reset = false;  // a fault, once since it is wanted
  };

  // 1,000 per mille of the motor's rated torque, times the gear, in 1/100 mNm.
  static constexpr std::int64_t rated_at_wheel = std::int64_t{wiring.rated_torque_mNm} * wiring.gear_percent;
  static constexpr std::int32_t hundredths = 100'000;

  static constexpr std::size_t wheel_at(std::uint16_t identifier) {
    return (identifier & 0x7FU) == static_cast<std::uint32_t>(wiring.left_node) ? left_wheel : right_wheel;
  }
  static constexpr bool is_tpdo(const Frame& frame) { return (frame.id & 0x780U) == cia402::tpdo1; }
  static constexpr bool is_heartbeat(const Frame& frame) { return (frame.id & 0x780U) == cia402::heartbeat; }
  static constexpr bool is_command(const Frame& frame) {
    return frame.id == id(left_wheel, cia402::rpdo1) || frame.id == id(right_wheel, cia402::rpdo1);
  }

  static std::int32_t per_mille_of(std::int32_t torque_mNm) {
    constexpr std::int64_t greatest = 32'767;
    return static_cast<std::int32_t>(
        std::clamp(std::int64_t{torque_mNm} * hundredths / rated_at_wheel, -greatest, greatest));
  }
  static std::int32_t torque_mNm(std::int32_t per_mille) {
    const std::int64_t product = std::int64_t{per_mille} * rated_at_wheel;
    return static_cast<std::int32_t>((product + (product < 0 ? 1 - hundredths : hundredths - 1)) /
                                     hundredths);
  }

  [[gnu::noinline]] static Frame command_frame(std::size_t wheel, std::uint32_t control_word,
                                               std::int32_t torque_mNm) {
    Frame frame = {.id = id(wheel, cia402::rpdo1), .length = 5};
    put_little_endian_16(frame, 0, control_word);
    put_little_endian_16(frame, 2, static_cast<std::uint32_t>(wiring.sign(wheel) * per_mille_of(torque_mNm)));
    frame.data[4] = cia402::cyclic_synchronous_torque;
    return frame;
  }
  static Frame start_frame(std::size_t wheel) {
    Frame frame = {.id = cia402::nmt, .length = 2};
    frame.data[0] = cia402::nmt_start;
    frame.data[1] = static_cast<std::uint8_t>(wiring.node(wheel));
    return frame;
  }

  // Of the rim, for a count of the motor, with so many bits behind the point.
  static constexpr std::int64_t um_of_count(std::uint32_t bits) {
    return ((std::int64_t{wiring.rim_um_per_turn()} << bits) + wiring.counts_per_turn / 2) /
           wiring.counts_per_turn;
  }
  // As many as leave a count's um in 31 bits, so that its product with 32 fits 64.
  static constexpr std::uint32_t um_bits() {
    std::uint32_t bits = 1;
    while (bits < 40 && um_of_count(bits + 1) < std::int64_t{1} << 31U) {
      ++bits;
    }
    return bits;
  }

  static std::optional<std::int32_t> speed_of(std::size_t wheel, std::uint32_t counts_per_s) {
    constexpr std::uint32_t bits = um_bits();
    constexpr std::int64_t um = um_of_count(bits);
    const std::int64_t speed_um_s =
        (static_cast<std::int32_t>(counts_per_s) * um + (std::int64_t{1} << (bits - 1))) >> bits;
    constexpr std::int64_t greatest = std::int64_t{1'000} * core::greatest_measured_mm_s;
    return speed_um_s < -greatest || speed_um_s > greatest
               ? std::nullopt
               : rim_speed_mm_s(wiring.sign(wheel) * static_cast<std::int32_t>(speed_um_s));
  }

  std::uint32_t control_word(std::size_t i) {
    Wheel& wheel = wheels_[i];
    if (!pair_.is_wanted()) {
      return cia402::shutdown;
    }
    if (wheel.state == cia402::State::fault) {
      const bool resets = wheel.may_reset;
      wheel.may_reset = false;
      return resets ? cia402::fault_reset : cia402::shutdown;
    }
    return cia402::control_word_after(wheel.state);
  }

  DrivePair pair_;
  std::array<Wheel, 2> wheels_{};
  std::uint32_t no_start_ticks_ =
      0;  // a start takes SYNC's place: not more often than a drive tells that it wants one
};

}  // namespace striker::can
