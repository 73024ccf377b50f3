# SPDX-License-Identifier: GPL-3.0-or-later
# Every library that this build uses; the configuration stops with one message that names all missing
# ones, their Debian packages (cmake/packages.txt) and the command that installs them.
include(ArgilFind)

# The extension of Python, for the interpreter of the system, whose packages know of ours, unless another
# is named by Python_EXECUTABLE.
macro(argil_find_python)
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the package argil is for")
  endif()
  argil_find_package("Python's headers" python3-dev Python 3.11 COMPONENTS Interpreter Development.Module)
  if(Python_FOUND)
    set(PYBIND11_FINDPYTHON ON)
  else()  # it would look for one itself, and stop with messages of its own
    set(PYBIND11_NOPYTHON ON)
  endif()
  argil_find_package("pybind11 2.10" pybind11-dev pybind11 2.10 CONFIG)
endmacro()

# What tests use besides; lib3mf, which is the 3MF consortium's own, is the other side of our 3MF.
macro(argil_find_for_tests)
  argil_find_package("GoogleTest" libgtest-dev GTest CONFIG)
  if(TARGET GTest::gmock)  # only its own package brings it
    set(GMock_FOUND TRUE)
  endif()
  argil_note_found("GoogleMock" libgmock-dev GMock_FOUND)
  argil_find_module("umockdev" libumockdev-dev UMOCKDEV umockdev-1.0)
  if(NOT ARGIL_CORE_ONLY)
    # The pkg-config file of lib3mf asks for a libzip it does not need.
    find_path(ARGIL_LIB3MF_INCLUDE Model/COM/NMR_DLLInterfaces.h PATH_SUFFIXES lib3mf)
    find_library(ARGIL_LIB3MF 3MF)
    argil_note_found("lib3mf's headers" lib3mf-dev ARGIL_LIB3MF_INCLUDE)
    argil_note_found("lib3mf" lib3mf-dev ARGIL_LIB3MF)
  endif()
endmacro()

function(argil_stop_when_missing)
  if(NOT ARGIL_MISSING)
    return()
  endif()
  set(groups build)
  if(ARGIL_BUILD_TESTS OR ARGIL_BUILD_BENCH)
    string(APPEND groups " test")
  endif()
  list(JOIN ARGIL_MISSING "\n  " libraries)
  list(REMOVE_DUPLICATES ARGIL_MISSING_PACKAGES)
  list(JOIN ARGIL_MISSING_PACKAGES " " packages)
  string(REPLACE " " "\\ " setup "${PROJECT_SOURCE_DIR}/cmake/setup.sh")  # to be pasted
  # Indented lines are shown as they are.
  message(FATAL_ERROR "These libraries were not found:\n  ${libraries}\n"
    "Install what the build needs, then configure again:\n"
    "  ${setup} ${groups}\n"
    "or only these:\n  sudo apt-get install ${packages}\n")
endfunction()

set(ARGIL_MISSING "")
set(ARGIL_MISSING_PACKAGES "")
argil_find_core()
argil_find_haptics()
if(NOT ARGIL_CORE_ONLY)
  argil_find_engine()
  argil_find_mesh()
  argil_find_io()
  argil_find_viewer()
  argil_find_package("CLI11 2.1" libcli11-dev CLI11 2.1 CONFIG)
  if(ARGIL_BUILD_PYTHON)
    argil_find_python()
  endif()
endif()
if(ARGIL_BUILD_TESTS)
  argil_find_for_tests()
endif()
if(ARGIL_BUILD_BENCH AND NOT ARGIL_CORE_ONLY)
  argil_find_package("Google Benchmark" libbenchmark-dev benchmark CONFIG)
endif()
argil_stop_when_missing()
