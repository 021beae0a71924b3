#!/bin/sh
# SPDX-License-Identifier: MIT
# tests/accuracy.sh [MOTE [WxH]]: the table of docs/accuracy.md. Draws each scene, compares it with the
# double-precision reference and prints one row; ids of both expansions must be the same bytes.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mote=${1:-$root/build/release/mote}
size=${2:-640x360}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo "| scene | wrong ids | ambiguous | depth median | depth p99 | normals beyond the bar | vertex = geometry |"
echo "|---|---|---|---|---|---|---|"
row() { # row NAME SCENE [--set ...]
  name=$1
  shift
  for expansion in vertex geometry; do
    "$mote" render "$@" --size "$size" --expansion $expansion -o "$work/$expansion.exr" \
      --aov id="$work/$expansion-id.npy" --aov depth="$work/$expansion-depth.npy" 2>/dev/null
  done
  same=yes
  cmp -s "$work/vertex-id.npy" "$work/geometry-id.npy" && cmp -s "$work/vertex-depth.npy" "$work/geometry-depth.npy" || same=no
  scene=$1
  shift
  "$mote" compare "$work/vertex.exr" --reference "$scene" "$@" >"$work/report" 2>&1 || true
  awk -v name="$name" -v same=$same '
    /ambiguous/ { ambiguous = $5 }
    /^ids:/ { wrong = $2 }
    /^depth, relative/ { median = $6; p99 = $8; gsub(",", "", median); gsub(",", "", p99) }
    /^normals beyond/ { beyond = $(NF - 1) }
    END { printf "| %s | %s | %s | %s | %s | %s | %s |\n", name, wrong, ambiguous, median, p99, beyond, same }' "$work/report"
}
for n in 1e3 1e5; do
  for camera in fit fill inside; do
    for frame in 0 46 55; do row "$n:$camera, frame $frame" "spheres:$n:$camera:frame=$frame"; done
  done
done
# The packing of this repository: orthographic, cut by a near plane, and a million units away.
scene() { # scene FILE OFFSET CAMERA...
  printf 'schema = 1\n[camera]\neye = [%s, %s, %s]\ntarget = [%s, %s, %s]\n' \
    "$(($2 - 26))" "$(($2 - 34))" "$(($2 + 30))" "$(($2 + 10))" "$(($2 + 10))" "$(($2 + 9))" >"$work/$1"
  printf '%s\n' "$3" "[[data]]" "file = \"$root/app/scenes/data/packing.npy\"" "transform = [{ translate = [$2, $2, $2] }]" >>"$work/$1"
}
scene orthographic.toml 0 'projection = "orthographic"
height = 30.0'
scene near.toml 0 'near = 50.0'
scene far_away.toml 1000000 ''
row "packing, orthographic" "$work/orthographic.toml"
row "packing, near cut" "$work/near.toml"
row "packing, moved by 1e6" "$work/far_away.toml"

# Shadows of the benchmark scene at the map's default size, in windows of three shapes.
shadows=$(dirname "$mote")/tests/passes/passes_gpu
if [ -x "$shadows" ]; then
  echo
  MOTE_ACCURACY=full MOTE_ADAPTER=llvmpipe "$shadows" --gtest_filter=Shadows.TheBenchmarkSceneAtTheDefaultSize | grep 'wrong of'
fi
