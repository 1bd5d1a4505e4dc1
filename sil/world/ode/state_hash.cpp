// SPDX-License-Identifier: Apache-2.0
#include "sil/world/ode/state_hash.hpp"

#include <bit>

namespace striker::sil {
namespace {

class Fnv1a {
 public:
  void add(std::uint64_t word) {
    constexpr unsigned bits = 64;
    constexpr unsigned byte_bits = 8;
    for (unsigned shift = 0; shift < bits; shift += byte_bits) {
      value_ = (value_ ^ ((word >> shift) & 0xFFU)) * prime;
    }
  }
  void add(std::span<const dReal> numbers) {
    for (const dReal number : numbers) {
      add(std::bit_cast<std::uint64_t>(number));
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t prime = 0x100000001B3;
  std::uint64_t value_ = 0xCBF29CE484222325;  // the offset basis
};

void hash_body(Fnv1a& hash, dBodyID body) {
  constexpr std::size_t axes = 3;
  constexpr std::size_t quaternion = 4;
  hash.add({dBodyGetPosition(body), axes});
  hash.add({dBodyGetQuaternion(body), quaternion});
  hash.add({dBodyGetLinearVel(body), axes});
  hash.add({dBodyGetAngularVel(body), axes});
}

}  // namespace

std::uint64_t state_hash(std::span<const Robot> robots, const Ball& ball) {
  Fnv1a hash;
  for (const Robot& robot : robots) {
    hash_body(hash, robot.body);
    for (dBodyID wheel : robot.wheels) {
      hash_body(hash, wheel);
    }
    hash.add(robot.on_field ? 1U : 0U);
  }
  hash_body(hash, ball.body);
  return hash.value();
}

}  // namespace striker::sil
