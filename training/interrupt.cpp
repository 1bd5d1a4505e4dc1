#include "training/interrupt.hpp"

#include <csignal>

namespace striker::training {

namespace {

volatile std::sig_atomic_t signalled = 0;

void note_signal(int /*signal*/) {
  signalled = 1;
}

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

bool interrupted() {
  return signalled != 0;
}

}  // namespace striker::training
