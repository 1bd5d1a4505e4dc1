// SPDX-License-Identifier: Apache-2.0
// The referee of a match in which anything happens: bodies jump, fall, touch, are far away and at no number at all.
// What holds after every frame of every match does; the same frames give the same rulings; a copy goes on as the
// original does.
#include <cmath>
#include <limits>

#include "tests/fuzz/support/bytes.hpp"
#include "tests/match/referee_invariants.hpp"

namespace striker::fuzz {
namespace {

sil::MatchRules rules_from(std::uint8_t choice) {
  sil::MatchRules rules = (choice & 1U) != 0 ? sil::published() : sil::official();
  rules.deadlock = (choice & 2U) == 0;
  rules.half_ms = (choice & 4U) != 0 ? 5'000 : 60'000;
  return rules;
}

// Where rules ask for something; in red's frame of the first half.
constexpr std::array<sil::Vec2, 16> places = {{{0.0, 0.0},
                                               {0.6, 0.0},
                                               {1.5, -1.0},
                                               {2.0, 1.0},
                                               {2.9, 0.0},
                                               {3.2, 0.3},
                                               {3.3, -0.6},
                                               {3.6, 0.0},
                                               {3.6, 0.6},
                                               {3.95, 0.3},
                                               {3.95, 0.7},
                                               {4.4, 0.0},
                                               {3.6, 1.9},
                                               {3.9, 2.3},
                                               {0.0, 2.4},
                                               {0.65, 0.3}}};

class RefereeRig {
 public:
  RefereeRig(Bytes& bytes, const sil::MatchRules& rules)
      : bytes_(bytes), referee_(rules), twin_(rules), watch_(referee_) {
    follow(referee_.ruling());
  }

  void run() {
    while (!bytes_.done() && referee_.ruling().state != sil::GameState::over) {
      operate(bytes_.u8() & 31U);
    }
    step(1);
  }

 private:
  void operate(std::uint8_t operation) {
    switch (operation) {
      case letter('b'):
        frame_.ball.position_m = place();
        return;
      case letter('c'):
        frame_.ball.position_m = spot();
        return;
      case letter('v'):
        frame_.ball.speed_m_s = bytes_.u8() / 64.0;
        return;
      case letter('r'):
        return put(place());
      case letter('p'):
        return put(spot());
      case letter('f'):
        frame_.standing.flip(robot());
        return;
      case letter('t'):
        frame_.touching.set(robot());
        return;
      case letter('n'):
        return lose();
      case letter('k'):
        twin_ = referee_;
        return;
      case letter('l'):
        follows_ = !follows_;
        return;
      case letter('w'):
        return step(1 + bytes_.u8() % 64);
      case letter('z'):
        return step(20);
      default:
        return step(1);
    }
  }

  std::size_t robot() { return bytes_.u8() % sil::robots_in_match; }

  // The low four bits choose, bit 4 and bit 5 turn x and y round; so letters and digits are good for many.
  sil::Vec2 place() {
    const std::uint8_t choice = bytes_.u8();
    const sil::Vec2 place = places[choice & 15U];
    return {(choice & 16U) != 0 ? -place.x : place.x, (choice & 32U) != 0 ? -place.y : place.y};
  }
  sil::Vec2 spot() {
    const double x_mm = bytes_.i16();
    return {x_mm / 4e3, bytes_.i16() / 4e3};
  }
  void put(sil::Vec2 at) { frame_.robots[robot()] = {at.x, at.y, 0.0}; }

  // A number that is none, or beyond all.
  void lose() {
    constexpr std::array<double, 4> values = {
        std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max()};
    const std::uint8_t choice = bytes_.u8();
    const double value = values[choice & 3U];
    switch (choice >> 2U & 7U) {
      case 0:
        frame_.ball.position_m.x = value;
        return;
      case 1:
        frame_.ball.position_m.y = value;
        return;
      case 2:
        frame_.ball.speed_m_s = value;
        return;
      case 3:
        frame_.robots[robot()].heading_rad = value;
        return;
      case 4:
        frame_.robots[robot()].x_m = value;
        return;
      default:
        frame_.robots[robot()].y_m = value;
        return;
    }
  }

  void follow(const sil::Ruling& ruling) {
    for (std::size_t robot = 0; robot < sil::robots_in_match; ++robot) {
      frame_.robots[robot] = ruling.placements.robots[robot].value_or(frame_.robots[robot]);
    }
    if (const auto& ball = ruling.placements.ball) {
      frame_.ball = {.position_m = ball->position_m, .height_m = ball->height_m};
    }
  }

  void step(int frames) {
    for (int i = 0; i < frames; ++i) {
      const sil::Ruling& ruling = referee_.step(frame_);
      const std::string_view broken = watch_.watch(frame_, ruling);
      require(broken.empty(), broken.data());
      require(sil::RulingDigest::of(twin_.step(frame_)) == sil::RulingDigest::of(ruling),
              "the same frames give the same rulings");
      frame_.touching.reset();
      if (follows_) {
        follow(ruling);
      }
    }
  }

  Bytes& bytes_;
  sil::Referee referee_;
  sil::Referee twin_;
  sil::RefereeWatch watch_;
  sil::RefereeFrame frame_;
  bool follows_ = true;  // else what is placed does not go there
};

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  striker::fuzz::Bytes bytes(data, size);
  const auto rules = striker::fuzz::rules_from(bytes.u8());
  striker::fuzz::RefereeRig(bytes, rules).run();
  return 0;
}
