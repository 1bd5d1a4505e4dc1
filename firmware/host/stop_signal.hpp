// SPDX-License-Identifier: Apache-2.0
// A clean stop on SIGINT or SIGTERM: the signal sets a flag, and ends blocking calls with EINTR.
#pragma once

namespace striker::host {

void catch_stop_signals();
[[nodiscard]] bool stop_requested();

}  // namespace striker::host
