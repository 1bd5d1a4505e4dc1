// SPDX-License-Identifier: Apache-2.0
// What a decision of the planner costs: plays episodes with it, and prints how many decisions it took. A tool
// that counts instructions finds them under the name `counted_plan` (tools/bench-training).
#include <fmt/format.h>

#include "training/ceiling/rivals.hpp"

using namespace striker::training;

extern "C" [[gnu::noinline]] int counted_plan(const KickEnvironment& env) {
  return plan_ahead(env);
}

int main() {
  constexpr std::uint64_t seed = 1000;
  KickEnvironment env({});
  long decisions = 0;
  for (std::uint64_t episode = 0; episode < 100; ++episode) {
    env.reset(seed, episode);
    for (bool end = false; !end; ++decisions) {
      end = env.step(counted_plan(env)).end;
    }
  }
  fmt::print("{}\n", decisions);
}
