// SPDX-License-Identifier: Apache-2.0
// How a robot's wheels are driven, as its description says: what the drives are spoken to with, their nodes on the bus,
// and what their numbers mean at the wheel. A value; each drive protocol takes it as a parameter.
//
// Keys of a robot's file (sil/robot/description/robot_file.hpp), all of which may be left out:
//
//   drives = "odrive"               striker (the usual one), odrive or cia402: drives/NAME_drives.hpp
//   identifier_base = 768           moves Striker's own identifiers (can/layout.hpp)
//   drive_left_node = 0             ODrive: 0 to 62; CANopen: 1 to 127
//   drive_right_node = 1
//   drive_left_reversed = 0         1: the motor turns against the wheel, as one of two that are mirrored does
//   drive_right_reversed = 1
//   drive_gear_percent = 100        turns of the motor for one of the wheel, in per cent
//   drive_rated_torque_mNm = 1_000  cia402: of the motor, object 6076h
//   drive_counts_per_turn = 16_384  cia402: velocity (606Ch) in counts a second, so many for a turn of the motor
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace striker::can {

enum class DriveKind : std::int32_t { striker, odrive, cia402 };

inline constexpr std::array<std::string_view, 3> drive_kind_names = {"striker", "odrive", "cia402"};

inline constexpr std::size_t left_wheel = 0;
inline constexpr std::size_t right_wheel = 1;

struct DriveWiring {
  DriveKind kind = DriveKind::striker;
  std::int32_t identifier_base = 0;
  std::int32_t left_node = 1;
  std::int32_t right_node = 2;
  std::int32_t left_reversed = 0;
  std::int32_t right_reversed = 0;
  std::int32_t gear_percent = 100;
  std::int32_t rated_torque_mNm = 1'000;
  std::int32_t counts_per_turn = 16'384;
  std::int32_t wheel_radius_um = 40'000;  // the description's own

  bool operator==(const DriveWiring&) const = default;

  [[nodiscard]] constexpr std::int32_t node(std::size_t wheel) const {
    return wheel == left_wheel ? left_node : right_node;
  }
  [[nodiscard]] constexpr std::int32_t sign(std::size_t wheel) const {
    return (wheel == left_wheel ? left_reversed : right_reversed) != 0 ? -1 : 1;
  }
  // Of the rim, for a turn of the motor: to the nearest um.
  [[nodiscard]] constexpr std::uint32_t rim_um_per_turn() const {
    constexpr std::int64_t circle_e9 = 6'283'185'307;  // 2 pi
    const std::int64_t around_um = (circle_e9 * wheel_radius_um + 500'000'000) / 1'000'000'000;
    return static_cast<std::uint32_t>((100 * around_um + gear_percent / 2) / gear_percent);
  }
};

struct WiringKey {
  std::string_view name;
  std::int32_t DriveWiring::*member;
  std::int32_t least;
  std::int32_t greatest;
};

// Beside `drives`, which is a name.
inline constexpr std::array wiring_keys = {
    WiringKey{"identifier_base", &DriveWiring::identifier_base, 0, 0x5D8},
    WiringKey{"drive_left_node", &DriveWiring::left_node, 0, 127},
    WiringKey{"drive_right_node", &DriveWiring::right_node, 0, 127},
    WiringKey{"drive_left_reversed", &DriveWiring::left_reversed, 0, 1},
    WiringKey{"drive_right_reversed", &DriveWiring::right_reversed, 0, 1},
    WiringKey{"drive_gear_percent", &DriveWiring::gear_percent, 10, 10'000},
    WiringKey{"drive_rated_torque_mNm", &DriveWiring::rated_torque_mNm, 10, 100'000},
    WiringKey{"drive_counts_per_turn", &DriveWiring::counts_per_turn, 100, 10'000'000}};

[[nodiscard]] constexpr bool in_range(const DriveWiring& wiring) {
  for (const WiringKey& key : wiring_keys) {
    if (wiring.*key.member < key.least || wiring.*key.member > key.greatest) {
      return false;
    }
  }
  return wiring.left_node != wiring.right_node && wiring.identifier_base % 8 == 0;
}

// CiA 402 has 16 bits for a torque in per mille of the motor's rated one, and 32 for a velocity in counts a second.
inline constexpr std::int64_t least_limit_per_mille = 20;  // a step of the torque is then 5 % of the limit
inline constexpr std::int64_t greatest_limit_per_mille = 32'767;

[[nodiscard]] constexpr std::int64_t limit_per_mille(const DriveWiring& wiring,
                                                     std::int32_t torque_limit_mNm) {
  return std::int64_t{torque_limit_mNm} * 100'000 /
         (std::int64_t{wiring.rated_torque_mNm} * wiring.gear_percent);
}
[[nodiscard]] constexpr std::int64_t counts_per_s(const DriveWiring& wiring, std::int32_t rim_speed_mm_s) {
  return std::int64_t{rim_speed_mm_s} * 1'000 * wiring.counts_per_turn / wiring.rim_um_per_turn();
}

[[nodiscard]] constexpr bool torque_fits(const DriveWiring& wiring, std::int32_t torque_limit_mNm) {
  const std::int64_t limit = limit_per_mille(wiring, torque_limit_mNm);
  return wiring.kind != DriveKind::cia402 ||
         (limit >= least_limit_per_mille && limit <= greatest_limit_per_mille);
}
[[nodiscard]] constexpr bool speed_fits(const DriveWiring& wiring, std::int32_t greatest_mm_s) {
  return wiring.kind != DriveKind::cia402 || counts_per_s(wiring, greatest_mm_s) <= 0x7FFF'FFFF;
}

}  // namespace striker::can
