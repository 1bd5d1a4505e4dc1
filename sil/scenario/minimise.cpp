// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/minimise.hpp"

#include <cstddef>
#include <cstdint>

namespace striker::sil {

namespace {

using Fails = std::function<bool(const FaultCase&)>;

void drop_faults(FaultCase& faults, const Fails& fails) {
  for (std::size_t i = 0; i < faults.faults.size() && faults.faults.size() > 1;) {
    FaultCase fewer = faults;
    fewer.faults.erase(fewer.faults.begin() + static_cast<std::ptrdiff_t>(i));
    if (fails(fewer)) {
      faults = fewer;
    } else {
      ++i;
    }
  }
}

// Moves one end of a window by halving steps.
void shorten(FaultCase& faults, std::size_t number, bool from_end, const Fails& fails) {
  const Fault& window = faults.faults[number];
  for (std::int32_t step = (window.until_ms - window.from_ms) / 2; step > 0; step /= 2) {
    FaultCase shorter = faults;
    Fault& fault = shorter.faults[number];
    (from_end ? fault.until_ms : fault.from_ms) += from_end ? -step : step;
    if (fault.from_ms < fault.until_ms && fails(shorter)) {
      faults = shorter;
    }
  }
}

}  // namespace

FaultCase minimised(FaultCase faults, const Fails& fails) {
  drop_faults(faults, fails);
  for (std::size_t i = 0; i < faults.faults.size(); ++i) {
    shorten(faults, i, true, fails);
    shorten(faults, i, false, fails);
  }
  return faults;
}

}  // namespace striker::sil
