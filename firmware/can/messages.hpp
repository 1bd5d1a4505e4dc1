// The message table: the single source of every frame on the bus. It packs and unpacks, drives the receive
// checks, is verified by the compiler, and prints the DBC (`striker-dbc`).
//
// Classic CAN 2.0A, 1 Mbit/s, one bus per robot. Identifiers go by function, so that priority does too.
// `striker-bus-budget` shows from this table whether every deadline is met. Status and FaultReport come on
// changes too, at most one a tick; a picture may bring its decision 5 ticks early, and has to come within
// that window. Fields are raw counts; their names carry the unit of a count.
#pragma once

#include <cstdint>
#include <limits>
#include <tuple>

#include "firmware/can/frame.hpp"
#include "firmware/can/layout.hpp"

namespace striker::can {

inline constexpr std::int32_t protocol_version = 2;

// ---- numbers on the wire -------------------------------------------------------------------------------

enum class State : std::uint8_t { boot = 0, self_test = 1, standby = 2, active = 3, fault = 4 };

enum class Fault : std::uint8_t {
  none = 0,
  self_test_failed = 1,  // a golden vector came out different; only a reboot clears it
  emergency_stop = 2,    // an emergency stop frame
  vision_lost = 3,       // active, and no complete vision pair within its timeout
  wheel_state_lost = 4,  // active, and no wheel state within its timeout
  sync_lost = 5,         // lockstep: no SYNC within the port's --sync-timeout
  overrun = 6,           // the port missed more periods than its limit
  overspeed = 7,         // a wheel beyond its greatest speed was to be driven further
  command_rejected = 8,  // the independent check refused the command
  bus_off = 9,           // the CAN controller left the bus
};

enum class Mode : std::uint8_t { disarm = 0, arm = 1, clear = 2 };

enum class StopSource : std::uint8_t { operator_ = 0, simulator = 1 };

// In unsigned 16-bit measured fields: no measurement.
inline constexpr std::int32_t not_available = 0xFFFF;

inline constexpr std::array<NamedValue, 5> state_names = {
    {{0, "boot"}, {1, "self_test"}, {2, "standby"}, {3, "active"}, {4, "fault"}}};
inline constexpr std::array<NamedValue, 10> fault_names = {{{0, "none"},
                                                            {1, "self_test_failed"},
                                                            {2, "emergency_stop"},
                                                            {3, "vision_lost"},
                                                            {4, "wheel_state_lost"},
                                                            {5, "sync_lost"},
                                                            {6, "overrun"},
                                                            {7, "overspeed"},
                                                            {8, "command_rejected"},
                                                            {9, "bus_off"}}};
inline constexpr std::array<NamedValue, 3> mode_names = {{{0, "disarm"}, {1, "arm"}, {2, "clear"}}};
inline constexpr std::array<NamedValue, 2> stop_source_names = {{{0, "operator"}, {1, "simulator"}}};
inline constexpr std::array<NamedValue, 1> measured_names = {{{not_available, "not_available"}}};

[[nodiscard]] constexpr std::string_view name_of(std::span<const NamedValue> names, std::int32_t raw) {
  for (const NamedValue& value : names) {
    if (value.raw == raw) {
      return value.name;
    }
  }
  return "?";
}

// ---- messages, in the order of their priority ------------------------------------------------------------

struct EmergencyStop {
  std::int32_t source = 0;  // StopSource
};

struct FaultReport {
  std::int32_t code = 0;  // Fault; the first since the last clear
  std::int32_t tick = 0;  // when it was latched, low 31 bits
};

struct Sync {
  std::int32_t tick = 0;  // logical time, 1 ms; 0 restarts the controller
};

struct ModeCommand {
  std::int32_t mode = 0;  // Mode
};

struct WheelCommand {
  std::int32_t tick_low = 0;  // the low 4 bits of the tick that it answers
  std::int32_t left_torque_mNm = 0;
  std::int32_t right_torque_mNm = 0;
  std::int32_t left_set_point_2mm_s = 0;  // one count is 2 mm/s
  std::int32_t right_set_point_2mm_s = 0;
};

struct WheelState {
  std::int32_t torque_cut = 0;  // 1: the drives' own watchdog holds the torque at 0
  std::int32_t left_mm_s = 0;   // rim speed, positive forward
  std::int32_t right_mm_s = 0;
};

struct VisionPose {
  std::int32_t frame = 0;         // 4 bits, shared with the ball of the same picture
  std::int32_t x_quarter_mm = 0;  // one count is 0.25 mm
  std::int32_t y_quarter_mm = 0;
  std::int32_t heading = 0;  // binary angle: 2^16 counts are the full circle
};

struct VisionBall {
  std::int32_t frame = 0;
  std::int32_t x_quarter_mm = 0;
  std::int32_t y_quarter_mm = 0;
};

struct Status {
  std::int32_t state = 0;         // State
  std::int32_t fault = 0;         // Fault; the first since the last clear
  std::int32_t wrong_length = 0;  // frames ignored since boot, by reason; each stays at 255
  std::int32_t wrong_crc = 0;
  std::int32_t wrong_counter = 0;
  std::int32_t out_of_range = 0;
  std::int32_t vision_ready = 0;  // 1: two fresh vision pairs: the controller could be armed
  std::int32_t wheels_ready = 0;  // 1: the wheel states are fresh
};

struct Decision {
  std::int32_t number = 0;  // since arming, low 16 bits
  std::int32_t action = 0;
  std::int32_t extrapolated = 0;  // 1: decided without a new vision pair
  std::int32_t best_q_256th = 0;  // Q of the action, in 1/256; saturates
  std::int32_t next_q_256th = 0;  // Q of the best other action
};

struct Timing {
  std::int32_t lateness_max_us = not_available;   // since the last timing frame
  std::int32_t execution_max_us = not_available;  // of one tick: receive, step, send
  std::int32_t overruns = not_available;          // periods missed since boot; stays at 65534
  std::int32_t latency_max_us = not_available;    // from a frame's reception to the command that follows it
};

struct Heartbeat {
  std::int32_t uptime_ms = 0;  // ticks since boot, low 31 bits
};

struct Version {
  std::int32_t protocol = protocol_version;
  std::int32_t decision_period_ms = 0;
  std::int32_t policy_low = 0;  // the policy's identity, 32 bits in two halves
  std::int32_t policy_high = 0;
};

// ---- the table
// ---------------------------------------------------------------------------------------------

namespace units {
inline constexpr Decimal one = {1, 0};
inline constexpr Decimal two = {2, 0};
inline constexpr Decimal quarter = {25, -2};
inline constexpr Decimal circle_65536th_deg = {54931640625, -13};
inline constexpr Decimal one_256th = {390625, -8};
}  // namespace units

inline constexpr std::int32_t greatest_31_bits = std::numeric_limits<std::int32_t>::max();

template <>
inline constexpr auto layout<EmergencyStop> = Layout<EmergencyStop, 1>{
    {"EmergencyStop", 0x010, 2, Node::operator_, 0, 0, 0x5A10, "Latches the emergency stop fault: torque 0.",
     on_events(10)},
    {{{"source", &EmergencyStop::source, 12, 4, false, 0, 1, {}, "", stop_source_names}}}};

template <>
inline constexpr auto layout<FaultReport> = Layout<FaultReport, 2>{
    {"FaultReport", 0x020, 7, Node::controller, 100, 0, 0x5A20, "At the fault, then while it is latched.",
     on_changes(2, 2)},
    {{{"code", &FaultReport::code, 16, 8, false, 0, 9, {}, "", fault_names},
      {"tick", &FaultReport::tick, 24, 31, false, 0, greatest_31_bits, units::one, "ms"}}}};

template <>
inline constexpr auto layout<Sync> = Layout<Sync, 1>{
    {"Sync", 0x030, 6, Node::simulator, 1, 0, 0x5A30, "Lockstep: the controller steps once for each."},
    {{{"tick", &Sync::tick, 16, 31, false, 0, greatest_31_bits, units::one, "ms"}}}};

template <>
inline constexpr auto layout<ModeCommand> =
    Layout<ModeCommand, 1>{{"ModeCommand", 0x040, 2, Node::operator_, 0, 0, 0x5A40,
                            "Arm, disarm, or clear the latched fault.", on_events(10)},
                           {{{"mode", &ModeCommand::mode, 12, 4, false, 0, 2, {}, "", mode_names}}}};

template <>
inline constexpr auto layout<WheelCommand> = Layout<WheelCommand, 5>{
    {"WheelCommand", 0x050, 8, Node::controller, 1, 10, 0x5A50, "The last frame of every tick."},
    {{{"tick_low", &WheelCommand::tick_low, 12, 4, false, 0, 15},
      {"left_torque", &WheelCommand::left_torque_mNm, 16, 12, true, -2000, 2000, units::one, "mNm"},
      {"right_torque", &WheelCommand::right_torque_mNm, 28, 12, true, -2000, 2000, units::one, "mNm"},
      {"left_set_point", &WheelCommand::left_set_point_2mm_s, 40, 12, true, -2000, 2000, units::two, "mm/s"},
      {"right_set_point", &WheelCommand::right_set_point_2mm_s, 52, 12, true, -2000, 2000, units::two,
       "mm/s"}}}};

template <>
inline constexpr auto layout<WheelState> = Layout<WheelState, 3>{
    {"WheelState", 0x060, 6, Node::drives, 1, 20, 0x5A60, "Measured rim speeds."},
    {{{"torque_cut", &WheelState::torque_cut, 12, 1, false, 0, 1},
      {"left_speed", &WheelState::left_mm_s, 16, 16, true, -8000, 8000, units::one, "mm/s"},
      {"right_speed", &WheelState::right_mm_s, 32, 16, true, -8000, 8000, units::one, "mm/s"}}}};

template <>
inline constexpr auto layout<VisionPose> = Layout<VisionPose, 4>{
    {"VisionPose", 0x070, 8, Node::vision, 50, 150, 0x5A70, "The robot, as the camera sees it.",
     due_within(5)},
    {{{"frame", &VisionPose::frame, 12, 4, false, 0, 15},
      {"x", &VisionPose::x_quarter_mm, 16, 16, true, -32768, 32767, units::quarter, "mm"},
      {"y", &VisionPose::y_quarter_mm, 32, 16, true, -32768, 32767, units::quarter, "mm"},
      {"heading", &VisionPose::heading, 48, 16, true, -32768, 32767, units::circle_65536th_deg, "deg"}}}};

template <>
inline constexpr auto layout<VisionBall> = Layout<VisionBall, 3>{
    {"VisionBall", 0x080, 6, Node::vision, 50, 150, 0x5A80, "The ball in the same picture.", due_within(5)},
    {{{"frame", &VisionBall::frame, 12, 4, false, 0, 15},
      {"x", &VisionBall::x_quarter_mm, 16, 16, true, -32768, 32767, units::quarter, "mm"},
      {"y", &VisionBall::y_quarter_mm, 32, 16, true, -32768, 32767, units::quarter, "mm"}}}};

template <>
inline constexpr auto layout<Status> =
    Layout<Status, 8>{{"Status", 0x100, 8, Node::controller, 10, 100, 0x5B00,
                       "State, latched fault, ignored frames.", on_changes(1, 3)},
                      {{{"state", &Status::state, 12, 4, false, 0, 4, {}, "", state_names},
                        {"fault", &Status::fault, 16, 8, false, 0, 9, {}, "", fault_names},
                        {"wrong_length", &Status::wrong_length, 24, 8, false, 0, 255},
                        {"wrong_crc", &Status::wrong_crc, 32, 8, false, 0, 255},
                        {"wrong_counter", &Status::wrong_counter, 40, 8, false, 0, 255},
                        {"out_of_range", &Status::out_of_range, 48, 8, false, 0, 255},
                        {"vision_ready", &Status::vision_ready, 56, 1, false, 0, 1},
                        {"wheels_ready", &Status::wheels_ready, 57, 1, false, 0, 1}}}};

template <>
inline constexpr auto layout<Decision> = Layout<Decision, 5>{
    {"Decision", 0x110, 7, Node::controller, 50, 0, unprotected, "What the Q network chose.",
     on_changes(45, 2)},
    {{{"number", &Decision::number, 0, 16, false, 0, 65535},
      {"action", &Decision::action, 16, 4, false, 0, 15},
      {"extrapolated", &Decision::extrapolated, 20, 1, false, 0, 1},
      {"best_q", &Decision::best_q_256th, 24, 16, true, -32768, 32767, units::one_256th},
      {"next_q", &Decision::next_q_256th, 40, 16, true, -32768, 32767, units::one_256th}}}};

template <>
inline constexpr auto layout<Timing> = Layout<Timing, 4>{
    {"Timing", 0x120, 8, Node::controller, 100, 0, unprotected,
     "The port's clock; not available in lockstep."},
    {{{"lateness_max", &Timing::lateness_max_us, 0, 16, false, 0, 65535, units::one, "us", measured_names},
      {"execution_max", &Timing::execution_max_us, 16, 16, false, 0, 65535, units::one, "us", measured_names},
      {"overruns", &Timing::overruns, 32, 16, false, 0, 65535, units::one, "", measured_names},
      {"latency_max", &Timing::latency_max_us, 48, 16, false, 0, 65535, units::one, "us", measured_names}}}};

template <>
inline constexpr auto layout<Heartbeat> = Layout<Heartbeat, 1>{
    {"Heartbeat", 0x700, 4, Node::controller, 100, 500, unprotected, "The controller is alive."},
    {{{"uptime", &Heartbeat::uptime_ms, 0, 31, false, 0, greatest_31_bits, units::one, "ms"}}}};

template <>
inline constexpr auto layout<Version> = Layout<Version, 4>{
    {"Version", 0x710, 6, Node::controller, 1000, 0, unprotected, "Protocol and policy."},
    {{{"protocol", &Version::protocol, 0, 8, false, 0, 255},
      {"decision_period", &Version::decision_period_ms, 8, 8, false, 0, 255, units::one, "ms"},
      {"policy_low", &Version::policy_low, 16, 16, false, 0, 65535},
      {"policy_high", &Version::policy_high, 32, 16, false, 0, 65535}}}};

using Messages = std::tuple<EmergencyStop, FaultReport, Sync, ModeCommand, WheelCommand, WheelState,
                            VisionPose, VisionBall, Status, Decision, Timing, Heartbeat, Version>;

// Calls visit(layout) for every message, in the order of the table.
template <class Visit>
constexpr void for_each_layout(Visit visit) {
  [&]<class... Message>(const std::tuple<Message...>*) {
    (visit(layout<Message>), ...);
  }(static_cast<const Messages*>(nullptr));
}

template <class Message>
[[nodiscard]] constexpr bool is(const Frame& frame) {
  return frame.id == layout<Message>.info.id;
}

namespace detail {

// Identifiers rise along the table: they are unique, and the table reads in the order of priority.
constexpr bool identifiers_rise() {
  int previous = -1;
  bool rising = true;
  for_each_layout([&](const auto& message) {
    rising = rising && message.info.id > previous;
    previous = message.info.id;
  });
  return rising;
}

constexpr bool names_and_data_ids_are_unique() {
  bool unique = true;
  for_each_layout([&](const auto& one) {
    for_each_layout([&](const auto& other) {
      const bool same = one.info.id == other.info.id;
      const bool clash = one.info.name == other.info.name ||
                         (one.info.data_id != unprotected && one.info.data_id == other.info.data_id);
      unique = unique && (same || !clash);
    });
  });
  return unique;
}

template <class... Message>
constexpr bool layouts_are_sound(const std::tuple<Message...>*) {
  return (layout_is_sound<Message>() && ...);
}

static_assert(layouts_are_sound(static_cast<const Messages*>(nullptr)), "a signal overlaps, or does not fit");
static_assert(identifiers_rise(), "identifiers must be unique and rise along the table");
static_assert(names_and_data_ids_are_unique(), "message names and E2E data IDs must be unique");

}  // namespace detail

}  // namespace striker::can
