// SPDX-License-Identifier: Apache-2.0
// The operator of one controller: gives mode commands and hears what the controller says of itself.
#pragma once

#include <span>
#include <string>

#include "firmware/can/codec.hpp"

namespace striker::sil {

class Operator {
 public:
  [[nodiscard]] can::Frame order(can::Mode mode);
  void hear(std::span<const can::Frame> frames);

  // By its last status.
  [[nodiscard]] bool controller_faulty() const { return faulty_; }
  // The policy's identity from the last version frame, 8 hexadecimal digits; "unknown" before one came.
  [[nodiscard]] const std::string& policy() const { return policy_; }

 private:
  can::SendCounter mode_counter_;
  bool faulty_ = false;
  std::string policy_ = "unknown";
};

}  // namespace striker::sil
