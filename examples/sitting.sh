#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays the two windows of docs/sitting.md and takes its pictures.
# Usage: examples/sitting.sh [FOLDER]   (default docs/img/sitting; FOLDER/flask.vdb and flask.3mf with
# another one. Needs a Release build and xvfb)
set -eu
cd "$(dirname "$0")/.."
argil=$PWD/build/release/cli/argil
page=$PWD/docs/sitting.md
out=${1:-docs/img/sitting}
[ -x "$argil" ] || { echo "no $argil; build first: cmake --build --preset release" >&2; exit 1; }
command -v xvfb-run > /dev/null || { echo "no xvfb-run; install the package xvfb" >&2; exit 1; }
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/docs/img/sitting"
cp examples/pebble.ply examples/alphas/stars.png "$work"
cd "$work"

# Each window ends where its user leaves.
awk '/^```/ { in_script = $0 == "```script"; next }
     in_script { print > ("window" (ended + 1) ".txt") }
     in_script && ended_next { ended++; ended_next = 0 }
     in_script && $0 == "key Ctrl+Q" { ended_next = 1 }' "$page"

window() { # SCRIPT [PROJECT]
  script=$1
  shift
  xvfb-run -a -s '-screen 0 1280x800x24' "$argil" view --home home --width 1280 --height 720 \
    --input "$script" --quiet "$@"
}
window window1.txt
window window2.txt flask.vdb
python3 "${page%/docs/*}/examples/smaller_png.py" docs/img/sitting/*.png
mv docs/img/sitting/*.png "$out"
[ "$out" = "${page%/*}/img/sitting" ] || mv flask.vdb flask.3mf "$out"
echo "$out"
