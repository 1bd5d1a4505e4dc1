// SPDX-License-Identifier: Apache-2.0
// Every message's receive checks, on arbitrary frames and on frames whose checksum was made right.
#include "firmware/can/codec.hpp"

#include <bit>

#include "tests/fuzz/support/any_frame.hpp"

namespace striker::fuzz {
namespace {

template <class Message>
can::Verdict take(const can::Frame& frame, Message& message) {
  if constexpr (can::layout<Message>.info.data_ids == can::unprotected) {
    return can::unpack(frame, message);
  } else {
    return can::receive(frame, message);
  }
}

template <class Message>
bool is_within_its_ranges(const Message& message) {
  bool within = true;
  for (const auto& signal : can::layout<Message>.signals) {
    within = within && message.*signal.field >= signal.minimum && message.*signal.field <= signal.maximum;
  }
  return within;
}

template <class Message>
bool same(const Message& one, const Message& other) {
  bool equal = true;
  for (const auto& signal : can::layout<Message>.signals) {
    equal = equal && one.*signal.field == other.*signal.field;
  }
  return equal;
}

template <class Message>
void check(const can::Frame& frame) {
  Message message;
  const Message before = message;
  if (take(frame, message) != can::Verdict::accepted) {
    require(same(message, before), "a refused frame changes no field");
    return;
  }
  require(frame.length == can::layout<Message>.info.length, "an accepted frame has its message's length");
  require(is_within_its_ranges(message), "an accepted message is within its ranges");
  Message again;
  require(can::unpack(can::pack(message), again) == can::Verdict::accepted && same(message, again),
          "what is packed unpacks to the same");
}

template <class... Message>
void check_all(const can::Frame& frame, const std::tuple<Message...>*) {
  (check<Message>(frame), ...);
}

// One to three flipped bits of a protected frame are always found (firmware/can/e2e.hpp).
void check_flips(const can::Frame& correct, Bytes& bytes) {
  std::uint64_t mask = 0;
  for (int flips = 0; flips < 3; ++flips) {
    mask |= std::uint64_t{1} << (bytes.u8() % (8U * correct.length));
  }
  can::Frame broken = correct;
  broken.data = std::bit_cast<std::array<std::uint8_t, 8>>(std::bit_cast<std::uint64_t>(correct.data) ^ mask);
  can::for_each_layout([&](const auto& message) {
    if (message.info.data_ids == can::unprotected || message.info.length != correct.length) {
      return;
    }
    if (message.info.id == correct.id) {
      require(broken.data[0] != can::protection_crc(broken, message.info.data_ids), "flipped bits are found");
    } else {
      require(correct.data[0] != can::protection_crc(correct, message.info.data_ids),
              "a frame under another message's identifier is found");
    }
  });
}

bool is_protected(const can::Frame& frame) {
  bool found = false;
  can::for_each_layout([&](const auto& message) {
    found = found || (message.info.id == frame.id && message.info.data_ids != can::unprotected);
  });
  return found;
}

}  // namespace
}  // namespace striker::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  fuzz::Bytes bytes(data, size);
  while (!bytes.done()) {
    const bool forge = bytes.u8() % 2 != 0;
    const can::Frame frame = forge ? fuzz::forged_frame(bytes) : fuzz::raw_frame(bytes);
    fuzz::check_all(frame, static_cast<const can::Messages*>(nullptr));
    if (forge && fuzz::is_protected(frame)) {
      fuzz::check_flips(frame, bytes);
    }
  }
  return 0;
}
