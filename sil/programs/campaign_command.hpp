// SPDX-License-Identifier: Apache-2.0
// `striker-sil campaign`: random combinations of faults against random robots.
#pragma once

#include <CLI/CLI.hpp>

#include "sil/scenario/campaign.hpp"

namespace striker::sil {

void define(CLI::App& campaign, CampaignOptions& options);

// The exit status: 1 if an invariant was violated.
[[nodiscard]] int play_campaign(const CampaignOptions& options);

}  // namespace striker::sil
