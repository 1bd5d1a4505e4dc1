// The kick controller: one `step` a tick of 1 ms, from frames in to frames out.
//
//   take frames -> estimate -> supervise -> every 50 ticks: relative state -> Q network -> action
//   -> wheel-speed loops -> independent check of the command -> frames out
//
// Integers only, no heap, no clock, no I/O, no statics: all state is in the object, which may be copied (a
// copy goes on alone, with the same answers). One thread at a time. Never fails: what goes wrong becomes a
// latched fault and torque 0.
//
// Arming wants state standby, two vision pairs since the last disarm, and fresh wheel states. Disarming, not
// arming, resets the estimator: so the two pairs that arming waits for give the first decision its velocity,
// and nothing from before the disarm can.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/can/codec.hpp"
#include "firmware/core/command_check.hpp"
#include "firmware/core/estimator.hpp"
#include "firmware/core/inbox.hpp"
#include "firmware/core/relative_state.hpp"
#include "firmware/core/supervisor.hpp"
#include "firmware/core/wheel_loop.hpp"

namespace striker::core {

inline constexpr std::uint32_t decision_period_ticks = 50;

// A vision pair this near to the expected time restarts the decision period.
inline constexpr std::uint32_t decision_window_ticks = 5;

struct Inputs {
  std::uint32_t tick = 0;  // logical time in ms; may jump forward when a port misses periods
  std::span<const can::Frame> frames;
  can::Timing timing = {};  // what the port measured; not available by default
};

class Outputs {
 public:
  void clear() { count_ = 0; }
  void add(const can::Frame& frame) { frames_[count_++] = frame; }
  // In the order of sending; after a step, the wheel command is the last.
  [[nodiscard]] std::span<const can::Frame> frames() const { return std::span(frames_).first(count_); }

 private:
  std::array<can::Frame, 8> frames_{};  // one of each message that the controller sends, and to spare
  std::size_t count_ = 0;
};

// What was last decided, for telemetry and tests.
struct DecisionRecord {
  std::uint32_t number = 0;  // decisions since arming
  std::uint8_t action = 0;
  bool extrapolated = false;
  std::array<std::int32_t, policy::greatest_inputs>
      inputs{};  // of the network; as many as `policy_inputs` names
};

// What the built-in policy reads, in the order of its inputs.
[[nodiscard]] std::span<const policy::StateInput> policy_inputs();

class Controller {
 public:
  void step(const Inputs& inputs, Outputs& outputs);

  // For a port: latches a fault that the core cannot see, and puts out its report and torque 0.
  void enter_fault(can::Fault fault, Outputs& outputs);

  // For a port that stops: to standby at once, with torque 0 put out.
  void disarm(Outputs& outputs);

  [[nodiscard]] can::State state() const { return supervisor_.state; }
  [[nodiscard]] can::Fault fault() const { return supervisor_.fault; }
  [[nodiscard]] const DecisionRecord& last_decision() const { return decision_; }
  [[nodiscard]] const IgnoredFrames& ignored() const { return inbox_.ignored(); }

 private:
  struct SendCounters {
    can::SendCounter fault_report;
    can::SendCounter status;
    can::SendCounter wheel_command;
  };

  // When each periodic message last went out.
  struct Sent {
    Freshness fault_report;
    Freshness status;
    Freshness timing;
    Freshness heartbeat;
    Freshness version;
  };

  void run_self_test();
  void supervise_tick(const Requests& requests);
  void decide_if_due(bool new_pair, Outputs& outputs);
  void remember(const RelativeState& state);
  void decide(bool extrapolated, Outputs& outputs);
  [[nodiscard]] can::WheelCommand drive();
  [[nodiscard]] DriveFacts drive_facts() const;
  void report(const can::Timing& timing, Outputs& outputs);
  void report_fault(Outputs& outputs);
  void report_status(Outputs& outputs);

  std::uint32_t tick_ = 0;
  std::uint32_t boot_tick_ = 0;
  Inbox inbox_;
  Estimator estimator_;
  Freshness vision_;  // complete pairs
  SelfTest self_test_ = SelfTest::running;
  std::size_t self_tested_ = 0;  // golden vectors that passed
  Supervisor supervisor_;
  Supervisor reported_;  // as last told in a status
  std::uint32_t fault_tick_ = 0;

  bool awaits_first_pair_ = true;
  std::uint32_t decision_tick_ = 0;
  DecisionRecord decision_;
  std::array<RelativeState, policy::greatest_look_back + 1> history_{};  // of the decisions, the newest first
  std::int32_t left_set_point_mm_s_ = 0;
  std::int32_t right_set_point_mm_s_ = 0;
  WheelLoop left_loop_;
  WheelLoop right_loop_;

  SendCounters counters_;
  Sent sent_;
};

}  // namespace striker::core
