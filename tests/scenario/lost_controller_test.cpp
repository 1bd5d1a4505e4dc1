// The controller dies in mid-run, and comes back: the drives act by themselves, and nobody arms it unasked.
#include <gtest/gtest.h>

#include <vector>

#include "sil/bus/in_process_link.hpp"
#include "sil/scenario/kick_run.hpp"

namespace striker::sil {
namespace {

// A controller that dies at one tick and is booted anew at another.
class MortalLink final : public ControllerLink {
 public:
  MortalLink(std::uint32_t death, std::uint32_t rebirth) : death_(death), rebirth_(rebirth) {}

  void exchange(std::uint32_t tick, std::span<const can::Frame> sent,
                std::vector<can::Frame>& answer) override {
    if (tick == rebirth_) {
      link_ = {};
    }
    if (tick < death_ || tick >= rebirth_) {
      link_.exchange(tick, sent, answer);
    }
  }
  [[nodiscard]] can::State state() const { return link_.controller().state(); }

 private:
  std::uint32_t death_;
  std::uint32_t rebirth_;
  InProcessLink link_;
};

constexpr std::uint32_t first_decision = 150;  // 50 ticks of boot, then two pictures
constexpr std::uint32_t death = first_decision + 700;
constexpr std::uint32_t rebirth = death + 300;

TEST(LostController, TheDrivesCutWithinTenMillisecondsAndOnlyAnArmBringsTorqueBack) {
  MortalLink link(death, rebirth);
  std::vector<bool> cut;
  std::vector<can::State> states;
  KickRunner* observed = nullptr;
  KickRunner runner({.plant = PlantKind::drive, .episodes = 2}, link,
                    {.begin_tick = {},
                     .end_tick =
                         [&](const TickRecord& record) {
                           cut.push_back(observed->drives().cut(record.tick));
                           states.push_back(link.state());
                         },
                     .end_episode = {},
                     .stop = {}});
  observed = &runner;
  runner.run();
  EXPECT_FALSE(cut[death - 1]);
  EXPECT_TRUE(cut[death + 9]);
  for (std::uint32_t tick = death + 9; tick < rebirth; ++tick) {
    ASSERT_TRUE(cut[tick]);
  }
  const std::uint32_t second_episode = 50 + 2200;
  for (std::uint32_t tick = rebirth; tick < second_episode + 51; ++tick) {
    ASSERT_NE(states[tick], can::State::active) << tick;
  }
  EXPECT_EQ(states[second_episode + 60], can::State::active);
  EXPECT_EQ(runner.outcomes().size(), 2U);
}

}  // namespace
}  // namespace striker::sil
