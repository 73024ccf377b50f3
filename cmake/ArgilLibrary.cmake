# SPDX-License-Identifier: GPL-3.0-or-later
# The libraries of Argil, each a folder with include/ (public) and src/ (private).
include(GNUInstallDirs)

# argil_library(LAYER [PUBLIC layer targets] [PRIVATE third-party targets] [WITHOUT sources])
# Makes argil_LAYER with the alias argil::LAYER out of the calling folder. WITHOUT names sources under
# src/ that the caller compiles in its own way.
function(argil_library layer)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE;WITHOUT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} src/*.cpp)
  list(REMOVE_ITEM sources ${arg_WITHOUT})
  add_library(argil_${layer} STATIC ${sources})
  add_library(argil::${layer} ALIAS argil_${layer})
  set_target_properties(argil_${layer} PROPERTIES EXPORT_NAME ${layer})
  target_include_directories(argil_${layer} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(argil_${layer} PUBLIC cxx_std_20)
  target_link_libraries(argil_${layer}
    PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:argil_compile> ${arg_PRIVATE})
  argil_check_headers(${layer})
endfunction()
