// SPDX-License-Identifier: Apache-2.0
#include "sil/record/candump_log.hpp"

#include "sil/record/candump_text.hpp"

namespace striker::sil {

void CandumpLog::end_tick(const Snapshot& snapshot) {
  CandumpText text;
  for (std::size_t robot = 0; robot < snapshot.robots.size(); ++robot) {
    for (const StampedFrame& stamped : snapshot.robots[robot].frames) {
      append_line(text, robot, stamped);
    }
  }
  file_.write({text.data(), text.size()});
  file_.flush();
}

}  // namespace striker::sil
