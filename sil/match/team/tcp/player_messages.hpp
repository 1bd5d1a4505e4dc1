// SPDX-License-Identifier: Apache-2.0
// What a player program of AI Soccer 2020 says, out of a stream of text (wcg_ai_soccer_2020 c619e20):
//
//   aiwc.NAME("key", 1.0, "text", -2.5)aiwc.NAME("key")...
//
// NAME is of a to z and _; arguments are texts in double quotes, without one in them, and numbers. Blanks and line ends
// between the parts are skipped. Anything else is no message, and neither is one of more than 16 KiB or 64 numbers: the
// stream is broken from there on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace striker::sil {

struct PlayerMessage {
  std::string name;
  std::vector<double> numbers;  // the arguments that are some, in order; infinities and NaNs are taken
};

class PlayerMessages {
 public:
  void add(std::string_view text);
  // The next one, if it has come as a whole.
  [[nodiscard]] std::optional<PlayerMessage> next();
  [[nodiscard]] bool is_broken() const { return is_broken_; }

 private:
  std::string text_;  // not yet read; bounded
  bool is_broken_ = false;
};

}  // namespace striker::sil
