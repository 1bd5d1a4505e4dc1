# SPDX-License-Identifier: Apache-2.0
# Which board a build is for, if any: -DSTRIKER_BOARD=NAME, one of this folder, or -DSTRIKER_BOARD_DIR=PATH, the folder of
# any other. Before project(), which takes the toolchain file from here unless one was given.
set(STRIKER_BOARD_DIR "" CACHE PATH "The folder of a board outside this tree, with its board.cmake")

if(STRIKER_BOARD_DIR AND STRIKER_BOARD)
  message(FATAL_ERROR "STRIKER_BOARD is '${STRIKER_BOARD}' and STRIKER_BOARD_DIR '${STRIKER_BOARD_DIR}': a build is for one "
                      "board. Give one of them, in a build folder of its own.")
endif()
if(STRIKER_BOARD_DIR)
  if(STRIKER_BOARD_DIR MATCHES ";")
    message(FATAL_ERROR "STRIKER_BOARD_DIR: '${STRIKER_BOARD_DIR}' has a ';' in it, which parts a list in CMake: give a path "
                        "without one.")
  endif()
  if(NOT EXISTS "${STRIKER_BOARD_DIR}/board.cmake")
    message(FATAL_ERROR "STRIKER_BOARD_DIR: there is no ${STRIKER_BOARD_DIR}/board.cmake. Give the path of a folder that has "
                        "one; firmware/ports/README.md says how a board of your own becomes one.")
  endif()
  file(REAL_PATH "${STRIKER_BOARD_DIR}" STRIKER_BOARD)
endif()
if(DEFINED STRIKER_BOARD AND NOT DEFINED CMAKE_TOOLCHAIN_FILE)
  set(CMAKE_TOOLCHAIN_FILE "${CMAKE_CURRENT_LIST_DIR}/../arm-none-eabi.cmake")
endif()

# striker_check_built_for_board(): after project(). A folder that was the host's stays the host's, whatever is asked later.
function(striker_check_built_for_board)
  if(DEFINED STRIKER_BOARD AND NOT CMAKE_SYSTEM_NAME STREQUAL "Generic")
    message(FATAL_ERROR "STRIKER_BOARD: '${STRIKER_BOARD}' is asked for, but this build folder compiles for ${CMAKE_SYSTEM_NAME}: "
                        "take a build folder of its own for each board.")
  endif()
endfunction()
