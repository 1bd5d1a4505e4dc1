#include "sil/bus/in_process_link.hpp"

namespace striker::sil {

void InProcessLink::send(std::uint32_t, std::span<const can::Frame> frames) {
  outputs_.clear();
  for (const can::Frame& frame : frames) {
    clock_.take(frame, outputs_);
  }
}

void InProcessLink::collect(std::uint32_t, std::vector<can::Frame>& answer) {
  answer.insert(answer.end(), outputs_.frames().begin(), outputs_.frames().end());
}

}  // namespace striker::sil
