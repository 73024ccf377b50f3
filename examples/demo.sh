#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds Argil, and takes a piece from a stroke script to a printable file.
# Usage: ./examples/demo.sh      (leaves demo/piece.vdb, .png and .3mf, demo/carve.svg, demo/charts)
# Stopped at any moment, it goes on from there when it is run again.
set -euo pipefail
unset CDPATH
cd "$(dirname "${BASH_SOURCE[0]}")/.."
say_name=demo
# shellcheck source=../cmake/say.sh
. cmake/say.sh

stop() {
  printf 'demo: %s\n' "$@" >&2
  exit 1
}

require_writable build demo || exit 1

say "packages"
./cmake/setup.sh build || stop "the packages are not all there; the lines above name the remedy"

say "Release build in build/release (the first time takes some minutes)"
build_preset release argil ||
  stop "the build failed" "remedy: see build/log; after a system upgrade, remove build/ and try again"
argil=build/release/cli/argil

scripts=(examples/*.strokes.jsonl)
[ -f "${scripts[0]}" ] || stop "no stroke script in examples/" "remedy: git checkout -- examples"
mkdir -p demo

run() {
  echo "\$ argil $*"
  "$argil" "$@" || stop "argil $1 failed with status $?; its message above names the remedy"
}

say "sculpting ${scripts[0]}"
run sculpt --strokes "${scripts[0]}" -o demo/piece.vdb
run info demo/piece.vdb

say "feeling it: a ball of 4 mm pressed on the owl's belly pushes back"
run force demo/piece.vdb --tool ball:4 --at 0,-19,-10

say "a simulated hand on a simulated Falcon carves it, and presses what it carved"
run lab clay --project demo/piece.vdb --tool ball:2 --active --plot demo/carve.svg --save demo/felt.vdb

say "what a query costs and how exact it is, next to other methods: demo/charts"
run chart force --quick -o demo/charts

say "a picture"
run render demo/piece.vdb -o demo/piece.png

say "a printable file, written, read back and judged"
run export demo/piece.vdb -o demo/piece.3mf
run check demo/piece.3mf

say "done: demo/piece.png, demo/piece.3mf, demo/piece.vdb, demo/carve.svg, demo/charts/force_accuracy.svg"
