// SPDX-License-Identifier: Apache-2.0
// The messages of a DBC file for a bus budget: those with 11-bit identifiers of up to 8 bytes, and the
// attributes GenMsgCycleTime (period), GenMsgDelayTime (shortest distance) and Deadline, all in ms, and Burst,
// as `striker-dbc` writes them. Without a period it is the distance; with a distance but no Burst the period
// is the distance, because nothing else bounds frames on changes; without Deadline it is the period.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sil/budget/response_time.hpp"

namespace striker::sil {

// Jitter 0. `default_distance_ms` (period and distance) is for messages with neither a period nor a distance;
// 0: they are an error. Throws std::runtime_error with one line that names the file, what is wrong in it, and
// the way out.
[[nodiscard]] std::vector<BusMessage> read_dbc(const std::filesystem::path& file,
                                               std::int64_t default_distance_ms);

}  // namespace striker::sil
