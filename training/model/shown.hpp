// SPDX-License-Identifier: Apache-2.0
// Text from a file as a message shows it: on one line, in UTF-8, without control characters, and not longer than one reads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace striker::training {

// Of the character that a text which is not empty begins with: its bytes in UTF-8, or 0 if it is a control character (ASCII's,
// or one of U+0080 to U+009F, which terminals obey too) or no UTF-8. Source: RFC 3629.
[[nodiscard]] inline std::size_t shown_bytes(std::string_view text) {
  constexpr std::array<std::uint32_t, 5> least = {0, 0x20, 0xA0, 0x800, 0x10000};
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t bytes = lead < 0x80 ? 1 : lead < 0xC0 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (bytes == 0 || bytes > text.size()) {
    return 0;
  }
  std::uint32_t code = bytes == 1 ? lead : lead & (0x7FU >> bytes);
  for (const char next : text.substr(1, bytes - 1)) {
    const auto octet = static_cast<unsigned char>(next);
    if (octet < 0x80 || octet > 0xBF) {
      return 0;
    }
    code = code << 6U | (octet & 0x3FU);
  }
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[bytes] || code > 0x10FFFF || code == 0x7F || is_surrogate ? 0 : bytes;
}

// What is no character to show becomes '?'.
[[nodiscard]] inline std::string shown(std::string_view text, std::size_t most = 300) {
  std::string line;
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    const std::string_view letter = bytes == 0 ? "?" : text.substr(0, bytes);
    if (line.size() + letter.size() > most) {
      return line + "...";
    }
    line += letter;
    text.remove_prefix(bytes == 0 ? 1 : bytes);
  }
  return line;
}

}  // namespace striker::training
