#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a build of Argil, moves the installed tree elsewhere, and has the outside project of this
# folder built against it (build.sh). Usage: run.sh BUILD_FOLDER SCRATCH_FOLDER
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
named=$(grep -rlF -e "$source" -e "$scratch/first" "$scratch/prefix" --include='*.cmake' \
  --include='*.pc' || true)
[ -z "$named" ] || stop "the installed package names the source tree or its old place: $named"
for file in bin/argil share/doc/argil/LICENSE share/doc/argil/README.md \
  include/argil/core/vec3.h include/argil/engine/clay.h include/argil/haptics/force/tool_force.h \
  include/argil/io/mesh_file.h lib/udev/rules.d/70-argil-falcon.rules \
  share/argil/falcon/martin-hillier.txt share/applications/argil.desktop \
  share/icons/hicolor/scalable/apps/argil.svg share/mime/packages/argil.xml \
  share/man/man1/argil-import.1.gz share/bash-completion/completions/argil \
  share/zsh/site-functions/_argil share/blender/scripts/addons/argil_blender/__init__.py; do
  [ -f "$scratch/prefix/$file" ] || stop "$file was not installed"
done
[ -z "$(find "$scratch/prefix/include" -name level_stack.h)" ] || stop "a private header was installed"
"$scratch/prefix/bin/argil" --help >"$scratch/help.log" || stop "the installed argil does not start"

pc=$(dirname "$(find "$scratch/prefix" -name argil-core.pc)")
CMAKE_PREFIX_PATH=$scratch/prefix PKG_CONFIG_PATH=$pc "$here/build.sh" "$scratch/outside"
