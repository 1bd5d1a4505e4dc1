// SPDX-License-Identifier: Apache-2.0
// Three roles and two policies in one program: each controller's run of its own, as a hash of every frame that
// it sent, on every target as on the host.
//
//   striker-roles
//
// Exit status 0 if each hash is the one written down here, ten copies stepped in turn gave what one gives, and
// the robot that the built-in policy is too fast for refused it.
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/core/controller.hpp"
#include "firmware/loop/controller_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "firmware/policy/exported/kick.hpp"
#include "tests/images/console.hpp"
#include "tests/loop/bench/consent.hpp"
#include "tests/policy/wander_policy.hpp"

namespace {

using namespace striker;

using Kick = core::Pilot<policy::kick>;
using Wander = core::Pilot<policy::wander>;
template <class Pilot>
using Node = loop::GatedNode<loop::ControllerNode<core::Controller<Pilot>, can::StrikerDrives>>;

constexpr core::RobotProfile forward = core::profile_of(core::forward);
constexpr core::RobotProfile defender = core::profile_of(core::defender);
constexpr core::RobotProfile goalkeeper = core::profile_of(core::goalkeeper);

static_assert(Kick::suits(forward) && !Kick::suits(defender) && !Kick::suits(goalkeeper));
static_assert(Wander::suits(forward) && Wander::suits(defender) && Wander::suits(goalkeeper));

constexpr std::uint32_t run_ticks = 2'000;

// A robot around a node: wheels that follow the torque, a camera that sees where they took it, a ball that comes and
// goes, an operator who arms.
template <class Pilot>
class Robot {
 public:
  explicit Robot(const core::RobotProfile& robot) : turn_q12_(robot.turn_q12), node_(robot) {}

  void tick() {
    std::array<can::Frame, 5> frames;
    std::size_t count = 0;
    if (now_ % 50 == 0) {
      const auto number = static_cast<std::int32_t>(now_ / 50 % 16);
      const auto phase = static_cast<std::int32_t>(now_ % 1500 < 750 ? now_ % 1500 : 1500 - now_ % 1500);
      frames[count++] = can::send(can::VisionPose{.frame = number,
                                                  .x_quarter_mm = place_um_.x / can::um_per_quarter_mm,
                                                  .y_quarter_mm = place_um_.y / can::um_per_quarter_mm,
                                                  .heading = core::wrap_angle(heading_q12_ >> 12)},
                                  pose_);
      frames[count++] = can::send(
          can::VisionBall{
              .frame = number, .x_quarter_mm = 8000 - 8 * phase, .y_quarter_mm = 3 * phase - 2000},
          ball_);
    }
    frames[count++] = can::send(wheels_, wheel_counter_);
    move();
    if (now_ == 160) {
      frames[count++] = operator_.command(can::Mode::arm);
    }
    if (confirmation_) {
      frames[count++] = *std::exchange(confirmation_, std::nullopt);
    }
    can::FrameList sent;
    node_.step({.number = now_, .frames = std::span(frames).first(count)}, sent);
    confirmation_ = operator_.answer(std::as_const(sent).frames());
    for (const can::Frame& frame : std::as_const(sent).frames()) {
      take(frame);
    }
    ++now_;
  }

  void run() {
    while (now_ < run_ticks) {
      tick();
    }
  }

  [[nodiscard]] std::uint32_t hash() const { return hash_.value(); }
  [[nodiscard]] std::uint32_t decisions() const { return node_.controller().pilot().decisions(); }
  [[nodiscard]] core::Fault fault() const { return node_.controller().fault(); }

 private:
  // In a tick of 1 ms a speed in mm/s is a distance in um.
  void move() {
    const core::Vector way =
        core::rotate({(wheels_.left_mm_s + wheels_.right_mm_s) / 2, 0}, core::wrap_angle(heading_q12_ >> 12));
    place_um_ = {place_um_.x + way.x, place_um_.y + way.y};
    // Binary angle in Q12, whose full circle is 2^28.
    heading_q12_ = (heading_q12_ + (wheels_.right_mm_s - wheels_.left_mm_s) * turn_q12_) & 0x0FFFFFFF;
  }

  void take(const can::Frame& frame) {
    hash_.add(frame.id);
    for (const std::uint8_t byte : frame.data) {
      hash_.add(byte);
    }
    can::WheelCommand command;
    if (can::is<can::WheelCommand>(frame) && can::unpack(frame, command) == can::Verdict::accepted) {
      wheels_.left_mm_s += command.left_torque_mNm / 36;
      wheels_.right_mm_s += command.right_torque_mNm / 36;
    }
  }

  std::int32_t turn_q12_;
  core::Vector place_um_;
  std::int32_t heading_q12_ = 0;
  Node<Pilot> node_;
  std::optional<can::Frame> confirmation_;
  policy::proof::Fnv1a hash_;
  std::uint32_t now_ = 0;
  can::WheelState wheels_;
  can::SendCounter pose_, ball_, wheel_counter_;
  loop::BenchOperator operator_;
};

int failures = 0;

void expect(const char* name, std::uint32_t value, std::uint32_t wanted) {
  images::console::print_line(name, value);
  if (value != wanted) {
    images::console::print_line("  but wanted", wanted);
    ++failures;
  }
}

template <class Pilot>
void expect_run(const char* name, const core::RobotProfile& profile, std::uint32_t wanted) {
  Robot<Pilot> robot(profile);
  robot.run();
  expect(name, robot.hash(), wanted);
  if (robot.decisions() < 30 || robot.fault() != core::Fault::none) {
    images::console::print("  but it hardly drove\n");
    ++failures;
  }
}

// Stepped in turn, they share the program but no state.
void expect_ten_copies(std::uint32_t wanted) {
  static std::array<Robot<Wander>, 5> defenders = {Robot<Wander>(defender), Robot<Wander>(defender),
                                                   Robot<Wander>(defender), Robot<Wander>(defender),
                                                   Robot<Wander>(defender)};
  static std::array<Robot<Wander>, 5> goalkeepers = {Robot<Wander>(goalkeeper), Robot<Wander>(goalkeeper),
                                                     Robot<Wander>(goalkeeper), Robot<Wander>(goalkeeper),
                                                     Robot<Wander>(goalkeeper)};
  for (std::uint32_t tick = 0; tick < run_ticks; ++tick) {
    for (std::size_t i = 0; i < defenders.size(); ++i) {
      goalkeepers[i].tick();
      defenders[i].tick();
    }
  }
  for (const Robot<Wander>& robot : defenders) {
    expect("defender, wander, one of ten", robot.hash(), wanted);
  }
}

// Apart from main, whose name every image's stack analysis reads.
[[gnu::noinline]] void run_all() {
  constexpr std::uint32_t defender_wander = 1812365664;
  expect_run<Kick>("forward, kick", forward, 2428278656);
  expect_run<Wander>("forward, wander", forward, 2491819050);
  expect_run<Wander>("defender, wander", defender, defender_wander);
  expect_run<Wander>("goalkeeper, wander", goalkeeper, 913944092);
  expect_ten_copies(defender_wander);
  Robot<Kick> too_fast(goalkeeper);
  too_fast.run();
  expect("goalkeeper, kick", static_cast<std::uint32_t>(too_fast.fault()),
         static_cast<std::uint32_t>(core::Fault::self_test_failed));
}

}  // namespace

int main() {
  run_all();
  images::console::exit(failures == 0 ? 0 : 1);
}
