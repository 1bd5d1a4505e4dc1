// SPDX-License-Identifier: Apache-2.0
// The command line of the live view, as kick runs and matches have it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace striker::sil {

struct ViewOptions {
  std::optional<std::uint16_t> port;  // none: no view; 0: any that is free
  std::string bind = "127.0.0.1";
  std::string speed = "1";  // times real time, or "max"
};

// `options` outlives the parsing.
void define_view(CLI::App& command, ViewOptions& options);

// 0: as fast as it goes.
[[nodiscard]] double speed_of(const ViewOptions& options);

}  // namespace striker::sil
