// SPDX-License-Identifier: Apache-2.0
// A live view for as long as a program plays: one address, however often a run is begun anew.
//
//   const auto view = open_view(options.view, facts, true);  // nothing without --view
//   do { status = play_once(...); } while (begins_anew(view.get(), options.seed));
//   finish(view.get(), status);
#pragma once

#include <memory>
#include <string>

#include "sil/programs/view/view_options.hpp"
#include "sil/view/live_view.hpp"
#include "sil/view/web/view_server.hpp"

namespace striker::sil {

struct ViewSession {
  ViewSession(const ViewOptions& options, const ViewFacts& facts);

  ViewExchange exchange;
  LiveView view;
  ViewServer server;
};

// Prints its address. `facts` without its faults, which follow from the bus. Throws std::runtime_error with one line.
[[nodiscard]] std::unique_ptr<ViewSession> open_view(const ViewOptions& options, ViewFacts facts,
                                                     bool in_process);

// Somebody asked for another run. It may be nothing, as below.
[[nodiscard]] bool wants_another(const ViewSession* session);
// As a run ended: whether it is to be played again, with this seed.
[[nodiscard]] bool begins_anew(const ViewSession* session, std::uint64_t& seed);
// Tells the page why it ended.
void finish(ViewSession* session, const std::string& why);

}  // namespace striker::sil
