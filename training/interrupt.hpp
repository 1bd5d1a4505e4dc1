// Ctrl-C, and SIGTERM: long work asks, and stops cleanly.
#pragma once

namespace striker::training {

inline constexpr int exit_interrupted = 130;

void watch_for_interrupt();
[[nodiscard]] bool interrupted();

}  // namespace striker::training
