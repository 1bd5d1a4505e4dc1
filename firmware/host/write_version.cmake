# SPDX-License-Identifier: Apache-2.0
# Runs in every build: cmake -D SOURCES=... -D VERSION=... -D BUILD_TYPE=... -D OUTPUT=... -P write_version.cmake.
# Leaves OUTPUT alone if nothing in it would change, so that nothing is compiled again.
set(GIT_HASH unknown)
execute_process(COMMAND git rev-parse --show-toplevel WORKING_DIRECTORY ${SOURCES}
                OUTPUT_VARIABLE repository OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
file(REAL_PATH "${SOURCES}" own_folder)
# Unpacked into somebody else's repository, the sources have no hash of their own.
if(status EQUAL 0 AND repository STREQUAL own_folder)
  execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCES}
                  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    set(GIT_HASH ${hash})
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.cpp.in ${OUTPUT} @ONLY)
