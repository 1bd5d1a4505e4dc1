// SPDX-License-Identifier: Apache-2.0
#include "sil/budget/dbc_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "sil/budget/dbc_file.hpp"
#include "sil/budget/dbc_scanner.hpp"

namespace striker::sil {

namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20U;

// VFrameFormat by its index, where the file gives no names.
constexpr std::array<std::string_view, 16> frame_formats = {
    "StandardCAN",    "ExtendedCAN",   "", "J1939PG", "", "", "", "", "", "", "", "", "", "",
    "StandardCAN_FD", "ExtendedCAN_FD"};

constexpr std::uint32_t greatest_standard_id = 0x7FF;
constexpr std::uint32_t greatest_extended_id = 0x1FFFFFFF;

bool contains_any(std::string_view text, std::initializer_list<std::string_view> words) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

template <class Number, class... Format>
std::optional<Number> number_in(std::string_view text, Format... format) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, format...);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

std::int64_t first_but_zero_ns(std::initializer_list<double> times_ms) {
  for (const double time_ms : times_ms) {
    if (time_ms != 0.0) {
      return std::llround(time_ms * static_cast<double>(ns_per_ms));
    }
  }
  return 0;
}

// What a DBC says of a message's traffic, in ms; 0: nothing.
struct Traffic {
  double period_ms = 0.0;
  double distance_ms = 0.0;
  double deadline_ms = 0.0;
  double burst = 0.0;
};

// One message of a file, and what its attributes mean.
class MessageReading {
 public:
  MessageReading(const DbcFile& file, std::uint32_t id, const DbcMessage& message, const DbcOptions& options)
      : file_(file), id_(id), message_(message), options_(options) {}

  // Nothing if it belongs in no budget.
  [[nodiscard]] std::optional<BusMessage> bus_message() const {
    if (number(dbc_attribute::awaited) != 0.0) {
      return std::nullopt;
    }
    require_identifier();
    const Traffic traffic{.period_ms = period_ms(),
                          .distance_ms = distance_ms(),
                          .deadline_ms = number(dbc_attribute::deadline),
                          .burst = number(dbc_attribute::burst)};
    require_in_range(traffic);
    const auto fallback_ms = static_cast<double>(options_.default_distance_ms);
    const auto [period_ms, distance_ms, deadline_ms, burst] = traffic;
    const std::int64_t distance_ns = first_but_zero_ns({distance_ms, period_ms, fallback_ms});
    const bool has_burst = burst > 1.0;
    return BusMessage{
        .name = message_.name,
        .sender = message_.sender,
        .id = id_ & ~extended_identifier_bit,
        .bytes = message_.bytes,
        .period_ns = has_burst ? first_but_zero_ns({period_ms, distance_ms, fallback_ms}) : distance_ns,
        .distance_ns = distance_ns,
        .burst = std::max<std::int64_t>(1, std::llround(burst)),
        .deadline_ns = first_but_zero_ns({deadline_ms, period_ms, distance_ms, fallback_ms}),
        .format = format(),
        .events_uncounted = names_events() && period_ms != 0.0 && distance_ms == 0.0 && !has_burst};
  }

 private:
  struct Said {
    std::string text;
    bool own = false;
    int line = 0;
  };

  [[noreturn]] void fail(int line, const std::string& what) const {
    fail_dbc(file_.name, line, fmt::format("message {}: {}", shown(message_.name), what));
  }
  [[noreturn]] void fail(const std::string& what) const { fail(message_.line, what); }
  [[nodiscard]] std::optional<Said> said(std::string_view attribute) const {
    if (const auto values = file_.values.find(id_); values != file_.values.end()) {
      if (const auto own = values->second.find(attribute); own != values->second.end()) {
        return meaning(attribute, own->second, true);
      }
    }
    const bool is_others =
        file_.defined_elsewhere.contains(attribute) && !file_.definitions.contains(attribute);
    const auto absent = file_.defaults.find(attribute);
    return absent == file_.defaults.end() || is_others || absent->second.text.empty()
               ? std::nullopt
               : std::optional(meaning(attribute, absent->second, false));
  }

