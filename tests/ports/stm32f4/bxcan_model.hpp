// SPDX-License-Identifier: Apache-2.0
// A bxCAN as RM0090 describes it, register by register, with a bus that is the test's: what a driver may rely on, and no more.
// Writes that the hardware ignores are ignored; those that it forbids fail the test.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "firmware/ports/boards/stm32f4/bxcan_registers.hpp"

namespace striker::stm32f4::model {

// What comes of a frame on the wire.
enum class Outcome : std::uint8_t { acknowledged, unacknowledged, bit_error };

struct WireFrame {
  std::uint32_t id = 0;
  std::uint32_t length = 0;
  std::array<std::uint8_t, 8> data{};
  bool is_extended = false;
  bool is_remote = false;
};

class BxCanModel {
 public:
  // A transmission that runs, from `begin` to `end`.
  std::optional<WireFrame> begin_transmission() {
    if (!is_on_bus() || in_flight_) {
      return std::nullopt;
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (mailboxes_[i].pending && (!in_flight_ || id_of(i) < id_of(*in_flight_))) {
        in_flight_ = i;
      }
    }
    return in_flight_ ? std::optional(frame_of(*in_flight_)) : std::nullopt;
  }

  void end_transmission(Outcome outcome) {
    const std::uint32_t i = *in_flight_;
    in_flight_.reset();
    const bool ok = outcome == Outcome::acknowledged;
    // ISO 11898-1: who is error passive and gets no acknowledge counts no further.
    if (ok) {
      transmit_errors_ -= transmit_errors_ > 0 ? 1 : 0;
    } else if (outcome == Outcome::bit_error || transmit_errors_ < 128) {
      transmit_errors_ += 8;
    }
    if (transmit_errors_ > 255) {
      bus_off_ = true;
    }
    if (ok || mailboxes_[i].abort) {
      complete(i, ok);
    }
    if (initialise_requested()) {
      initialising_ = true;
    }
  }

  // As many recessive bits in a row.
  void recessive_bits(std::uint32_t bits) {
    if (initialise_requested() || asleep_) {
      return;
    }
    in_a_row_ += bits;
    initialising_ = initialising_ && in_a_row_ < 11;
    if (bus_off_ && may_recover_ && in_a_row_ >= 128 * 11) {
      bus_off_ = false;
      transmit_errors_ = 0;
    }
  }

  // A frame from another node; the interrupt handler runs if it is asked for.
  void receive(const WireFrame& frame) {
    if (!is_on_bus() || !passes_filter(frame)) {
      return;
    }
    if (fifo_.size() == 3) {
      ++overruns_;
      EXPECT_TRUE((control_ & can1::receive_locked) != 0) << "the oldest would be overwritten";
      return;
    }
    fifo_.push_back(frame);
    while (handler && (interrupts_ & can1::on_reception) != 0 && !fifo_.empty()) {
      handler();
    }
  }

  std::function<void()> handler;
  bool acknowledges_initialisation = true;
  bool takes_back_at_once = true;

  // What was to be taken back meanwhile.
  void take_back_now() {
    takes_back_at_once = true;
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (mailboxes_[i].abort && in_flight_ != i) {
        complete(i, false);
      }
    }
  }

  [[nodiscard]] bool is_on_bus() const {
    return !initialising_ && !initialise_requested() && !asleep_ && !bus_off_;
  }
  [[nodiscard]] bool is_bus_off() const { return bus_off_; }
  [[nodiscard]] std::uint32_t timing() const { return timing_; }
  [[nodiscard]] std::uint32_t overruns() const { return overruns_; }
  [[nodiscard]] bool holds_frames() const {
    return std::ranges::any_of(mailboxes_, [](const Mailbox& mailbox) { return mailbox.pending; });
  }

