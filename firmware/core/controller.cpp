#include "firmware/core/controller.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "firmware/policy/built_in.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/proof.hpp"

namespace striker::core {

namespace {

using policy::built_in;
using Trained = std::remove_cvref_t<decltype(built_in)>;

static_assert(policy::scales_are_valid(built_in),
              "STRIKER POLICY: a shift, a multiplier or the period is out of range");
static_assert(policy::sums_fit(built_in),
              "STRIKER POLICY: a 32-bit sum could overflow: export the model again");
static_assert(policy::identity_of(built_in) == built_in.identity,
              "STRIKER POLICY: the header was altered after its export: export the model again");
static_assert(built_in.decision_period_ms == decision_period_ticks,
              "STRIKER POLICY: trained at another decision period than this controller's 50 ms");
static_assert(policy::inputs_are_known(built_in),
              "STRIKER POLICY: an input that this controller does not compute, or too many of them");
static_assert(Trained::goldens >= 1, "STRIKER POLICY: no golden vector to test the boot with");
static_assert(std::is_trivially_copyable_v<Controller>);

// What is needed at run time, without the header's weights beside it: those are in the kernel's order
// already.
constexpr auto state_inputs = built_in.state;
constexpr auto golden_vectors = built_in.golden_vectors;
constexpr auto set_points = built_in.set_points;
constexpr bool mirrored = built_in.mirrored;

constexpr std::uint32_t low_31_bits = 0x7FFFFFFF;

// The best Q among the actions other than the chosen one, still in the output layer's scale.
std::int32_t runner_up(const policy::QValues<Trained::actions>& q) {
  std::int32_t best = q.sums[q.action == 0 ? 1 : 0];
  for (std::size_t k = 0; k < Trained::actions; ++k) {
    best = k == q.action ? best : std::max(best, q.sums[k]);
  }
  return best;
}

template <class Message>
constexpr std::uint32_t period = can::layout<Message>.info.period_ms;

// True when a periodic message is due; then counts it as sent now.
bool take_due(Freshness& sent, std::uint32_t tick, std::uint32_t period_ticks) {
  const bool due = !sent.within(tick, period_ticks - 1);
  if (due) {
    sent.feed(tick);
  }
  return due;
}

}  // namespace

std::span<const policy::StateInput> policy_inputs() {
  return state_inputs;
}

void Controller::step(const Inputs& inputs, Outputs& outputs) {
  outputs.clear();
  tick_ = inputs.tick;
  if (supervisor_.state == can::State::boot) {
    boot_tick_ = tick_;
  }
  const Requests requests = inbox_.take(inputs.frames, tick_, estimator_);
  if (requests.disarm) {
    vision_ = {};
  }
  const bool new_pair = estimator_.end_tick(tick_);
  if (new_pair) {
    vision_.feed(tick_);
  }
  run_self_test();
  supervise_tick(requests);
  if (supervisor_.state == can::State::active) {
    decide_if_due(new_pair, outputs);
  }
  const can::WheelCommand command = drive();
  report(inputs.timing, outputs);
  outputs.add(can::send(command, counters_.wheel_command));
}

void Controller::enter_fault(can::Fault fault, Outputs& outputs) {
  outputs.clear();
  if (supervisor_.state != can::State::fault) {
    fault_tick_ = tick_;
  }
  supervisor_ = latch(supervisor_, fault);
  report_fault(outputs);
  report_status(outputs);
  outputs.add(can::send(drive(), counters_.wheel_command));
}

void Controller::disarm(Outputs& outputs) {
  outputs.clear();
  if (supervisor_.state == can::State::active) {
    supervisor_.state = can::State::standby;
  }
  report_status(outputs);
  outputs.add(can::send(drive(), counters_.wheel_command));
}

// One golden vector a tick, so that no tick is longer than one with a decision.
void Controller::run_self_test() {
  if (self_test_ != SelfTest::running) {
    return;
  }
  const auto& golden = golden_vectors[self_tested_];
  const auto q = policy::infer<built_in>(golden.raw);
  if (q.sums != golden.sums || q.action != golden.action) {
    self_test_ = SelfTest::failed;
  } else if (++self_tested_ == Trained::goldens) {
    self_test_ = SelfTest::passed;
  }
}

void Controller::supervise_tick(const Requests& requests) {
  const bool vision_fresh = vision_.within(tick_, can::layout<can::VisionPose>.info.timeout_ms);
  const Supervisor before = supervisor_;
  supervisor_ = supervise(before, {.self_test = self_test_,
                                   .arm = requests.arm,
                                   .disarm = requests.disarm,
                                   .clear = requests.clear,
                                   .emergency_stop = inbox_.emergency_stop(tick_),
                                   .vision_fresh = vision_fresh,
                                   .vision_ready = vision_fresh && estimator_.has_velocity(),
                                   .wheels_fresh = inbox_.wheels_fresh(tick_)});
  if (supervisor_.fault != before.fault) {
    fault_tick_ = tick_;
  }
  if (supervisor_.state == can::State::active && before.state != can::State::active) {
    awaits_first_pair_ = true;
    decision_ = {};
    history_ = {};
    left_loop_.reset();
    right_loop_.reset();
  }
}

void Controller::decide_if_due(bool new_pair, Outputs& outputs) {
  const std::uint32_t phase = tick_ - decision_tick_;
  const bool early_enough = phase >= decision_period_ticks - decision_window_ticks;
  const bool late_for_extrapolated = decision_.extrapolated && phase <= decision_window_ticks;
  if (new_pair && (awaits_first_pair_ || early_enough || late_for_extrapolated)) {
    awaits_first_pair_ = false;
    decision_tick_ = tick_;
    decide(false, outputs);
  } else if (!awaits_first_pair_ && phase >= decision_period_ticks) {
    decision_tick_ = tick_ - phase % decision_period_ticks;
    decide(true, outputs);
  }
}

void Controller::remember(const RelativeState& state) {
  if (decision_.number == 0) {
    history_.fill(state);
    return;
  }
  std::copy_backward(history_.begin(), history_.end() - 1, history_.end());
  history_.front() = state;
}

void Controller::decide(bool extrapolated, Outputs& outputs) {
  RelativeState state = relative_state(estimator_.at(tick_));
  const auto made =
      static_cast<std::int32_t>(std::min<std::uint32_t>(decision_.number, policy::decisions_a_kick));
  state.decisions_left = policy::decisions_a_kick - made;
  remember(state);
  const bool mirror = mirrored && state.ball_um.y < 0;
  std::array<std::int32_t, Trained::inputs> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const std::int32_t value = element_of(history_[state_inputs[i].decisions_ago], state_inputs[i].element);
    raw[i] = mirror && policy::changes_sign(state_inputs[i].element) ? -value : value;
  }
  const auto q = policy::infer<built_in>(raw);
  decision_.number += 1;
  decision_.action = q.action;
  decision_.extrapolated = extrapolated;
  std::copy(raw.begin(), raw.end(), decision_.inputs.begin());
  left_set_point_mm_s_ = set_points[q.action].left_mm_s;
  right_set_point_mm_s_ = set_points[q.action].right_mm_s;
  if (mirror) {
    std::swap(left_set_point_mm_s_, right_set_point_mm_s_);
  }
  outputs.add(can::pack(can::Decision{.number = static_cast<std::int32_t>((decision_.number - 1) & 0xFFFFU),
                                      .action = q.action,
                                      .extrapolated = static_cast<std::int32_t>(extrapolated),
                                      .best_q_256th = q.sums[q.action] >> built_in.output.shift,
                                      .next_q_256th = runner_up(q) >> built_in.output.shift}));
}

