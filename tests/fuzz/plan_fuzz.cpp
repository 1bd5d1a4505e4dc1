// SPDX-License-Identifier: Apache-2.0
// A plan of faults from anywhere is read, or refused with one line that names it; written, it is the same plan.
#include <stdexcept>
#include <string_view>

#include "sil/fault/plan/fault_plan.hpp"
#include "sil/fault/plan/plan_file.hpp"
#include "tests/fuzz/support/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace striker;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const sil::FaultPlan plan = sil::parse_plan(text, "fuzz.toml");
    const std::string written = sil::plan_text(plan);
    fuzz::require(sil::plan_text(sil::parse_plan(written, "written.toml")) == written,
                  "a written plan is its own");
    for (const sil::FaultCase& fault_case : plan.cases) {
      static_cast<void>(sil::timed(fault_case.faults, 100));
      static_cast<void>(sil::in_words(fault_case.faults));
    }
  } catch (const std::runtime_error& error) {
    fuzz::require(std::string_view(error.what()).starts_with("fuzz.toml"), "an error names its file");
  }
  return 0;
}
