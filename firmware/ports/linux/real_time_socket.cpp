// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/real_time_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <stdexcept>

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

loop::Received<std::int64_t> RealTimeSocket::receive(std::size_t most) {
  batch_.clear();
  // One stop is as good as many.
  std::optional<can::Frame> stop;
  while (const auto frame = stops_.receive()) {
    stop = frame;
  }
  if (stop) {
    batch_.add(*stop, host::MonotonicClock().now_ns());
  }
  const std::size_t wanted = std::min(most, slots_.size()) - (stop ? 1 : 0);
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
