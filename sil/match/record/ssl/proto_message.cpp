// SPDX-License-Identifier: Apache-2.0
#include "sil/match/record/ssl/proto_message.hpp"

#include <bit>
#include <cstddef>

namespace striker::sil {

void ProtoMessage::number(int field, std::uint64_t value) {
  tag(field, Wire::varint);
  varint(value);
}

void ProtoMessage::zigzag(int field, std::int64_t value) {
  const auto sign = static_cast<std::uint64_t>(value >> 63);
  number(field, (static_cast<std::uint64_t>(value) << 1U) ^ sign);
}

void ProtoMessage::real(int field, float value) {
  tag(field, Wire::fixed32);
  little_endian(std::bit_cast<std::uint32_t>(value));
}

void ProtoMessage::real(int field, double value) {
  tag(field, Wire::fixed64);
  little_endian(std::bit_cast<std::uint64_t>(value));
}

void ProtoMessage::text(int field, std::string_view value) {
  tag(field, Wire::bytes);
  varint(value.size());
  bytes_ += value;
}

void ProtoMessage::tag(int field, Wire wire) {
  varint((static_cast<std::uint64_t>(field) << 3U) | static_cast<std::uint64_t>(wire));
}

void ProtoMessage::varint(std::uint64_t value) {
  for (; value >= 0x80U; value >>= 7U) {
    bytes_.push_back(static_cast<char>((value & 0x7FU) | 0x80U));
  }
  bytes_.push_back(static_cast<char>(value));
}

template <class T>
void ProtoMessage::little_endian(T bits) {
  for (std::size_t byte = 0; byte < sizeof bits; ++byte) {
    bytes_.push_back(static_cast<char>((bits >> (8U * byte)) & 0xFFU));
  }
}

}  // namespace striker::sil
