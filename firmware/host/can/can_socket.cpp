// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/can/can_socket.hpp"

#include <fcntl.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "firmware/host/stop_signal.hpp"

namespace striker::host {

namespace {

std::string error_text() {
  return std::strerror(errno);
}

std::string how_to_create(const std::string& interface) {
  return "create it with 'ip link add dev " + interface + " type vcan && ip link set up " + interface +
         "', or run under tools/with-vcan";
}

std::vector<can_filter> filters_for(std::span<const std::uint16_t> identifiers) {
  std::vector<can_filter> filters;
  filters.reserve(identifiers.size());
  for (const std::uint16_t id : identifiers) {
    filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return filters;
}

// What an error frame says of the controller's state (linux/can/error.h).
can::BusHealth health_after(const can_frame& error, can::BusHealth before) {
  if ((error.can_id & CAN_ERR_BUSOFF) != 0) {
    return can::BusHealth::bus_off;
  }
  if ((error.can_id & CAN_ERR_RESTARTED) != 0) {
    return can::BusHealth::active;
  }
  if ((error.can_id & CAN_ERR_CRTL) != 0) {
    if ((error.data[1] & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) {
      return can::BusHealth::error_passive;
    }
    if ((error.data[1] & CAN_ERR_CRTL_ACTIVE) != 0) {
      return can::BusHealth::active;
    }
  }
  return before;
}

constexpr std::chrono::microseconds queue_retry{200};

std::int64_t to_ns(const timespec& time) {
  return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

// A process that is stalled for a second finds what came meanwhile, instead of its beginning. Without the right
// to force it, the kernel's own limit holds.
void ask_for_room(int socket) {
  const int bytes = 4 << 20;
  if (setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) != 0) {
    setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
  }
}

}  // namespace

bool says_gone(int error) {
  return error == ENODEV || error == ENXIO || error == ENETDOWN;
}

Reception reception_of(msghdr& message) {
  Reception reception;
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
      reception.stamp_ns = to_ns(stamp);
    } else if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&reception.dropped, CMSG_DATA(part), sizeof reception.dropped);
    }
  }
  return reception;
}

std::uint8_t age_ms(std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<std::uint8_t>(std::clamp<std::int64_t>((to_ns - from_ns) / 1'000'000, 0, 255));
}

void CanSocket::fail(const std::string& what) const {
  const std::string message = "CAN interface '" + interface_ + "': " + what;
  if (socket_ >= 0) {
    close(socket_);
  }
  throw std::runtime_error(message);
}

CanSocket::CanSocket(const std::string& interface, std::span<const std::uint16_t> identifiers)
    : interface_(interface), stamps_(read_clocks()) {
  socket_ = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (socket_ < 0) {
    fail("this kernel has no CAN (" + error_text() +
         "): load it with 'modprobe can-raw', or run under tools/with-vcan, or use striker-sil --bus inproc");
  }
  if (interface.empty() || interface.size() >= IFNAMSIZ) {
    fail("a name has 1 to 15 characters; try vcan0");
  }
  ifreq request{};
  std::copy(interface.begin(), interface.end(), request.ifr_name);
  if (ioctl(socket_, SIOCGIFINDEX, &request) != 0) {
    fail("no such interface: " + how_to_create(interface));
  }
  const int index = request.ifr_ifindex;
  if (ioctl(socket_, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) {
    fail("the interface is down: bring it up with 'ip link set up " + interface + "'");
  }
  const std::vector<can_filter> filters = filters_for(identifiers);
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL;
  if (setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                 static_cast<socklen_t>(filters.size() * sizeof(can_filter))) != 0 ||
      setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors) != 0) {
    fail("cannot set receive filters (" + error_text() + ")");
  }
  const int on = 1;
  if (setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0 ||
      setsockopt(socket_, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on) != 0) {
    fail("cannot ask for time stamps and lost frames (" + error_text() + ")");
  }
  ask_for_room(socket_);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail("cannot bind (" + error_text() + "): is it a CAN interface?");
  }
}

CanSocket::~CanSocket() {
  close(socket_);
}

