// The bus as a candump log (the format of candump -L and of canplayer, python-can and SavvyCAN):
//   (0000000012.345000) vcan0 050#1122334455667788
// Stamps are logical time, the interface column is always vcan0: same seed, same bytes.
#pragma once

#include <cstdint>

#include "firmware/can/frame.hpp"
#include "firmware/host/atomic_file.hpp"

namespace striker::sil {

void write_candump(host::AtomicFile& log, std::int64_t stamp_us, const can::Frame& frame);

}  // namespace striker::sil
