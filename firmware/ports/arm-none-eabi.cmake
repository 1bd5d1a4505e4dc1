# SPDX-License-Identifier: Apache-2.0
# Toolchain file for the boards: after -DSTRIKER_BOARD=, which ports/boards/read_board.cmake explains. The presets call it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES STRIKER_BOARD)

# A compiler cache does not bring back the .ci files that bare_metal/stack_usage.py reads, whatever the environment says.
set(CMAKE_CXX_COMPILER_LAUNCHER "" CACHE STRING "")

include(${CMAKE_CURRENT_LIST_DIR}/boards/read_board.cmake)
striker_read_board("${STRIKER_BOARD}")

# The vector unit's registers belong to the floating-point ABI. No other image touches them: no state to save.
if(BOARD_CPU STREQUAL "cortex-m55")
  set(abi hard)
else()
  set(abi soft)
endif()
set(CMAKE_CXX_FLAGS_INIT
    "-mcpu=${BOARD_CPU} -mthumb -mfloat-abi=${abi} -ffunction-sections -fdata-sections -fno-threadsafe-statics")

# -O3 unrolls what is not the kernel: more flash, no faster kernel. The same holds of two parts of -O2: on the Cortex-M55
# they take 460 bytes, and no processor's longest step is more than 0.6 % longer without them.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -fno-tree-vectorize -fno-inline-small-functions -DNDEBUG" CACHE STRING "")
