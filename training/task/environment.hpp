// SPDX-License-Identifier: Apache-2.0
// A task as a learner sees it: episodes that can be drawn again, a situation as numbers, actions, rewards, an
// end.
//
// `Environment` is what learner, training, evaluation and export need of one. They are templates over it, as
// they call it in every decision; which one a run plays is chosen once, from the configuration
// (environments.hpp). One episode:
//
//   env.reset(seed, episode);
//   for (bool end = false; !end;) {
//     end = env.step(choose(env.features())).end;
//   }
//
// Cost: a decision of the kick on the plane takes about 0.2 us, among wheel bodies 40 us. Neither `reset` nor
// `step` allocates.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>

#include "training/task/state.hpp"

namespace striker::training {

struct StepResult {
  double reward = 0.0;   // of this decision
  bool success = false;  // what the task is about happened in this decision: for the kick, the first contact
  bool last = false;     // this was the episode's last possible decision
  bool end = false;      // of the episode, for a learner
  // The episode ended because its time was over, not because of what happened: in the state after it the task would
  // have gone on (Gymnasium's "truncated"). False: nothing after the end is worth anything.
  bool truncated = false;
};

template <class E>
concept Environment = requires(E env, const E& seen, std::uint64_t number, int action) {
  // How the episode went so far: a value with a `reward` (their sum), and whatever else the task reports.
  typename E::Outcome;
  { seen.outcome() } -> std::same_as<const typename E::Outcome&>;
  { seen.outcome().reward } -> std::convertible_to<double>;
  { seen.success() } -> std::same_as<bool>;

  // To the start of episode (seed, episode): the same one however often, whatever was played before.
  { env.reset(number, number) } -> std::same_as<void>;
  // Action 0 to actions - 1. To be called until `last` at the most.
  { env.step(action) } -> std::same_as<StepResult>;

  // What a network reads now, one value an input; and the same as the controller's integers, for inputs it
  // knows.
  { seen.features() } -> std::same_as<const Features&>;
  { seen.raw() } -> std::same_as<RawState>;

  // No further decision can change the outcome, or there is none left; and the time after the last decision
  // in which it may still become known.
  { seen.settled() } -> std::same_as<bool>;
  { env.finish() } -> std::same_as<void>;
};

// Plays an episode by a rule, int(const E&), until its outcome is known.
template <Environment E, class Rule>
typename E::Outcome play(E& env, std::uint64_t seed, std::uint64_t episode, Rule&& choose) {
  env.reset(seed, episode);
  while (!env.settled()) {
    env.step(choose(std::as_const(env)));
  }
  env.finish();
  return env.outcome();
}

}  // namespace striker::training
