// SPDX-License-Identifier: Apache-2.0
// The driver of a bxCAN (RM0090, "Controller area network (bxCAN)"), as ports/bare_metal/can_bus.hpp wants it.
//
//   BxCan<Memory> driver;
//   driver.start(timing, identifiers);
//   driver.on_reception();                // from the reception interrupt, and from nowhere else
//   driver.receive(frame);  driver.try_send(frame, now_ms);  driver.health(now_ms);   // from the main loop
//   driver.serve(now_ms);                 // often: moves frames on; the three above do it too
//
// Nothing waits. Joining the bus is a handshake (request, acknowledge, 11 recessive bits) that `serve` carries on; until it
// is over, and after it was lost, the health is bus_off. A frame that has not gone after 10 ms is taken back.
//
// Bus-off: everything that waits is taken back, and nothing is left to go when the bus is there again. The controller
// rests for 1 ms, then leaves the initialisation, and waits by itself for 128 times 11 recessive bits. Each bus-off without
// a frame sent in between doubles the rest, up to 256 ms: a node with a fault of its own disturbs the others ever less.
//
// What is urgent never waits for what is not: a frame more urgent than all three mailboxes' takes the place of the least
// urgent, which is taken back, and has its turn again.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "firmware/ports/bare_metal/can_bus.hpp"
#include "firmware/ports/bare_metal/can_driver/transmit_queue.hpp"
#include "firmware/ports/boards/stm32f4/bxcan_registers.hpp"
#include "firmware/ports/boards/stm32f4/registers.hpp"

namespace striker::stm32f4 {

inline constexpr std::uint32_t longest_rest_ms = 256;

template <class Registers>
class BxCan {
 public:
  explicit constexpr BxCan(const Registers& registers = {}) : registers_(registers) {}

  // `timing` is the timing register's value. Identifiers that are not among these never arrive; at most 56.
  void start(std::uint32_t timing, std::span<const std::uint16_t> identifiers) {
    timing_ = timing;
    set_filters(identifiers);
    registers_.write(can1::interrupts, can1::on_reception);
    enter_initialisation();
  }

  // The oldest frame received.
  bool receive(can::Frame& frame, std::uint32_t now_ms) {
    serve(now_ms);
    if (taken_ == received_) {
      return false;
    }
    std::atomic_signal_fence(std::memory_order_acquire);
    frame = ring_[taken_ % ring_.size()];
    std::atomic_signal_fence(std::memory_order_release);
    taken_ = taken_ + 1;
    return true;
  }

  // False off the bus, and where as many frames wait that are at least as urgent.
  bool try_send(const can::Frame& frame, std::uint32_t now_ms) {
    serve(now_ms);
    if (!is_on_bus() || !queue_.add({.frame = frame, .since_tick = now_ms})) {
      return false;
    }
    fill_mailboxes();
    return true;
  }

  can::BusHealth health(std::uint32_t now_ms) {
    serve(now_ms);
    if (std::exchange(went_off_, false) || !is_on_bus()) {
      return can::BusHealth::bus_off;
    }
    return (registers_.read(can1::errors) & can1::error_passive) != 0 ? can::BusHealth::error_passive
                                                                      : can::BusHealth::active;
  }

  // Since the start.
  [[nodiscard]] std::uint32_t bus_offs() const { return bus_offs_; }

  void serve(std::uint32_t now_ms) {
    empty_mailboxes();
    take_back_old(now_ms);
    switch (phase_) {
      case Phase::entering:
        if ((registers_.read(can1::status) & can1::initialising) != 0) {
          registers_.write(can1::timing, timing_);
          phase_ = Phase::resting;
        }
        break;
      case Phase::resting:
        if (now_ms - off_since_ms_ >= rest_ms_ && std::ranges::none_of(mailboxes_, &Mailbox::is_used)) {
          registers_.write(can1::control, settings);
          phase_ = Phase::joining;
        }
        break;
      case Phase::joining:
        phase_ = is_synchronised() && !is_bus_off() ? Phase::joined : phase_;
        break;
      case Phase::joined:
        if (is_bus_off()) {
          leave_bus(now_ms);
        }
        fill_mailboxes();
        break;
    }
  }

