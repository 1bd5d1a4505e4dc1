// SPDX-License-Identifier: Apache-2.0
// Encodes a protobuf message, field by field: as much of the wire format as SSL messages take. The numbers are those of
// sil/match/record/proto; a test has protoc decode everything that is written.
//
//   ProtoMessage vector;
//   vector.real(1, 0.5F);
//   robot.message(2, vector);
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace striker::sil {

class ProtoMessage {
 public:
  void number(int field, std::uint64_t value);  // uint32, uint64, bool, enum, and int32 that is not negative
  void zigzag(int field, std::int64_t value);   // sint64
  void real(int field, float value);
  void real(int field, double value);
  void text(int field, std::string_view value);
  void message(int field, const ProtoMessage& value) { text(field, value.bytes_); }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  enum class Wire : std::uint8_t { varint = 0, fixed64 = 1, bytes = 2, fixed32 = 5 };

  void tag(int field, Wire wire);
  void varint(std::uint64_t value);
  template <class T>
  void little_endian(T bits);

  std::string bytes_;
};

}  // namespace striker::sil
