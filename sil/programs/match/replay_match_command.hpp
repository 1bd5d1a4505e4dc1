// SPDX-License-Identifier: Apache-2.0
// `striker-sil replay DIRECTORY`: a recorded match, played again as its teams ordered.
#pragma once

#include <filesystem>

namespace striker::sil {

// The exit status: 0 the same frames on all buses, the same state at the end and the same records, 1 others,
// 130 interrupted.
int play_match_again(const std::filesystem::path& directory);

}  // namespace striker::sil
