# Toolchain file for bare-metal Arm, after -DSTRIKER_CPU=<name as in -mcpu>. The presets call it.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES STRIKER_CPU)

if(STRIKER_CPU STREQUAL "cortex-r5")
  set(instructions -marm)
else()
  set(instructions -mthumb)
endif()
set(CMAKE_CXX_FLAGS_INIT
    "-mcpu=${STRIKER_CPU} ${instructions} -mfloat-abi=soft -ffunction-sections -fdata-sections -fno-threadsafe-statics")