  // Of an ENUM the text that an index stands for.
  [[nodiscard]] Said meaning(std::string_view attribute, const DbcValue& value, bool own) const {
    const auto definition = file_.definitions.find(attribute);
    if (definition == file_.definitions.end() || definition->second.type != DbcDefinition::Type::choice) {
      return {value.text, own, value.line};
    }
    const auto& choices = definition->second.choices;
    const auto index = number_in<std::size_t>(value.text);
    if (!value.is_text && index && *index < choices.size()) {
      return {choices[*index], own, value.line};
    }
    if (!value.is_text || std::find(choices.begin(), choices.end(), value.text) == choices.end()) {
      fail(
          value.line,
          fmt::format("{} '{}' is none of the {} values that BA_DEF_ gives it: give one, or its index from 0",
                      attribute, shown(value.text), choices.size()));
    }
    return {value.text, own, value.line};
  }

  [[nodiscard]] double number_of(std::string_view attribute, const Said& said) const {
    const auto definition = file_.definitions.find(attribute);
    const bool is_hex = definition != file_.definitions.end() &&
                        definition->second.type == DbcDefinition::Type::hex &&
                        (said.text.starts_with("0x") || said.text.starts_with("0X"));
    const std::size_t prefix = is_hex ? 2 : said.text.starts_with('+') ? 1 : 0;
    const std::string_view digits = std::string_view(said.text).substr(prefix);
    const auto format = is_hex ? std::chars_format::hex : std::chars_format::general;
    const auto value = number_in<double>(digits, format);
    if (!value || !std::isfinite(*value)) {
      fail(said.line, fmt::format("{} '{}' is no number: give one", attribute, shown(said.text)));
    }
    return *value;
  }

  [[nodiscard]] double number(std::string_view attribute) const {
    const auto given = said(attribute);
    return given ? number_of(attribute, *given) : 0.0;
  }

  [[nodiscard]] std::optional<Said> send_type() const {
    auto type = said(dbc_attribute::send_type);
    if (type && number_in<double>(type->text)) {
      fail(type->line, fmt::format("nothing says what GenMsgSendType {} is: define it, as BA_DEF_ BO_ "
                                   "\"GenMsgSendType\" ENUM \"Cyclic\",\"OnEvent\";",
                                   shown(type->text)));
    }
    return type;
  }

  [[nodiscard]] bool names_cycle() const {
    const auto type = send_type();
    return !type || (contains_any(type->text, {"cycl", "period"}) &&
                     !contains_any(type->text, {"acycl", "aperiod", "noncycl", "nonperiod"}));
  }

  [[nodiscard]] bool names_events() const {
    const auto type = send_type();
    return type && contains_any(type->text, {"event", "spontan", "change", "write", "trigger"});
  }

  [[nodiscard]] double period_ms() const {
    const auto cycle = said(dbc_attribute::cycle_time);
    return cycle && (cycle->own || names_cycle()) ? number_of(dbc_attribute::cycle_time, *cycle) : 0.0;
  }

  [[nodiscard]] double distance_ms() const {
    const auto delay = said(dbc_attribute::delay_time);
    return delay && (delay->own || !send_type() || names_events())
               ? number_of(dbc_attribute::delay_time, *delay)
               : 0.0;
  }

  // "": the file does not say.
  [[nodiscard]] std::string named_format() const {
    const auto named = said(dbc_attribute::frame_format);
    if (!named) {
      return "";
    }
    const auto index = number_in<std::size_t>(named->text);
    std::string name(index && *index < frame_formats.size() ? frame_formats[*index] : named->text);
    if (!contains_any(name, {"fd"}) && name != "StandardCAN" && name != "ExtendedCAN" && name != "J1939PG") {
      fail(named->line,
           fmt::format("VFrameFormat '{}' is unknown: give StandardCAN, ExtendedCAN, StandardCAN_FD, "
                       "ExtendedCAN_FD or J1939PG",
                       shown(named->text)));
    }
    return name;
  }

