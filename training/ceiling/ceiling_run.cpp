#include "training/ceiling/ceiling_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

namespace striker::training {

namespace {

constexpr std::string_view action_letters = "fsb";

Choice replay_of(const Actions& actions) {
  return [&actions](const KickEnv& env) -> int {
    return actions.at(static_cast<std::size_t>(sil::kick_decisions - env.decisions_left()));
  };
}

CeilingEpisode run_episode(const CeilingOptions& options, std::uint64_t number, CeilingSearch& search,
                           KickEnv& env) {
  const sil::KickStart start = sil::draw_kick(options.seed, number, options.pose);
  CeilingEpisode episode;
  episode.ceiling = search.search(start);
  episode.best_replay = play(env, options.seed, number, replay_of(episode.ceiling.best.actions));
  episode.safe_replay = play(env, options.seed, number, replay_of(episode.ceiling.safe.actions));
  if (options.rivals) {
    for (const Rival rival : all_rivals) {
      episode.rivals.at(static_cast<std::size_t>(rival)) =
          play(env, options.seed, number, rule_of(rival, options.seed, number));
    }
  }
  return episode;
}

// The better of the two replays.
const sil::KickOutcome& bound_of(const CeilingEpisode& episode) {
  return episode.safe_replay.reward > episode.best_replay.reward ? episode.safe_replay : episode.best_replay;
}

bool as_found(const Found& found, const sil::KickOutcome& replay) {
  return found.contact_step < 0 ? !replay.contact
                                : replay.contact_decision == found.contact_step / steps_per_decision &&
                                      std::abs(replay.reward - found.reward) < 0.01;
}

struct Means {
  double reward = 0.0;
  double standard_error = 0.0;
};

template <typename RewardOf>
Means means_of(const std::vector<CeilingEpisode>& episodes, const RewardOf& reward_of) {
  const auto n = static_cast<double>(episodes.size());
  Means means;
  for (const CeilingEpisode& episode : episodes) {
    means.reward += reward_of(episode) / n;
  }
  double squares = 0.0;
  for (const CeilingEpisode& episode : episodes) {
    squares += (reward_of(episode) - means.reward) * (reward_of(episode) - means.reward);
  }
  means.standard_error = episodes.size() > 1 ? std::sqrt(squares / (n - 1.0) / n) : 0.0;
  return means;
}

Means ceiling_means(const std::vector<CeilingEpisode>& episodes) {
  return means_of(episodes, [](const CeilingEpisode& episode) { return episode.ceiling.best.reward; });
}

double contact_possible(const std::vector<CeilingEpisode>& episodes) {
  const auto possible = std::ranges::count_if(
      episodes, [](const CeilingEpisode& episode) { return episode.ceiling.best.contact_step >= 0; });
  return static_cast<double>(possible) / static_cast<double>(episodes.size());
}

template <typename OutcomeOf>
sil::KickSummary summary_of(const std::vector<CeilingEpisode>& episodes, const OutcomeOf& outcome_of) {
  std::vector<sil::KickOutcome> outcomes;
  outcomes.reserve(episodes.size());
  for (const CeilingEpisode& episode : episodes) {
    outcomes.push_back(outcome_of(episode));
  }
  return sil::summarise(outcomes);
}

sil::KickSummary rival_summary(const std::vector<CeilingEpisode>& episodes, Rival rival) {
  return summary_of(episodes, [rival](const CeilingEpisode& episode) {
    return episode.rivals.at(static_cast<std::size_t>(rival));
  });
}

std::string world_name(World world) {
  return world == World::fast ? "fast" : "full";
}

// The share of the way from no contact to the ceiling.
double score(double mean_reward, double ceiling) {
  return (mean_reward - no_contact_reward) / (ceiling - no_contact_reward);
}

struct Row {
  std::string name;
  sil::KickSummary summary;
};

std::vector<Row> replay_rows(const std::vector<CeilingEpisode>& episodes) {
  return {{"best", summary_of(episodes, [](const CeilingEpisode& episode) { return episode.best_replay; })},
          {"safe", summary_of(episodes, [](const CeilingEpisode& episode) { return episode.safe_replay; })},
          {"better", summary_of(episodes, bound_of)}};
}

std::vector<Row> rival_rows(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  std::vector<Row> rows;
  for (const Rival rival : all_rivals) {
    if (options.rivals) {
      rows.push_back({std::string(name_of(rival)), rival_summary(episodes, rival)});
    }
  }
  return rows;
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

double found_again(const std::vector<CeilingEpisode>& episodes) {
  const auto count = std::ranges::count_if(episodes, [](const CeilingEpisode& episode) {
    return as_found(episode.ceiling.best, episode.best_replay);
  });
  return static_cast<double>(count) / static_cast<double>(episodes.size());
}

}  // namespace

std::vector<CeilingEpisode> run_ceiling(const CeilingOptions& options, const Reachable& reachable,
                                        const std::function<bool(int done)>& progress) {
  using namespace std::chrono_literals;
  std::vector<CeilingEpisode> episodes(static_cast<std::size_t>(options.episodes));
  std::atomic<int> next = 0;
  std::atomic<int> done = 0;
  std::atomic<int> working = options.jobs;
  std::mutex failing;
  std::exception_ptr failure;
  // Each worker has a search and a world of its own, and writes only its episodes' places.
  const auto work = [&](const std::stop_token& stopped) {
    try {
      CeilingSearch search(reachable);
      KickEnv env({.world = options.replay, .pose = options.pose});
      for (int i = next++; i < options.episodes && !stopped.stop_requested(); i = next++) {
        const auto number = static_cast<std::size_t>(i);
        episodes[number] = run_episode(options, number, search, env);
        ++done;
      }
    } catch (...) {
      const std::scoped_lock lock(failing);
      failure = std::current_exception();
      next = options.episodes;
    }
    --working;
  };
  bool complete = true;
  {
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(options.jobs));
    for (int i = 0; i < options.jobs; ++i) {
      workers.emplace_back(work);
    }
    while (working > 0) {
      std::this_thread::sleep_for(20ms);
      if (complete && !progress(done)) {
        complete = false;
        for (std::jthread& worker : workers) {
          worker.request_stop();
        }
      }
    }
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  return complete ? episodes : std::vector<CeilingEpisode>{};
}

std::string ceiling_table(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  const Means ceiling = ceiling_means(episodes);
  std::string table = fmt::format(
      "{} episodes, seed {}, pose {}; replays and rivals in the {} world\n"
      "ceiling: mean reward {:.4f}, standard error {:.4f}; contact is possible in {:.1f} % of the episodes\n"
      "replayed, the best actions make the contact that was found in {:.2f} % of the episodes\n\n"
      "{:<34}{:>8}{:>10}{:>10}{:>10}\n",
      options.episodes, options.seed, options.pose == sil::PoseMode::origin ? "origin" : "anywhere",
      world_name(options.replay), ceiling.reward, ceiling.standard_error, 100.0 * contact_possible(episodes),
      100.0 * found_again(episodes), "", "reward", "score", "contacts", "kicks");
  const std::array replays = {"replayed: the best", "replayed: the best off the edges",
                              "replayed: the better of the two"};
  const std::vector<Row> rows = replay_rows(episodes);
  for (std::size_t i = 0; i < replays.size(); ++i) {
    table += line_of(replays.at(i), rows.at(i).summary, ceiling.reward);
  }
  for (const auto& [name, summary] : rival_rows(options, episodes)) {
    table += line_of(name, summary, ceiling.reward);
  }
  return table;
}

std::string ceiling_json(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  const Means ceiling = ceiling_means(episodes);
  nlohmann::ordered_json report = {{"episodes", options.episodes},
                                   {"seed", options.seed},
                                   {"pose", options.pose == sil::PoseMode::origin ? "origin" : "anywhere"},
                                   {"position_cell_mm", options.grid.position_cell_m * 1e3},
                                   {"speed_cell_mm_s", options.grid.speed_cell_m_s * 1e3},
                                   {"mean_reward", ceiling.reward},
                                   {"standard_error", ceiling.standard_error},
                                   {"contact_possible", contact_possible(episodes)},
                                   {"world", world_name(options.replay)},
                                   {"found_again", found_again(episodes)}};
  for (const auto& [name, summary] : replay_rows(episodes)) {
    report["replay"][name] = json_of(summary, ceiling.reward);
  }
  for (const auto& [name, summary] : rival_rows(options, episodes)) {
    report["rivals"][name] = json_of(summary, ceiling.reward);
  }
  return report.dump(2) + "\n";
}

std::string ceiling_csv(const CeilingOptions& options, const std::vector<CeilingEpisode>& episodes) {
  std::string csv =
      "episode,reward,contact_step,safe_reward,replay_reward,safe_replay_reward,actions,safe_actions";
  for (const Rival rival : all_rivals) {
    csv += options.rivals ? fmt::format(",{}", name_of(rival)) : "";
  }
  const auto letters = [](const Actions& actions) {
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
