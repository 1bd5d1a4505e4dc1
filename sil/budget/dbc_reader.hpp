// SPDX-License-Identifier: Apache-2.0
// The messages of a DBC file for a bus budget, classic or CAN FD, with identifiers of 11 or 29 bits (bit 31 set, as
// the format has it). sil/budget/dbc_file.hpp says which statements are read.
//
// Traffic comes from the attributes GenMsgCycleTime (period), GenMsgDelayTime (shortest distance) and Deadline, all
// in ms, and Burst, as `striker-dbc` writes them. Without a period it is the distance; with a distance but no Burst
// the period is the distance, because nothing else bounds frames on changes; without Deadline it is the period.
// A message that is Awaited is left out, and so is VECTOR__INDEPENDENT_SIG_MSG, which is none.
//
// A message that does not have an attribute has the file's default (BA_DEF_DEF_). Where GenMsgSendType is known, by a
// value or by default, the default of GenMsgCycleTime is for types that name a cycle alone ("Cyclic", "FixedPeriodic"),
// and that of GenMsgDelayTime for types that name events alone ("OnEvent", "spontanX", "OnWrite", "OnChange",
// "triggered"); of "CyclicAndEvent" both count, of "NoMsgSendType" neither. A message's own values count whatever its
// type. If the type names events that neither a distance nor a Burst bounds, `events_uncounted` says that the budget
// leaves them out. Values of an ENUM are its texts or their index.
//
// A frame is CAN FD if VFrameFormat says so ("StandardCAN_FD", or 14) or if it has more than 8 bytes, and then switches
// the bit rate unless CANFD_BRS is 0. Lengths go up to what a DLC can say.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sil/budget/response_time.hpp"

namespace striker::sil {

struct DbcOptions {
  std::int64_t default_distance_ms = 0;  // period and distance of messages with neither; 0: they are an error
  bool has_data_bitrate = false;         // if not, a frame that switches to it is an error
};

// In the order of priority, jitter 0. Names are the file's bytes, in its encoding. Throws std::runtime_error with one
// line that names the file, the line in it, what is wrong, and the way out.
[[nodiscard]] std::vector<BusMessage> read_dbc(std::string_view text, const std::string& name,
                                               const DbcOptions& options);

// A file, or a pipe, of up to 64 MiB.
[[nodiscard]] std::vector<BusMessage> read_dbc(const std::filesystem::path& file, const DbcOptions& options);

}  // namespace striker::sil