DriveFacts Controller::drive_facts() const {
  return {.armed = supervisor_.state == can::State::active && supervisor_.fault == can::Fault::none,
          .vision_fresh = vision_.within(tick_, can::layout<can::VisionPose>.info.timeout_ms),
          .wheels_fresh = inbox_.wheels_fresh(tick_),
          .wheels = inbox_.wheels()};
}

can::WheelCommand Controller::drive() {
  can::WheelCommand command{.tick_low = static_cast<std::int32_t>(tick_ & 0xFU)};
  if (supervisor_.state != can::State::active || awaits_first_pair_) {
    left_set_point_mm_s_ = 0;
    right_set_point_mm_s_ = 0;
    return command;
  }
  can::WheelCommand wanted = command;
  wanted.left_torque_mNm = left_loop_.step(left_set_point_mm_s_, inbox_.wheels().left_mm_s);
  wanted.right_torque_mNm = right_loop_.step(right_set_point_mm_s_, inbox_.wheels().right_mm_s);
  wanted.left_set_point_2mm_s = left_set_point_mm_s_ / 2;
  wanted.right_set_point_2mm_s = right_set_point_mm_s_ / 2;
  const can::Fault refused = check_command(wanted, drive_facts());
  if (refused == can::Fault::none) {
    return wanted;
  }
  supervisor_ = latch(supervisor_, refused);
  fault_tick_ = tick_;
  return command;
}

