#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Configures where some libraries cannot be seen and tells whether CMake stops with a command that
# installs the Debian packages of exactly those. Usage: missing_libraries.sh HIDDEN REPOSITORY SCRATCH
set -euo pipefail
hidden=$1 repository=$2 scratch=$3
log=$scratch/log

fail() {
  echo "FAILED $hidden: $1"
  tail -n 60 "$log"
  exit 1
}

# Without those that others of the list bring, for which CMake does not look, and one that may be
# missing.
packages_cmake_finds() {
  awk '$1 == "build" || $1 == "test" { print $2 }' "$repository/cmake/packages.txt" |
    grep -e '-dev$' | grep -vxE 'libgl-dev|libegl-dev|libmeshoptimizer-dev' | sort
}

rm -rf "$scratch"
mkdir -p "$scratch"
case $hidden in
  Everything)
    options=(-DARGIL_BUILD_TESTS=ON -DARGIL_BUILD_BENCH=ON -DCMAKE_FIND_ROOT_PATH="$scratch")
    for mode in PACKAGE LIBRARY INCLUDE; do
      options+=("-DCMAKE_FIND_ROOT_PATH_MODE_$mode=ONLY")
    done
    export PKG_CONFIG_LIBDIR=$scratch
    expected=$(packages_cmake_finds)
    ;;
  Embree)
    options=(-DARGIL_BUILD_TESTS=OFF -DARGIL_BUILD_BENCH=OFF -DCMAKE_DISABLE_FIND_PACKAGE_embree=ON)
    expected=libembree-dev
    ;;
  PkgConfigModules)
    options=(-DARGIL_CORE_ONLY=ON -DARGIL_BUILD_TESTS=OFF -DARGIL_BUILD_BENCH=OFF)
    export PKG_CONFIG_LIBDIR=$scratch
    expected=$(printf 'libsodium-dev\nlibusb-1.0-0-dev\nlibxxhash-dev')
    ;;
  *)
    echo "missing_libraries.sh: nothing is called '$hidden'"
    exit 2
    ;;
esac

! "${CMAKE:-cmake}" -G Ninja -S "$repository" -B "$scratch/build" "${options[@]}" >"$log" 2>&1 ||
  fail "the configuration went through"
grep -qF "$repository/cmake/setup.sh build" "$log" || fail "the message does not name cmake/setup.sh"
named=$(sed -n 's/^ *sudo apt-get install //p' "$log" | tr ' ' '\n' | sort)
difference=$(diff <(echo "$expected") <(echo "$named")) ||
  fail "expected (<) and named (>) packages differ: $difference"
echo "$hidden: named $(wc -l <<<"$named") packages"
