// SPDX-License-Identifier: Apache-2.0
// striker-dbc: prints the message table as a DBC file on standard output.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "firmware/can/dbc.hpp"
#include "firmware/host/command_line.hpp"

int main(int argc, char** argv) {
  CLI::App app("Prints the message table as a DBC file, for candump users, cantools, canmatrix, SavvyCAN.",
               "striker-dbc");
  return striker::host::run(app, argc, argv, [&] {
    striker::can::print_dbc(
        [](void*, std::string_view text) {
          if (!text.empty()) {
            std::fwrite(text.data(), 1, text.size(), stdout);
          }
        },
        nullptr);
    return 0;
  });
}
