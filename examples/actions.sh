#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Sculpts one small piece with each action and renders it, the pictures of docs/actions.md; then draws
# every action at three levels beside Blender's, those of docs/gallery.md. The latter wants the packages
# blender and xvfb: without them Blender's column says so.
# Usage: examples/actions.sh [FOLDER]   (default docs/img, for FOLDER/actions and FOLDER/gallery; needs
# a Release build)
set -eu
cd "$(dirname "$0")/.."
argil=build/release/cli/argil
folder=${1:-docs/img}
out=$folder/actions
[ -x "$argil" ] || { echo "no $argil; build first: cmake --build --preset release" >&2; exit 1; }
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A ball with a ring of knobs, so that it shows where matter went.
header='{"argil_strokes":1,"start":{"shape":"ball","radius_mm":20,"voxel_mm":0.25}}
{"tool":"add","shape":"ball","radius_mm":1.4,"radial_symmetry":24,"radial_axis":"y","poses":[[0,0,0,20]]}
{"tool":"add","shape":"ball","radius_mm":1,"radial_symmetry":2,"radial_axis":"y","poses":[[0,-8,-18.3,0],[1,8,-18.3,0]]}
{"tool":"carve","shape":"ball","radius_mm":0.7,"radial_symmetry":1,"poses":[[0,-9,-17,6],[1,9,-17,6]]}
{"tool":"carve","shape":"ball","radius_mm":0.7,"poses":[[0,-9,-17,-6],[1,9,-17,-6]]}'

picture() { # NAME LINES
  printf '%s\n%s\n' "$header" "$2" > "$work/$1.strokes.jsonl"
  rm -f "$work/$1.vdb"
  "$argil" sculpt --strokes "$work/$1.strokes.jsonl" -o "$work/$1.vdb" --quiet
  "$argil" render "$work/$1.vdb" -o "$out/$1.png" --size 480x400 --view=0.15,-1,0.3 --quiet
  echo "$out/$1.png"
}

