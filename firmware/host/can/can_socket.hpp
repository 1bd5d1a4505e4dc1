// SPDX-License-Identifier: Apache-2.0
// A SocketCAN raw socket on one interface (linux/can/raw.h). Blocking is in `wait` alone; sending and
// receiving never block. One thread at a time.
//
// The constructor throws std::runtime_error with one line that names the interface and the way out: a kernel
// without CAN, no such interface, an interface that is down or that is no CAN interface. A socket outlives its
// interface, but hears nothing of one that was made anew under the same name: `adopt` gives it another end.
#pragma once

#include <linux/can.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <ctime>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "firmware/can/bus_health.hpp"
#include "firmware/can/frame.hpp"
#include "firmware/host/can/stamp_clock.hpp"

namespace striker::host {

[[nodiscard]] can_frame to_wire(const can::Frame& frame);

// What the kernel tells beside a frame (SO_TIMESTAMPNS, SO_RXQ_OVFL).
struct Reception {
  std::int64_t stamp_ns = 0;  // by CLOCK_REALTIME; 0 without a stamp
  std::uint32_t dropped = 0;  // by this socket since it was made, as its queue was full
};
[[nodiscard]] Reception reception_of(msghdr& message);

// An errno of sending that tells of an interface that has gone, or down.
[[nodiscard]] bool says_gone(int error);

// Room for both.
inline constexpr std::size_t reception_space =
    CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));

// Whole milliseconds, 0 to 255; a time to come is 0.
[[nodiscard]] std::uint8_t age_ms(std::int64_t from_ns, std::int64_t to_ns);

// An interface that was there has gone, or down.
struct InterfaceGone : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class CanSocket {
 public:
  // Receives data frames with these identifiers only, and the bus's error frames.
  CanSocket(const std::string& interface, std::span<const std::uint16_t> identifiers);
  ~CanSocket();
  CanSocket(const CanSocket&) = delete;
  CanSocket& operator=(const CanSocket&) = delete;

  // False if the frame was dropped: the interface's queue is full or the bus is off. An interface that has
  // gone throws InterfaceGone.
  bool send(const can::Frame& frame);

  // The same, but a full queue gets this long to take it, or until a stop signal.
  bool send(const can::Frame& frame, std::chrono::microseconds patience);

  // Why a frame was dropped in spite of the patience, and the way out: one line.
  [[nodiscard]] std::string full_queue(std::chrono::microseconds patience) const;

  // The next frame that waits, with its age, or nothing. Error frames are taken note of, not returned.
  std::optional<can::Frame> receive();

  // True when something can be received; false at the timeout or at a signal.
  bool wait(std::chrono::microseconds timeout);

  // As the error frames that came tell it: off the bus until it is restarted or a frame is received, and for
  // one call at least, even if it was over by then.
  [[nodiscard]] can::BusHealth health() {
    return std::exchange(went_off_, false) ? can::BusHealth::bus_off : health_;
  }

  // Frames that the socket's queue did not hold, since this was asked last.
  [[nodiscard]] std::uint32_t lost() { return std::exchange(lost_, 0); }
  void note_dropped(std::uint32_t since_made);

  // For other calls on this socket: its file descriptor, and what came as a frame, or nothing for an error
  // frame, which is taken note of.
  [[nodiscard]] int handle() const { return socket_; }
  std::optional<can::Frame> accept(const can_frame& wire);

  // Goes on with the other's end of the bus, under the same file descriptor, at once: while another thread uses this
  // socket, too. What waited in its own queue is lost.
  void adopt(const CanSocket& other);

 private:
  std::int64_t received_ns(std::int64_t stamp_ns);
  [[noreturn]] void fail(const std::string& what) const;

  std::string interface_;
  int socket_ = -1;
  can::BusHealth health_ = can::BusHealth::active;
  StampClock stamps_;
  bool in_a_row_ = false;  // frames are taken one after the other, and the clocks were read
  std::uint32_t dropped_ = 0;
  std::uint32_t lost_ = 0;
  bool went_off_ = false;  // since `health` was asked
};

}  // namespace striker::host
