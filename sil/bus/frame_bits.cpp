// SPDX-License-Identifier: Apache-2.0
#include "sil/bus/frame_bits.hpp"

#include <algorithm>

namespace striker::sil {

namespace {

// Takes a frame's bits in their order: feeds the CRC, and counts them with the stuff bits between them.
class BitCounter {
 public:
  void put(std::uint32_t value, int bits) {
    for (int bit = bits - 1; bit >= 0; --bit) {
      put((value >> static_cast<unsigned>(bit) & 1U) != 0);
    }
  }
  void put_crc() { put(crc_, 15); }
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  void put(bool bit) {
    // ISO 11898-1, 10.4.2.6.
    constexpr std::uint32_t polynomial = 0x4599;
    const bool next = bit != ((crc_ & 0x4000U) != 0);
    crc_ = (crc_ << 1U & 0x7FFFU) ^ (next ? polynomial : 0U);
    send(bit);
  }

  void send(bool bit) {
    run_ = count_ != 0 && bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    ++count_;
    if (run_ == 5) {
      last_ = !bit;
      run_ = 1;
      ++count_;
    }
  }

  std::uint32_t crc_ = 0;
  std::int64_t count_ = 0;
  bool last_ = false;
  int run_ = 0;
};

}  // namespace

std::int64_t frame_bits(const can::Frame& frame) {
  BitCounter bits;
  bits.put(0, 1);
  bits.put(frame.id, 11);
  bits.put(0, 3);
  bits.put(frame.length, 4);
  for (std::size_t byte = 0; byte < std::min<std::size_t>(frame.length, frame.data.size()); ++byte) {
    bits.put(frame.data[byte], 8);
  }
  bits.put_crc();
  return bits.count() + 13;
}

}  // namespace striker::sil