can_frame to_wire(const can::Frame& frame) {
  can_frame wire{};
  wire.can_id = frame.id;
  wire.len = frame.length;
  std::copy_n(frame.data.begin(), frame.length, wire.data);
  return wire;
}

bool CanSocket::send(const can::Frame& frame) {
  const can_frame wire = to_wire(frame);
  if (write(socket_, &wire, sizeof wire) == static_cast<ssize_t>(sizeof wire)) {
    return true;
  }
  if (says_gone(errno)) {
    const std::string why = error_text();
    throw InterfaceGone("CAN interface '" + interface_ + "': cannot send (" + why +
                        "): the interface went away or down; bring it up and start again");
  }
  return false;
}

// The kernel tells nobody when the queue has room again.
bool CanSocket::send(const can::Frame& frame, std::chrono::microseconds patience) {
  using Clock = std::chrono::steady_clock;
  if (send(frame)) {
    return true;
  }
  const auto deadline = Clock::now() + patience;
  while (Clock::now() < deadline && !stop_requested()) {
    std::this_thread::sleep_for(queue_retry);
    if (send(frame)) {
      return true;
    }
  }
  return false;
}

std::string CanSocket::full_queue(std::chrono::microseconds patience) const {
  return "CAN interface '" + interface_ + "': the queue to send stayed full for " +
         std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(patience).count()) +
         " ms (ENOBUFS): the bus is off, nobody acknowledges, or it is too slow; a longer queue ('ip link set " +
         interface_ + " txqueuelen 1000') helps against bursts alone";
}

void CanSocket::adopt(const CanSocket& other) {
  if (dup3(other.socket_, socket_, O_CLOEXEC) < 0) {
    throw std::runtime_error("CAN interface '" + interface_ + "': cannot be opened anew (" + error_text() +
                             "): start again");
  }
}

std::optional<can::Frame> CanSocket::accept(const can_frame& wire) {
  if ((wire.can_id & CAN_ERR_FLAG) != 0) {
    health_ = health_after(wire, health_);
    went_off_ = went_off_ || health_ == can::BusHealth::bus_off;
    return std::nullopt;
  }
  health_ = health_ == can::BusHealth::bus_off ? can::BusHealth::active : health_;
  can::Frame frame{.id = static_cast<std::uint16_t>(wire.can_id & CAN_SFF_MASK), .length = wire.len};
  std::copy_n(wire.data, std::min<std::size_t>(wire.len, frame.data.size()), frame.data.begin());
  return frame;
}

std::optional<can::Frame> CanSocket::receive() {
  can_frame wire{};
  iovec part{&wire, sizeof wire};
  alignas(cmsghdr) std::array<char, reception_space> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  while (true) {
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (recvmsg(socket_, &message, 0) != static_cast<ssize_t>(sizeof wire)) {
      stamps_.note_empty();
      in_a_row_ = false;
      return std::nullopt;
    }
    const Reception reception = reception_of(message);
    note_dropped(reception.dropped);
    if (auto frame = accept(wire)) {
      frame->age_ms = age_ms(received_ns(reception.stamp_ns), stamps_.now_ns());
      return frame;
    }
  }
}

// All frames that are taken in a row are taken now: to read the clocks for each would cost as much as the frame.
std::int64_t CanSocket::received_ns(std::int64_t stamp_ns) {
  if (!in_a_row_ || !stamps_.covers(stamp_ns)) {
    stamps_.take(read_clocks());
    in_a_row_ = true;
  }
  return stamps_.monotonic_ns(stamp_ns);
}

// A socket that was made anew counts from 0.
void CanSocket::note_dropped(std::uint32_t since_made) {
  if (since_made != 0) {
    lost_ += since_made - (since_made < dropped_ ? 0 : dropped_);
    dropped_ = since_made;
  }
}

bool CanSocket::wait(std::chrono::microseconds timeout) {
  pollfd waiting{socket_, POLLIN, 0};
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const timespec limit{seconds.count(), std::chrono::nanoseconds(timeout - seconds).count()};
  return ppoll(&waiting, 1, &limit, nullptr) > 0;
}

}  // namespace striker::host
