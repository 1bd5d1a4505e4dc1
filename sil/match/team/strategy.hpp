// SPDX-License-Identifier: Apache-2.0
// What plays a team. It is asked once a frame while the clock runs, and not in pauses; it keeps what it needs to know
// from frame to frame by itself. The same views and the same seed give the same orders, to the bit.
#pragma once

#include "sil/match/team/order.hpp"
#include "sil/match/team/team_view.hpp"

namespace striker::sil {

class Strategy {
 public:
  virtual ~Strategy() = default;
  [[nodiscard]] virtual TeamOrders play(const TeamView& view) = 0;
};

}  // namespace striker::sil
