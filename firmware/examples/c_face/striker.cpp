#include "striker.h"

#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <type_traits>

#include "firmware/core/controller.hpp"

namespace {

using namespace striker;

static_assert(sizeof(core::Controller) <= sizeof(striker_controller),
              "striker.h: enlarge striker_controller");
static_assert(alignof(core::Controller) <= alignof(striker_controller));
static_assert(std::is_trivially_copyable_v<core::Controller>);
static_assert(std::is_trivially_destructible_v<core::Controller>);
static_assert(static_cast<int>(can::State::standby) == STRIKER_STANDBY);
static_assert(static_cast<int>(can::State::active) == STRIKER_ACTIVE);
static_assert(static_cast<int>(can::State::fault) == STRIKER_FAULT);

core::Controller& inside(striker_controller* controller) {
  return *std::launder(reinterpret_cast<core::Controller*>(controller->storage));
}

const core::Controller& inside(const striker_controller* controller) {
  return *std::launder(reinterpret_cast<const core::Controller*>(controller->storage));
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

void striker_init(striker_controller* controller) {
  new (controller->storage) core::Controller();
}

size_t striker_step(striker_controller* controller, const striker_frame* frames, size_t count, uint32_t tick,
                    striker_frame* answers, size_t capacity) {
  std::array<can::Frame, STRIKER_MOST_FRAMES> received{};
  count = std::min(count, received.size());
  std::transform(frames, frames + count, received.begin(), frame_of);
  core::Outputs outputs;
  inside(controller).step({.tick = tick, .frames = std::span(received).first(count)}, outputs);
  const auto made = outputs.frames();
  std::transform(made.begin(), made.begin() + std::min(made.size(), capacity), answers, frame_for_c);
  return made.size();
}

striker_state striker_get_state(const striker_controller* controller) {
  return static_cast<striker_state>(inside(controller).state());
}

uint8_t striker_get_fault(const striker_controller* controller) {
  return static_cast<uint8_t>(inside(controller).fault());
}
