// SPDX-License-Identifier: Apache-2.0
// The rule-based players of AI Soccer v0.7 (AI World Cup examples ae937e6): B, and A, which is B with passing and a
// rule for robots that are stuck.
//
//   set piece          own ball                         else
//   kickoff            robot 4 goes to the centre       last orders again
//   goal kick          the goalkeeper drives ahead      last orders again
//   penalty            robot 4 drives ahead             last orders again
//   corner, open play  all by the tables of roles.hpp   the same
// Last orders are those of robots that may not move, or have nothing else to do.
#pragma once

#include <array>
#include <optional>

#include "sil/match/team/go_to.hpp"
#include "sil/match/team/rules/passing.hpp"
#include "sil/match/team/rules/sight.hpp"
#include "sil/match/team/strategy.hpp"

namespace striker::sil {

struct RulesOptions {
  ReverseSteering reverse = ReverseSteering::corrected;
  bool passing = false;
};

class RulesTeam final : public Strategy {
 public:
  explicit RulesTeam(const RulesOptions& options) : options_(options) {}
  [[nodiscard]] TeamOrders play(const TeamView& view) override;

 private:
  void play_open(const TeamView& view, const Sight& sight);
  void play_set_piece(const TeamView& view);
  void play_roles(const Sight& sight);
  void order(std::size_t id, const Pose& robot, const Action& action);

  RulesOptions options_;
  PassingPlay passing_;
  std::optional<Glimpse> before_;
  std::array<SpeedOrder, robots_a_team> last_ = {};
};

}  // namespace striker::sil
