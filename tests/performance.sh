#!/usr/bin/env bash
# The tables of docs/performance.md, in Markdown on standard output; minutes on two cores. Nothing else should run.
#
#   tests/performance.sh [--mote PROGRAM] [--embree DIR] [--vtk] [--quick]
#
# --embree DIR: a folder with `embree_spheres` (../shared/bench/build.sh makes it); its column is measured right after mote's, on the
#               same scene, which is made in DIR where it is missing.
# --vtk:        Debian's python3-vtk9 and xvfb are there; VTK's sphere mapper, up to 1e6.
# --quick:      no scene of 1e7.
# SIZE (1920x1080) and FRAMES (9) come from the environment.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
peers=$root/../shared/bench
mote=$root/build/release/mote embree="" vtk="" quick=""
while [ $# -gt 0 ]; do
  case $1 in
    --mote) mote=$2; shift ;;
    --embree) embree=$2; shift ;;
    --vtk) vtk=1 ;;
    --quick) quick=1 ;;
    *) sed -n '2,12s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift
done
: "${SIZE:=1920x1080}" "${FRAMES:=9}"
width=${SIZE%x*} height=${SIZE#*x}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[ -z "$embree" ] || [ -x "$embree/embree_spheres" ] || { echo "$embree/embree_spheres is not there; ../shared/bench/build.sh makes it" >&2; exit 1; }
counts="1000 100000 1000000"
[ -n "$quick" ] || counts+=" 10000000"
if { [ -n "$embree" ] || [ -n "$vtk" ]; }; then
  scenes=${embree:-$scratch}/scenes
  last=${counts##* }
  [ -e "$scenes/spheres_$last.bin" ] || python3 "$peers/scenes/make_scenes.py" "$scenes" --max "$last" --text-max 0 >&2
fi

bench() { "$mote" bench "$@" --size "$SIZE" --frames "$FRAMES" --json; }
field() { python3 -c 'import json,sys; v=json.load(sys.stdin)[sys.argv[1]]; print(v if isinstance(v,str) else f"{v:.1f}")' "$1"; }
result() { sed -n 's/^RESULT //p' | field "$1"; }
ratio() { python3 -c 'import sys; print(f"{float(sys.argv[1])/float(sys.argv[2]):.2f}")' "$1" "$2"; }

date -u '+Measured on %Y-%m-%d,'
"$mote" bench spheres:10 --frames 1 --size 16x16 --json | field device
echo; echo "## Frames, $SIZE"; echo
echo "| scene | expansion | mote, ms | first frame, ms | Embree, ms | mote / Embree | VTK, ms |"
echo "|---|---|---|---|---|---|---|"
for camera in fill fit; do
  for count in $counts; do
    name=spheres:$count:$camera
    bench "$name" >"$scratch/own"
    own=$(field median_ms <"$scratch/own") other="" by="" third=""
    if [ -n "$embree" ]; then
      other=$("$embree/embree_spheres" "$scenes/spheres_$count.bin" "$scenes/cameras_$camera.txt" "$width" "$height" "$scratch/e.png" "$FRAMES" | result ms)
      by=$(ratio "$own" "$other")
    fi
    if [ -n "$vtk" ] && [ "$count" -le 1000000 ]; then
      third=$(xvfb-run -a python3 "$peers/vtk/vtk_bench.py" "$scenes/spheres_$count.bin" "$width" "$height" "$scratch/v.png" --camera "$camera" --frames "$FRAMES" | result ms)
    fi
    echo "| \`$name\` | $(field expansion <"$scratch/own") | $own | $(field first_ms <"$scratch/own") | $other | $by | $third |"
  done
done

n=1e7
[ -z "$quick" ] || n=1e6
echo; echo "## Other scenes and cameras, $SIZE"; echo
echo "| what | expansion | ms |"
echo "|---|---|---|"
row() { # row TEXT ARGUMENTS...
  local text=$1
  shift
  bench "$@" >"$scratch/own"
  echo "| $text | $(field expansion <"$scratch/own") | $(field median_ms <"$scratch/own") |"
}
row "\`spheres:$n:inside\`" "spheres:$n:inside"
row "crystal" "crystal:$n:fill"
row "slab, nothing to hide" "slab:$n:fill"
row "dust" "dust:$n:fill"
row "\`spheres:$n:fill\`, 1° a frame" "spheres:$n:fill" --turn 1
row "\`spheres:$n:fill\`, 2° a frame" "spheres:$n:fill" --turn 2
row "\`spheres:$n:fill\`, a camera cut each frame" "spheres:$n:fill" --cut

echo; echo "## Parts of a frame, \`spheres:1e6:fill\`, $SIZE"; echo
bench spheres:1e6:fill --stages | python3 -c '
import json, sys
print("| pass | part | ms |\n|---|---|---|")
for p in json.load(sys.stdin)["passes"]:
    print("| {} | | {} |".format(p["name"], p["gpu_ms"]))
    for name, ms in p.get("stages", {}).items(): print(f"| | {name} | {ms} |")'

echo; echo "## Expansions, 1280x720"; echo
echo "| scene | vertex, ms | geometry, ms | compute, ms |"
echo "|---|---|---|---|"
for name in spheres:1e3:fit spheres:1e5:fit spheres:1e5:fill; do
  line="| \`$name\` |"
  for expansion in vertex geometry compute; do
    line+=" $("$mote" bench "$name" --expansion $expansion --size 1280x720 --frames "$FRAMES" --json | field median_ms) |"
  done
  echo "$line"
done
