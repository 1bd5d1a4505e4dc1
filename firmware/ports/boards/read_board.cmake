# SPDX-License-Identifier: Apache-2.0
# What a board is: a folder with a board.cmake, which says everything in one call. STRIKER_BOARD names the folder: one
# beside this file by its name, any other by its absolute path. Several boards may have the same processor.
#
#   striker_add_board(
#     NAME mps2-an386             the folder's name
#     CPU cortex-m4               as in -mcpu
#     LABEL Cortex-M4F            what tables call the processor; CPU by default
#     FLASH_ORIGIN 0x00000000     where an image lies and how much there is of it: the linker script's MEMORY
#     FLASH 4M
#     RAM_ORIGIN 0x20000000
#     RAM 4M
#     CLOCK_HZ 25000000           what CLOCK counts; sources see it as STRIKER_CLOCK_HZ
#     INTERRUPTS 32               lines of its interrupt controller: a vector for each, see cortex_m/startup.cpp
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
# Files are looked for in the board's folder, then in firmware/ports/bare_metal, which has what boards share.

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
                        "Give one of ${known}, or the absolute path of a board's folder.")
  endif()
  set(BOARD_FOLDER "${folder}")
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

set(striker_board_words NAME CPU LABEL FLASH_ORIGIN FLASH RAM_ORIGIN RAM CLOCK_HZ INTERRUPTS QEMU_MACHINE QEMU_SYSTEM QEMU_POWER_ON
    QEMU_CAN QEMU_CLOCK_HZ)
set(striker_board_lists SOURCES CLOCK CAN UART WATCHDOG DEFINITIONS QEMU_ARGUMENTS QEMU_DEFINITIONS)

function(striker_add_board)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "${striker_board_words}" "${striker_board_lists}")
  if(ARG_UNPARSED_ARGUMENTS)
    striker_board_error("'${ARG_UNPARSED_ARGUMENTS}' belongs to no field")
  endif()
  foreach(field NAME CPU FLASH_ORIGIN FLASH RAM_ORIGIN RAM CLOCK_HZ INTERRUPTS SOURCES CLOCK CAN WATCHDOG)
    if("${ARG_${field}}" STREQUAL "")
      striker_board_error("${field} is missing")
    endif()
  endforeach()
  cmake_path(GET CMAKE_CURRENT_LIST_DIR FILENAME folder_name)
  if(NOT ARG_NAME STREQUAL folder_name)
    striker_board_error("NAME is '${ARG_NAME}', but the folder's name is '${folder_name}': they have to agree")
  endif()
  foreach(field FLASH_ORIGIN RAM_ORIGIN)
    if(NOT ARG_${field} MATCHES "^0x[0-9A-Fa-f]+$")
      striker_board_error("${field} is '${ARG_${field}}', but has to be an address such as 0x20000000")
    endif()
  endforeach()
  foreach(field FLASH RAM)
    if(NOT ARG_${field} MATCHES "^[0-9]+[KM]?$")
      striker_board_error("${field} is '${ARG_${field}}', but has to be a size in bytes such as 256K")
    endif()
  endforeach()
  foreach(field CLOCK_HZ QEMU_CLOCK_HZ)
    if(NOT "${ARG_${field}}" STREQUAL "" AND NOT ARG_${field} MATCHES "^[1-9][0-9]*$")
      striker_board_error("${field} is '${ARG_${field}}', but has to be a number of hertz such as 16000000")
    endif()
  endforeach()
  if(ARG_CAN STREQUAL "slcan")
    if(NOT ARG_UART)
      striker_board_error("UART is missing: CAN slcan speaks over it")
    endif()
    set(ARG_CAN slcan_bus.cpp)
  elseif(ARG_UART)
    striker_board_error("UART belongs to CAN slcan alone: add its file to CAN, or leave it out")
  endif()
  if(NOT ARG_INTERRUPTS MATCHES "^[0-9]+$")
    striker_board_error("INTERRUPTS is '${ARG_INTERRUPTS}', but has to be a number of lines such as 32")
  endif()
  if(ARG_WATCHDOG STREQUAL "none")
    set(ARG_WATCHDOG no_watchdog.cpp)
  endif()
  if(NOT ARG_LABEL)
    set(ARG_LABEL ${ARG_CPU})
  endif()
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
    if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/${file}")
      list(APPEND found "${CMAKE_CURRENT_LIST_DIR}/${file}")
    elseif(EXISTS "${ports}/bare_metal/${file}")
      list(APPEND found "${ports}/bare_metal/${file}")
    else()
      striker_board_error("${field}: no ${file}, neither in the board's folder nor in ${ports}/bare_metal")
    endif()
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()

function(striker_board_error text)
  message(FATAL_ERROR "${CMAKE_CURRENT_LIST_FILE}: ${text}. "
                      "${CMAKE_CURRENT_FUNCTION_LIST_FILE} says what every field means.")
endfunction()
