#include "training/export/reward_difference.hpp"

#include <algorithm>
#include <cmath>

namespace striker::training {

RewardDifference reward_difference(const Parameters& parameters, const IntegerNetwork& network,
                                   EnvConfig task, int episodes) {
  task.world = World::full;
  task.velocities = Velocities::estimated;
  KickEnv env(task);
  Actor actor(parameters.shape());
  RewardDifference result{.episodes = episodes};
  double squares = 0.0;
  for (int i = 0; i < episodes; ++i) {
    const std::uint64_t episode = first_reward_difference_episode + static_cast<std::uint64_t>(i);
    const double exact = play(env, reward_difference_seed, episode, [&](const KickEnv& seen) {
                           return actor.choose(parameters, seen.features());
                         }).reward;
    const double integer = play(env, reward_difference_seed, episode, [&](const KickEnv& seen) {
                             return static_cast<int>(evaluate(network, seen.raw()).action);
                           }).reward;
    result.float_mean += exact / episodes;
    result.integer_mean += integer / episodes;
    squares += (integer - exact) * (integer - exact) / episodes;
  }
  const double mean = result.integer_mean - result.float_mean;
  result.standard_error = std::sqrt(std::max(0.0, squares - mean * mean) / episodes);
  return result;
}

}  // namespace striker::training
