#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays scripts into the window and keeps what it shows: the pictures of docs/viewer.md.
# Usage: examples/window.sh [FOLDER]   (default docs/img/viewer; needs a Release build and xvfb)
set -eu
cd "$(dirname "$0")/.."
argil=$PWD/build/release/cli/argil
out=${1:-docs/img/viewer}
[ -x "$argil" ] || { echo "no $argil; build first: cmake --build --preset release" >&2; exit 1; }
command -v xvfb-run > /dev/null || { echo "no xvfb-run; install the package xvfb" >&2; exit 1; }
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A ball with a ring of knobs to press on.
printf '%s\n' '{"argil_strokes":1,"start":{"shape":"ball","radius_mm":25,"voxel_mm":0.4}}' \
  '{"tool":"add","shape":"ball","radius_mm":2,"radial_symmetry":20,"radial_axis":"z","poses":[[0,25,0,9]]}' \
  > "$work/piece.strokes.jsonl"
"$argil" sculpt --strokes "$work/piece.strokes.jsonl" -o "$work/piece.vdb" --quiet
mkdir "$work/sculptures"
cp "$work/piece.vdb" "$work/sculptures/Knobs.vdb"

picture() { # NAME SIZE SCRIPT [OPTIONS]
  printf '%b\nshot %s\nclose\n' "$3" "$out/$1.png" > "$work/$1.txt"
  name=$1 width=${2%x*} height=${2#*x}
  cp "$work/piece.vdb" "$work/$name.vdb"
  shift 3
  xvfb-run -a -s '-screen 0 1280x800x24' "$argil" view "$work/$name.vdb" --home "$work/home" \
    --width "$width" --height "$height" --input "$work/$name.txt" --quiet "$@"
  echo "$out/$name.png"
}

# A path drawn over the clay, and the hand beside it, which is drawn to it.
picture guidance 1180x600 'settle\nclick Guidance along a path\nframes 3\nclick Guidance\nframes 3\nclick Guidance/Direct\nframes 3\nclick Draw a path\nframes 3\ndrag left 510 330 700 235 20\nsettle\nmove 620 330\nframes 600' \
  --device sim
# The hand on its way: the tool is felt and drawn behind it.
picture filtered 1180x600 'settle\nmove 540 250\nframes 600\nmove 670 330\nframes 4' \
  --device sim --filter 0.02 --filter-lambda 5
# A stroke in the half of the right eye.
picture stereo 860x480 'settle\nkey Tab\nkey Shift+Z\nframes 3\ndrag left 590 250 710 190 20\nsettle\nmove 660 330\nframes 1000'
# What is asked before a mesh is imported.
picture import 900x520 "settle\nkey Tab\ndrop $PWD/examples/pebble.ply\nframes 5\nsettle\nframes 5"
# A distance, an angle and a thickness.
picture measure 1180x660 'settle\nkey Shift+U\nframes 3\nmove 500 200\npress left\nrelease left\nsettle\nmove 690 180\npress left\nrelease left\nsettle\nkey Ctrl+U\nmove 680 330\npress left\nrelease left\nsettle\nmove 600 290\npress left\nrelease left\nsettle\nmove 660 240\npress left\nrelease left\nsettle\nkey Alt+U\nmove 520 260\npress left\nrelease left\nsettle\nmove 760 640\nsettle\nframes 1000'
# What the search finds by three letters.
picture search 900x480 'settle\nkey Ctrl+K\ntype mas\nkey Down\nframes 1000'
# The ring of favourites, held open at one of them.
picture favourites 1000x560 'settle\nmove 520 250\nframes 3\nhold `\nframes 3\nmove 600 320\nframes 1000'
# A mask by a lasso, and the line of a trim while it is drawn.
picture outline 1000x560 'settle\nkey Num1\nkey M\nframes 3\nclick Drawn by\nframes 3\nclick Drawn by/Lasso\nframes 3\nmove 430 180\npress left\nmove 520 150\nmove 600 230\nmove 560 330\nmove 440 300\nframes 2\nrelease left\nsettle\nkey Q\nframes 3\nclick Drawn by\nframes 3\nclick Drawn by/Line\nframes 3\nmove 330 440\npress left\nmove 660 360\nframes 3'
# A curve while it is clicked together, below the panel with the pen's curve; and the palette of images.
picture strokes 1280x720 'settle\nkey Num1\nclick Stroke\nframes 3\nclick Method\nframes 3\nclick Method/Dots\nframes 3\npen 0.3\ndrag left 480 300 640 300 40\npen 0.55\ndrag left 480 330 640 330 60\npen 0.7\ndrag left 480 360 640 360 30\nsettle\nclick Soft\nframes 3\npen 1\nclick Method\nframes 3\nclick Method/Curve\nframes 3\nmove 1120 400\nscroll -30\nframes 5\nmove 470 420\npress left\nrelease left\nmove 560 500\npress left\nrelease left\nmove 650 420\npress left\nrelease left\nmove 720 470\nframes 5'
picture palette 1280x720 "settle\nkey Num1\nclick Emboss\nframes 3\nsettle\nclick medal\nsettle\nclick Image\nframes 3\nclick Image/Dragged\nframes 3\nclick Amplitude\nmove 560 330\npress left\nmove 620 330\nmove 660 360\nrelease left\nsettle\nclick scales\nsettle\nframes 3\nmove 600 600\nframes 5"

# A head on a body: two pieces, of which the head is turned.
printf '%s\n' '{"argil_strokes":1,"start":{"shape":"ball","radius_mm":11,"voxel_mm":0.3}}' \
  '{"tool":"inflate","shape":"ball","radius_mm":4,"strength":1,"poses":[[0,0,-11,-1],[0.01,0,-12.5,-1],[0.02,0,-13,-1]]}' \
  '{"tool":"carve","shape":"ball","radius_mm":1.8,"poses":[[0,3.8,-10.2,3.4]]}' \
  '{"tool":"carve","shape":"ball","radius_mm":1.8,"poses":[[0,-3.8,-10.2,3.4]]}' > "$work/head.strokes.jsonl"
"$argil" sculpt --strokes "$work/head.strokes.jsonl" -o "$work/head.vdb" --quiet
printf '%s\n' '{"argil_strokes":1,"start":{"shape":"ball","radius_mm":18,"voxel_mm":0.4}}' \
  '{"tool":"add","shape":"ball","radius_mm":6,"poses":[[0,-14,-4,8],[0.01,-22,-8,-2]]}' \
  '{"tool":"add","shape":"ball","radius_mm":6,"poses":[[0,14,-4,8],[0.01,22,-8,-2]]}' \
  '{"piece":"change","name":"Clay","new_name":"Body"}' \
  '{"piece":"add","name":"Head","of":"head.vdb","position_mm":[0,-2,25],"color":"#e0ac8c"}' > "$work/two.strokes.jsonl"
"$argil" sculpt --strokes "$work/two.strokes.jsonl" -o "$work/piece.vdb" --quiet
picture pieces 1180x660 'settle\nkey Ctrl+P\nkey Shift+G\nframes 3\nclick ##ry\nframes 3\nkey Ctrl+A\ntype 30\nkey Enter\nsettle\nmove 760 620\nframes 1000'
# The head from the front, to sculpt another by.
"$argil" render "$work/head.vdb" --view front --size 480x480 -o "$work/front.png" --quiet
picture reference 1180x660 "settle\nkey Num1\nframes 3\ndrop $work/front.png\nframes 5\nclick Sculpt by it as a reference\nsettle\nclick Width, mm##ref1\nframes 3\nkey Ctrl+A\ntype 100\nkey Enter\nmove 760 620\nframes 1000"

# Projects that were open before, by the pictures that closing them made; and the question about work that a window left.
"$argil" import examples/pebble.ply --resolution 150 -o "$work/sculptures/Pebble.vdb" --quiet
cp "$work/head.vdb" "$work/sculptures/Head.vdb"
cp "$work/piece.vdb" "$work/sculptures/Figure.vdb"
others() { # SCRIPT [FILE]
  printf '%b\n' "$1" > "$work/others.txt"
  shift
  xvfb-run -a -s '-screen 0 1280x800x24' "$argil" view "$@" --home "$work/other" --width 900 --height 600 \
    --input "$work/others.txt" --quiet
}
for name in Knobs Head Pebble Figure; do
  others 'settle\nkey Ctrl+Q\nframes 3' "$work/sculptures/$name.vdb"
done
others "settle\nkey Ctrl+Shift+O\nframes 3\nsettle\nmove 500 310\nframes 5\nshot $out/recent.png"
echo "$out/recent.png"
others 'settle\nkey Num1\nsettle\nclick Clay\nframes 3\ndrag left 400 220 480 220 20\nsettle\nframes 3' "$work/sculptures/Head.vdb"
others "frames 5\nsettle\nframes 5\nsettle\nshot $out/recover.png" "$work/sculptures/Head.vdb"
echo "$out/recover.png"

# The list of keys, with one that is pressed and means something already.
picture keys 1100x640 'settle\nkey Shift+F1\nframes 3\nclick Find\nframes 2\ntype view\nframes 3\nclick key wires\nframes 3\nkey X\nframes 3\nmove 700 600\nframes 5'
# The light theme, and the palette of brushes with names. Last, since the theme is kept.
picture light 1180x700 'settle\nclick View\nframes 3\nclick Dark or light\nframes 3\nkey Shift+B\nframes 3\nclick Polish\nframes 3\nsettle\nmove 700 250\nframes 5'
