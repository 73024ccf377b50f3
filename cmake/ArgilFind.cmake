# SPDX-License-Identifier: GPL-3.0-or-later
# How each layer finds its private libraries, as Debian 12 or 13 packages them: used by the build and
# by the installed package. Macros, because find_package sets variables that its caller needs.
#
# What is missing stops nothing here. It is added to two lists, so that one message can name all of it:
#   ARGIL_MISSING           a line each: the library and its Debian package
#   ARGIL_MISSING_PACKAGES  the packages

# argil_note_found(LIBRARY PACKAGE VARIABLE [VERSION]): the variable is true when it was found.
macro(argil_note_found library package variable)
  if(${variable})
    if(NOT Argil_FIND_QUIETLY)
      message(STATUS "${library}: found ${ARGN}")
    endif()
  else()
    list(APPEND ARGIL_MISSING "${library} (Debian package ${package})")
    list(REMOVE_DUPLICATES ARGIL_MISSING)
    list(APPEND ARGIL_MISSING_PACKAGES ${package})
  endif()
endmacro()

# argil_find_package(LIBRARY PACKAGE NAME [what find_package takes after NAME])
macro(argil_find_package library package name)
  # OpenVDB and CGAL take Boost's own config rather than CMake's module for it, of which CMake 3.30
  # warns.
  set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)
  find_package(${name} ${ARGN} QUIET)
  unset(CMAKE_POLICY_DEFAULT_CMP0167)
  argil_note_found("${library}" ${package} ${name}_FOUND ${${name}_VERSION})
endmacro()

# argil_find_module(LIBRARY PACKAGE PREFIX MODULE...): through pkg-config, which core finds.
macro(argil_find_module library package prefix)
  if(PkgConfig_FOUND)
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${ARGN})
  endif()
  argil_note_found("${library}" ${package} ${prefix}_FOUND ${${prefix}_VERSION})
endmacro()

macro(argil_find_core)
  argil_find_package("POSIX threads" libc6-dev Threads)
  argil_find_package("pkg-config" pkg-config PkgConfig)
  argil_find_module("xxHash" libxxhash-dev XXHASH libxxhash)
endmacro()

# For the real device, and the key of the bridge.
macro(argil_find_haptics)
  argil_find_module("libusb 1.0" libusb-1.0-0-dev LIBUSB libusb-1.0)
  argil_find_module("libsodium" libsodium-dev SODIUM libsodium)
endmacro()

# OpenVDB ships only a Find module, in a folder of its own, which stops with messages of its own when a
# library that OpenVDB needs is missing; it is therefore asked last, when there are all of them. That
# folder must not stay on the module path: its FindTBB would answer every later find_package(TBB).
# TBB's own config comes first, so that all packages share one TBB::tbb.
macro(argil_find_openvdb)
  set(_argil_vdb_modules /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
  find_path(ARGIL_OPENVDB_INCLUDE openvdb/openvdb.h)
  if(ARGIL_OPENVDB_INCLUDE AND TBB_FOUND AND Boost_FOUND AND ZLIB_FOUND)
    list(APPEND CMAKE_MODULE_PATH ${_argil_vdb_modules})
    argil_find_package("OpenVDB 10" libopenvdb-dev OpenVDB 10.0 COMPONENTS openvdb)
    list(REMOVE_ITEM CMAKE_MODULE_PATH ${_argil_vdb_modules})
  else()
    argil_note_found("OpenVDB 10" libopenvdb-dev ARGIL_OPENVDB_INCLUDE)
  endif()
endmacro()

# Two layers ask for these: the second time nothing is looked for.
macro(argil_find_tbb)
  if(NOT TARGET TBB::tbb)
    argil_find_package("oneTBB" libtbb-dev TBB CONFIG COMPONENTS tbb)
  endif()
endmacro()

macro(argil_find_embree)
  if(NOT TARGET embree)
    # The headers embree.h take the newer one as well when there are both.
    find_package(embree 4 CONFIG QUIET)
    if(NOT embree_FOUND)
      find_package(embree 3.13 CONFIG QUIET)
    endif()
    argil_note_found("Embree 3.13 or 4" libembree-dev embree_FOUND ${embree_VERSION})
  endif()
endmacro()

macro(argil_find_engine)
  argil_find_tbb()
  argil_find_package("Boost.Iostreams, which OpenVDB needs" libboost-iostreams-dev
    Boost CONFIG COMPONENTS iostreams)
  argil_find_package("zlib" zlib1g-dev ZLIB)
  argil_find_openvdb()
  argil_find_embree()
endmacro()

macro(argil_find_mesh)
  argil_find_tbb()
  argil_find_embree()
  # OpenMesh's config has no version file: do not ask for one.
  argil_find_package("OpenMesh" libopenmesh-dev OpenMesh CONFIG)
  argil_find_package("Eigen 3.4" libeigen3-dev Eigen3 3.4 CONFIG)
  # CGAL's own config takes 6 for 5.5, and so do we.
  argil_find_package("CGAL 5.5 or 6" libcgal-dev CGAL 5.5 CONFIG)
  include(CGAL_Eigen3_support OPTIONAL)
endmacro()

macro(argil_find_io)
  argil_find_module("Blosc" libblosc-dev BLOSC blosc)
  argil_find_package("nlohmann-json 3.11" nlohmann-json3-dev nlohmann_json 3.11 CONFIG)
  argil_find_module("libpng" libpng-dev PNG libpng)
  argil_find_module("libjpeg-turbo" libjpeg-dev JPEG libjpeg)
endmacro()

# The window. What talks to OpenGL finds its functions through epoxy when the program runs, so that a
# machine without a display runs all other commands.
macro(argil_find_viewer)
  argil_find_package("GLFW 3.3" libglfw3-dev glfw3 3.3 CONFIG)
  argil_find_module("epoxy" libepoxy-dev EPOXY epoxy)
  argil_find_module("Dear ImGui" libimgui-dev IMGUI imgui)
  argil_find_module("X11's input extension" libxi-dev XINPUT xi x11)
  find_library(ARGIL_SPNAV spnav)  # brings no description of itself
  argil_note_found("libspnav" libspnav-dev ARGIL_SPNAV)
  if(NOT TARGET argil_spnav)
    add_library(argil_spnav UNKNOWN IMPORTED)
    set_target_properties(argil_spnav PROPERTIES IMPORTED_LOCATION "${ARGIL_SPNAV}")
  endif()
endmacro()
