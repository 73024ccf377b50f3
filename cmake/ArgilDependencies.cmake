# SPDX-License-Identifier: GPL-3.0-or-later
# Every library Argil uses, as Debian 12 packages it (cmake/packages.txt names the packages).
include(ArgilFind)
argil_find_core(REQUIRED)
argil_find_haptics(REQUIRED)
if(NOT ARGIL_CORE_ONLY)
  argil_find_engine(REQUIRED)
  argil_find_io(REQUIRED)
  argil_find_viewer(REQUIRED)
  find_package(CLI11 2.1 CONFIG REQUIRED)
  find_package(spdlog 1.10 CONFIG REQUIRED)
endif()
