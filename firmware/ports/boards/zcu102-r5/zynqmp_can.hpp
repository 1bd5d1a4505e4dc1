// SPDX-License-Identifier: Apache-2.0
// The driver of the Zynq UltraScale+'s CAN controller (AMD UG1085, "CAN Controller"; UG1087, module CAN): polled, and
// apart from the registers' place, so that tests give it a model of them.
//
// Reception: the hardware's FIFO of 64 frames, behind its four acceptance filters.
//
// Transmission: a queue in the order of urgency (transmit_queue.hpp) before the hardware's FIFO, which is handed one
// frame at a time, and its high-priority buffer, which goes first and gets what is more urgent than the frame in the FIFO.
// So a frame that loses arbitration holds nothing more urgent up.
//
// A frame cannot be taken back alone: where one in the hardware is 10 ms old, the controller is reset and joins the bus
// again, and what it had received and not handed out is lost; the frames' counters show that. At bus-off it is reset as
// well, everything that waits is dropped, and it joins after a pause (bus_off_pause.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/can_driver/bus_off_pause.hpp"
#include "firmware/ports/bare_metal/can_driver/transmit_queue.hpp"
#include "firmware/ports/boards/zcu102-r5/can_words.hpp"

namespace striker::zcu102 {

// Offsets of the registers, in bytes.
enum class CanRegister : std::uint32_t {
  reset = 0x00,
  mode = 0x04,
  prescaler = 0x08,
  segments = 0x0C,
  error_counters = 0x10,
  status = 0x18,
  events = 0x1C,  // ISR
  clear_events = 0x24,
  transmit_fifo = 0x30,
  transmit_urgent = 0x40,
  receive_fifo = 0x50,
  use_filters = 0x60,
  first_filter = 0x64,  // mask, then identifier; four times
};

namespace can_bits {
inline constexpr std::uint32_t reset = 1U << 0U;  // SRR
inline constexpr std::uint32_t enable = 1U << 1U;
inline constexpr std::uint32_t filters_busy = 1U << 11U;  // SR
inline constexpr std::uint32_t urgent_full = 1U << 9U;
inline constexpr std::uint32_t error_state = 3U << 7U;
inline constexpr std::uint32_t error_state_bus_off = 2U << 7U;
inline constexpr std::uint32_t transmit_empty = 1U << 14U;  // ISR
inline constexpr std::uint32_t bus_off = 1U << 9U;
inline constexpr std::uint32_t received = 1U << 7U;
inline constexpr std::uint32_t all_events = 0x7FFF;
}  // namespace can_bits

// Registers: read(CanRegister, words = 0) and write(CanRegister, value, words = 0), `words` further on.
template <class Registers, Encoding encoding>
class ZynqmpCan {
 public:
  using Words = CanWords<encoding>;
  using Filters = std::array<bare_metal::AcceptanceFilter, 4>;

  explicit constexpr ZynqmpCan(Registers registers = {}) : registers_(registers) {}

  void start(const BitTiming& timing, const Filters& filters) {
    timing_ = timing;
    filters_ = filters;
    join();
  }

  bool receive(can::Frame& frame, std::uint32_t tick) {
    serve(tick);
    while (!is_off_ && (registers_.read(CanRegister::events) & can_bits::received) != 0) {
      const FrameWords words = {.id = registers_.read(CanRegister::receive_fifo, 0),
                                .length = registers_.read(CanRegister::receive_fifo, 1),
                                .data1 = registers_.read(CanRegister::receive_fifo, 2),
                                .data2 = registers_.read(CanRegister::receive_fifo, 3)};
      // Set again at once where more has come.
      registers_.write(CanRegister::clear_events, can_bits::received);
      if (Words::decode(words, frame)) {
        return true;
      }
    }
    return false;
  }

  bool try_send(const can::Frame& frame, std::uint32_t tick) {
    serve(tick);
    const bool taken = !is_off_ && queue_.add({.frame = frame, .since_tick = tick});
    serve(tick);
    return taken;
  }

  can::BusHealth health(std::uint32_t tick) {
    serve(tick);
    if (is_off_ || off_untold_) {
      off_untold_ = false;
      return can::BusHealth::bus_off;
    }
    constexpr std::uint32_t passive = 128;
    const std::uint32_t counters = registers_.read(CanRegister::error_counters);
    const bool is_passive = (counters & 0xFFU) >= passive || (counters >> 8U & 0xFFU) >= passive;
    return is_passive ? can::BusHealth::error_passive : can::BusHealth::active;
  }

