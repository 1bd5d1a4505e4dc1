// SPDX-License-Identifier: Apache-2.0
// The records of a match (sil/match/record/match_records.hpp) against those that the same match leaves when it is
// played again: byte for byte, timing.json left out. What says with which build a match was played may be another, but
// is the same in all of its records; of match.log.gz what was compressed is compared, as another zlib compresses
// otherwise.
//
//   if (const auto other = first_other_record("out/match", "/tmp/again")) { fmt::print("{}\n", *other); }
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace striker::sil {

// "frames.csv: line 3, column 7: recorded '0.1', now '0.2'", "match.json: /red/goals is 3, now 2" or "match.log.gz:
// cannot be read (...)". None: all are there and the same. Throws std::runtime_error that names a file of `now` which
// cannot be read.
[[nodiscard]] std::optional<std::string> first_other_record(const std::filesystem::path& recorded,
                                                            const std::filesystem::path& now);

}  // namespace striker::sil
