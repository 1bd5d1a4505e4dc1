// SPDX-License-Identifier: Apache-2.0
#include "sil/match/team/simple_teams.hpp"

#include "sil/match/team/top_speed.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

TeamOrders IdleTeam::play(const TeamView& /*view*/) {
  TeamOrders orders;
  orders.fill(SpeedOrder{});
  return orders;
}

RandomTeam::RandomTeam(std::uint64_t seed) : random_(seed, 0, random_stream::random_team) {}

TeamOrders RandomTeam::play(const TeamView& /*view*/) {
  TeamOrders orders;
  for (std::size_t id = 0; id < robots_a_team; ++id) {
    const double top_m_s = top_speed_m_s(id);
    const double left_m_s = random_.uniform(-top_m_s, top_m_s);
    orders[id] = SpeedOrder{left_m_s, random_.uniform(-top_m_s, top_m_s)};
  }
  return orders;
}

}  // namespace striker::sil
