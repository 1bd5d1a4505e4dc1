// SPDX-License-Identifier: Apache-2.0
#include "sil/task/kick_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "firmware/host/atomic_file.hpp"
#include "firmware/host/version.hpp"
#include "sil/task/mean_estimate.hpp"

namespace striker::sil {
namespace {

bool was_driven(const KickRun& run, std::uint64_t episode) {
  return std::find(run.undriven.begin(), run.undriven.end(), episode) == run.undriven.end();
}

nlohmann::ordered_json row_json(std::uint64_t episode, const KickOutcome& outcome, bool driven) {
  nlohmann::ordered_json row = {{"episode", episode},
                                {"contact", outcome.contact},
                                {"contact_decision", nullptr},
                                {"theta_contact_rad", nullptr},
                                {"v_contact_m_s", nullptr},
                                {"front_face", nullptr},
                                {"reward", outcome.reward},
                                {"ball_speed_m_s", nullptr},
                                {"ball_angle_rad", nullptr},
                                {"kicked", outcome.kicked},
                                {"driven", driven}};
  if (outcome.contact) {
    row["contact_decision"] = outcome.contact_decision;
    row["theta_contact_rad"] = outcome.theta_contact_rad;
    row["v_contact_m_s"] = outcome.v_contact_m_s;
    row["front_face"] = outcome.front_face;
  }
  if (outcome.ball_measured) {
    row["ball_speed_m_s"] = outcome.ball_speed_m_s;
    row["ball_angle_rad"] = outcome.ball_angle_rad;
  }
  return row;
}

double realtime_factor(const KickRun& run) {
  return run.wall_s > 0.0 ? run.simulated_s / run.wall_s : 0.0;
}

nlohmann::ordered_json run_json(const KickRun& run) {
  const KickSummary summary = kick_summary(run.episodes);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < run.episodes.size(); ++i) {
    const std::uint64_t episode = run.first_episode + i;
    rows.push_back(row_json(episode, run.episodes[i], was_driven(run, episode)));
  }
  nlohmann::ordered_json report = {{"episodes", run.episodes.size()},
                                   {"mean_reward", summary.mean_reward},
                                   {"reward_ci95", summary.reward_ci95},
                                   {"contact_rate", summary.contact_rate},
                                   {"kick_rate", summary.kick_rate},
                                   {"seed", run.seed},
                                   {"plant", run.plant},
                                   {"pose", run.pose},
                                   {"policy_name", run.policy_name},
                                   {"policy", run.policy},
                                   {"undriven_episodes", run.undriven},
                                   {"simulated_s", run.simulated_s},
                                   {"wall_s", run.wall_s},
                                   {"realtime_factor", realtime_factor(run)},
                                   {"rows", std::move(rows)}};
  if (!run.robot.empty()) {
    report["robot"] = run.robot;
  }
  if (!run.variation.empty()) {
    report["variation"] = run.variation;
  }
  host::stamp(report);
  return report;
}

std::string cell(bool known, double value, int decimals) {
  return known ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string row_text(std::uint64_t episode, const KickOutcome& outcome, bool driven) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  return fmt::format("{:>7}  {:>7}  {:>9}  {:>9}  {:>8.3f}  {:>10}  {:>10}  {:>6}{}\n", episode,
                     outcome.contact ? "yes" : "no",
                     cell(outcome.contact, outcome.theta_contact_rad * degrees, 1),
                     cell(outcome.contact, outcome.v_contact_m_s, 3), outcome.reward,
                     cell(outcome.ball_measured, outcome.ball_speed_m_s, 3),
                     cell(outcome.ball_measured, outcome.ball_angle_rad * degrees, 1),
                     outcome.kicked ? "yes" : "no", driven ? "" : "  not driven");
}

}  // namespace

KickSummary kick_summary(const std::vector<KickOutcome>& episodes) {
  KickSummary summary;
  if (episodes.empty()) {
    return summary;
  }
  const auto count = static_cast<double>(episodes.size());
  std::vector<double> rewards;
  rewards.reserve(episodes.size());
  for (const KickOutcome& outcome : episodes) {
    rewards.push_back(outcome.reward);
    summary.contact_rate += outcome.contact ? 1.0 / count : 0.0;
    summary.kick_rate += outcome.kicked ? 1.0 / count : 0.0;
  }
  const MeanEstimate reward = mean_estimate(rewards);
  summary.mean_reward = reward.mean;
  summary.reward_ci95 = 1.96 * reward.standard_error;
  return summary;
}

std::string row_line(std::uint64_t episode, const KickOutcome& outcome, bool driven) {
  return row_json(episode, outcome, driven).dump() + '\n';
}

void write_json(const KickRun& run, const std::filesystem::path& file) {
  host::AtomicFile out(file);
  out.write(run_json(run).dump(1) + '\n');
  out.finish();
}

std::string format_table(const KickRun& run, bool rows) {
  std::string text;
  if (rows) {
    text += fmt::format("{:>7}  {:>7}  {:>9}  {:>9}  {:>8}  {:>10}  {:>10}  {:>6}\n", "episode", "contact",
                        "theta_deg", "v_m_s", "reward", "ball_m_s", "ball_deg", "kicked");
    for (std::size_t i = 0; i < run.episodes.size(); ++i) {
      const std::uint64_t episode = run.first_episode + i;
      text += row_text(episode, run.episodes[i], was_driven(run, episode));
    }
  }
  const KickSummary summary = kick_summary(run.episodes);
  text += fmt::format(
      "{} episodes: mean reward {:.3f} +- {:.3f}, contact rate {:.3f}, kick rate {:.3f}, {:.1f} x real time\n",
      run.episodes.size(), summary.mean_reward, summary.reward_ci95, summary.contact_rate, summary.kick_rate,
      realtime_factor(run));
  if (!run.policy_name.empty()) {
    text += fmt::format("policy {} {}\n", run.policy_name, run.policy);
  }
  if (!run.undriven.empty()) {
    text += fmt::format("{} of them were not driven all along, and are no result of a policy: episodes {}\n",
                        run.undriven.size(), fmt::join(run.undriven, ", "));
  }
  return text;
}

}  // namespace striker::sil
