// SPDX-License-Identifier: Apache-2.0
// Text from a file as a message shows it: on one line, without control characters, and not longer than one reads.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace striker::training {

[[nodiscard]] inline std::string shown(std::string_view text, std::size_t most = 300) {
  std::string line(text.substr(0, most));
  for (char& letter : line) {
    const auto code = static_cast<unsigned char>(letter);
    letter = code < 0x20 || code == 0x7F ? '?' : letter;
  }
  return text.size() > most ? line + "..." : line;
}

}  // namespace striker::training
