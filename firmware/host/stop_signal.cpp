// SPDX-License-Identifier: Apache-2.0
#include "firmware/host/stop_signal.hpp"

#include <csignal>

namespace striker::host {

namespace {

// A signal handler may write nothing but such a flag (C++ [support.signal]).
volatile std::sig_atomic_t stop_flag = 0;

}  // namespace

void catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_flag = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, nullptr);
  struct sigaction before {};
  if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
    sigaction(SIGHUP, &action, nullptr);
  }
}

bool stop_requested() {
  return stop_flag != 0;
}

}  // namespace striker::host
