// SPDX-License-Identifier: Apache-2.0
// Ten robots that have jammed in a corner, 100 steps of 10 ms, to be counted by callgrind.
#include "tests/world/match/drivers.hpp"

extern "C" [[gnu::noinline]] void counted_corner(striker::sil::World& world,
                                                 const striker::sil::WorldConfig& config) {
  striker::sil::press(world, config, 1.6, 1.0);
}

int main() {
  const striker::sil::WorldConfig config = striker::sil::match_world(0.010);
  striker::sil::World world(config);
  striker::sil::place_for_corner(world);
  striker::sil::press(world, config, 1.6, 1.0);
  counted_corner(world, config);
}
