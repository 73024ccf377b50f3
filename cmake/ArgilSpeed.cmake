# SPDX-License-Identifier: GPL-3.0-or-later
# What makes the build fast and nothing else: precompiled headers and unity builds. Sources are valid
# without either (ARGIL_PCH, ARGIL_UNITY; the preset `plain` has both off).

# The headers of the standard library that most sources include.
set(ARGIL_STANDARD_HEADERS
  <algorithm> <array> <atomic> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional>
  <limits> <map> <memory> <mutex> <numbers> <optional> <set> <span> <sstream> <string>
  <string_view> <thread> <tuple> <unordered_map> <utility> <variant> <vector>)

# argil_precompile(TARGET [HEADERS headers] [SAME_AS target])
# HEADERS join those of the standard library. With SAME_AS the two targets share one file; the
# compiler refuses it where their options differ in more than warnings.
function(argil_precompile target)
  cmake_parse_arguments(arg "" "SAME_AS" "HEADERS" ${ARGN})
  if(NOT ARGIL_PCH)
    return()
  endif()
  if(arg_SAME_AS)
    target_precompile_headers(${target} REUSE_FROM ${arg_SAME_AS})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGIL_STANDARD_HEADERS} ${arg_HEADERS})
  endif()
endfunction()

# argil_unity(TARGET): its sources are compiled eight at a time.
function(argil_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ARGIL_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# argil_compile_alone(SOURCE... OPTIONS options): sources with options of their own share neither a
# precompiled header nor a unit with others.
function(argil_compile_alone)
  cmake_parse_arguments(arg "" "" "OPTIONS" ${ARGN})
  set_source_files_properties(${arg_UNPARSED_ARGUMENTS} PROPERTIES COMPILE_OPTIONS "${arg_OPTIONS}"
    SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