  std::uint32_t read(std::uint32_t address) {
    switch (address) {
      case can1::control:
        return control_;
      case can1::status:
        return (initialising_ ? 1U : 0U) | (asleep_ ? 2U : 0U);
      case can1::transmit_status:
        return transmit_status();
      case can1::receive_fifo:
        return static_cast<std::uint32_t>(fifo_.size()) | (fifo_.size() == 3 ? 8U : 0U);
      case can1::interrupts:
        return interrupts_;
      case can1::errors:
        return transmit_errors_ << 16U | (bus_off_ ? 4U : 0U) | (transmit_errors_ >= 128 ? 2U : 0U) |
               (transmit_errors_ >= 96 ? 1U : 0U);
      case can1::timing:
        return timing_;
      case can1::receive_mailbox:
        EXPECT_FALSE(fifo_.empty()) << "reads an empty FIFO";
        return (fifo_[0].is_extended ? fifo_[0].id << 3U | can1::extended
                                     : fifo_[0].id << can1::standard_id_at) |
               (fifo_[0].is_remote ? can1::remote : 0U);
      case can1::receive_mailbox + can1::length_offset:
        return 0xABCD'0300U | fifo_[0].length;  // time stamp and filter's number beside it
      case can1::receive_mailbox + can1::low_offset:
        return words_of(fifo_[0])[0];
      case can1::receive_mailbox + can1::high_offset:
        return words_of(fifo_[0])[1];
      default:
        return others_[address];
    }
  }

  void write(std::uint32_t address, std::uint32_t value) {
    if (address == can1::control) {
      write_control(value);
    } else if (address == can1::transmit_status) {
      write_transmit_status(value);
    } else if (address == can1::receive_fifo) {
      if ((value & can1::release) != 0 && !fifo_.empty()) {
        fifo_.pop_front();
      }
    } else if (address == can1::interrupts) {
      interrupts_ = value;
    } else if (address == can1::timing) {
      timing_ = initialising_ && initialise_requested() ? value : timing_;
    } else if (address >= can1::transmit_mailbox(0) && address < can1::transmit_mailbox(3)) {
      write_mailbox(address - can1::transmit_mailbox(0), value);
    } else if (address > can1::filter_control) {
      write_filter(address, value);
    } else {
      others_[address] = value;
    }
  }

 private:
  struct Mailbox {
    std::array<std::uint32_t, 4> words{};
    bool pending = false;
    bool abort = false;
    bool completed = false;
    bool ok = false;
  };

  static std::array<std::uint32_t, 2> words_of(const WireFrame& frame) {
    return std::bit_cast<std::array<std::uint32_t, 2>>(frame.data);
  }
  [[nodiscard]] bool initialise_requested() const { return (control_ & can1::initialise) != 0; }
  [[nodiscard]] std::uint32_t id_of(std::uint32_t i) const {
    return mailboxes_[i].words[0] >> can1::standard_id_at;
  }
  [[nodiscard]] WireFrame frame_of(std::uint32_t i) const {
    const auto& words = mailboxes_[i].words;
    return {.id = id_of(i),
            .length = words[1] & 0xFU,
            .data = std::bit_cast<std::array<std::uint8_t, 8>>(std::array{words[2], words[3]}),
            .is_extended = (words[0] & can1::extended) != 0,
            .is_remote = (words[0] & can1::remote) != 0};
  }

