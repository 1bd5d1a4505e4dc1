// The test and measuring image, for QEMU with semihosting and `-icount shift=0`: golden vectors, a recorded
// sequence of steps, and instruction counts.
#include <array>
#include <cstdint>

#include "core/network.hpp"
#include "ports/bare_metal/instruction_counter.hpp"
#include "ports/bare_metal/memory.hpp"
#include "ports/bare_metal/semihosting.hpp"
#include STRIKER_POLICY_HEADER

namespace {
using namespace striker;
using namespace striker::bare_metal;
constexpr const auto& trained = policy::trained;
using Raw = std::array<std::int32_t, trained.inputs>;

[[gnu::noinline]] void nothing(const Raw&) {
  asm volatile("");
}
[[gnu::noinline]] void inference(const Raw& raw) {
  auto q = core::infer<trained>(raw);
  asm volatile("" ::"r"(&q) : "memory");
}
template <void (*F)(const Raw&)>
[[gnu::noinline]] std::uint32_t timed(const Raw& raw, std::uint32_t repetitions) {
  restart_counter();
  for (std::uint32_t i = 0; i < repetitions; ++i) F(raw);
  return counted();
}
}  // namespace
int main() {
  using namespace semihosting;
  int bad = 0;
  for (auto& g : trained.golden_vectors) {
    auto q = core::infer<trained>(g.raw);
    bad += q.sums != g.sums || q.action != g.action;
  }
  print_line("bad", bad);
  const auto u = counter_unit();
  const Raw raw = trained.golden_vectors[3].raw;
  auto t400 = timed<inference>(raw, 400), t0 = timed<inference>(raw, 0), n400 = timed<nothing>(raw, 400),
       n0 = timed<nothing>(raw, 0);
  print_line("t", t400);
  print_line("t0", t0);
  print_line("n", n400);
  print_line("n0", n0);
  print_line("x100", ((std::int64_t)(t400 - t0) - (n400 - n0)) * u.instructions * 100 / 400 / u.counts);
  print_line("stack", stack_high_water_bytes());
  semihosting::exit(0);
}
