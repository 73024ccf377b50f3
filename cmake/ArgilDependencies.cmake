# SPDX-License-Identifier: GPL-3.0-or-later
# Debian 12 packages; ../shared/facts/stack.md section 1 tells why each line is as it is.
find_package(Threads REQUIRED)
find_package(TBB CONFIG REQUIRED COMPONENTS tbb)  # first, so that every later package shares it
set(_argil_vdb_modules /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
list(APPEND CMAKE_MODULE_PATH ${_argil_vdb_modules})  # only a Find module, off CMake's own path
find_package(OpenVDB 10.0 REQUIRED COMPONENTS openvdb)
list(REMOVE_ITEM CMAKE_MODULE_PATH ${_argil_vdb_modules})
find_package(embree 3.13 CONFIG REQUIRED)
find_package(OpenMesh CONFIG REQUIRED)
find_package(Eigen3 3.4 CONFIG REQUIRED)
find_package(CGAL 5.5 CONFIG REQUIRED)
include(CGAL_Eigen3_support)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json 3.11 CONFIG REQUIRED)
find_package(CLI11 2.1 CONFIG REQUIRED)
find_package(spdlog 1.10 CONFIG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
