// SPDX-License-Identifier: Apache-2.0
#include "training/ceiling/ceiling_run.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

namespace striker::training {

namespace {

ActionRule replay_of(const ActionSequence& actions) {
  return [&actions](const KickEnvironment& env) -> int {
    return actions.at(static_cast<std::size_t>(sil::kick_decisions - env.decisions_left()));
  };
}

CeilingEpisode run_episode(const CeilingOptions& options, std::uint64_t number, CeilingSearch& search,
                           KickEnvironment& env) {
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
      CeilingSearch search(reachable, options.reward);
      KickEnvironment env({.robot = reachable.grid().robot,
                           .physics = options.replay,
                           .pose = options.pose,
                           .rules = {.reward = options.reward}});
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

}  // namespace striker::training
