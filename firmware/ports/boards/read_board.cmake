# SPDX-License-Identifier: Apache-2.0
# What a board is: a folder with a board.cmake, which says everything in one call. STRIKER_BOARD names a folder beside this
# file, STRIKER_BOARD_DIR any other by its path. Several boards may have the same processor.
#
#   striker_add_board(
#     NAME mps2-an386             the folder's name
#     CPU cortex-m4               as in -mcpu
#     LABEL Cortex-M4F            what tables call the processor; CPU by default
#     FLASH_ORIGIN 0x00000000     where an image lies and how much there is of it: the linker script's MEMORY
#     FLASH 4M
#     RAM_ORIGIN 0x20000000
#     RAM 4M
#     IMAGE_FLASH 48K             what of them the controller's image may take: by default 48K of flash, 64K on cores without
#     IMAGE_RAM 4K                SMLAD, and 4K of RAM, stack included
#     CLOCK_HZ 25000000           what CLOCK counts; sources see it as STRIKER_CLOCK_HZ
#     INTERRUPTS 32               lines of its interrupt controller: a vector for each, see cortex_m/startup.cpp
#     HANDLERS 20=name...         of which these are handled, by a driver's extern "C" void name(); every other is a fault
#     SOURCES file...             in every image: reset, vector table, and what hardware needs before main
#     CLOCK file...               implements bare_metal/clock.hpp
#     CAN file... | slcan         implements bare_metal/can_bus.hpp; slcan does it over UART
#     UART file...                implements bare_metal/uart.hpp; only slcan wants it
#     WATCHDOG file... | none     implements bare_metal/watchdog.hpp; none: nothing ends a hang
#     DEFINITIONS NAME=VALUE...   for the sources above
#     QEMU_MACHINE mps2-an386     QEMU's name of the board; a board without one is built, but not emulated
#     QEMU_SYSTEM program         qemu-system-arm by default
#     QEMU_ARGUMENTS word...      what starts {image}: -kernel {image} by default
#     QEMU_POWER_ON path          a processor that QEMU leaves off, as a path of its object model
#     QEMU_CAN canbus0            the machine's property for the bus of its own CAN controller
#     QEMU_CLOCK_HZ 133000000     what CLOCK counts on QEMU, if that is not CLOCK_HZ
#     QEMU_DEFINITIONS NAME...)   for the sources above, on QEMU
#
# With -DSTRIKER_FOR_QEMU=ON the last two count: images for a board whose model differs from the hardware.
#
# Files are looked for in the board's folder, then in firmware/ports/bare_metal, which has what boards share. A field that is
# missing or wrong ends the configuration: check_board.cmake says what each has to be.
include(${CMAKE_CURRENT_LIST_DIR}/check_board.cmake)

# striker_read_board(BOARD): BOARD_FOLDER and, of the call's fields, BOARD_NAME, BOARD_CPU and so on, in the caller's
# scope, with complete paths. Called without a compiler too: by the toolchain file, and by the host's build.
function(striker_read_board board)
  set(folder "${board}")
  if(NOT IS_ABSOLUTE "${board}")
    set(folder "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${board}")
  endif()
  if(NOT EXISTS "${folder}/board.cmake")
    striker_known_boards(known)
    list(JOIN known ", " known)
    message(FATAL_ERROR "STRIKER_BOARD: '${board}' is no board: there is no ${folder}/board.cmake. "
                        "Give one of ${known}, or STRIKER_BOARD_DIR, the path of a board's folder.")
  endif()
  set(BOARD_FOLDER "${folder}")
  set(BOARD_NAME "")
  include("${folder}/board.cmake")
  if(STRIKER_FOR_QEMU)
    list(APPEND BOARD_DEFINITIONS ${BOARD_QEMU_DEFINITIONS})
    if(BOARD_QEMU_CLOCK_HZ)
      set(BOARD_CLOCK_HZ ${BOARD_QEMU_CLOCK_HZ})
    endif()
  endif()
  if(NOT BOARD_NAME)
    message(FATAL_ERROR "${folder}/board.cmake: it does not call striker_add_board; "
                        "see ${CMAKE_CURRENT_FUNCTION_LIST_FILE}.")
  endif()
  foreach(field FOLDER ${striker_board_words} ${striker_board_lists})
    set(BOARD_${field} "${BOARD_${field}}" PARENT_SCOPE)
  endforeach()
endfunction()

# striker_known_boards(VARIABLE): the names of the boards beside this file.
function(striker_known_boards variable)
  file(GLOB files RELATIVE "${CMAKE_CURRENT_FUNCTION_LIST_DIR}" "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/*/board.cmake")
  list(TRANSFORM files REPLACE "/board.cmake" "")
  set(${variable} ${files} PARENT_SCOPE)
endfunction()

set(striker_board_words NAME CPU LABEL FLASH_ORIGIN FLASH RAM_ORIGIN RAM IMAGE_FLASH IMAGE_RAM CLOCK_HZ INTERRUPTS QEMU_MACHINE QEMU_SYSTEM QEMU_POWER_ON
    QEMU_CAN QEMU_CLOCK_HZ)
set(striker_board_lists HANDLERS SOURCES CLOCK CAN UART WATCHDOG DEFINITIONS QEMU_ARGUMENTS QEMU_DEFINITIONS)

function(striker_add_board)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "${striker_board_words}" "${striker_board_lists}")
  striker_check_board()
  if(ARG_CAN STREQUAL "slcan")
    set(ARG_CAN slcan_bus.cpp)
  endif()
  if(ARG_WATCHDOG STREQUAL "none")
    set(ARG_WATCHDOG no_watchdog.cpp)
  endif()
  if(NOT ARG_LABEL)
    set(ARG_LABEL ${ARG_CPU})
  endif()
  if(NOT ARG_IMAGE_FLASH)
    set(ARG_IMAGE_FLASH 48K)
    if(ARG_CPU MATCHES "^cortex-m(0|0plus|1|3)$")
      set(ARG_IMAGE_FLASH 64K)  # the same network takes more code without SMLAD
    endif()
  endif()
  if(NOT ARG_IMAGE_RAM)
    set(ARG_IMAGE_RAM 4K)
  endif()
  striker_check_memory_holds_image()
  if(NOT ARG_QEMU_SYSTEM)
    set(ARG_QEMU_SYSTEM qemu-system-arm)
  endif()
  if(NOT ARG_QEMU_ARGUMENTS)
    set(ARG_QEMU_ARGUMENTS -kernel {image})
  endif()
  foreach(field SOURCES CLOCK CAN UART WATCHDOG)
    striker_find_sources(ARG_${field} ${field})
  endforeach()
  foreach(field ${striker_board_words} ${striker_board_lists})
    set(BOARD_${field} "${ARG_${field}}" PARENT_SCOPE)
  endforeach()
endfunction()

# striker_find_sources(VARIABLE FIELD): its files become complete paths.
function(striker_find_sources variable field)
  cmake_path(GET CMAKE_CURRENT_FUNCTION_LIST_DIR PARENT_PATH ports)
  set(found "")
  foreach(file ${${variable}})
    set(here "${BOARD_FOLDER}/${file}")
    set(shared "${ports}/bare_metal/${file}")
    if(EXISTS "${here}" AND NOT IS_DIRECTORY "${here}")
      list(APPEND found "${here}")
    elseif(EXISTS "${shared}" AND NOT IS_DIRECTORY "${shared}")
      list(APPEND found "${shared}")
    else()
      striker_board_error("${field}: no ${file}, neither in the board's folder nor in ${ports}/bare_metal")
    endif()
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()
