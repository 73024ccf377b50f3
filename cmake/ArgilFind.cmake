# SPDX-License-Identifier: GPL-3.0-or-later
# How each layer finds its private libraries: used by the build, which passes REQUIRED, and by the
# installed package, which passes what its user asked for. Macros, because find_package sets
# variables that its caller needs.

macro(argil_find_core)
  find_package(Threads ${ARGN})
  find_package(PkgConfig ${ARGN})
  pkg_check_modules(XXHASH ${ARGN} IMPORTED_TARGET libxxhash)
endmacro()

# For the real device. Its find must come after core's, which finds pkg-config.
macro(argil_find_haptics)
  pkg_check_modules(LIBUSB ${ARGN} IMPORTED_TARGET libusb-1.0)
endmacro()

# OpenVDB ships only a Find module, in a folder of its own. That folder must not stay on the module
# path: its FindTBB would answer every later find_package(TBB). TBB's own config comes first, so
# that all packages share one TBB::tbb.
macro(argil_find_engine)
  find_package(TBB CONFIG ${ARGN} COMPONENTS tbb)
  set(_argil_vdb_modules /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
  list(APPEND CMAKE_MODULE_PATH ${_argil_vdb_modules})
  find_package(OpenVDB 10.0 ${ARGN} COMPONENTS openvdb)
  list(REMOVE_ITEM CMAKE_MODULE_PATH ${_argil_vdb_modules})
  find_package(embree 3.13 CONFIG ${ARGN})
endmacro()

macro(argil_find_io)
  find_package(OpenMesh CONFIG ${ARGN})  # its config has no version file: do not ask for one
  find_package(Eigen3 3.4 CONFIG ${ARGN})
  find_package(CGAL 5.5 CONFIG ${ARGN})
  include(CGAL_Eigen3_support OPTIONAL)
  find_package(ZLIB ${ARGN})
  find_package(nlohmann_json 3.11 CONFIG ${ARGN})
  pkg_check_modules(PNG ${ARGN} IMPORTED_TARGET libpng)
endmacro()

# The window. What talks to OpenGL finds its functions through epoxy when the program runs, so that a
# machine without a display runs all other commands.
macro(argil_find_viewer)
  find_package(glfw3 3.3 CONFIG ${ARGN})
  pkg_check_modules(EPOXY ${ARGN} IMPORTED_TARGET epoxy)
  pkg_check_modules(IMGUI ${ARGN} IMPORTED_TARGET imgui)
  pkg_check_modules(XINPUT ${ARGN} IMPORTED_TARGET xi x11)
  find_library(ARGIL_SPNAV spnav ${ARGN})  # brings no description of itself
  if(NOT TARGET argil_spnav)
    add_library(argil_spnav UNKNOWN IMPORTED)
    set_target_properties(argil_spnav PROPERTIES IMPORTED_LOCATION "${ARGIL_SPNAV}")
  endif()
endmacro()
