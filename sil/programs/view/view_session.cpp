// SPDX-License-Identifier: Apache-2.0
#include "sil/programs/view/view_session.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "firmware/host/stop_signal.hpp"

namespace striker::sil {

ViewSession::ViewSession(const ViewOptions& options, const ViewFacts& facts)
    : view(exchange, {.speed = speed_of(options), .has_time = facts.has_time, .stop = host::stop_requested}),
      server({.address = options.bind, .port = *options.port, .facts = facts}, exchange) {}

std::unique_ptr<ViewSession> open_view(const ViewOptions& options, ViewFacts facts, bool in_process) {
  if (!options.port) {
    return nullptr;
  }
  for (const FaultKindInfo& kind : fault_kinds()) {
    if (can_begin_live(kind.kind, in_process)) {
      facts.faults.emplace_back(kind.name);
    }
  }
  auto session = std::make_unique<ViewSession>(options, facts);
  fmt::print(stderr, "striker-sil: live view: {}\n", session->server.url());
  return session;
}

bool wants_another(const ViewSession* session) {
  return session != nullptr && session->view.restart_seed();
}

bool begins_anew(const ViewSession* session, std::uint64_t& seed) {
  if (!wants_another(session) || host::stop_requested()) {
    return false;
  }
  seed = *session->view.restart_seed();
  fmt::print(stderr, "striker-sil: begun anew from the live view, with seed {}; its files begin anew too\n",
             seed);
  return true;
}

void finish(ViewSession* session, const std::string& why) {
  if (session != nullptr) {
    session->server.finish(why);
  }
}

}  // namespace striker::sil
