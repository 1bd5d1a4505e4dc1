// SPDX-License-Identifier: Apache-2.0
// A frame's bits, against a second implementation by text: CRC by polynomial division, stuffing by search.
#include "sil/bus/frame_bits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <string>

#include "sil/world/random.hpp"

namespace striker::sil {
namespace {

std::string binary(unsigned value, std::size_t bits) {
  return std::bitset<32>(value).to_string().substr(32 - bits);
}

// The remainder of text * x^15 by x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1.
std::string crc15(std::string text) {
  const std::string divisor = "1100010110011001";
  text += std::string(15, '0');
  for (std::size_t i = 0; i + divisor.size() <= text.size(); ++i) {
    if (text[i] == '1') {
      for (std::size_t k = 0; k < divisor.size(); ++k) {
        text[i + k] = text[i + k] == divisor[k] ? '0' : '1';
      }
    }
  }
  return text.substr(text.size() - 15);
}

std::string unstuffed(const can::Frame& frame) {
  std::string text = binary(frame.id, 12) + binary(frame.length, 7);
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    text += binary(frame.data[byte], 8);
  }
  return text + crc15(text);
}

std::string stuffed(std::string text) {
  for (std::size_t end = 5; end <= text.size(); ++end) {
    const std::string last = text.substr(end - 5, 5);
    if (last == "00000" || last == "11111") {
      text.insert(end, 1, last[0] == '0' ? '1' : '0');
    }
  }
  return text;
}

can::Frame random_frame(Random& random) {
  can::Frame frame;
  frame.id = static_cast<std::uint16_t>(random.below(2048));
  frame.length = static_cast<std::uint8_t>(random.below(9));
  const double runs = random.uniform();
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    const double kind = random.uniform();
    frame.data[byte] = kind > runs  ? static_cast<std::uint8_t>(random.below(256))
                       : kind < 0.3 ? std::uint8_t{0x0F}
                       : kind < 0.6 ? std::uint8_t{0x87}
                       : kind < 0.8 ? std::uint8_t{0x00}
                                    : std::uint8_t{0x3C};
  }
  return frame;
}

TEST(FrameBits, TheSecondImplementationHasTheKnownCheckValue) {
  std::string text;
  for (const char digit : {'1', '2', '3', '4', '5', '6', '7', '8', '9'}) {
    text += binary(static_cast<unsigned>(digit), 8);
  }
  EXPECT_EQ(crc15(text), binary(0x059E, 15));
}

TEST(FrameBits, AgreesWithTheSecondImplementationAndStaysWithinTheBound) {
  Random random(15, 0, 0);
  std::int64_t least_slack = 1000;
  for (int i = 0; i < 50'000; ++i) {
    const can::Frame frame = random_frame(random);
    const std::int64_t bits = frame_bits(frame);
    ASSERT_EQ(bits, static_cast<std::int64_t>(stuffed(unstuffed(frame)).size()) + 13);
    ASSERT_GE(bits, 47 + 8 * frame.length);
    ASSERT_LE(bits, worst_case_frame_bits(frame.length));
    least_slack = std::min(least_slack, worst_case_frame_bits(frame.length) - bits);
  }
  EXPECT_LE(least_slack, 4);
}

// ---- the other formats ---------------------------------------------------------------------------------

constexpr std::array<std::int64_t, 16> lengths = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};

// Up to FDF; then what may go at the second bit rate.
struct WireText {
  std::string arbitration;
  std::string data;
};

WireText fd_text(Random& random, bool extended, std::size_t code, double runs) {
  const auto bits = [&](std::int64_t count) {
    std::string text;
    while (static_cast<std::int64_t>(text.size()) < count) {
      text += random.uniform() < runs ? (text.size() / 4 % 2 == 0 ? "1111" : "0000")
                                      : std::string(1, random.below(2) == 0 ? '0' : '1');
    }
    return text.substr(0, static_cast<std::size_t>(count));
  };
  std::string head = "0";
  head += bits(11);
  head += extended ? "11" : "";
  head += extended ? bits(18) + "0" : "00";
  std::string data = "01";  // res and BRS
  data += bits(1);
  data += binary(static_cast<unsigned>(code), 4);
  return {head + "1", data + bits(8 * lengths[code])};
}