picture start ''
picture add '{"tool":"add","shape":"ball","radius_mm":4,"poses":[[0,-7,-18,2],[1,0,-20,6],[2,7,-18,2]]}'
picture carve '{"tool":"carve","shape":"ball","radius_mm":4,"poses":[[0,-7,-19,2],[1,0,-21,6],[2,7,-19,2]]}'
picture smooth '{"tool":"smooth","shape":"ball","radius_mm":8,"poses":[[0,-7,-18,3],[1,7,-18,3],[2,-7,-18,3],[3,7,-18,3]]}'
picture inflate '{"tool":"inflate","shape":"ball","radius_mm":8,"poses":[[0,-5,-19,2],[1,5,-19,2],[2,-5,-19,2]]}'
picture layer '{"tool":"layer","shape":"ball","radius_mm":6,"poses":[[0,-9,-17.5,3],[1,9,-17.5,3],[2,0,-19.8,3],[3,0,-18,-9]]}'
picture flatten '{"tool":"flatten","shape":"ball","radius_mm":9,"hold_s":0.1,"poses":[[0,0,-20,0],[1.2,0,-19,0]]}'
picture scrape '{"tool":"scrape","shape":"ball","radius_mm":9,"hold_s":0.1,"poses":[[0,0,-20,0],[1.2,0,-19,0]]}'
picture fill '{"tool":"fill","shape":"ball","radius_mm":9,"hold_s":0.1,"poses":[[0,0,-20,0],[1.2,0,-20,0]]}'
picture pinch '{"tool":"pinch","shape":"ball","radius_mm":9,"hold_s":0.1,"poses":[[0,0,-20,0],[0.8,0,-20,0]]}'
picture crease '{"tool":"crease","shape":"ball","radius_mm":5,"poses":[[0,-11,-17,-1],[1,0,-20,0],[2,11,-17,1]]}'
picture ridge '{"tool":"ridge","shape":"ball","radius_mm":5,"poses":[[0,-11,-17,-1],[1,0,-20,0],[2,11,-17,1]]}'
picture grab '{"tool":"grab","shape":"ball","radius_mm":10,"poses":[[0,0,-20,0],[1,4,-30,7]]}'
picture twist '{"tool":"twist","shape":"ball","radius_mm":14,"poses":[[0,0,-20,0,0.7071068,0.7071068,0,0,1],[1,0,-12,0,0.7071068,0.7071068,0,0,1],[2,0,-20,0,0.7071068,0.7071068,0,0,1]]}'
picture clay '{"tool":"clay","shape":"ball","radius_mm":6,"strength":0.6,"poses":[[0,-9,-17.5,3],[1,9,-17.5,3],[2,-9,-17.5,3]]}'
picture clay_strips '{"tool":"clay_strips","shape":"ball","radius_mm":3.5,"strength":0.8,"poses":[[0,-10,-17,5],[1,10,-17,5]]}
{"tool":"clay_strips","shape":"ball","radius_mm":3.5,"strength":0.8,"poses":[[0,-11,-16.8,-3],[1,0,-20,-1],[2,11,-16.8,1]]}
{"tool":"clay_strips","shape":"ball","radius_mm":3.5,"strength":0.8,"poses":[[0,-2,-18,-9],[1,1,-20.4,0],[2,4,-18,9]]}'
picture elastic '{"tool":"elastic","shape":"ball","radius_mm":4,"poses":[[0,0,-20,0],[1,0,-28,0]]}'
picture snake_hook '{"tool":"snake_hook","shape":"ball","radius_mm":5,"poses":[[0,0,-18,0],[1,2,-24,3],[2,8,-27,6],[3,15,-26,8]]}'
picture slide '{"tool":"slide","shape":"ball","radius_mm":5.5,"poses":[[0,-8,-18.3,0],[1,-4,-19.6,0],[2,-1,-19.8,3]]}'
picture trim '{"tool":"trim","shape":"ball","radius_mm":8,"plane_offset":-0.1,"poses":[[0,0,-20,0],[1,6,-18.5,3],[2,8,-18,-2]]}'
picture noise '{"tool":"noise","shape":"ball","radius_mm":12,"strength":0.4,"wavelength_mm":4,"poses":[[0,0,-20,0]]}'
# Images of examples/alphas: a stamp, tiles along a stroke, and one that is dragged to its size.
cp examples/alphas/*.png "$work/"
facing='0.7071068,0.7071068,0,0,1' # the image's right side to the right, its top up
picture emboss "{\"tool\":\"emboss\",\"shape\":\"ball\",\"radius_mm\":9,\"alpha\":\"stars.png\",\"amplitude_mm\":3,\"poses\":[[0,0,-20,0,$facing]]}"
picture emboss_tiled '{"tool":"emboss","shape":"ball","radius_mm":7,"alpha":"scales.png","alpha_mode":"tiled","tile_mm":14,"amplitude_mm":1,"poses":[[0,-9,-17.5,3],[1,0,-19.8,3],[2,9,-17.5,-3]]}'
picture emboss_anchored "{\"tool\":\"emboss\",\"shape\":\"ball\",\"radius_mm\":1,\"alpha\":\"weave.png\",\"alpha_mode\":\"anchored\",\"strength\":-1,\"amplitude_mm\":1,\"poses\":[[0,0,-20,0,$facing],[1,8,-19,-6,$facing]]}"
held='{"tool":"mask","shape":"ball","radius_mm":5,"poses":[[0,-7,-18,9],[1,1,-19,7],[2,8,-17,2],[3,6,-18,-5]]}'
swell='{"tool":"inflate","shape":"ball","radius_mm":10,"poses":[[0,-5,-19,4],[1,5,-19,4],[2,-5,-19,0],[3,5,-19,0],[4,-5,-19,4]]}'
picture mask "$held"
picture mask_inflate "$held
$swell"
picture mask_invert "$held
{\"mask\":\"invert\"}
$swell"

picture mask_grow "$held
{\"mask\":\"grow\",\"by_mm\":3}"
picture mask_shrink "$held
{\"mask\":\"shrink\",\"by_mm\":2}"
picture mask_sharpen "$held
{\"mask\":\"sharpen\"}
{\"mask\":\"sharpen\"}"
picture mask_cavity '{"mask":"cavity","radius_mm":1}'
picture mask_ridges '{"mask":"cavity","radius_mm":1,"factor":-1}'

# A four-pointed star, 2 high, as the mesh of a tool: raised on the left, imprinted on the right.
awk 'BEGIN {
  for (z = -1; z <= 1; z += 2)
    for (n = 0; n < 8; n++) {
      r = n % 2 ? 0.35 : 1; a = n * atan2(0, -1) / 4
      printf "v %.6f %.6f %d\n", r * cos(a), r * sin(a), z
    }
  print "v 0 0 -1\nv 0 0 1"
  for (n = 1; n <= 8; n++) {
    m = n % 8 + 1
    printf "f 17 %d %d\nf 18 %d %d\nf %d %d %d\nf %d %d %d\n", m, n, n + 8, m + 8, n, m, m + 8, n, m + 8, n + 8
  }
}' > "$work/star.obj"
turned='0.7071068,0.7071068,0,0,1' # the star lies in the picture
picture stamp "{\"tool\":\"add\",\"shape\":\"mesh\",\"mesh\":\"star.obj\",\"radii_mm\":[6,6,3],\"poses\":[[0,-7.5,-17.5,1,$turned]]}
{\"tool\":\"carve\",\"shape\":\"mesh\",\"mesh\":\"star.obj\",\"radii_mm\":[6,6,3],\"poses\":[[1,7.5,-18.5,1,$turned]]}"

"$argil" chart gallery -o "$folder/gallery" --quiet
echo "$folder/gallery"
