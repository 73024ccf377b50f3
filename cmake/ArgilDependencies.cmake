# SPDX-License-Identifier: GPL-3.0-or-later
# Every library Argil uses, as Debian 12 packages it (cmake/packages.txt names the packages).
# The installed package reads the same list: cmake/ArgilConfig.cmake.in.
include(${CMAKE_CURRENT_LIST_DIR}/ArgilFind.cmake)
argil_find_core()
if(NOT ARGIL_CORE_ONLY)
  argil_find_engine()
  argil_find_io()
  find_package(CLI11 2.1 CONFIG REQUIRED)
  find_package(spdlog 1.10 CONFIG REQUIRED)
endif()
