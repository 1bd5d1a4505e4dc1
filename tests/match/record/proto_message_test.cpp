// SPDX-License-Identifier: Apache-2.0
// Against the examples of protobuf's own description of its encoding.
#include "sil/match/record/ssl/proto_message.hpp"

#include <gtest/gtest.h>

namespace striker::sil {
namespace {

TEST(ProtoMessage, NumbersAreVarints) {
  ProtoMessage message;
  message.number(1, 150);
  EXPECT_EQ(message.bytes(), "\x08\x96\x01");
}

TEST(ProtoMessage, TextIsItsSizeAndItself) {
  ProtoMessage message;
  message.text(2, "testing");
  EXPECT_EQ(message.bytes(), "\x12\x07testing");
}

TEST(ProtoMessage, AMessageIsText) {
  ProtoMessage inner;
  inner.number(1, 150);
  ProtoMessage message;
  message.message(3, inner);
  EXPECT_EQ(message.bytes(), "\x1a\x03\x08\x96\x01");
}

TEST(ProtoMessage, ZigzagKeepsSmallNegativesSmall) {
  for (const auto& [value, byte] : {std::pair{0, 0}, std::pair{-1, 1}, std::pair{1, 2}, std::pair{-2, 3}}) {
    ProtoMessage message;
    message.zigzag(1, value);
    EXPECT_EQ(message.bytes(), (std::string{'\x08', static_cast<char>(byte)})) << value;
  }
}

TEST(ProtoMessage, RealsAreLittleEndian) {
  ProtoMessage message;
  message.real(1, 1.0F);
  message.real(16, -2.0);
  using namespace std::string_literals;
  EXPECT_EQ(message.bytes(), "\x0d\x00\x00\x80\x3f\x81\x01\x00\x00\x00\x00\x00\x00\x00\xc0"s);
}

}  // namespace
}  // namespace striker::sil
