// SPDX-License-Identifier: Apache-2.0
#include "sil/match/replay/record_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "firmware/host/files.hpp"
#include "sil/match/replay/gzip_reader.hpp"
#include "sil/match/replay/recorded_plan.hpp"

namespace striker::sil {

namespace {

using Json = nlohmann::ordered_json;

// As it can be printed, and no more than fits a line.
std::string excerpt(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string shown;
  for (const char byte : text.substr(0, most)) {
    const bool is_plain = byte >= ' ' && byte <= '~';
    shown += is_plain ? std::string(1, byte) : fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  }
  return text.empty() ? "nothing" : '\'' + shown + '\'';
}

// From the byte on that differs, up to the end of its line; an end of line is a byte too.
std::string_view rest_of_line(std::string_view text, std::size_t from) {
  const std::string_view rest = text.substr(from);
  return rest.substr(0, std::max<std::size_t>(1, std::min(rest.find('\n'), rest.size())));
}

std::optional<std::string> first_other_byte(std::string_view recorded, std::string_view now) {
  const auto [here, there] = std::ranges::mismatch(recorded, now);
  if (here == recorded.end() && there == now.end()) {
    return std::nullopt;
  }
  const auto at = static_cast<std::size_t>(here - recorded.begin());
  const std::string_view same = recorded.substr(0, at);
  const std::size_t line_begin = same.rfind('\n') + 1;
  return fmt::format("line {}, column {}: recorded {}, now {}", std::ranges::count(same, '\n') + 1,
                     at - line_begin + 1, excerpt(rest_of_line(recorded, at)),
                     excerpt(rest_of_line(now, at)));
}

Json with_build_of(Json now, const Json& recorded) {
  for (const std::string_view key : keys_of_build) {
    if (recorded.contains(key)) {
      now[std::string(key)] = recorded.at(std::string(key));
    }
  }
  return now;
}

// What a record should be: as it is now, with the build that the match was recorded by.
class Comparison {
 public:
  Comparison(const std::filesystem::path& recorded, const std::filesystem::path& now)
      : recorded_(recorded),
        now_(now),
        match_(Json::parse(host::read_file(recorded / "match.json"))),
        match_now_(Json::parse(host::read_file(now / "match.json"))) {}

  [[nodiscard]] std::optional<std::string> match_json() const {
    if (auto other = first_other_value(recorded_ / "match.json", match_now_)) {
      return other;
    }
    return first_other_byte(host::read_file(recorded_ / "match.json"),
                            with_build_of(match_now_, match_).dump(1) + '\n');
  }
  [[nodiscard]] std::optional<std::string> events() const {
    const std::string now = host::read_file(now_ / "events.jsonl");
    const std::size_t head = now.find('\n');
    return first_other_byte(
        host::read_file(recorded_ / "events.jsonl"),
        with_build_of(Json::parse(now.substr(0, head)), match_).dump() + now.substr(head));
  }
  [[nodiscard]] std::optional<std::string> frames() const {
    return first_other_byte(host::read_file(recorded_ / "frames.csv"), host::read_file(now_ / "frames.csv"));
  }
  // Not text: a place in it is a byte of what was compressed.
  [[nodiscard]] std::optional<std::string> game_log() const {
    const std::string recorded = read_gzip_file(recorded_ / "match.log.gz");
    const std::string now = read_gzip_file(now_ / "match.log.gz");
    if (recorded == now) {
      return std::nullopt;
    }
    const auto same = std::ranges::mismatch(recorded, now).in1 - recorded.begin();
    return fmt::format("byte {} of {} is another, or is not there; now {} bytes", same, recorded.size(),
                       now.size());
  }

 private:
  std::filesystem::path recorded_;
  std::filesystem::path now_;
  Json match_;
  Json match_now_;
};

}  // namespace

std::optional<std::string> first_other_record(const std::filesystem::path& recorded,
                                              const std::filesystem::path& now) {
  struct Record {
    const char* file;
    std::optional<std::string> (Comparison::*compare)() const;
  };
  constexpr Record records[] = {{"match.json", &Comparison::match_json},
                                {"events.jsonl", &Comparison::events},
                                {"frames.csv", &Comparison::frames},
                                {"match.log.gz", &Comparison::game_log}};
  const Comparison comparison(recorded, now);
  for (const Record& record : records) {
    if (!std::filesystem::exists(recorded / record.file)) {
      return fmt::format("{}: is not there", record.file);
    }
    try {
      if (const auto other = (comparison.*record.compare)()) {
        return fmt::format("{}: {}", record.file, *other);
      }
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }
  return std::nullopt;
}

}  // namespace striker::sil
