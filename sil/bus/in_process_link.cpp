#include "sil/bus/in_process_link.hpp"

namespace striker::sil {

void InProcessLink::exchange(std::uint32_t, std::span<const can::Frame> sent,
                             std::vector<can::Frame>& answer) {
  for (const can::Frame& frame : sent) {
    if (clock_.take(frame, outputs_)) {
      answer.insert(answer.end(), outputs_.frames().begin(), outputs_.frames().end());
    }
  }
}

}  // namespace striker::sil
