# SPDX-License-Identifier: GPL-3.0-or-later
# How each layer finds its private libraries: used by the build and by the installed package.
# Macros, because find_package sets variables that its caller needs.

macro(argil_find_core)
  find_package(Threads REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
endmacro()

# OpenVDB ships only a Find module, in a folder of its own. That folder must not stay on the module
# path: its FindTBB would answer every later find_package(TBB). TBB's own config comes first, so
# that all packages share one TBB::tbb.
macro(argil_find_engine)
  find_package(TBB CONFIG REQUIRED COMPONENTS tbb)
  set(_argil_vdb_modules /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
  list(APPEND CMAKE_MODULE_PATH ${_argil_vdb_modules})
  find_package(OpenVDB 10.0 REQUIRED COMPONENTS openvdb)
  list(REMOVE_ITEM CMAKE_MODULE_PATH ${_argil_vdb_modules})
  find_package(embree 3.13 CONFIG REQUIRED)
endmacro()

macro(argil_find_io)
  find_package(OpenMesh CONFIG REQUIRED)  # its config has no version file: do not ask for one
  find_package(Eigen3 3.4 CONFIG REQUIRED)
  find_package(CGAL 5.5 CONFIG REQUIRED)
  include(CGAL_Eigen3_support)
  find_package(ZLIB REQUIRED)
  find_package(nlohmann_json 3.11 CONFIG REQUIRED)
  pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
endmacro()