  // Since boot: how often it went off the bus, and how many frames were taken back.
  [[nodiscard]] std::uint32_t times_off() const { return pause_.times(); }
  [[nodiscard]] std::uint32_t taken_back() const { return taken_back_; }

 private:
  struct Pending {
    bool is_there = false;
    std::uint16_t id = 0;
    std::uint32_t since = 0;

    [[nodiscard]] bool is_too_old(std::uint32_t tick) const {
      return is_there && tick - since >= bare_metal::transmit_timeout_ticks;
    }
  };

  // From any state. What the controller still held is gone. Rare, and apart: a tick comes here once or twice
  // (tools/step_bound/facts.toml).
  [[gnu::noinline]] void join() {
    leave();
    registers_.write(CanRegister::mode, 0);
    registers_.write(CanRegister::prescaler, timing_.prescaler);
    registers_.write(CanRegister::segments, timing_.segments);
    set_filters();
    registers_.write(CanRegister::clear_events, can_bits::all_events);
    registers_.write(CanRegister::reset, can_bits::enable);
  }

  // In configuration mode it neither sends nor receives.
  void leave() {
    registers_.write(CanRegister::reset, can_bits::reset);
    in_fifo_ = {};
    in_urgent_ = {};
  }

  void set_filters() {
    constexpr int patience = 1'000;
    registers_.write(CanRegister::use_filters, 0);
    for (int i = 0; i < patience && (registers_.read(CanRegister::status) & can_bits::filters_busy) != 0;
         ++i) {
    }
    for (std::uint32_t i = 0; i < filters_.size(); ++i) {
      const FilterWords words = Words::encode(filters_[i]);
      registers_.write(CanRegister::first_filter, words.mask, 2 * i);
      registers_.write(CanRegister::first_filter, words.id, 2 * i + 1);
    }
    registers_.write(CanRegister::use_filters, (1U << filters_.size()) - 1);
  }

  // Whatever is due: called from each of the three.
  void serve(std::uint32_t tick) {
    if (is_off_) {
      if (!pause_.is_over(tick)) {
        return;
      }
      is_off_ = false;
      join();
    }
    const std::uint32_t status = registers_.read(CanRegister::status);
    const std::uint32_t events = registers_.read(CanRegister::events);
    if ((events & can_bits::bus_off) != 0 ||
        (status & can_bits::error_state) == can_bits::error_state_bus_off) {
      go_off(tick);
      return;
    }
    in_fifo_.is_there = in_fifo_.is_there && (events & can_bits::transmit_empty) == 0;
    in_urgent_.is_there = in_urgent_.is_there && (status & can_bits::urgent_full) != 0;
    if (in_fifo_.is_too_old(tick) || in_urgent_.is_too_old(tick)) {
      taken_back_ += (in_fifo_.is_there ? 1U : 0U) + (in_urgent_.is_there ? 1U : 0U);
      join();
    }
    taken_back_ += static_cast<std::uint32_t>(queue_.drop_too_old(tick));
    hand_over();
  }

  void go_off(std::uint32_t tick) {
    taken_back_ += (in_fifo_.is_there ? 1U : 0U) + (in_urgent_.is_there ? 1U : 0U);
    taken_back_ += static_cast<std::uint32_t>(queue_.clear());
    leave();
    is_off_ = true;
    off_untold_ = true;
    pause_.begin(tick);
  }

  void hand_over() {
    if (!queue_.empty() && !in_fifo_.is_there) {
      in_fifo_ = put(CanRegister::transmit_fifo);
      registers_.write(CanRegister::clear_events, can_bits::transmit_empty);
    }
    if (!queue_.empty() && !in_urgent_.is_there && queue_[0].frame.id < in_fifo_.id) {
      in_urgent_ = put(CanRegister::transmit_urgent);
    }
  }

  Pending put(CanRegister buffer) {
    const FrameWords words = Words::encode(queue_[0].frame);
    registers_.write(buffer, words.id, 0);
    registers_.write(buffer, words.length, 1);
    registers_.write(buffer, words.data1, 2);
    registers_.write(buffer, words.data2, 3);
    const Pending pending = {.is_there = true, .id = queue_[0].frame.id, .since = queue_[0].since_tick};
    queue_.remove(0);
    return pending;
  }

  Registers registers_;
  BitTiming timing_;
  Filters filters_{};
  bare_metal::TransmitQueue queue_;
  Pending in_fifo_;
  Pending in_urgent_;
  bool is_off_ = false;
  bool off_untold_ = false;
  bare_metal::BusOffPause pause_;
  std::uint32_t taken_back_ = 0;
};

}  // namespace striker::zcu102
