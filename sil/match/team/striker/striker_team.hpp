// SPDX-License-Identifier: Apache-2.0
// The team of this project.
#pragma once

#include <array>
#include <cstddef>

#include "sil/match/team/strategy.hpp"
#include "sil/match/team/striker/ball_track.hpp"
#include "sil/match/team/striker/kick_chance.hpp"
#include "sil/match/team/striker/manners.hpp"
#include "sil/match/team/striker/situation.hpp"

namespace striker::sil {

struct StrikerOptions {
  bool kicks = true;  // the learned kick, where it pays
};

class StrikerTeam final : public Strategy {
 public:
  explicit StrikerTeam(const StrikerOptions& options) : options_(options) {}
  [[nodiscard]] TeamOrders play(const TeamView& view) override;

 private:
  [[nodiscard]] SpeedOrder wheels_of(const Situation& now, std::size_t id);

  StrikerOptions options_;
  BallTrack ball_;
  std::size_t chaser_ = nobody;
  GoalAreaWatch goal_area_;
  Unstick unstick_;
  Kicks kicks_;
};

}  // namespace striker::sil