  [[nodiscard]] FrameFormat format() const {
    const std::string named = named_format();
    FrameFormat format{.extended = (id_ & extended_identifier_bit) != 0,
                       .fd = contains_any(named, {"fd"}) || message_.bytes > 8};
    if (format.fd && named == "J1939PG") {
      fail(
          "a J1939 message of more than 8 bytes goes in several frames: give those (TP.CM, TP.DT) in its place");
    }
    if (message_.bytes < 0 || message_.bytes > 64) {
      fail(fmt::format("a frame has 0 to 64 bytes, not {}: give the frames that carry it", message_.bytes));
    }
    const auto switches = said(dbc_attribute::bit_rate_switch);
    format.bit_rate_switch =
        format.fd && (!switches || number_of(dbc_attribute::bit_rate_switch, *switches) != 0.0);
    if (format.bit_rate_switch && !options_.has_data_bitrate) {
      fail("CAN FD with a second bit rate: give --data-bitrate, or CANFD_BRS 0");
    }
    return format;
  }

  void require_identifier() const {
    const bool is_extended = (id_ & extended_identifier_bit) != 0;
    if (!is_extended && id_ > greatest_standard_id) {
      fail(fmt::format("identifier {} has more than 11 bits: one of 29 bits has bit 31 set (add 2147483648)",
                       id_));
    }
    if (is_extended && (id_ & ~extended_identifier_bit) > greatest_extended_id) {
      fail(fmt::format("identifier {} has more than 29 bits below bit 31: correct it", id_));
    }
  }

  void require_in_range(const Traffic& traffic) const {
    const auto [period_ms, distance_ms, deadline_ms, burst] = traffic;
    if (period_ms == 0.0 && distance_ms == 0.0 && options_.default_distance_ms == 0) {
      const auto type = send_type();
      fail(!names_cycle()
               ? fmt::format("GenMsgSendType '{}' has no cycle, and it has no GenMsgDelayTime: give one, or "
                             "--default-distance-ms",
                             shown(type->text))
               : "neither GenMsgCycleTime nor GenMsgDelayTime: give one, or --default-distance-ms");
    }
    for (const double time_ms : {period_ms, distance_ms, deadline_ms}) {
      if (time_ms != 0.0 && (time_ms < 0.001 || time_ms > 1e7)) {
        fail(fmt::format("times go from 0.001 to 10,000,000 ms, not {}: correct it", time_ms));
      }
    }
    if (burst < 0.0 || burst > 1e3 || burst != std::floor(burst)) {
      fail(fmt::format("Burst goes from 1 to 1000, not {}: correct it", burst));
    }
    if (period_ms > 0.0 && distance_ms > period_ms) {
      fail(fmt::format("GenMsgDelayTime {} goes up to GenMsgCycleTime {}: correct one", distance_ms,
                       period_ms));
    }
  }

  const DbcFile& file_;
  std::uint32_t id_;
  const DbcMessage& message_;
  const DbcOptions& options_;
};

// A value for a message that is not there says that the file lacks one.
void require_messages_of_values(const DbcFile& file) {
  for (const auto& [id, values] : file.values) {
    if (!file.messages.contains(id)) {
      const auto& [attribute, value] = *values.begin();
      fail_dbc(file.name, value.line,
               fmt::format("{} of message {}, which is not there: give its BO_, or remove the value",
                           attribute, id));
    }
  }
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code none;
  if (!stream || std::filesystem::is_directory(file, none)) {
    const char* why = stream ? "it is a directory" : std::strerror(errno);
    throw std::runtime_error(fmt::format("{}: cannot be read ({}): name a DBC file", file.string(), why));
  }
  std::string text;
  std::array<char, 65'536> part{};
  while (stream.read(part.data(), part.size()) || stream.gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most_bytes) {
      throw std::runtime_error(
          fmt::format("{}: more than {} MiB: name a DBC file", file.string(), most_bytes >> 20U));
    }
  }
  return text;
}

}  // namespace

std::vector<BusMessage> read_dbc(std::string_view text, const std::string& name, const DbcOptions& options) {
  const DbcFile file = parse_dbc(text, name);
  require_messages_of_values(file);
  std::vector<BusMessage> messages;
  for (const auto& [id, message] : file.messages) {
    if (const auto read = MessageReading(file, id, message, options).bus_message()) {
      messages.push_back(*read);
    }
  }
  std::sort(messages.begin(), messages.end(), [](const BusMessage& a, const BusMessage& b) {
    return arbitration_rank(a.id, a.format.extended) < arbitration_rank(b.id, b.format.extended);
  });
  return messages;
}

std::vector<BusMessage> read_dbc(const std::filesystem::path& file, const DbcOptions& options) {
  return read_dbc(read_text(file), file.string(), options);
}

}  // namespace striker::sil
