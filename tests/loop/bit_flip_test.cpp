// SPDX-License-Identifier: Apache-2.0
// Every single bit of a controller's memory, flipped at several instants and in several situations: no torque
// without being armed, no fault forgotten, no torque beyond the limit, and no wrong torque that nobody notices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <sstream>
#include <vector>

#include "tests/loop/bench/node_rig.hpp"

namespace striker::loop {
namespace {

using core::State;
using Controller = core::Controller<BuiltInPilot>;

constexpr int watched_ticks = 300;

constexpr std::size_t bits = 8 * sizeof(Controller);
// A sanitizer makes each flip forty times as long: there, every seventh bit.
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t bit_step = 7;
#else
constexpr std::size_t bit_step = 1;
#endif

// A rig whose wheels follow the torque, and whose camera sees where they took the robot.
class FlippedRig : public NodeRig {
 public:
  std::deque<can::WheelCommand> on_its_way;  // as many as the commands take ticks

  void live() {
    on_its_way.push_back(command);
    wheels.left_mm_s += on_its_way.front().left_torque_mNm / 36;
    wheels.right_mm_s += on_its_way.front().right_torque_mNm / 36;
    on_its_way.pop_front();
    robot_um += (wheels.left_mm_s + wheels.right_mm_s) / 2;
    tick();
  }
  // Where the node keeps its controller: the same bytes that a flip in RAM would hit.
  unsigned char* memory() {
    return reinterpret_cast<unsigned char*>(const_cast<Controller*>(&node.node().controller()));
  }
};

struct Outcome {
  int nothing = 0;
  int fault = 0;
  int wrong_undetected = 0;
  int unarmed_torque = 0;
  int fault_lost = 0;
  int beyond_limit = 0;
  std::map<std::size_t, int> wrong_bytes;
};

// What a tick shows from outside.
struct Seen {
  State state;
  std::int32_t left_mNm;
  std::int32_t right_mNm;
};

Seen look(const FlippedRig& rig) {
  return {rig.state(), rig.command.left_torque_mNm, rig.command.right_torque_mNm};
}

void judge(const FlippedRig& from, const std::vector<Seen>& gold, std::size_t bit, Outcome& outcome) {
  FlippedRig rig = from;
  rig.memory()[bit / 8] ^= static_cast<unsigned char>(1U << (bit % 8));
  bool wrong = false;
  bool fault = false;
  for (int i = 0; i < watched_ticks; ++i) {
    rig.live();
    const Seen seen = look(rig);
    const Seen& honest = gold[static_cast<std::size_t>(i)];
    const bool torque = seen.left_mNm != 0 || seen.right_mNm != 0;
    outcome.unarmed_torque += honest.state != State::active && torque ? 1 : 0;
    outcome.fault_lost += honest.state == State::fault && seen.state != State::fault ? 1 : 0;
    const std::int32_t limit = built_in_robot.torque_limit_mNm;
    outcome.beyond_limit += std::abs(seen.left_mNm) > limit || std::abs(seen.right_mNm) > limit ? 1 : 0;
    fault = fault || (seen.state == State::fault && honest.state != State::fault);
    wrong = wrong || (!fault && (seen.left_mNm != honest.left_mNm || seen.right_mNm != honest.right_mNm));
  }
  if (fault) {
    ++outcome.fault;
  } else if (wrong) {
    ++outcome.wrong_undetected;
    ++outcome.wrong_bytes[bit / 8];
  } else {
    ++outcome.nothing;
  }
}

Outcome flip_every_bit(const FlippedRig& from) {
  FlippedRig honest = from;
  std::vector<Seen> gold;
  for (int i = 0; i < watched_ticks; ++i) {
    honest.live();
    gold.push_back(look(honest));
  }
  Outcome outcome;
  for (std::size_t bit = 0; bit < bits; bit += bit_step) {
    judge(from, gold, bit, outcome);
  }
  return outcome;
}

void expect_sound(const FlippedRig& from, const char* where) {
  const Outcome outcome = flip_every_bit(from);
  std::ostringstream bytes;
  for (const auto& [byte, count] : outcome.wrong_bytes) {
    bytes << " " << byte << " (" << count << ")";
  }
  std::printf("%s: of %zu bits %d without effect, %d a fault, %d wrong and unnoticed:%s\n", where,
              (bits + bit_step - 1) / bit_step, outcome.nothing, outcome.fault, outcome.wrong_undetected,
              bytes.str().c_str());
  EXPECT_EQ(outcome.unarmed_torque, 0) << where;
  EXPECT_EQ(outcome.fault_lost, 0) << where;
  EXPECT_EQ(outcome.beyond_limit, 0) << where;
  EXPECT_EQ(outcome.wrong_undetected, 0) << where;
}

FlippedRig driving(std::uint32_t ticks, const FlippedRig& from = {}) {
  FlippedRig rig = from;
  rig.run(210);
  rig.mode(can::Mode::arm);
  for (std::uint32_t i = 0; i < ticks; ++i) {
    rig.live();
  }
  EXPECT_TRUE(rig.torque());
  return rig;
}

TEST(BitFlip, WhileDrivingItIsNoticedBeforeItMatters) {
  for (const std::uint32_t ticks : {137U, 139U, 150U}) {
    expect_sound(driving(ticks), "driving");
  }
}

// What is on its way to the wheels is state too.
TEST(BitFlip, WithLateCommandsItIsNoticedAsWell) {
  core::RobotDescription late = core::forward;
  late.command_delay_ms = 20;
  FlippedRig rig;
  rig.node = GatedNode<BuiltInNode>(core::profile_of(late));
  rig.on_its_way.resize(20);
  expect_sound(driving(139, rig), "driving with late commands");
}

TEST(BitFlip, UnarmedItNeverMoves) {
  FlippedRig rig;
  rig.run(210);
  expect_sound(rig, "standby");
}

// What is looked at for the first time when it is armed: found there, it is a fault by its own name, and nothing moves.
TEST(BitFlip, FoundAtArmingItIsToldByItsName) {
  FlippedRig rig;
  rig.run(210);
  int found = 0;
  for (std::size_t bit = 0; bit < bits; bit += bit_step) {
    FlippedRig copy = rig;
    copy.memory()[bit / 8] ^= static_cast<unsigned char>(1U << (bit % 8));
    copy.send_vision = false;
    copy.tick();
    if (copy.state() == State::fault) {
      continue;  // found at once
    }
    copy.mode(can::Mode::arm);
    copy.tick();
    if (copy.state() == State::active) {
      continue;
    }
    ++found;
    ASSERT_EQ(copy.state(), State::fault) << bit;
    ASSERT_EQ(copy.fault(), core::Fault::state_corrupt) << bit;
    ASSERT_FALSE(copy.torque()) << bit;
  }
  EXPECT_GT(found, 0);
}

TEST(BitFlip, StoppedItStaysStopped) {
  FlippedRig rig = driving(60);
  rig.stop();
  for (int i = 0; i < 300; ++i) {
    rig.live();
  }
  ASSERT_EQ(rig.state(), State::fault);
  expect_sound(rig, "stopped");
}

// After a restart of logical time a controller is in a fault, or does what one does whose memory never changed.
void expect_restart_sound(const FlippedRig& from, bool arms) {
  const auto after_restart = [arms](FlippedRig& rig) {
    rig.answer({.number = 0, .frames = {}, .restart = true});
    std::vector<Seen> seen;
    rig.run(200);
    if (arms) {
      rig.mode(can::Mode::arm);
    }
    for (int i = 0; i < 60; ++i) {
      rig.live();
      seen.push_back(look(rig));
    }
    return seen;
  };
  FlippedRig honest = from;
  const std::vector<Seen> gold = after_restart(honest);
  int changed = 0;
  int faults = 0;
  for (std::size_t bit = 0; bit < bits; bit += bit_step) {
    FlippedRig rig = from;
    rig.memory()[bit / 8] ^= static_cast<unsigned char>(1U << (bit % 8));
    const std::vector<Seen> seen = after_restart(rig);
    const bool stays_down = std::all_of(seen.begin(), seen.end(), [](const Seen& one) {
      return one.state == State::fault && one.left_mNm == 0 && one.right_mNm == 0;
    });
    const bool same =
        std::equal(seen.begin(), seen.end(), gold.begin(), [](const Seen& one, const Seen& other) {
          return one.state == other.state && one.left_mNm == other.left_mNm &&
                 one.right_mNm == other.right_mNm;
        });
    changed += !stays_down && !same ? 1 : 0;
    faults += stays_down ? 1 : 0;
  }
  EXPECT_EQ(changed, 0);
  EXPECT_GT(faults, 100);
}

TEST(BitFlip, BeforeTimeBeginsAnewItIsFoundThere) {
  FlippedRig rig = driving(60);
  expect_restart_sound(rig, true);
}

TEST(BitFlip, BeforeTimeBeginsAnewItForgetsNoStop) {
  FlippedRig rig = driving(60);
  rig.stop();
  rig.run(300);
  expect_restart_sound(rig, false);
}

// The byte that holds the state, with every value that it could take.
TEST(BitFlip, NoValueOfTheStateArms) {
  FlippedRig rig;
  rig.run(210);
  unsigned char* const memory = rig.memory();
  for (std::size_t byte = 0; byte < sizeof(Controller); ++byte) {
    if (memory[byte] != static_cast<unsigned char>(State::standby)) {
      continue;
    }
    for (int value = 0; value < 256; ++value) {
      FlippedRig copy = rig;
      copy.memory()[byte] = static_cast<unsigned char>(value);
      copy.run(5);
      ASSERT_NE(copy.state(), State::active) << byte << " " << value;
      ASSERT_FALSE(copy.torque());
    }
  }
}

}  // namespace
}  // namespace striker::loop