  // The interrupt's. What finds no room is dropped, the newest first.
  void on_reception() {
    while ((registers_.read(can1::receive_fifo) & can1::frames_pending) != 0) {
      if (received_ - taken_ < ring_.size() && take(ring_[received_ % ring_.size()])) {
        std::atomic_signal_fence(std::memory_order_release);
        received_ = received_ + 1;
      }
      registers_.write(can1::receive_fifo, can1::release);
    }
  }

 private:
  // Initialisation is asked for; it has begun; it is over, but not yet on the bus; on the bus.
  enum class Phase : std::uint8_t { entering, resting, joining, joined };

  struct Mailbox {
    bare_metal::Waiting waiting;
    bool is_used = false;
    bool is_taken_back = false;
    bool goes_again = false;
  };

  static constexpr std::uint32_t settings =
      can1::receive_locked;  // repeats until acknowledged; by identifier
  static constexpr std::uint32_t first_rest_ms = 1;
  static constexpr std::size_t ring_frames =
      32;  // 24 are to be kept, and a power of two divides without a division

  void set_filters(std::span<const std::uint16_t> identifiers) {
    constexpr std::size_t ids_a_bank = 4;
    const std::size_t banks =
        std::min<std::size_t>((identifiers.size() + ids_a_bank - 1) / ids_a_bank, can1::banks);
    const std::uint32_t used = (1U << banks) - 1;
    set_bits(registers_, can1::filter_control, can1::filters_initialise);
    registers_.write(can1::filter_is_on, 0);
    registers_.write(can1::filter_is_list, used);
    registers_.write(can1::filter_is_32_bits, 0);
    registers_.write(can1::filter_to_fifo_1, 0);
    // A bank that is not full holds the last identifier again.
    const auto filter = [&](std::size_t at) {
      return std::uint32_t{identifiers[std::min(at, identifiers.size() - 1)]} << can1::filtered_id_at;
    };
    for (std::uint32_t bank = 0; bank < banks; ++bank) {
      const std::size_t at = ids_a_bank * bank;
      registers_.write(can1::filter_bank(bank), filter(at) | filter(at + 1) << 16U);
      registers_.write(can1::filter_bank(bank) + 4, filter(at + 2) | filter(at + 3) << 16U);
    }
    registers_.write(can1::filter_is_on, used);
    clear_bits(registers_, can1::filter_control, can1::filters_initialise);
  }

  void enter_initialisation() {
    registers_.write(can1::control, settings | can1::initialise);
    phase_ = Phase::entering;
  }

  bool is_synchronised() { return (registers_.read(can1::status) & can1::initialising) == 0; }
  bool is_bus_off() { return (registers_.read(can1::errors) & can1::bus_off) != 0; }
  bool is_on_bus() { return phase_ == Phase::joined && !is_bus_off(); }

  void leave_bus(std::uint32_t now_ms) {
    went_off_ = true;
    ++bus_offs_;
    off_since_ms_ = now_ms;
    rest_ms_ = rest_ms_ == 0 ? first_rest_ms : std::min(2 * rest_ms_, longest_rest_ms);
    queue_.clear();
    for (std::uint32_t i = 0; i < mailboxes_.size(); ++i) {
      if (mailboxes_[i].is_used) {
        take_back(i, false);
      }
    }
    enter_initialisation();
  }

  void take_back(std::uint32_t i, bool goes_again) {
    registers_.write(can1::transmit_status, can1::take_back(i));
    mailboxes_[i].is_taken_back = true;
    mailboxes_[i].goes_again = goes_again;
  }

  void empty_mailboxes() {
    const std::uint32_t status = registers_.read(can1::transmit_status);
    for (std::uint32_t i = 0; i < mailboxes_.size(); ++i) {
      Mailbox& mailbox = mailboxes_[i];
      if (!mailbox.is_used || (status & can1::completed(i)) == 0) {
        continue;
      }
      registers_.write(can1::transmit_status, can1::completed(i));
      mailbox.is_used = false;
      if ((status & can1::was_sent(i)) != 0) {
        rest_ms_ = 0;
      } else if (mailbox.goes_again) {
        static_cast<void>(queue_.put_back(mailbox.waiting));
      }
    }
  }

