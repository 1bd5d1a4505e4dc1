// SPDX-License-Identifier: Apache-2.0
// The last `size` values of a series, the newest first. Nothing moves when one is added: the oldest makes room.
//
//   Recent<double, 3> speeds;       // before the first one: value-initialised ones
//   speeds.add(1.5);
//   speeds.ago(0);                  // 1.5; ago(1) is the one before, ... ago(2)
#pragma once

#include <array>
#include <cstddef>

namespace striker::training {

template <class Value, std::size_t size>
class Recent {
 public:
  void fill(const Value& value) { values_.fill(value); }
  void add(const Value& newest) {
    newest_ = newest_ == 0 ? size - 1 : newest_ - 1;
    values_[newest_] = newest;
  }
  // `steps`: 0 to size - 1.
  [[nodiscard]] const Value& ago(std::size_t steps) const {
    const std::size_t at = newest_ + steps;
    return values_[at < size ? at : at - size];
  }

 private:
  std::array<Value, size> values_{};
  std::size_t newest_ = 0;
};

}  // namespace striker::training
