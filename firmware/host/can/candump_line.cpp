// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/can/candump_line.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>

namespace striker::host {

namespace {

constexpr std::uint32_t error_flag = 0x20000000;  // linux/can.h, CAN_ERR_FLAG: an error frame's identifier
constexpr std::size_t longest_fd_data = 64;

// What stands before `end`; that and `end` are taken off `text`.
std::optional<std::string_view> take_until(std::string_view& text, std::string_view end) {
  const std::size_t at = text.find(end);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at + end.size());
  return taken;
}

template <class Number>
std::optional<Number> number(std::string_view digits, int base) {
  Number value{};
  const char* const end = digits.data() + digits.size();
  const auto [stopped, error] = std::from_chars(digits.data(), end, value, base);
  return error == std::errc() && stopped == end ? std::optional(value) : std::nullopt;
}

// "0000000012.345000", 6 digits behind the point.
std::optional<std::int64_t> stamp_us(std::string_view text) {
  const auto whole = take_until(text, ".");
  const auto seconds = whole ? number<std::uint32_t>(*whole, 10) : std::nullopt;
  const auto micros = text.size() == 6 ? number<std::uint32_t>(text, 10) : std::nullopt;
  return seconds && micros ? std::optional(std::int64_t{*seconds} * 1'000'000 + *micros) : std::nullopt;
}

bool is_data(std::string_view digits, std::size_t most_bytes) {
  return digits.size() % 2 == 0 && digits.size() <= 2 * most_bytes &&
         std::all_of(digits.begin(), digits.end(), [](char letter) {
           return (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'F') ||
                  (letter >= 'a' && letter <= 'f');
         });
}

std::optional<LoggedKind> kind_of(std::string_view identifier, std::uint32_t id, std::string_view data) {
  if (data.starts_with('#')) {
    return data.size() >= 2 && is_data(data.substr(2), longest_fd_data) ? std::optional(LoggedKind::fd)
                                                                        : std::nullopt;
  }
  if (data.starts_with('R')) {
    return data.size() <= 2 ? std::optional(LoggedKind::remote) : std::nullopt;
  }
  if (!is_data(data, can::Frame{}.data.size())) {
    return std::nullopt;
  }
  if (identifier.size() == 8) {
    return (id & error_flag) != 0 ? LoggedKind::error : LoggedKind::extended;
  }
  return LoggedKind::data;
}

can::Frame frame_of(std::uint32_t id, std::string_view data) {
  can::Frame frame{.id = static_cast<std::uint16_t>(id),
                   .length = static_cast<std::uint8_t>(data.size() / 2)};
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    frame.data[byte] = number<std::uint8_t>(data.substr(2 * byte, 2), 16).value_or(0);
  }
  return frame;
}

}  // namespace

std::variant<CandumpLine, const char*> parse_candump_line(std::string_view line) {
  if (!line.starts_with('(')) {
    return "a stamp in brackets is missing";
  }
  line.remove_prefix(1);
  const auto stamp_text = take_until(line, ") ");
  const auto stamp = stamp_text ? stamp_us(*stamp_text) : std::nullopt;
  if (!stamp) {
    return "the stamp is no time as (seconds.microseconds)";
  }
  const auto interface = take_until(line, " ");
  if (!interface || interface->empty()) {
    return "an interface and a frame are missing";
  }
  if (line.ends_with(" R") || line.ends_with(" T")) {
    line.remove_suffix(2);
  }
  const auto identifier = take_until(line, "#");
  const auto id = identifier && (identifier->size() == 3 || identifier->size() == 8)
                      ? number<std::uint32_t>(*identifier, 16)
                      : std::nullopt;
  if (!id || (identifier->size() == 3 && *id > 0x7FF)) {
    return "the frame has no identifier of 3 or 8 hexadecimal digits before a '#'";
  }
  const auto kind = kind_of(*identifier, *id, line);
  if (!kind) {
    return "the frame's data are no pairs of hexadecimal digits, 8 at most";
  }
  return CandumpLine{.stamp_us = *stamp,
                     .interface = *interface,
                     .kind = *kind,
                     .frame = *kind == LoggedKind::data ? frame_of(*id, line) : can::Frame{}};
}

}  // namespace striker::host
