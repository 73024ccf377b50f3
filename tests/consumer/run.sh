#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a build of Argil, moves the installed tree elsewhere, builds the outside project of this
# folder against it and runs what it built. Usage: run.sh BUILD_FOLDER SCRATCH_FOLDER
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1 scratch=$2
cmake=${CMAKE:-cmake}

stop() {
  echo "FAILED: $1"
  exit 1
}

rm -rf "$scratch"
mkdir -p "$scratch"
"$cmake" --install "$build" --prefix "$scratch/first" >"$scratch/install.log" ||
  stop "cmake --install; see $scratch/install.log"
mv "$scratch/first" "$scratch/prefix" # a package that can be moved names no place of its own

source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
named=$(grep -rlF -e "$source" -e "$scratch/first" "$scratch/prefix" --include='*.cmake' || true)
[ -z "$named" ] || stop "the installed package names the source tree or its old place: $named"
for file in bin/argil share/doc/Argil/LICENSE share/doc/Argil/README.md \
  include/argil/core/vec3.h include/argil/engine/clay.h include/argil/haptics/tool_force.h \
  include/argil/io/mesh_file.h lib/udev/rules.d/70-argil-falcon.rules \
  share/argil/falcon/martin-hillier.txt; do
  [ -f "$scratch/prefix/$file" ] || stop "$file was not installed"
done
[ -z "$(find "$scratch/prefix/include" -name level_stack.h)" ] || stop "a private header was installed"
"$scratch/prefix/bin/argil" --help >"$scratch/help.log" || stop "the installed argil does not start"

"$cmake" -G Ninja -S "$here" -B "$scratch/build" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  >"$scratch/configure.log" 2>&1 ||
  { tail -n 30 "$scratch/configure.log"; stop "the outside project does not configure"; }
"$cmake" --build "$scratch/build" -j 2 >"$scratch/build.log" 2>&1 ||
  { tail -n 30 "$scratch/build.log"; stop "the outside project does not build"; }
"$scratch/build/feel" || stop "feel: the clay does not push the tool out"
"$scratch/build/sculpt" "$scratch/groove.stl" || stop "sculpt: the groove took nothing away"
[ -s "$scratch/groove.stl" ] || stop "sculpt wrote no mesh"