void Controller::report(const can::Timing& timing, Outputs& outputs) {
  const bool changed = supervisor_.state != reported_.state || supervisor_.fault != reported_.fault;
  const bool faulty = supervisor_.state == can::State::fault;
  if (faulty && (changed || !sent_.fault_report.within(tick_, period<can::FaultReport> - 1))) {
    report_fault(outputs);
  }
  if (changed || !sent_.status.within(tick_, period<can::Status> - 1)) {
    report_status(outputs);
  }
  if (take_due(sent_.timing, tick_, period<can::Timing>)) {
    outputs.add(can::pack(timing));
  }
  if (take_due(sent_.heartbeat, tick_, period<can::Heartbeat>)) {
    outputs.add(can::pack(
        can::Heartbeat{.uptime_ms = static_cast<std::int32_t>((tick_ - boot_tick_) & low_31_bits)}));
  }
  if (take_due(sent_.version, tick_, period<can::Version>)) {
    outputs.add(can::pack(can::Version{.protocol = can::protocol_version,
                                       .decision_period_ms = built_in.decision_period_ms,
                                       .policy_low = static_cast<std::int32_t>(built_in.identity & 0xFFFFU),
                                       .policy_high = static_cast<std::int32_t>(built_in.identity >> 16U)}));
  }
}

void Controller::report_fault(Outputs& outputs) {
  sent_.fault_report.feed(tick_);
  outputs.add(can::send(can::FaultReport{.code = static_cast<std::int32_t>(supervisor_.fault),
                                         .tick = static_cast<std::int32_t>(fault_tick_ & low_31_bits)},
                        counters_.fault_report));
}

void Controller::report_status(Outputs& outputs) {
  sent_.status.feed(tick_);
  reported_ = supervisor_;
  const DriveFacts facts = drive_facts();
  const IgnoredFrames& ignored = inbox_.ignored();
  outputs.add(can::send(
      can::Status{.state = static_cast<std::int32_t>(supervisor_.state),
                  .fault = static_cast<std::int32_t>(supervisor_.fault),
                  .wrong_length = ignored.wrong_length,
                  .wrong_crc = ignored.wrong_crc,
                  .wrong_counter = ignored.wrong_counter,
                  .out_of_range = ignored.out_of_range,
                  .vision_ready = static_cast<std::int32_t>(facts.vision_fresh && estimator_.has_velocity()),
                  .wheels_ready = static_cast<std::int32_t>(facts.wheels_fresh)},
      counters_.status));
}

}  // namespace striker::core
