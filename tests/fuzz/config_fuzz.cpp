// SPDX-License-Identifier: Apache-2.0
// A training configuration from anywhere is read, or refused with one line that names it; its canonical text is
// the same configuration.
#include "training/run/config.hpp"

#include <stdexcept>
#include <string_view>

#include "tests/fuzz/support/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const training::Config config = training::parse_config(text, "fuzz.toml");
    static_cast<void>(training::setup_of(config));
    fuzz::require(training::parse_config(config.text, "fuzz.toml").text == config.text,
                  "the canonical text is its own");
  } catch (const std::runtime_error& error) {
    const std::string_view what = error.what();
    fuzz::require(what.starts_with("fuzz.toml: "), "an error names its file");
  }
  return 0;
}
