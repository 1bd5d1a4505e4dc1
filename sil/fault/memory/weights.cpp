// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/memory/weights.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "firmware/policy/built_in.hpp"
#include "firmware/policy/network.hpp"

namespace striker::sil {

namespace {

template <class Layer>
std::span<std::byte> writable(const Layer& layer) {
  const auto bytes = std::as_writable_bytes(std::span(const_cast<Layer*>(&layer), 1));
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t before = reinterpret_cast<std::uintptr_t>(bytes.data()) % page;
  if (mprotect(bytes.data() - before, before + bytes.size(), PROT_READ | PROT_WRITE) != 0) {
    throw std::runtime_error(
        fmt::format("the policy's weights cannot be made writable ({}): leave weight_flips out",
                    std::generic_category().message(errno)));
  }
  return bytes;
}

}  // namespace

std::vector<std::span<std::byte>> writable_weights() {
  using Weights = policy::Packed<policy::built_in>;
  return []<std::size_t... n>(std::index_sequence<n...>) {
    return std::vector{writable(Weights::template layer<n>)...};
  }
  (std::make_index_sequence<Weights::layers>{});
}

}  // namespace striker::sil