  [[nodiscard]] std::uint32_t transmit_status() const {
    std::uint32_t status = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      status |= mailboxes_[i].completed ? can1::completed(i) : 0;
      status |= mailboxes_[i].ok ? can1::was_sent(i) : 0;
      status |= mailboxes_[i].abort ? can1::take_back(i) : 0;
      status |= mailboxes_[i].pending ? 0 : can1::is_empty(i);
    }
    return status;
  }

  void complete(std::uint32_t i, bool ok) {
    mailboxes_[i].pending = mailboxes_[i].abort = false;
    mailboxes_[i].completed = true;
    mailboxes_[i].ok = ok;
  }

  void write_control(std::uint32_t value) {
    const bool requested = initialise_requested();
    control_ = value;
    asleep_ = (value & can1::sleep) != 0;
    if (initialise_requested() && acknowledges_initialisation && !in_flight_ && !asleep_) {
      initialising_ = true;
    }
    if (requested && !initialise_requested()) {
      in_a_row_ = 0;
      may_recover_ = true;
    }
    if (initialise_requested()) {
      may_recover_ = false;
    }
  }

  void write_transmit_status(std::uint32_t value) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      if ((value & can1::completed(i)) != 0) {
        mailboxes_[i].completed = mailboxes_[i].ok = false;
      }
      if ((value & can1::take_back(i)) != 0 && mailboxes_[i].pending) {
        mailboxes_[i].abort = true;
        if (in_flight_ != i && takes_back_at_once) {
          complete(i, false);
        }
      }
    }
  }

  void write_mailbox(std::uint32_t offset, std::uint32_t value) {
    Mailbox& mailbox = mailboxes_[offset / 0x10];
    EXPECT_FALSE(mailbox.pending) << "writes to a mailbox that is not empty";
    EXPECT_FALSE(mailbox.completed) << "writes to a mailbox before it knows what became of its frame";
    mailbox.words[offset % 0x10 / 4] = value;
    mailbox.pending = offset % 0x10 == 0 && (value & can1::transmit) != 0;
  }

  // Mode, scale and FIFO in filter initialisation alone; a bank also while it is off.
  void write_filter(std::uint32_t address, std::uint32_t value) {
    const bool open = (others_[can1::filter_control] & can1::filters_initialise) != 0;
    const bool is_bank = address >= can1::filter_bank(0);
    const std::uint32_t bank = is_bank ? (address - can1::filter_bank(0)) / 8 : 0;
    const bool is_off = is_bank && (others_[can1::filter_is_on] >> bank & 1U) == 0;
    if (open || is_off || address == can1::filter_is_on) {
      others_[address] = value;
    }
  }

  [[nodiscard]] bool passes_filter(const WireFrame& frame) {
    EXPECT_EQ(others_[can1::filter_control] & can1::filters_initialise, 0U) << "filters are still being set";
    const std::uint32_t standard = frame.id << can1::filtered_id_at;
    const std::uint32_t wanted =
        (frame.is_extended ? (frame.id >> 18U) << 5U | 8U | (frame.id >> 15U & 7U) : standard) |
        (frame.is_remote ? 0x10U : 0U);
    for (std::uint32_t bank = 0; bank < can1::banks; ++bank) {
      const auto has = [&](std::uint32_t of) { return (others_[of] >> bank & 1U) != 0; };
      if (!has(can1::filter_is_on) || has(can1::filter_to_fifo_1)) {
        continue;
      }
      EXPECT_TRUE(has(can1::filter_is_list) && !has(can1::filter_is_32_bits))
          << "the model knows lists of 16 bits";
      for (const std::uint32_t word :
           {others_[can1::filter_bank(bank)], others_[can1::filter_bank(bank) + 4]}) {
        if ((word & 0xFFFFU) == wanted || word >> 16U == wanted) {
          return true;
        }
      }
    }
    return false;
  }

  std::uint32_t control_ = 0x00010002;  // as reset leaves it: asleep
  bool asleep_ = true;
  bool initialising_ = false;
  std::uint32_t in_a_row_ = 0;
  bool bus_off_ = false;
  bool may_recover_ = false;
  std::uint32_t transmit_errors_ = 0;
  std::uint32_t timing_ = 0x01230000;
  std::uint32_t interrupts_ = 0;
  std::uint32_t overruns_ = 0;
  std::array<Mailbox, 3> mailboxes_{};
  std::optional<std::uint32_t> in_flight_;
  std::deque<WireFrame> fifo_;
  std::map<std::uint32_t, std::uint32_t> others_ = {{can1::filter_control, 0x2A1C0E01}};
};

// What the driver is given in the memory's place.
struct ModelledRegisters {
  BxCanModel* model = nullptr;
  std::uint32_t read(std::uint32_t address) { return model->read(address); }
  void write(std::uint32_t address, std::uint32_t value) { model->write(address, value); }
};

}  // namespace striker::stm32f4::model
