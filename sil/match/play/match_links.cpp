// SPDX-License-Identifier: Apache-2.0
#include "sil/match/play/match_links.hpp"

#include "sil/bus/in_process_link.hpp"
#include "sil/match/play/robot_kind.hpp"

namespace striker::sil {

MatchLinks links_in_process() {
  MatchLinks links;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    const RobotKind kind = kind_of(robot);
    const core::RobotProfile profile = core::profile_of(*kind.description);
    if (kind.role == Role::forward) {
      links[robot] = std::make_unique<InProcessLink>(profile);
    } else {
      links[robot] = std::make_unique<NodeLink<loop::OrderedNode>>(profile);
    }
  }
  return links;
}

MatchLinks links_on_can(const std::string& prefix, const SocketCanOptions& options) {
  MatchLinks links;
  for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
    links[robot] = std::make_unique<LockstepLink>(prefix + std::to_string(robot), options);
  }
  return links;
}

}  // namespace striker::sil
