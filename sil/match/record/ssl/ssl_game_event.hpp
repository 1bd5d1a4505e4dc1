// SPDX-License-Identifier: Apache-2.0
// A ruling's event as SSL's game event: ssl_referee.hpp says which is which.
#pragma once

#include <optional>

#include "sil/match/record/ssl/proto_message.hpp"
#include "sil/match/referee/event.hpp"

namespace striker::sil {

// GameEvent; none if SSL knows of no such thing.
[[nodiscard]] std::optional<ProtoMessage> ssl_game_event(const MatchEvent& event);

}  // namespace striker::sil
