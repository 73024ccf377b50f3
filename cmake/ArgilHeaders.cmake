# SPDX-License-Identifier: GPL-3.0-or-later
# Compiles every public header, seeing nothing but the layers it may see, the standard library and the
# C library; each alone where there are no unity builds, else those of a layer in one go. The target
# `headers` builds them all.
#
# Debian keeps third-party headers in /usr/include beside the C library's, so leaving out include
# folders would not hide them. The C library's own are therefore linked into a folder of the build
# and /usr/include is not searched.
include(${CMAKE_CURRENT_LIST_DIR}/ArgilLayers.cmake)

function(argil_libc_include_folder out)
  set(folder ${PROJECT_BINARY_DIR}/headers/libc)
  set(${out} ${folder} PARENT_SCOPE)
  if(EXISTS ${folder}/stdlib.h)
    return()
  endif()
  execute_process(COMMAND dpkg-query -L libc6-dev linux-libc-dev
    OUTPUT_VARIABLE listed RESULT_VARIABLE failed ERROR_QUIET)
  string(REGEX MATCHALL "/usr/include/[^/\n]+" entries "${listed}")
  if(failed OR NOT entries)
    message(FATAL_ERROR "Cannot list the files of the packages libc6-dev and linux-libc-dev, which "
      "the header check needs. Build on Debian, or configure with -DARGIL_BUILD_TESTS=OFF.")
  endif()
  list(REMOVE_DUPLICATES entries)
  file(MAKE_DIRECTORY ${folder})
  foreach(entry IN LISTS entries)
    cmake_path(GET entry FILENAME name)
    file(CREATE_LINK ${entry} ${folder}/${name} SYMBOLIC)
  endforeach()
endfunction()

function(argil_header_include_flags out layer)
  set(flags -nostdinc)
  argil_libc_include_folder(libc)
  foreach(folder IN LISTS CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
    if(folder STREQUAL "/usr/include")
      set(folder ${libc})
    elseif(folder MATCHES "^/usr/local")
      continue()
    endif()
    list(APPEND flags "SHELL:-isystem ${folder}")
  endforeach()
  foreach(seen IN ITEMS ${layer} ${ARGIL_REACH_${layer}})
    list(APPEND flags "SHELL:-I ${PROJECT_SOURCE_DIR}/${ARGIL_ROOT_${seen}}/include")
  endforeach()
  set(${out} "${flags}" PARENT_SCOPE)
endfunction()

# argil_check_headers(LAYER): adds the object library headers_LAYER, one file per public header.
function(argil_check_headers layer)
  if(NOT ARGIL_BUILD_TESTS OR ARGIL_SANITIZE)
    return()
  endif()
  set(root ${PROJECT_SOURCE_DIR}/${ARGIL_ROOT_${layer}}/include)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*.h)
  set(units "")
  foreach(header IN LISTS headers)
    set(unit ${PROJECT_BINARY_DIR}/headers/${header}.cpp)
    # Twice: it must be complete by itself and guarded against a second inclusion.
    file(CONFIGURE OUTPUT ${unit} CONTENT "#include \"${header}\"\n#include \"${header}\"\n")
    list(APPEND units ${unit})
  endforeach()
  argil_header_include_flags(flags ${layer})
  add_library(headers_${layer} OBJECT ${units})
  target_link_libraries(headers_${layer} PRIVATE argil_compile)
  target_compile_options(headers_${layer} PRIVATE ${flags})
  set_target_properties(headers_${layer} PROPERTIES
    UNITY_BUILD ${ARGIL_UNITY} UNITY_BUILD_BATCH_SIZE 0)
  if(NOT TARGET headers)
    add_custom_target(headers)
  endif()
  add_dependencies(headers headers_${layer})
endfunction()
