// SPDX-License-Identifier: Apache-2.0
// Which of how many processes of one `mpirun` this one is, by what it puts into their environment.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace striker::sil {

struct Ranks {
  std::uint64_t rank = 0;
  std::uint64_t size = 1;
};

// Without an mpirun: the only one.
[[nodiscard]] inline Ranks ranks_of_mpirun() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (rank == nullptr || size == nullptr) {
    return {};
  }
  return {.rank = std::strtoull(rank, nullptr, 10), .size = std::strtoull(size, nullptr, 10)};
}

}  // namespace striker::sil
