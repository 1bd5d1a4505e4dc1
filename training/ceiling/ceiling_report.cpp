// SPDX-License-Identifier: Apache-2.0
#include "training/ceiling/ceiling_report.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "firmware/core/robot_ranges.hpp"
#include "firmware/host/version.hpp"
#include "training/ceiling/ceiling_figures.hpp"

namespace striker::training {

namespace {

constexpr std::string_view action_letters = "fsb";

std::string world_name(Physics physics) {
  return physics == Physics::planar ? "fast" : "full";
}

std::string line_of(const std::string& label, const sil::KickSummary& summary, double ceiling) {
  return fmt::format("{:<34}{:>8.3f}{:>8.1f} %{:>8.1f} %{:>8.1f} %\n", label, summary.mean_reward,
                     100.0 * score(summary.mean_reward, ceiling), 100.0 * summary.contact_rate,
                     100.0 * summary.kick_rate);
}

nlohmann::ordered_json json_of(const sil::KickSummary& summary, double ceiling) {
  return {{"mean_reward", summary.mean_reward},
          {"standard_error", summary.reward_ci95 / 1.96},
          {"score", score(summary.mean_reward, ceiling)},
          {"contact_rate", summary.contact_rate},
          {"kick_rate", summary.kick_rate}};
}

}  // namespace

std::string ceiling_table(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  const CeilingFigures figures = ceiling_figures(options, episodes);
  const auto& [mean, standard_error] = figures.ceiling;
  std::string table = fmt::format(
      "{}{} episodes, seed {}, pose {}; replays and rivals in the {} world\n"
      "ceiling: mean reward {:.4f}, standard error {:.4f}; contact is possible in {:.1f} % of the episodes\n"
      "replayed, the best actions make the contact that was found in {:.2f} % of the episodes\n\n"
      "{:<34}{:>8}{:>10}{:>10}{:>10}\n",
      options.reward == sil::KickReward::aimed ? "the aimed kick: " : "", options.episodes, options.seed,
      options.pose == sil::PoseMode::origin ? "origin" : "anywhere", world_name(options.replay), mean,
      standard_error, 100.0 * figures.contact_possible, 100.0 * figures.found_again, "", "reward", "score",
      "contacts", "kicks");
  const std::array replays = {"replayed: the best", "replayed: the best off the edges",
                              "replayed: the better of the two"};
  for (std::size_t i = 0; i < replays.size(); ++i) {
    table += line_of(replays.at(i), figures.replays.at(i).summary, mean);
  }
  for (const auto& [name, summary] : figures.rivals) {
    table += line_of(name, summary, mean);
  }
  return table;
}

std::string ceiling_json(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  const CeilingFigures figures = ceiling_figures(options, episodes);
  const auto& [mean, standard_error] = figures.ceiling;
  nlohmann::ordered_json report = {{"episodes", options.episodes},
                                   {"seed", options.seed},
                                   {"pose", options.pose == sil::PoseMode::origin ? "origin" : "anywhere"},
                                   {"position_cell_mm", options.grid.position_cell_m * 1e3},
                                   {"speed_cell_mm_s", options.grid.speed_cell_m_s * 1e3},
                                   {"mean_reward", mean},
                                   {"standard_error", standard_error},
                                   {"contact_possible", figures.contact_possible},
                                   {"world", world_name(options.replay)},
                                   {"found_again", figures.found_again}};
  if (options.reward == sil::KickReward::aimed) {
    report["task"] = "aimed";
  }
  for (const core::RobotKey& key : core::robot_keys) {
    report["robot"][std::string(key.name)] = options.grid.robot.*key.member;
  }
  for (const auto& [name, summary] : figures.replays) {
    report["replay"][name] = json_of(summary, mean);
  }
  for (const auto& [name, summary] : figures.rivals) {
    report["rivals"][name] = json_of(summary, mean);
  }
  host::stamp(report);
  return report.dump(2) + "\n";
}

std::string ceiling_csv(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  std::string csv =
      "episode,reward,contact_step,safe_reward,replay_reward,safe_replay_reward,actions,safe_actions";
  for (const Rival rival : all_rivals) {
    csv += options.rivals ? fmt::format(",{}", name_of(rival)) : "";
  }
  const auto letters = [](const ActionSequence& actions) {
    std::string text;
    for (const std::uint8_t action : actions) {
      text += action_letters[action];
    }
    return text;
  };
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const auto& [ceiling, best_replay, safe_replay, rivals] = episodes[i];
    csv += fmt::format("\n{},{},{},{},{},{},{},{}", i, ceiling.best.reward, ceiling.best.contact_step,
                       ceiling.safe.reward, best_replay.reward, safe_replay.reward,
                       letters(ceiling.best.actions), letters(ceiling.safe.actions));
    for (const sil::KickOutcome& outcome : rivals) {
      csv += options.rivals ? fmt::format(",{}", outcome.reward) : "";
    }
  }
  return csv + "\n";
}

}  // namespace striker::training
