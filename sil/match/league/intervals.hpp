// SPDX-License-Identifier: Apache-2.0
// 95 % intervals of what a league measures.
#pragma once

#include <optional>
#include <span>

namespace striker::sil {

// A mean with the half-width of its interval by Student's t: none of fewer than two values.
struct Mean {
  double value = 0.0;
  std::optional<double> half_width;
};

[[nodiscard]] Mean mean_of(std::span<const double> values);

// What Student's t with so many degrees of freedom (1 or more) is below with 97.5 %, to 0.0005.
[[nodiscard]] double student_t(int degrees);

struct Share {
  double value = 0.0;
  double low = 0.0;
  double high = 1.0;
};

// `part` of `whole` with Wilson's interval; 0, from 0 to 1, of nothing.
[[nodiscard]] Share share_of(int part, int whole);

}  // namespace striker::sil
