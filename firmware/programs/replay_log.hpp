// SPDX-License-Identifier: Apache-2.0
// A recorded run in lockstep, repeated by the built-in controller without a bus.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "firmware/host/can/lockstep_log.hpp"

namespace striker {

// `seed` has to be the recorded run's (core/supervision/consent.hpp): with another, a recorded operator arms nothing.
// Throws as host::LockstepLog.
[[nodiscard]] host::ReplayReport replay_log(const std::filesystem::path& file, const std::string& interface,
                                            std::uint32_t seed, const std::function<bool()>& stop);

}  // namespace striker
