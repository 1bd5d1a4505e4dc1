// SPDX-License-Identifier: Apache-2.0
// Prints frames that the message table packed, with the values that went in, for a foreign decoder to check:
//   MESSAGE IDENTIFIER PAYLOAD signal=raw ...
// Every signal's minimum, maximum and zero with the others at zero, then random values for all.
#include <fmt/core.h>

#include <algorithm>
#include <random>
#include <string>

#include "firmware/can/codec.hpp"

namespace {

using namespace striker::can;

template <class Message>
void print_sample(const Message& message, std::uint8_t counter) {
  constexpr const auto& table = layout<Message>;
  Frame frame = pack(message);
  std::string values;
  if (table.info.data_ids != unprotected) {
    protect(frame, table.info.data_ids, counter);
    values = fmt::format(" crc={} counter={}", frame.data[0], counter);
  }
  std::string payload;
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    payload += fmt::format("{:02X}", frame.data[byte]);
  }
  for (const auto& signal : table.signals) {
    values += fmt::format(" {}={}", signal.name, message.*signal.field);
  }
  fmt::print("{} {} {}{}\n", table.info.name, frame.id, payload, values);
}

template <class Message>
void print_samples(std::mt19937& random) {
  constexpr const auto& table = layout<Message>;
  Message zero;
  for (const auto& signal : table.signals) {
    zero.*signal.field = std::clamp<std::int32_t>(0, signal.minimum, signal.maximum);
  }
  print_sample(zero, 0);
  for (const auto& signal : table.signals) {
    for (const std::int32_t end : {signal.minimum, signal.maximum}) {
      Message message = zero;
      message.*signal.field = end;
      print_sample(message, 15);
    }
  }
  for (int i = 0; i < 100; ++i) {
    Message message;
    for (const auto& signal : table.signals) {
      message.*signal.field =
          std::uniform_int_distribution<std::int32_t>(signal.minimum, signal.maximum)(random);
    }
    print_sample(message, static_cast<std::uint8_t>(i % 16));
  }
}

}  // namespace

int main() {
  std::mt19937 random(1);
  [&]<class... Message>(const std::tuple<Message...>*) {
    (print_samples<Message>(random), ...);
  }(static_cast<const Messages*>(nullptr));
  return 0;
}
