// SPDX-License-Identifier: Apache-2.0
#include "firmware/ports/linux/real_time_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <optional>

#include "firmware/ports/linux/stop_identifiers.hpp"

namespace striker::linux_port {

namespace {

constexpr std::uint32_t calendar_ticks = 1000;

std::int64_t to_ns(const timespec& time) {
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

std::int64_t now_ns(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return to_ns(now);
}

}  // namespace

RealTimeSocket::RealTimeSocket(const std::string& interface, std::span<const std::uint16_t> identifiers)
    : socket_(interface, all_but_stops(identifiers)), stops_(interface, stop_identifiers) {
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
      gone_ = false;
      continue;
    }
    gone_ = gone_ || errno == ENODEV || errno == ENXIO || errno == ENETDOWN;
    ++begin;
  }
  return taken;
}

void RealTimeSocket::read_calendar() {
  if (receptions_++ % calendar_ticks == 0) {
    calendar_ns_ = now_ns(CLOCK_REALTIME) - now_ns(CLOCK_MONOTONIC);
  }
}

loop::Received<std::int64_t> RealTimeSocket::receive(std::size_t most) {
  read_calendar();
  batch_.clear();
  // One stop is as good as many.
  std::optional<can::Frame> stop;
  while (const auto frame = stops_.receive()) {
    stop = frame;
  }
  if (stop) {
    batch_.add(*stop, now_ns(CLOCK_MONOTONIC));
  }
  const std::size_t wanted = std::min(most, slots_.size()) - (stop ? 1 : 0);
  for (std::size_t i = 0; i < wanted; ++i) {
    messages_[i].msg_hdr.msg_control = slots_[i].control.data();
    messages_[i].msg_hdr.msg_controllen = slots_[i].control.size();
  }
  const int received =
      recvmmsg(socket_.handle(), messages_.data(), static_cast<unsigned>(wanted), MSG_DONTWAIT, nullptr);
  const std::int64_t now = now_ns(CLOCK_MONOTONIC);
  for (std::size_t i = 0; received > 0 && i < static_cast<std::size_t>(received); ++i) {
    const host::Reception reception = host::reception_of(messages_[i].msg_hdr);
    socket_.note_dropped(reception.dropped);
    if (auto frame = socket_.accept(slots_[i].wire)) {
      const std::int64_t received_ns = reception.stamp_ns - calendar_ns_;
      frame->age_ms = host::age_ms(received_ns, now);
      batch_.add(*frame, received_ns);
    }
  }
  return batch_.received();
}

}  // namespace striker::linux_port
