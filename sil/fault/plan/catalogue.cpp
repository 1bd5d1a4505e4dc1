// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/plan/catalogue.hpp"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "firmware/can/messages.hpp"

namespace striker::sil {

namespace {

using enum FaultKind;

constexpr std::int32_t usual_from_ms = 300;
constexpr std::int32_t usual_until_ms = 1500;
constexpr std::int32_t stall_ms = 400;

using Change = std::function<void(Fault&)>;

class Catalogue {
 public:
  void add(
      const std::string& name, FaultKind kind, const Change& change = [](Fault&) {}) {
    Fault fault = usual(kind, usual_from_ms, info_of(kind).at_once ? usual_from_ms + 1 : usual_until_ms);
    change(fault);
    add(name, {fault});
  }
  void add(const std::string& name, std::vector<Fault> faults) {
    for (std::size_t i = 0; i < faults.size(); ++i) {
      faults[i].stream = i;
    }
    plan_.cases.push_back({.name = name, .setup = {}, .faults = std::move(faults)});
  }
  [[nodiscard]] FaultPlan plan() const { return plan_; }

 private:
  FaultPlan plan_;
};

template <class Message>
void of(Fault& fault) {
  fault.message = can::layout<Message>.info.id;
}

Change count(std::uint32_t count) {
  return [count](Fault& fault) { fault.count = count; };
}

Change wheel(FaultyWheel wheel) {
  return [wheel](Fault& fault) { fault.wheel = wheel; };
}

Change value(double value) {
  return [value](Fault& fault) { fault.value = value; };
}

Change for_ms(std::int32_t ms) {
  return [ms](Fault& fault) { fault.until_ms = fault.from_ms + ms; };
}

template <class Message>
Change replayed(std::uint32_t frames) {
  return [frames](Fault& fault) {
    of<Message>(fault);
    fault.count = frames;
  };
}

template <class Message, class As>
Change masqueraded() {
  return [](Fault& fault) {
    of<Message>(fault);
    fault.as = can::layout<As>.info.id;
  };
}

template <class Message>
Change babbled(std::uint32_t frames) {
  return replayed<Message>(frames);
}

void add_losses(Catalogue& all) {
  all.add("WheelState lost", loss, of<can::WheelState>);
  all.add("WheelCommand lost", loss, of<can::WheelCommand>);
  all.add("VisionPose lost", loss, of<can::VisionPose>);
  all.add("SYNC lost", loss, of<can::Sync>);
  all.add("one frame in ten lost", loss, [](Fault& fault) { fault.probability = 0.1; });
  all.add("every second picture lost", picture_loss, [](Fault& fault) { fault.probability = 0.5; });
  all.add("pictures lost", picture_loss);
}

void add_times(Catalogue& all) {
  all.add("frames 5 ms late", delay);
  all.add("WheelState 100 ms late", delay, replayed<can::WheelState>(100));
  all.add("frames 0 to 5 ms late", jitter);
  all.add("a tick's frames out of order", reorder);
  all.add("every frame twice", duplicate);
}

void add_replays(Catalogue& all) {
  all.add("WheelState frozen", replay, replayed<can::WheelState>(1));
  all.add("two old WheelStates in turn", replay, replayed<can::WheelState>(2));
  all.add("a recording of 64 WheelStates", replay, replayed<can::WheelState>(64));
  all.add("WheelCommand frozen", replay, replayed<can::WheelCommand>(1));
  all.add("two old WheelCommands in turn", replay, replayed<can::WheelCommand>(2));
  all.add("a recording of 64 WheelCommands", replay, replayed<can::WheelCommand>(64));
  all.add("VisionPose frozen", replay, replayed<can::VisionPose>(1));
  all.add("4 old VisionBalls in turn", replay, replayed<can::VisionBall>(4));
  all.add("ModeCommand stuck", replay, replayed<can::ModeCommand>(1));
}

void add_forgeries(Catalogue& all) {
  all.add("WheelState as WheelCommand", masquerade, masqueraded<can::WheelState, can::WheelCommand>());
  all.add("VisionBall as VisionPose", masquerade, masqueraded<can::VisionBall, can::VisionPose>());
  all.add("WheelState as WheelOrder", masquerade, masqueraded<can::WheelState, can::WheelOrder>());
  all.add("Status as ModeCommand", masquerade, masqueraded<can::Status, can::ModeCommand>());
  for (const std::uint32_t bits : {1U, 2U, 3U}) {
    all.add(fmt::format("{} wrong bits in every frame", bits), flip_bits, count(bits));
  }
  all.add("wrong lengths", wrong_length);
  all.add("babble on all identifiers", babble);
  all.add("babble on ModeCommand", babble, babbled<can::ModeCommand>(8));
  all.add("babble on WheelCommand", babble, babbled<can::WheelCommand>(8));
  all.add("babble on WheelState", babble, babbled<can::WheelState>(8));
  all.add("babble on WheelOrder", babble, babbled<can::WheelOrder>(8));
  all.add("babble on MotionOrder", babble, babbled<can::MotionOrder>(8));
}

void add_foreign(Catalogue& all) {
  all.add("remote frames", remote_frames);
  all.add("extended frames", extended_frames);
  all.add("CAN FD frames", fd_frames);
}

void add_node(Catalogue& all) {
  all.add("off the bus", bus_off);
  all.add("off the bus for 50 ms", bus_off, for_ms(50));
  all.add("error passive", error_passive);
  all.add("interface down for 200 ms", interface_down, for_ms(200));
  all.add("a bit of the state flips", state_flips);
  all.add("a bit of the weights flips", weight_flips);
  all.add("a second controller", second_controller);
  all.add("brown-out of 100 ms", brown_out, for_ms(100));
}

void add_clock(Catalogue& all) {
  all.add("SYNC repeated", sync_repeat);
  all.add("SYNC stands still", sync_freeze);
  all.add("SYNC 100 ticks back", sync_backward);
  all.add("SYNC wraps", sync_wrap);
  all.add("SYNC(0) in mid-run", sync_restart);
  all.add("a second simulator", second_simulator);
  all.add("stall of 8 ms", stall, for_ms(8));
  all.add("stall of 100 ms", stall, for_ms(100));
  all.add("stall of 400 ms", stall, for_ms(stall_ms));
}

void add_stops(Catalogue& all) {
  all.add("emergency stop", emergency_stop);
  all.add("emergency stop behind 200 frames", emergency_stop, count(200));
  const Fault late = usual(emergency_stop, usual_from_ms + stall_ms - 50, usual_from_ms + stall_ms - 49);
  const Fault endless = usual(stall, usual_from_ms, usual_from_ms + stall_ms);
  Fault bounded = endless;
  bounded.count = 277;  // frames in a Linux socket's queue by default
  all.add("emergency stop in a stall", {late, endless});
  all.add("emergency stop in a stall, queue of 277", {late, bounded});
}

void add_camera(Catalogue& all) {
  all.add("camera frozen", camera_frozen);
  all.add("pictures one late", camera_late);
  all.add("robot seen 2 m off, to and fro", camera_jump);
  all.add("robot seen turned by half a circle", camera_turn);
  all.add("positions off by up to 20 mm", camera_noise);
  all.add("ball seen 100 mm off", camera_bias);
  all.add("pictures mirrored", camera_mirrored);
  all.add("ball seen 2 m off, to and fro", ball_jumps);
}

void add_wheels(Catalogue& all) {
  all.add("wheel speeds frozen at 0", wheels_frozen);
  all.add("wheel speeds frozen at 1000 mm/s", wheels_frozen, value(1000.0));
  all.add("left wheel speed frozen at 0", wheels_frozen, wheel(FaultyWheel::left));
  all.add("left wheel speed reversed", wheels_reversed, wheel(FaultyWheel::left));
  all.add("right wheel speed reversed", wheels_reversed, wheel(FaultyWheel::right));
  all.add("wheel speeds reversed", wheels_reversed);
  all.add("wheel speeds swapped", wheels_swapped);
  all.add("wheel speeds halved", wheels_scaled);
  all.add("wheel speeds wrap at 2048 mm/s", wheels_wrapped);
  all.add("wheel speeds jump by 5800 mm/s", wheels_jump);
  all.add("torque_cut told for ever", torque_cut_told);
  all.add("left wheel stuck", wheel_stuck, wheel(FaultyWheel::left));
  all.add("left wheel slips", wheel_slips, wheel(FaultyWheel::left));
  all.add("motors weak", torque_saturated);
}

}  // namespace

FaultPlan fault_catalogue() {
  Catalogue all;
  add_losses(all);
  add_times(all);
  add_replays(all);
  add_forgeries(all);
  add_foreign(all);
  add_node(all);
  add_clock(all);
  add_stops(all);
  add_camera(all);
  add_wheels(all);
  return all.plan();
}

}  // namespace striker::sil
