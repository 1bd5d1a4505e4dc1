// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/box_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sil/world/robot_specs.hpp"

namespace striker::sil {
namespace {

constexpr double shortest_line_m = 0.005;  // below it one contact is enough

// Mean place and normal of those on one side of a line across.
class End {
 public:
  void add(const dContactGeom& contact) {
    if (count_++ == 0) {
      sum_ = contact;
      lowest_m_ = highest_m_ = contact.pos[2];
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum_.pos[axis] += contact.pos[axis];
      sum_.normal[axis] += contact.normal[axis];
    }
    sum_.depth = std::max(sum_.depth, contact.depth);
    lowest_m_ = std::min(lowest_m_, contact.pos[2]);
    highest_m_ = std::max(highest_m_, contact.pos[2]);
  }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] dContactGeom mean() const {
    dContactGeom mean = sum_;
    const double length = std::sqrt(dCalcVectorDot3(sum_.normal, sum_.normal));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mean.pos[axis] /= count_;
      mean.normal[axis] /= length;
    }
    mean.pos[2] = std::clamp(centre_of_mass_height_m, lowest_m_, highest_m_);
    return mean;
  }

 private:
  int count_ = 0;
  dContactGeom sum_{};
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
};

}  // namespace

std::span<dContactGeom> reduced(std::span<dContactGeom> contacts) {
  if (contacts.size() < 2) {
    return contacts;
  }
  const dReal* normal = contacts.front().normal;
  const auto along = [across_x = -normal[1], across_y = normal[0]](const dContactGeom& contact) {
    return across_x * contact.pos[0] + across_y * contact.pos[1];
  };
  const auto [first, last] = std::ranges::minmax(contacts, {}, along);
  const double length_m = along(last) - along(first);
  const double middle = 0.5 * (along(first) + along(last));
  std::array<End, 2> ends;
  for (const dContactGeom& contact : contacts) {
    const bool beyond = length_m > shortest_line_m && along(contact) > middle;
    ends[beyond ? 1 : 0].add(contact);
  }
  std::size_t kept = 0;
  for (const End& end : ends) {
    if (!end.empty()) {
      contacts[kept++] = end.mean();
    }
  }
  return contacts.first(kept);
}

}  // namespace striker::sil
