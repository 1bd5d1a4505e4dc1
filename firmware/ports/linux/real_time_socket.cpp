// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/real_time_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/host/periodic_clock.hpp"
#include "firmware/ports/linux/stop_identifiers.hpp"

namespace striker::linux_port {

RealTimeSocket::RealTimeSocket(const std::string& interface, std::span<const std::uint16_t> identifiers)
    : interface_(interface),
      others_(all_but_stops(identifiers)),
      socket_(interface, others_),
      stops_(interface, stop_identifiers),
      stamps_(host::read_clocks()) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    slots_[i].part = {&slots_[i].wire, sizeof slots_[i].wire};
    messages_[i].msg_hdr.msg_iov = &slots_[i].part;
    messages_[i].msg_hdr.msg_iovlen = 1;
  }
}

std::size_t RealTimeSocket::try_send(std::span<const can::Frame> frames) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    slots_[i].wire = host::to_wire(frames[i]);
    messages_[i].msg_hdr.msg_control = nullptr;
    messages_[i].msg_hdr.msg_controllen = 0;
  }
  std::size_t taken = 0;
  for (std::size_t begin = 0; begin < frames.size();) {
    const int sent =
        sendmmsg(socket_.handle(), &messages_[begin], static_cast<unsigned>(frames.size() - begin), 0);
    if (sent > 0) {
      taken += static_cast<std::size_t>(sent);
      begin += static_cast<std::size_t>(sent);
      gone_.store(false, std::memory_order_relaxed);
      continue;
    }
    if (host::says_gone(errno)) {
      gone_.store(true, std::memory_order_relaxed);
    }
    ++begin;
  }
  return taken;
}

// Stops first: what could be driven is heard no sooner than what stops it.
bool RealTimeSocket::reopen() {
  try {
    const host::CanSocket stops(interface_, stop_identifiers);
    const host::CanSocket others(interface_, others_);
    stops_.adopt(stops);
    socket_.adopt(others);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

// One stop is as good as many, and no wrong frame on its identifier hides it; these take half of the room at most.
std::size_t RealTimeSocket::receive_stops(std::size_t room) {
  bool stopped = false;
  std::size_t wrong = 0;
  while (const auto frame = stops_.receive()) {
    if (can::is_valid<can::EmergencyStop>(*frame)) {
      if (std::exchange(stopped, true)) {
        continue;
      }
    } else if (++wrong > room / 2) {
      ++skipped_;
      continue;
    }
    batch_.add(*frame, host::MonotonicClock().now_ns());
  }
  return std::min(wrong, room / 2) + (stopped ? 1 : 0);
}

loop::Received<std::int64_t> RealTimeSocket::receive(std::size_t most) {
  batch_.clear();
  const std::size_t room = std::min(most, slots_.size());
  const std::size_t wanted = std::max<std::size_t>(room - receive_stops(room), room < slots_.size() ? 1 : 0);
  for (std::size_t i = 0; i < wanted; ++i) {
    messages_[i].msg_hdr.msg_control = slots_[i].control.data();
    messages_[i].msg_hdr.msg_controllen = slots_[i].control.size();
  }
  const int received =
      recvmmsg(socket_.handle(), messages_.data(), static_cast<unsigned>(wanted), MSG_DONTWAIT, nullptr);
  stamps_.take(host::read_clocks());
  for (std::size_t i = 0; received > 0 && i < static_cast<std::size_t>(received); ++i) {
    const host::Reception reception = host::reception_of(messages_[i].msg_hdr);
    socket_.note_dropped(reception.dropped);
    if (auto frame = socket_.accept(slots_[i].wire)) {
      const std::int64_t received_ns = stamps_.monotonic_ns(reception.stamp_ns);
      frame->age_ms = host::age_ms(received_ns, stamps_.now_ns());
      batch_.add(*frame, received_ns);
    }
  }
  if (received < static_cast<int>(wanted)) {
    stamps_.note_empty();
  }
  return batch_.received();
}

}  // namespace striker::linux_port
