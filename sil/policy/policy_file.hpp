// SPDX-License-Identifier: Apache-2.0
// A policy as a user names it: a header, or a float model, which striker-export makes one of first.
#pragma once

#include <filesystem>

#include "sil/policy/loaded_policy.hpp"

namespace striker::sil {

// A name that ends in .hpp is a header. Anything else is handed to the striker-export beside this program, which plays
// episodes for that (3 to 10 s), as any export does: the header is the same, to the byte, and lies in a temporary
// directory meanwhile. This room knows no training; the header is all that comes from there.
//
// Throws std::runtime_error as read_policy_header, or where striker-export is missing or refuses the model, which it says
// itself on stderr.
[[nodiscard]] LoadedPolicy load_policy(const std::filesystem::path& file);

}  // namespace striker::sil
