// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/ranks.hpp"

#ifdef STRIKER_HAS_MPI
#include <mpi.h>
#endif

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "firmware/host/files.hpp"

namespace striker::training {

#ifdef STRIKER_HAS_MPI

namespace {

constexpr int tag = 1;

void send(const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, tag, MPI_COMM_WORLD);
}

std::string receive(int from) {
  MPI_Status status;
  int size = 0;
  MPI_Probe(from, tag, MPI_COMM_WORLD, &status);
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string text(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_CHAR, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return text;
}

}  // namespace

Ranks::Ranks() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr) {
    return;
  }
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised != 0) {
    MPI_Finalize();
  }
}

// A file is two messages, its path and its content; an empty path ends a rank's list.
void Ranks::collect(const std::vector<std::filesystem::path>& files) const {
  if (rank_ > 0) {
    for (const auto& file : files) {
      send(file.string());
      send(host::read_file(file));
    }
    send("");
    return;
  }
  for (int from = 1; from < size_; ++from) {
    for (std::string path = receive(from); !path.empty(); path = receive(from)) {
      const std::string content = receive(from);
      if (!std::filesystem::exists(path)) {
        host::require_writable(std::filesystem::path(path).parent_path());
        host::write_file(path, content);
      }
    }
  }
}

int Ranks::sum(int value) const {
  int total = value;
  if (size_ > 1) {
    MPI_Allreduce(&value, &total, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  }
  return total;
}

#else

Ranks::Ranks() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr) {
    throw std::runtime_error(
        "mpirun: this program was built without Open MPI; install libopenmpi-dev, build again");
  }
}
Ranks::~Ranks() = default;
void Ranks::collect(const std::vector<std::filesystem::path>& /*files*/) const {}
int Ranks::sum(int value) const {
  return value;
}

#endif

}  // namespace striker::training
