// SPDX-License-Identifier: Apache-2.0
#include "sil/fault/memory/node_faults.hpp"

#include <cstddef>

#include "sil/fault/memory/weights.hpp"

namespace striker::sil {

namespace {

// Off the bus no frame passes, SYNC included; error passive, every one.
class Health final : public FrameFault {
 public:
  Health(const TimedFault& fault, InProcessLink& controller) : fault_(fault), controller_(&controller) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override {
    controller_->set_health(fault_.lasts(tick) ? health() : can::BusHealth::active);
    lose(tick, frames);
  }
  void from_controller(std::uint32_t tick, std::vector<can::Frame>& frames) override { lose(tick, frames); }

 private:
  [[nodiscard]] can::BusHealth health() const {
    switch (fault_.fault.kind) {
      case FaultKind::bus_off:
        return can::BusHealth::bus_off;
      case FaultKind::error_passive:
        return can::BusHealth::error_passive;
      default:
        return can::BusHealth::active;
    }
  }

  void lose(std::uint32_t tick, std::vector<can::Frame>& frames) const {
    if (fault_.lasts(tick) && fault_.fault.kind != FaultKind::error_passive) {
      frames.clear();
    }
  }

  TimedFault fault_;
  InProcessLink* controller_;
};

void flip(std::span<std::byte> memory, std::uint64_t bit) {
  memory[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
}

class StateFlips final : public FrameFault {
 public:
  StateFlips(const TimedFault& fault, const Random& random, InProcessLink& controller)
      : fault_(fault), random_(random), controller_(&controller) {}

  void to_controller(std::uint32_t tick, std::vector<can::Frame>&) override {
    for (std::uint32_t i = 0; tick == fault_.from && i < fault_.fault.count; ++i) {
      const auto memory = controller_->node_memory();
      flip(memory, random_.below(8 * memory.size()));
    }
  }

 private:
  TimedFault fault_;
  Random random_;
  InProcessLink* controller_;
};

// The weights serve every run of the process: what was flipped is flipped back.
class WeightFlips final : public FrameFault {
 public:
  WeightFlips(const TimedFault& fault, const Random& random) : fault_(fault), random_(random) {}
  ~WeightFlips() override { restore(); }

  void to_controller(std::uint32_t tick, std::vector<can::Frame>&) override {
    if (tick == fault_.from) {
      damage();
    } else if (tick == fault_.until) {
      restore();
    }
  }

 private:
  struct Flipped {
    std::span<std::byte> layer;
    std::uint64_t bit = 0;
  };

  void damage() {
    const auto layers = writable_weights();
    std::uint64_t bits = 0;
    for (const auto& layer : layers) {
      bits += 8 * layer.size();
    }
    for (std::uint32_t i = 0; i < fault_.fault.count; ++i) {
      std::uint64_t bit = random_.below(bits);
      auto layer = layers.begin();
      for (; bit >= 8 * layer->size(); ++layer) {
        bit -= 8 * layer->size();
      }
      flip(*layer, bit);
      flipped_.push_back({*layer, bit});
    }
  }

  void restore() {
    for (const Flipped& one : flipped_) {
      flip(one.layer, one.bit);
    }
    flipped_.clear();
  }

  TimedFault fault_;
  Random random_;
  std::vector<Flipped> flipped_;
};

}  // namespace

std::unique_ptr<FrameFault> make_node_fault(const TimedFault& fault, const Random& random,
                                            InProcessLink& controller) {
  switch (fault.fault.kind) {
    case FaultKind::bus_off:
    case FaultKind::error_passive:
    case FaultKind::interface_down:
      return std::make_unique<Health>(fault, controller);
    case FaultKind::state_flips:
      return std::make_unique<StateFlips>(fault, random, controller);
    case FaultKind::weight_flips:
      return std::make_unique<WeightFlips>(fault, random);
    default:
      return nullptr;
  }
}

}  // namespace striker::sil
