#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the outside project of this folder against an installed Argil, once through its CMake package
# and once through pkg-config, and runs what was built. Usage: build.sh SCRATCH_FOLDER
# Argil is found where CMAKE_PREFIX_PATH and PKG_CONFIG_PATH say, or where the system has it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$1
cmake=${CMAKE:-cmake}
cxx=${CXX:-c++}

stop() {
  echo "FAILED: $1"
  exit 1
}

logged() { # NAME WHAT COMMAND...
  local log=$scratch/$1.log what=$2
  shift 2
  "$@" >"$log" 2>&1 || {
    tail -n 30 "$log"
    stop "$what"
  }
}

run() { # FOLDER HOW
  "$1/feel" || stop "feel, built $2: the clay does not push the tool out"
  "$1/sculpt" "$1/groove.stl" || stop "sculpt, built $2: the groove took nothing away"
  [ -s "$1/groove.stl" ] || stop "sculpt, built $2, wrote no mesh"
}

mkdir -p "$scratch/cmake" "$scratch/pkg-config"
logged configure "the outside project does not configure" \
  "$cmake" -G Ninja -S "$here" -B "$scratch/cmake" -DCMAKE_BUILD_TYPE=Release
logged build "the outside project does not build" "$cmake" --build "$scratch/cmake" -j 2
run "$scratch/cmake" "by CMake"

# One word is one flag here, as in a makefile.
# shellcheck disable=SC2046
compile() { # NAME MODULE...
  local name=$1
  shift
  pkg-config --exists --print-errors "$@" || stop "pkg-config does not find $*"
  logged "$name" "$name does not build with the flags of pkg-config $*" \
    "$cxx" -std=c++20 -O1 "$here/$name.cpp" -o "$scratch/pkg-config/$name" \
    $(pkg-config --cflags --libs "$@")
}
compile feel argil-haptics
compile sculpt argil-engine argil-io
if ldd "$scratch/pkg-config/feel" | grep -q openvdb; then
  stop "the module argil-haptics brought the engine with it"
fi
run "$scratch/pkg-config" "by pkg-config"
