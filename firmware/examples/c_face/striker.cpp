// SPDX-License-Identifier: Apache-2.0
#include "striker.h"

#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <type_traits>

#include "firmware/can/drives/striker_drives.hpp"
#include "firmware/loop/controller_node.hpp"
#include "firmware/loop/gated_node.hpp"
#include "firmware/policy/exported/kick.hpp"

namespace {

using namespace striker;

using Pilot = core::Pilot<policy::kick>;
using Node = loop::GatedNode<loop::ControllerNode<core::Controller<Pilot>, can::StrikerDrives>>;

constexpr core::RobotProfile robot = core::profile_of(core::forward);
static_assert(Pilot::suits(robot));
static_assert(can::FrameList::capacity <= STRIKER_MOST_ANSWERS);

static_assert(sizeof(Node) <= sizeof(striker_controller), "striker.h: enlarge striker_controller");
static_assert(alignof(Node) <= alignof(striker_controller));
static_assert(std::is_trivially_copyable_v<Node>);
static_assert(std::is_trivially_destructible_v<Node>);
static_assert(static_cast<int>(core::State::standby) == STRIKER_STANDBY);
static_assert(static_cast<int>(core::State::active) == STRIKER_ACTIVE);
static_assert(static_cast<int>(core::State::fault) == STRIKER_FAULT);

Node& inside(striker_controller* controller) {
  return *std::launder(reinterpret_cast<Node*>(controller->storage));
}

const Node& inside(const striker_controller* controller) {
  return *std::launder(reinterpret_cast<const Node*>(controller->storage));
}

can::Frame frame_of(const striker_frame& from) {
  can::Frame frame{.id = from.id, .length = from.length, .data = {}};
  std::copy(std::begin(from.data), std::end(from.data), frame.data.begin());
  return frame;
}

striker_frame frame_for_c(const can::Frame& from) {
  striker_frame frame{from.id, from.length, {}};
  std::copy(from.data.begin(), from.data.end(), std::begin(frame.data));
  return frame;
}

}  // namespace

void striker_init(striker_controller* controller, uint32_t seed) {
  new (controller->storage) Node(robot, seed);
}

size_t striker_step(striker_controller* controller, const striker_frame* frames, size_t count, uint32_t tick,
                    striker_frame* answers, size_t capacity) {
  std::array<can::Frame, STRIKER_MOST_FRAMES> received{};
  count = std::min(count, received.size());
  std::transform(frames, frames + count, received.begin(), frame_of);
  can::FrameList answer;
  inside(controller).step({.number = tick, .frames = std::span(received).first(count)}, answer);
  const auto made = answer.frames();
  std::transform(made.begin(), made.begin() + std::min(made.size(), capacity), answers, frame_for_c);
  return made.size();
}

striker_state striker_get_state(const striker_controller* controller) {
  return static_cast<striker_state>(inside(controller).controller().state());
}

uint8_t striker_get_fault(const striker_controller* controller) {
  return static_cast<uint8_t>(inside(controller).controller().fault());
}
