# SPDX-License-Identifier: Apache-2.0
# cmake --install: headers, libraries, the DBC, and a package, so that find_package(striker) gives striker::core and the
# other parts. Headers are included as here, "firmware/core/controller.hpp".
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(parts GLOBAL PROPERTY STRIKER_PARTS)
list(TRANSFORM parts PREPEND striker_ OUTPUT_VARIABLE libraries)
list(TRANSFORM parts PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE folders)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/striker)

install(TARGETS ${libraries} EXPORT striker ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${folders} DESTINATION include/striker/firmware FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/striker)
# A build whose identifiers are moved has a DBC of its own, which needs a host to be printed on: none is better than a wrong one.
if(STRIKER_CAN_BASE EQUAL 0)
  install(FILES can/striker.dbc DESTINATION share/striker)
elseif(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  install(FILES ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/striker.dbc DESTINATION share/striker)
endif()
install(EXPORT striker FILE striker-config.cmake NAMESPACE striker:: DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/striker-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/striker-config-version.cmake DESTINATION ${package})
