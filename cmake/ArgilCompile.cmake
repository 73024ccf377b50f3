# SPDX-License-Identifier: GPL-3.0-or-later
# How every target of Argil is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)  # tests/lint.sh reads it
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Same bits in every build: no contraction of a*b+c, and never -ffast-math.
add_library(argil_compile INTERFACE)
target_compile_options(argil_compile INTERFACE
  -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Wold-style-cast
  -Wnon-virtual-dtor $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>
  # Asserts and tests name files from the root, so that a compiler cache has them for every clone.
  -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=
  # Without full optimisation GCC takes values inside CGAL's templates for uninitialised that are not;
  # the Release build keeps the warning.
  $<$<CONFIG:Debug>:-Wno-maybe-uninitialized>)
# Out of a precompiled header GCC 12 to 14 takes "text" + std::string for a copy onto itself or past
# its end (its bug 105329); the preset `plain` keeps the warnings.
if(ARGIL_PCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(argil_compile INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(ARGIL_ASSERTS)
  # Ours, and what libraries state by the standard's assert(); CGAL's own checks take minutes.
  target_compile_options(argil_compile INTERFACE -UNDEBUG)
  target_compile_definitions(argil_compile INTERFACE CGAL_NDEBUG EIGEN_NO_DEBUG)
endif()
if(ARGIL_SANITIZE)
  # What a sanitizer finds ends the test, else it would pass.
  add_compile_options(-fsanitize=${ARGIL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ARGIL_SANITIZE})
  if(ARGIL_SANITIZE_WITHOUT)
    add_compile_options(-fno-sanitize=${ARGIL_SANITIZE_WITHOUT})
  endif()
endif()
