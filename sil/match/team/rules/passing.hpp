// SPDX-License-Identifier: Apache-2.0
// The passing of the rule-based player A (AI World Cup examples ae937e6, player_rulebased-A_py), its slips included.
// A sender near the ball and a free receiver are chosen anew nearly every frame: little of it becomes a pass.
//
//   each frame of open play, of the active ones of robots 1 to 4
//   1 choose   Nobody any longer, if the kick's time is over or the sender has no shoot chance. Sender: if anybody is
//              within 0.5 m of the ball, who is nearest to where it is in 3 frames, within 1 m. Receiver, of a sender
//              without one: who is nearest to the ball of those that no opponent is within 0.5 m of. (Both count
//              in a list of the active and take a place in it, plus 1, for an id.)
//   2 pass     With both: the receiver acts, then the sender. A pair that would swap roles does not.
//   3 stuck    Anybody else that has hardly moved, at y > 0, goes to the centre.
//   A kick lasts 10 frames. A robot that has touched the ball in one stands for 5 frames instead; for good, as nothing
//   ever forgets that touch.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "sil/match/team/rules/action.hpp"
#include "sil/match/team/rules/sight.hpp"

namespace striker::sil {

class PassingPlay {
 public:
  // By id. None: as the role's table says. `frame` counts on the half's clock.
  [[nodiscard]] std::array<std::optional<Action>, robots_a_team> play(const Sight& sight, int frame);

 private:
  using Id = std::optional<std::size_t>;

  void choose(const Sight& sight, std::span<const std::size_t> active);
  void act(const Sight& sight);
  void receive(const Sight& sight);
  void send(const Sight& sight);
  // What a robot does about the ball.
  void shoot(const Sight& sight, std::size_t id);
  void go(std::size_t id, const GoTo& way);
  void kick(const Sight& sight, std::size_t id);
  void stand(std::size_t id);
  void drop_receiver();

  Id sender_, receiver_;                // of this frame
  Id sender_before_, receiver_before_;  // of the last pair
  int frame_ = 0;
  int ends_at_frame_ = 0;  // a kick, or standing after it; 0: none
  std::array<bool, robots_a_team> has_kicked_ = {};
  std::array<bool, robots_a_team> stands_ = {};
  std::array<std::optional<Action>, robots_a_team> actions_;
};

}  // namespace striker::sil
