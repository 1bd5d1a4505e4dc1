// SPDX-License-Identifier: Apache-2.0
// Runs the kernel on one set of 200 inputs, for a tool that counts its instructions:
//   kernel_probe random|zero|high|low|mixed
//   kernel_probe macs       prints the network's multiply-accumulates
#include <cstdio>
#include <limits>
#include <random>
#include <string_view>

#include "firmware/policy/built_in.hpp"
#include "tests/policy/multiply_accumulates.hpp"
#include "tests/policy/tested_infer.hpp"

namespace {

using namespace striker::policy;

using Raw = std::array<std::int32_t, built_in.inputs>;

std::int32_t draw(std::string_view set, std::mt19937& random) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (set == "random") {
    return static_cast<std::int32_t>(random()) >> (random() % 31);
  }
  if (set == "mixed") {
    return random() % 2 == 0 ? Limits::min() : Limits::max();
  }
  return set == "high" ? Limits::max() : set == "low" ? Limits::min() : 0;
}

}  // namespace

// Counted by its name.
extern "C" [[gnu::noinline]] int counted_inference(const Raw& raw) {
  return tested_infer<built_in>(raw).action;
}

int main(int argc, char** argv) {
  const std::string_view set = argc > 1 ? argv[1] : "zero";
  if (set == "macs") {
    std::printf("%zu\n", multiply_accumulates<built_in>);
    return 0;
  }
  std::mt19937 random(1);
  int actions = 0;
  for (int i = 0; i < 200; ++i) {
    Raw raw{};
    for (std::int32_t& element : raw) {
      element = draw(set, random);
    }
    actions += counted_inference(raw);
  }
  std::printf("%d\n", actions);
  return 0;
}
