// SPDX-License-Identifier: Apache-2.0
// striker-sil: the world around the controller, in lockstep or at wall-clock speed.
#include <fmt/format.h>

#include <stdexcept>

#include "firmware/host/command_line.hpp"
#include "firmware/host/stop_signal.hpp"
#include "firmware/policy/built_in.hpp"
#include "sil/bus/controller_messages.hpp"
#include "sil/programs/campaign_command.hpp"
#include "sil/programs/fault_command.hpp"
#include "sil/programs/kick_command.hpp"
#include "sil/programs/match/league_command.hpp"
#include "sil/programs/match/match_command.hpp"
#include "sil/programs/replay_command.hpp"

using namespace striker;
using namespace striker::sil;

int main(int argc, char** argv) {
  CLI::App app("Software in the loop: an AI Soccer world around the kick controller.", "striker-sil");
  app.require_subcommand(1);
  CLI::App* kick = app.add_subcommand("kick", "play the official kick task");
  KickOptions kick_options;
  define(*kick, kick_options);
  CLI::App* faults = app.add_subcommand("faults", "play the kick task with everything that can go wrong");
  FaultOptions fault_options;
  define(*faults, fault_options);
  CLI::App* campaign = app.add_subcommand("campaign", "play many random combinations of faults");
  CampaignOptions campaign_options;
  define(*campaign, campaign_options);
  CLI::App* match = app.add_subcommand("match", "play AI Soccer, five against five");
  MatchOptions match_options;
  define(*match, match_options);
  CLI::App* league = app.add_subcommand("league", "play every two of some teams, many times");
  LeaguePlan league_plan;
  define(*league, league_plan);
  CLI::App* replay =
      app.add_subcommand("replay", "give a recorded run's frames to a controller, and compare");
  ReplayOptions replay_options;
  define(*replay, replay_options);
  return host::run(
      app, argc, argv,
      [&] {
        host::catch_stop_signals();
        if (has_foreign_drives && !kick->parsed()) {
          throw std::runtime_error(
              "this build's robot has drives of another make: there is 'kick' for them. Everything else knows Striker's "
              "own: configure with a description without drives = \"...\" (-DSTRIKER_ROBOT=FILE.toml)");
        }
        if (campaign->parsed()) {
          return play_campaign(campaign_options);
        }
        if (match->parsed()) {
          return play_match(match_options);
        }
        if (league->parsed()) {
          return play_league(league_plan);
        }
        if (replay->parsed()) {
          return play_replay(replay_options);
        }
        return faults->parsed() ? play_faults(fault_options) : play_kicks(kick_options);
      },
      fmt::format("policy {} {:08x}", policy::built_in_name, policy::built_in.identity));
}
