// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/sensor/camera_faults.hpp"

#include <algorithm>
#include <numbers>

namespace striker::sil {

Picture CameraFault::look(const World& world) {
  const Picture honest = camera_->look(world);
  constexpr std::size_t most_late = 8;
  seen_.push_back(honest);
  if (seen_.size() > most_late + 1) {
    seen_.pop_front();
  }
  if (!fault_.lasts(*now_)) {
    return honest;
  }
  first_ = first_.value_or(honest);
  const Picture result = changed(honest);
  ++faulty_pictures_;
  return result;
}

Picture CameraFault::changed(const Picture& honest) {
  const double value = fault_.fault.value;
  Picture picture = honest;
  switch (fault_.fault.kind) {
    case FaultKind::camera_frozen:
      return *first_;
    case FaultKind::camera_late:
      return seen_[seen_.size() - 1 - std::min<std::size_t>(fault_.fault.count, seen_.size() - 1)];
    case FaultKind::camera_jump:
      picture.robot.x_m += faulty_pictures_ % 2 == 0 ? value : 0.0;
      return picture;
    case FaultKind::camera_turn:
      picture.robot.heading_rad += std::numbers::pi;
      return picture;
    case FaultKind::camera_noise:
      return noisy(honest);
    case FaultKind::camera_bias:
      picture.ball_m = {honest.ball_m.x + value, honest.ball_m.y + value};
      return picture;
    case FaultKind::camera_mirrored:
      picture.robot.y_m = -honest.robot.y_m;
      picture.robot.heading_rad = -honest.robot.heading_rad;
      picture.ball_m.y = -honest.ball_m.y;
      return picture;
    case FaultKind::ball_jumps:
      picture.ball_m.x += faulty_pictures_ % 2 == 0 ? value : -value;
      return picture;
    default:
      return honest;
  }
}

Picture CameraFault::noisy(const Picture& honest) {
  const auto draw = [&] { return random_.uniform(-fault_.fault.value, fault_.fault.value); };
  Picture picture = honest;
  picture.robot.x_m += draw();
  picture.robot.y_m += draw();
  picture.ball_m.x += draw();
  picture.ball_m.y += draw();
  return picture;
}

}  // namespace striker::sil