  void take_back_old(std::uint32_t now_ms) {
    queue_.drop_too_old(now_ms);
    for (std::uint32_t i = 0; i < mailboxes_.size(); ++i) {
      const Mailbox& mailbox = mailboxes_[i];
      if (mailbox.is_used && mailbox.waiting.is_too_old(now_ms) &&
          (!mailbox.is_taken_back || mailbox.goes_again)) {
        take_back(i, false);
      }
    }
  }

  // Two frames of one identifier are never in mailboxes at once: which goes first would be the mailboxes' numbers to say.
  void fill_mailboxes() {
    for (std::size_t at = 0; at < queue_.size();) {
      const std::uint16_t id = queue_[at].frame.id;
      const auto holds_id = [&](const Mailbox& mailbox) {
        return mailbox.is_used && mailbox.waiting.frame.id == id;
      };
      if (std::ranges::any_of(mailboxes_, holds_id)) {
        ++at;
        continue;
      }
      const auto empty = std::ranges::find(mailboxes_, false, &Mailbox::is_used);
      if (empty == mailboxes_.end()) {
        make_room_for(id);
        return;
      }
      put(static_cast<std::uint32_t>(empty - mailboxes_.begin()), queue_[at]);
      queue_.remove(at);
    }
  }

  void make_room_for(std::uint16_t id) {
    if (std::ranges::any_of(mailboxes_, &Mailbox::is_taken_back)) {
      return;  // one is about to be empty
    }
    const auto least_urgent = std::ranges::max_element(
        mailboxes_, {}, [](const Mailbox& mailbox) { return mailbox.waiting.frame.id; });
    if (least_urgent->waiting.frame.id > id) {
      take_back(static_cast<std::uint32_t>(least_urgent - mailboxes_.begin()), true);
    }
  }

  void put(std::uint32_t i, const bare_metal::Waiting& waiting) {
    mailboxes_[i] = {.waiting = waiting, .is_used = true};
    const auto words = std::bit_cast<std::array<std::uint32_t, 2>>(waiting.frame.data);
    const std::uint32_t mailbox = can1::transmit_mailbox(i);
    registers_.write(mailbox + can1::length_offset, waiting.frame.length);
    registers_.write(mailbox + can1::low_offset, words[0]);
    registers_.write(mailbox + can1::high_offset, words[1]);
    registers_.write(mailbox, std::uint32_t{waiting.frame.id} << can1::standard_id_at | can1::transmit);
  }

  // The FIFO's oldest, if it is a standard data frame: the filters let nothing else pass.
  bool take(can::Frame& frame) {
    const std::uint32_t identifier = registers_.read(can1::receive_mailbox);
    if ((identifier & (can1::remote | can1::extended)) != 0) {
      return false;
    }
    const std::uint32_t length = registers_.read(can1::receive_mailbox + can1::length_offset) & 0xFU;
    frame = {.id = static_cast<std::uint16_t>(identifier >> can1::standard_id_at),
             .length = static_cast<std::uint8_t>(std::min(length, std::uint32_t{8}))};
    frame.data = std::bit_cast<decltype(frame.data)>(
        std::array{registers_.read(can1::receive_mailbox + can1::low_offset),
                   registers_.read(can1::receive_mailbox + can1::high_offset)});
    std::fill(frame.data.begin() + frame.length, frame.data.end(), std::uint8_t{0});
    return true;
  }

  Registers registers_;
  std::uint32_t timing_ = 0;
  Phase phase_ = Phase::entering;
  bool went_off_ = false;  // since `health` was asked
  std::uint32_t bus_offs_ = 0;
  std::uint32_t off_since_ms_ = 0;
  std::uint32_t rest_ms_ = 0;  // the next one's, but for the doubling; 0 once a frame was sent
  bare_metal::TransmitQueue queue_;
  std::array<Mailbox, 3> mailboxes_{};
  std::array<can::Frame, ring_frames> ring_{};
  volatile std::uint32_t received_ = 0;  // the interrupt's alone to write
  volatile std::uint32_t taken_ = 0;     // the main loop's
};

}  // namespace striker::stm32f4
