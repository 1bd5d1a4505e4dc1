// SPDX-License-Identifier: Apache-2.0
#include "firmware/programs/replay_log.hpp"

#include <vector>

#include "firmware/loop/built_in_node.hpp"
#include "firmware/loop/frame_queue.hpp"
#include "firmware/loop/sync_ticks.hpp"
#include "firmware/loop/tick_loop.hpp"

namespace striker {

host::ReplayReport replay_log(const std::filesystem::path& file, const std::string& interface,
                              std::uint32_t seed, const std::function<bool()>& stop) {
  host::LockstepLog log(file, interface);
  loop::TickLoop<loop::BuiltInNode, loop::FrameQueue, loop::SyncTicks> loop(loop::built_in_robot, {}, {},
                                                                            seed);
  return host::replay(
      log,
      [&](const host::LoggedTick& tick) {
        std::vector<can::Frame> answer;
        for (const can::Frame& frame : tick.inputs) {
          loop.bus().push(frame);
          if (loop.turn()) {
            const auto sent = loop.bus().sent();
            answer.insert(answer.end(), sent.begin(), sent.end());
          }
        }
        return answer;
      },
      stop);
}

}  // namespace striker
