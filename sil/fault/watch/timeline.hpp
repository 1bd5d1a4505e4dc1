// SPDX-License-Identifier: Apache-2.0
// What became of a fault: when the controller told of it, when the torque was gone, and whether it came back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sil/fault/watch/invariants.hpp"
#include "sil/record/observer.hpp"

namespace striker::sil {

class FaultTimeline final : public Observer {
 public:
  // The fault begins in tick `from`; the episode that it is in moves until tick `end`.
  FaultTimeline(const WatchedParts& parts, std::uint32_t from, std::uint32_t end)
      : parts_(parts), from_(from), end_(end) {}

  void end_tick(const Snapshot& snapshot) override;

  // The first fault that the controller told since `from`, with its name.
  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }
  [[nodiscard]] std::optional<std::uint32_t> detected_ms() const { return since(detected_); }
  // The drives' own watchdog has cut the torque in between.
  [[nodiscard]] bool drives_cut() const { return drives_cut_; }
  // The command gate has held something back.
  [[nodiscard]] bool limited() const { return limited_; }
  // From then on there was no torque until the episode's end.
  [[nodiscard]] std::optional<std::uint32_t> zero_torque_ms() const { return since(zero_); }
  // It was armed when the fault began; at the episode's end; and later.
  [[nodiscard]] bool armed_before() const { return armed_before_; }
  [[nodiscard]] bool armed_at_end() const { return armed_at_end_; }
  [[nodiscard]] bool drove_later() const { return drove_later_; }

 private:
  [[nodiscard]] std::optional<std::uint32_t> since(const std::optional<std::uint32_t>& tick) const {
    return tick ? std::optional(*tick - from_) : std::nullopt;
  }
  void hear(std::uint32_t tick);

  WatchedParts parts_;
  std::uint32_t from_;
  std::uint32_t end_;
  bool armed_ = false;
  std::optional<std::string> fault_;
  std::optional<std::uint32_t> detected_;
  std::optional<std::uint32_t> zero_;
  bool drives_cut_ = false;
  bool limited_ = false;
  bool armed_before_ = false;
  bool armed_at_end_ = false;
  bool drove_later_ = false;
};

}  // namespace striker::sil
