# SPDX-License-Identifier: Apache-2.0
# striker_write_robot(FILE HEADER): a robot's description as a header for firmware/loop/built_in_robot.hpp. The file is
# TOML, a key and a whole number a line, and drives = "NAME" (sil/robot/description/robot_file.hpp, which refuses what this
# does); ranges and unknown keys are left to the compiler. Sets STRIKER_CAN_BASE in the caller's scope: the file's
# identifier_base, or 0.
function(striker_write_robot file header)
  file(READ "${file}" text)
  string(ASCII 239 187 191 byte_order_mark)
  string(REGEX REPLACE "^${byte_order_mark}" "" text "${text}")
  string(REPLACE "\r\n" "\n" text "${text}")
  string(ASCII 1 2 3 4 5 6 7 8 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 127 control)
  if(text MATCHES "[${control}]")
    message(FATAL_ERROR "STRIKER_ROBOT: ${file}: a control character stands in it, which TOML has not")
  endif()
  string(REGEX REPLACE "#[^\n]*" "" text "${text}")
  string(REPLACE ";" "<semicolon>" text "${text}")
  string(REGEX REPLACE "\n" ";" lines "${text}")
  get_filename_component(name "${file}" NAME)
  set(known "")
  set(assignments "")
  set(wiring "")
  set(STRIKER_CAN_BASE 0 PARENT_SCOPE)
  set(line_number 0)
  foreach(line IN LISTS lines)
    math(EXPR line_number "${line_number} + 1")
    string(STRIP "${line}" line)
    if(line STREQUAL "")
      continue()
    endif()
    if(line MATCHES "^drives[ \t]*=[ \t]*\"([a-z0-9_]+)\"$")
      set(line "drives = 0")
      set(drives ${CMAKE_MATCH_1})
    elseif(line MATCHES "^drives[ \t]*=")
      message(FATAL_ERROR "STRIKER_ROBOT: ${file}: line ${line_number}: '${line}' is no name of drives, as in "
        "drives = \"odrive\"")
    endif()
    if(NOT line MATCHES "^([A-Za-z0-9_]+)[ \t]*=[ \t]*(0|[1-9][0-9]*(_[0-9]+)*)$")
      message(FATAL_ERROR "STRIKER_ROBOT: ${file}: line ${line_number}: '${line}' is no key with a whole number, as in "
        "body_mass_g = 1_500")
    endif()
    set(key ${CMAKE_MATCH_1})
    string(REPLACE "_" "" number "${CMAKE_MATCH_2}")
    if(key IN_LIST known)
      message(FATAL_ERROR "STRIKER_ROBOT: ${file}: line ${line_number}: ${key} stands twice")
    endif()
    list(APPEND known ${key})
    if(key STREQUAL "drives")
      string(APPEND wiring "  wiring.kind = can::DriveKind::${drives};\n")
    elseif(key STREQUAL "identifier_base")
      string(APPEND wiring "  wiring.identifier_base = {${number}};\n")
      set(STRIKER_CAN_BASE ${number} PARENT_SCOPE)
    elseif(key MATCHES "^drive_([A-Za-z0-9_]+)$")
      string(APPEND wiring "  wiring.${CMAKE_MATCH_1} = {${number}};\n")
    else()
      string(APPEND assignments "  robot.${key} = {${number}};\n")
    endif()
    if(key STREQUAL "wheel_radius_um")
      string(APPEND wiring "  wiring.wheel_radius_um = {${number}};\n")
    endif()
  endforeach()
  # Left alone if nothing in it would change, so that nothing is compiled again.
  file(CONFIGURE OUTPUT "${header}" @ONLY CONTENT [[
// Made of @name@ by firmware/robots/robot_header.cmake: change that.
#pragma once

#include "firmware/can/drives/drive_wiring.hpp"
#include "firmware/core/robot_profile.hpp"

namespace striker::loop {

inline constexpr core::RobotDescription built_in_description = [] {
  core::RobotDescription robot{};
@assignments@  return robot;
}();

inline constexpr can::DriveWiring built_in_wiring = [] {
  can::DriveWiring wiring{};
@wiring@  return wiring;
}();

}  // namespace striker::loop
]])
endfunction()
