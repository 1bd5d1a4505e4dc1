// SPDX-License-Identifier: Apache-2.0
// A clean stop on SIGINT, SIGTERM or SIGHUP: the signal sets a flag, and ends blocking calls with EINTR. A hang-up that
// was ignored before, as nohup does, stays ignored. A file that grows beyond the process's limit is a write that fails,
// and no signal any more.
#pragma once

namespace striker::host {

void catch_stop_signals();
[[nodiscard]] bool stop_requested();

}  // namespace striker::host
