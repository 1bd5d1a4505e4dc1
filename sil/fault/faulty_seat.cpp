// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/faulty_seat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "sil/fault/link/foreign_frames.hpp"
#include "sil/fault/link/second_controller.hpp"
#include "sil/fault/memory/node_faults.hpp"
#include "sil/fault/memory/weight_flips.hpp"
#include "sil/fault/sensor/camera_faults.hpp"
#include "sil/fault/sensor/drive_faults.hpp"
#include "sil/fault/sensor/plant_faults.hpp"
#include "sil/robot/plant_variation.hpp"
#include "sil/world/random_streams.hpp"

namespace striker::sil {

namespace {

Random random_of(const TimedFault& fault, std::uint64_t seed) {
  return {seed, fault.fault.stream, random_stream::faults};
}

std::vector<TimedFault> of_place(const std::vector<TimedFault>& faults, FaultPlace place) {
  std::vector<TimedFault> result;
  std::copy_if(faults.begin(), faults.end(), std::back_inserter(result),
               [&](const TimedFault& fault) { return info_of(fault.fault.kind).place == place; });
  return result;
}

std::vector<TimedFault> of_kind(const std::vector<TimedFault>& faults, FaultKind kind) {
  std::vector<TimedFault> result;
  std::copy_if(faults.begin(), faults.end(), std::back_inserter(result),
               [&](const TimedFault& fault) { return fault.fault.kind == kind; });
  return result;
}

// How many of those that were sent did not come; what came beside them does not count.
int missing_of(std::span<const can::Frame> sent, std::span<const can::Frame> came) {
  std::vector<can::Frame> rest(came.begin(), came.end());
  int missing = 0;
  for (const can::Frame& frame : sent) {
    const auto found = std::ranges::find(rest, frame);
    if (found == rest.end()) {
      ++missing;
    } else {
      rest.erase(found);
    }
  }
  return missing;
}

void require_possible(const std::vector<TimedFault>& faults, bool in_process) {
  for (const TimedFault& fault : faults) {
    const FaultKindInfo& info = info_of(fault.fault.kind);
    if (!possible(fault.fault, in_process)) {
      throw std::runtime_error(
          info.real_bus ? fmt::format("the fault {} needs a real bus: use --bus can:IFACE", info.name)
                        : fmt::format("the fault {} needs the controller in this process: use --bus inproc",
                                      info.name));
    }
  }
}

}  // namespace

FaultySeat::FaultySeat(const SoundParts& parts, const std::vector<TimedFault>& faults, std::uint64_t seed,
                       double torque_scale)
    : parts_(parts) {
  require_possible(faults, parts_.controller != nullptr);
  std::vector<TimedFault> sorted = faults;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const TimedFault& a, const TimedFault& b) { return a.fault.kind < b.fault.kind; });
  at_seat_ = std::make_unique<LinkTap>(add_link_faults(sorted, seed));
  add_part_faults(sorted, seed, torque_scale);
  seat_ = std::make_unique<Seat>(SeatParts{.robot = parts_.robot,
                                           .plant = plants_.empty() ? parts_.plant : *plants_.back(),
                                           .drives = drives_.empty() ? parts_.drives : *drives_.back(),
                                           .camera = cameras_.empty() ? parts_.camera : *cameras_.back(),
                                           .link = *at_seat_});
}

// From the controller outwards.
ControllerLink& FaultySeat::add_link_faults(const std::vector<TimedFault>& faults, std::uint64_t seed) {
  std::vector<LinkFault> outages;
  for (const TimedFault& fault : of_kind(faults, FaultKind::brown_out)) {
    outages.push_back({.from = fault.from, .until = fault.until});
    reboots_.push_back(fault.until);
  }
  ControllerLink* controller = &parts_.link;
  for (const TimedFault& fault : of_kind(faults, FaultKind::weight_flips)) {
    links_.push_back(std::make_unique<WeightFlips>(*controller, fault, random_of(fault, seed)));
    controller = links_.back().get();
  }
  links_.push_back(std::make_unique<FaultyLink>(*controller, std::move(outages),
                                                [controller = parts_.controller] { *controller = {}; }));
  at_controller_ = std::make_unique<LinkTap>(*links_.back());
  ControllerLink* outermost = at_controller_.get();
  for (const TimedFault& fault : of_kind(faults, FaultKind::second_controller)) {
    links_.push_back(std::make_unique<SecondController>(*outermost, fault));
    outermost = links_.back().get();
  }
  std::vector<std::unique_ptr<FrameFault>> frame_faults;
  for (const TimedFault& fault : faults) {
    auto made = make_frame_fault(fault, random_of(fault, seed));
    if (!made && parts_.controller != nullptr) {
      made = make_node_fault(fault, random_of(fault, seed), *parts_.controller);
    }
    if (!made && !parts_.interface.empty()) {
      made = make_foreign_frames(fault, random_of(fault, seed), parts_.interface);
    }
    if (made) {
      frame_faults.push_back(std::move(made));
    }
  }
  links_.push_back(std::make_unique<LinkFaults>(*outermost, std::move(frame_faults)));
  return *links_.back();
}

void FaultySeat::add_part_faults(const std::vector<TimedFault>& faults, std::uint64_t seed,
                                 double torque_scale) {
  if (torque_scale != 1.0) {
    plants_.push_back(std::make_unique<ScaledPlant>(parts_.plant, torque_scale));
  }
  for (const TimedFault& fault : of_place(faults, FaultPlace::camera)) {
    Camera& camera = cameras_.empty() ? parts_.camera : *cameras_.back();
    cameras_.push_back(std::make_unique<CameraFault>(camera, fault, random_of(fault, seed), clock_.next()));
  }
  for (const TimedFault& fault : of_place(faults, FaultPlace::drives)) {
    WheelDrives& drives = drives_.empty() ? parts_.drives : *drives_.back();
    drives_.push_back(std::make_unique<DriveFault>(drives, fault));
  }
  for (const TimedFault& fault : of_place(faults, FaultPlace::plant)) {
    Plant& plant = plants_.empty() ? parts_.plant : *plants_.back();
    plants_.push_back(std::make_unique<PlantFault>(plant, parts_.robot, fault, clock_.next()));
  }
}

WatchedParts FaultySeat::watched() const {
  return {
      .at_seat = *at_seat_, .at_controller = *at_controller_, .drives = parts_.drives, .plant = parts_.plant};
}

int FaultySeat::frames_not_through() const {
  return missing_of(at_seat_->to_controller(), at_controller_->to_controller()) +
         missing_of(at_controller_->from_controller(), at_seat_->from_controller());
}

std::vector<std::uint32_t> FaultySeat::reboots() const {
  return reboots_;
}

}  // namespace striker::sil
