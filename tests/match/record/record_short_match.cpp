// SPDX-License-Identifier: Apache-2.0
// Writes all records of the short match into a directory, for tests of what reads them.
#include <exception>
#include <iostream>

#include "sil/match/record/match_records.hpp"
#include "tests/match/record/short_match.hpp"

int main(int argc, char** argv) {
  using namespace striker::sil;
  if (argc != 2) {
    std::cerr << "usage: striker_record_short_match DIR\n";
    return 2;
  }
  try {
    const auto records = match_records(argv[1]);
    std::vector<MatchObserver*> observers;
    observers.reserve(records.size());
    for (const auto& record : records) {
      observers.push_back(record.get());
    }
    RecordedMatch play(observers, short_rules());
    play_short_match(play);
    play.finish();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