// Stuffing by search. After the last bit before the CRC field there is none: a fixed one follows.
FrameBits fd_bits(const WireText& text, std::int64_t length) {
  const auto head = static_cast<std::int64_t>(stuffed(text.arbitration).size());
  const std::string all =
      stuffed(text.arbitration + text.data.substr(0, text.data.size() - 1)) + text.data.back();
  // res and BRS go at the bus's rate.
  constexpr std::int64_t rest = 1 + 1 + 7 + 3;
  const std::int64_t crc_bits = length > 16 ? 21 : 17;
  const std::int64_t crc_field = 4 + crc_bits + (4 + crc_bits + 3) / 4;
  return {.arbitration = head + 2 + rest,
          .data = static_cast<std::int64_t>(all.size()) - head - 2 + crc_field + 1};
}

TEST(FrameBits, NoFdFrameIsBeyondItsBound) {
  Random random(17, 0, 0);
  for (const bool extended : {false, true}) {
    FrameBits slack{1000, 1000};
    for (int i = 0; i < 50'000; ++i) {
      const auto code = static_cast<std::size_t>(random.below(16));
      const WireText text = fd_text(random, extended, code, random.uniform());
      const FrameBits bits = fd_bits(text, lengths[code]);
      const FrameBits bound = worst_case_frame_bits(lengths[code], {.extended = extended, .fd = true});
      ASSERT_LE(bits.arbitration, bound.arbitration) << text.arbitration;
      ASSERT_LE(bits.data, bound.data) << text.data;
      slack.arbitration = std::min(slack.arbitration, bound.arbitration - bits.arbitration);
      slack.data = std::min(slack.data, bound.data - bits.data);
    }
    EXPECT_EQ(slack.arbitration, 0);
    EXPECT_LE(slack.data, 1);
  }
}

TEST(FrameBits, NoExtendedFrameIsBeyondItsBound) {
  Random random(29, 0, 0);
  std::int64_t least_slack = 1000;
  for (int i = 0; i < 50'000; ++i) {
    const auto length = static_cast<std::size_t>(random.below(9));
    const WireText text = fd_text(random, true, length, random.uniform());
    const std::string plain =
        text.arbitration.substr(0, 33) + "00" + text.data.substr(3);  // RTR, r1 and r0 are 0
    const auto bits = static_cast<std::int64_t>(stuffed(plain + crc15(plain)).size()) + 13;
    const FrameBits bound = worst_case_frame_bits(lengths[length], {.extended = true});
    ASSERT_EQ(bound.data, 0);
    ASSERT_LE(bits, bound.arbitration);
    least_slack = std::min(least_slack, bound.arbitration - bits);
  }
  EXPECT_LE(least_slack, 4);
}

TEST(FrameBits, AnFdLengthIsOneThatADlcCanSay) {
  for (std::int64_t bytes = 0; bytes <= 64; ++bytes) {
    EXPECT_EQ(fd_length(bytes),
              *std::find_if(lengths.begin(), lengths.end(), [&](auto length) { return length >= bytes; }));
  }
}

// SOF, the identifier and what the standard puts between its parts, as text: the first difference decides, 0 wins.
TEST(FrameBits, TheRankIsWhatTheArbitrationDecides) {
  struct Identifier {
    std::uint32_t id;
    bool extended;
  };
  Random random(3, 0, 0);
  const auto draw = [&](std::uint32_t base) -> Identifier {
    const bool extended = random.below(2) == 0;
    const auto more = static_cast<std::uint32_t>(random.below(4) == 0 ? 0 : random.below(1U << 18U));
    return {extended ? base << 18U | more : base, extended};
  };
  const auto field = [](const Identifier& of) {
    return of.extended ? binary(of.id >> 18U, 11) + "11" + binary(of.id & 0x3FFFFU, 18) + "0"
                       : binary(of.id, 11) + "00";
  };
  for (int i = 0; i < 20'000; ++i) {
    const auto base = static_cast<std::uint32_t>(random.below(2048));
    const Identifier one = draw(base);
    const Identifier other =
        draw(random.below(2) == 0 ? base : static_cast<std::uint32_t>(random.below(2048)));
    ASSERT_EQ(field(one) < field(other),
              arbitration_rank(one.id, one.extended) < arbitration_rank(other.id, other.extended))
        << field(one) << " " << field(other);
  }
}

TEST(FrameBits, KnownBounds) {
  EXPECT_EQ(worst_case_frame_bits(8, {.extended = true}).arbitration, 160);
  EXPECT_EQ(worst_case_frame_bits(8, {}).arbitration, 135);

  EXPECT_EQ(worst_case_frame_bits(0), 55);
  EXPECT_EQ(worst_case_frame_bits(7), 125);
  EXPECT_EQ(worst_case_frame_bits(8), 135);
}

}  // namespace
}  // namespace striker::sil
