// SPDX-License-Identifier: Apache-2.0
// The best reward that any action sequence gets in an episode of the kick or of the aimed kick: 3 actions in 40 decisions.
//
// Until the ball is near enough to the robot's line to be touched, the reachable states are the same in every
// episode (reachable.hpp). From there on the search goes forward decision by decision: every state that has
// not touched the ball yet branches into the three actions, stepped exactly, and is merged on the same grid.
// The first contact ends a branch and pays. Only branches are dropped that cannot meet the ball any more, or
// cannot beat what is found already.
//
// Every result is a real action sequence, so the ceiling is exact but for what the merging loses: a lower
// bound, at most a little below the truth. Half the cell size raises the mean by less than 0.01.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "training/ceiling/reachable.hpp"

namespace striker::training {

using ActionSequence = std::array<std::uint8_t, sil::kick_decisions>;

struct FoundSequence {
  double reward = no_contact_reward;
  int contact_step = -1;     // the physics step whose collision test finds it; -1: no contact
  ActionSequence actions{};  // after the contact, that of the contact's decision goes on
};

// The full wheel bodies are up to 0.2 mm elsewhere than the search expects them, which decides where a
// contact is a matter of edges. `safe` is the best sequence that is this far from every edge.
inline constexpr double safe_margin_m = 0.0003;

struct Ceiling {
  FoundSequence best;
  FoundSequence safe;
};

// One thread uses one search; many may share the reachable states.
class CeilingSearch {
 public:
  explicit CeilingSearch(const Reachable& reachable, sil::KickReward reward = sil::KickReward::contact);

  [[nodiscard]] Ceiling search(const sil::KickStart& start);

 private:
  // A state that has not touched the ball, found in this episode.
  struct Branch {
    LineState state;
    std::uint32_t parent = 0;  // in the level before; in the first level a node of the reachable states
    std::uint8_t action = 0;
    bool safe = true;
  };
  struct Contact {
    int level = -1;
    std::uint32_t branch = 0;
    std::uint8_t action = 0;
  };
  // Where a robot must be before a decision, and how fast, for a contact that is worth it: any state that
  // does not meet these needs is dropped.
  struct Needs {
    double low_m = 0.0;
    double high_m = 0.0;
    double least_speed_m_s = 0.0;
    [[nodiscard]] bool met_by(const LineState& state) const {
      return state.position_m >= low_m && state.position_m <= high_m && state.speed_m_s >= least_speed_m_s;
    }
  };

  [[nodiscard]] Needs needs(int decision, double to_beat) const;
  [[nodiscard]] double least_speed_m_s(int step, double to_beat) const;
  void begin(int decision);
  void expand(int decision);
  void grow(int decision, std::uint32_t branch, std::uint8_t action, const Needs& next);
  void record(FoundSequence& found, Contact& contact, double reward, int step, const Contact& here) const;
  void trace(FoundSequence& found, const Contact& contact) const;

  const Reachable* reachable_;
  LineDrive drive_;
  CellTable cells_;
  std::array<std::vector<Branch>, sil::kick_decisions + 1> levels_;
  BallTrack track_{};
  int first_level_ = 0;
  Ceiling ceiling_;
  Contact best_;
  Contact safe_;
};

}  // namespace striker::training
