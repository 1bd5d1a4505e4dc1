// SPDX-License-Identifier: Apache-2.0
// A camera whose pictures are wrong: a decorator of any other. Values, not frames: the protection is right.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "sil/fault/plan/fault_plan.hpp"
#include "sil/robot/camera.hpp"
#include "sil/world/random.hpp"

namespace striker::sil {

// One fault of the camera. `now` is the tick of the next picture, kept by whoever moves time.
class CameraFault final : public Camera {
 public:
  CameraFault(Camera& camera, const TimedFault& fault, const Random& random, const std::uint32_t& now)
      : camera_(&camera), fault_(fault), random_(random), now_(&now) {}

  [[nodiscard]] Picture look(const World& world) override;

 private:
  [[nodiscard]] Picture changed(const Picture& honest);
  [[nodiscard]] Picture noisy(const Picture& honest);

  Camera* camera_;
  TimedFault fault_;
  Random random_;
  const std::uint32_t* now_;
  std::deque<Picture> seen_;      // the last ones, the newest at the back
  std::optional<Picture> first_;  // of the fault
  std::uint64_t faulty_pictures_ = 0;
};

}  // namespace striker::sil
