// SPDX-License-Identifier: Apache-2.0
// The committed DBC is what the message table prints.
#include "firmware/can/dbc.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace striker::can {
namespace {

TEST(Dbc, TheCommittedFileIsWhatTheTablePrints) {
  std::string printed;
  print_dbc([](void* text, std::string_view piece) { static_cast<std::string*>(text)->append(piece); },
            &printed);
  std::stringstream committed;
  committed << std::ifstream(STRIKER_DBC).rdbuf();
  EXPECT_EQ(printed, committed.str()) << "run: build/bin/striker-dbc > firmware/can/striker.dbc";
}

}  // namespace
}  // namespace striker::can
