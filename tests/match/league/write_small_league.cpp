// SPDX-License-Identifier: Apache-2.0
// Writes the small league's reports into a directory, for tests of what reads them.
#include <exception>
#include <iostream>

#include "sil/match/league/league_report.hpp"
#include "tests/match/league/played_league.hpp"

int main(int argc, char** argv) {
  using namespace striker::sil;
  if (argc != 2) {
    std::cerr << "usage: striker_write_small_league DIR\n";
    return 2;
  }
  try {
    write_league(league_table(small_league()), argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
