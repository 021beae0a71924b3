#!/usr/bin/env bash
# The tables of docs/performance.md, in Markdown on standard output; minutes on two cores. Nothing else should run.
#
#   tests/performance.sh [--mote PROGRAM] [--embree DIR] [--vtk] [--quick] [--only TABLE]...
#
# --embree DIR: Embree's columns. DIR gets the programs (made by ../shared/bench/build.sh and from tests/peers) and their scenes
#               where they are missing; Debian 12: libembree-dev libtbb-dev zlib1g-dev.
# --vtk:        VTK's columns, up to 1e6; Debian's python3-vtk9, python3-numpy and xvfb are there.
# --quick:      no scene of 1e7.
# --only TABLE: frames, sticks, preparing, others, parts or expansions; all of them if not given.
# From the environment: SIZE (1920x1080), FRAMES (9), ROUNDS (3: each scene is drawn by all programs in turns, and medians are
# shown, of times and of the ratios within a turn), SCENES (a folder with the peers' scenes), PYTHON (with NumPy, for the peers),
# RUN (a command put before each measured one, like `nice -n -10`).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
peers=$root/../shared/bench
mote=$root/build/release/mote embree="" vtk="" quick="" only=""
while [ $# -gt 0 ]; do
  case $1 in
    --mote) mote=$2; shift ;;
    --embree) embree=$2; shift ;;
    --vtk) vtk=1 ;;
    --quick) quick=1 ;;
    --only) only+=" $2 "; shift ;;
    *) sed -n '2,15s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
  shift
done
: "${SIZE:=1920x1080}" "${FRAMES:=9}" "${ROUNDS:=3}" "${RUN:=}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
counts="1000 100000 1000000"
[ -n "$quick" ] || counts+=" 10000000"
wanted() { [ -z "$only" ] || [[ $only == *" $1 "* ]]; }

if [ -n "$embree" ]; then
  [ -x "$embree/embree_spheres" ] || "$peers/build.sh" "$embree" >&2
  [ "$embree/embree_sticks" -nt "$root/tests/peers/embree_sticks.cpp" ] ||
    "${CXX:-g++}" -std=c++20 -O3 -march=native -fno-math-errno -fno-trapping-math -I"$peers" "$root/tests/peers/embree_sticks.cpp" -o "$embree/embree_sticks" -lembree3 -ltbb -lz >&2
fi
if [ -n "$embree$vtk" ]; then
  if [ -z "${PYTHON:-}" ]; then
    for PYTHON in python3 /usr/bin/python3; do "$PYTHON" -c 'import numpy' 2>/dev/null && break; done
  fi
  "$PYTHON" -c 'import numpy' || { echo "no Python with NumPy: install python3-numpy, or name one by PYTHON" >&2; exit 1; }
  [ -z "$vtk" ] || "$PYTHON" -c 'import vtkmodules' || { echo "$PYTHON has no VTK: install python3-vtk9, or name another by PYTHON" >&2; exit 1; }
  scenes=${SCENES:-${embree:-$scratch}/scenes}
  last=${counts##* }
  [ -e "$scenes/spheres_$last.bin" ] || "$PYTHON" "$peers/scenes/make_scenes.py" "$scenes" --max "$last" --text-max 0 >&2
fi

# Each leaves its program's JSON in the file named first. Options: SCENE WIDTHxHEIGHT [FURTHER...]
run() { # shellcheck disable=SC2086
  $RUN "$@"
}
bench() { local out=$1; shift; run "$mote" bench "$@" --frames "$FRAMES" --json >"$out"; }
embree() { # OUT PROGRAM SCENE.bin CAMERA WIDTHxHEIGHT
  run "$embree/$2" "$scenes/$3" "$scenes/cameras_$4.txt" "${5%x*}" "${5#*x}" "$scratch/e.png" "$FRAMES" | sed -n 's/^RESULT //p' >"$1"
}
vtk() { # OUT MODE SCENE.bin CAMERA WIDTHxHEIGHT
  run xvfb-run -a "$PYTHON" "$peers/vtk/vtk_bench.py" "$scenes/$3" "${5%x*}" "${5#*x}" "$scratch/v.png" --mode "$2" --camera "$4" --frames "$FRAMES" |
    sed -n 's/^RESULT //p' >"$1"
}
# cells KEY FILE...: the median of that value over the files, empty where there are none; ratios A B: of A.* over B.*, pair by pair.
cells() { python3 -c '
import json, statistics, sys
values = [json.load(open(f))[sys.argv[1]] for f in sys.argv[2:]]
print(values[0] if values and isinstance(values[0], str) else f"{statistics.median(values):.1f}" if values else "", end="")' "$@"; }
ratios() { python3 -c '
import glob, json, statistics, sys
def of(name): return [(lambda j: j.get("median_ms", j.get("ms")))(json.load(open(f))) for f in sorted(glob.glob(name + ".*"))]
pairs = [a / b for a, b in zip(of(sys.argv[1]), of(sys.argv[2]))]
print("{:.2f} ({})".format(statistics.median(pairs), ", ".join(f"{p:.2f}" for p in pairs)) if pairs else "", end="")' "$@"; }
files() { compgen -G "$scratch/$1.*" || true; }

frames_table() {
  echo; echo "## Frames, $SIZE"; echo
  echo "| scene | expansion | mote, ms | first frame, ms | Embree, ms | mote / Embree | VTK, ms | mote / VTK |"
  echo "|---|---|---|---|---|---|---|---|"
  local camera count name round
  for camera in fill fit; do
    for count in $counts; do
      name=spheres:$count:$camera
      rm -f "$scratch"/{own,embree,vtk}.*
      for ((round = 0; round < ROUNDS; ++round)); do
        bench "$scratch/own.$round" "$name" --size "$SIZE"
        [ -z "$embree" ] || embree "$scratch/embree.$round" embree_spheres "spheres_$count.bin" "$camera" "$SIZE"
        [ -z "$vtk" ] || [ "$count" -gt 1000000 ] || vtk "$scratch/vtk.$round" sphere "spheres_$count.bin" "$camera" "$SIZE"
      done
      # shellcheck disable=SC2046
      echo "| \`$name\` | $(cells expansion $(files own)) | $(cells median_ms $(files own)) | $(cells first_ms $(files own)) | $(cells ms $(files embree)) |" \
        "$(ratios "$scratch/own" "$scratch/embree") | $(cells ms $(files vtk)) | $(ratios "$scratch/own" "$scratch/vtk") |"
    done
  done
}

# Flat-ended sticks, and arrows beside the spheres of Embree, whose time says how fast the machine is.
sticks_table() {
  local round size=1280x720
  for ((round = 0; round < ROUNDS; ++round)); do
    bench "$scratch/sticks.$round" sticks:1e5:fit --expansion compute --size $size
    bench "$scratch/arrows.$round" arrows:1e5:fit --expansion compute --size $size
    if [ -n "$embree" ]; then
      embree "$scratch/exact.$round" embree_sticks cylinders_100000.bin fit $size
      embree "$scratch/cones.$round" embree_spheres cylinders_100000.bin fit $size
      embree "$scratch/spheres.$round" embree_spheres spheres_100000.bin fit $size
    fi
    [ -z "$vtk" ] || vtk "$scratch/stick_mapper.$round" stick cylinders_100000.bin fit $size
  done
  echo; echo "## Sticks and arrows, 1e5, \`fit\`, $size"; echo
  echo "| mote draws | ms | beside it | ms | ratio |"
  echo "|---|---|---|---|---|"
  row() { # shellcheck disable=SC2046
    echo "| $1 | $(cells median_ms $(files "$2")) | $3 | $(cells ms $(files "$4")) | $(ratios "$scratch/$2" "$scratch/$4") |"
  }
  if [ -n "$embree" ]; then
    row sticks sticks "Embree, exact sticks (tests/peers)" exact
    row sticks sticks "Embree's own cones, not exact" cones
    row arrows arrows "Embree, spheres" spheres
  fi
  [ -z "$vtk" ] || row sticks sticks "VTK's stick mapper" stick_mapper
}

# Sort, boxes and upload, and what stays in memory beyond that of a scene of a thousand.
preparing_table() {
  local n=10000000 round
  [ -z "$quick" ] || n=1000000
  for ((round = 0; round < ROUNDS; ++round)); do
    bench "$scratch/large.$round" "spheres:$n:fit" --expansion compute --size "$SIZE"
    bench "$scratch/small.$round" spheres:1000:fit --expansion compute --size "$SIZE"
    [ -z "$embree" ] || embree "$scratch/built.$round" embree_spheres "spheres_$n.bin" fit "$SIZE"
  done
  echo; echo "## Preparing \`spheres:$n:fit\`, $SIZE"; echo
  "${PYTHON:-python3}" - "$scratch" "$n" <<'PY'
import glob, json, statistics, sys
def of(name): return [json.load(open(f)) for f in sorted(glob.glob(f"{sys.argv[1]}/{name}.*"))]
def median(runs, *keys):
    values = []
    for run in runs:
        for key in keys: run = run[key]
        values.append(run)
    return statistics.median(values)
large, small, built, n = of("large"), of("small"), of("built"), int(sys.argv[2])
print("| what | value |\n|---|---|")
for key, text in (("values_ms", "values from columns"), ("chunks_ms", "sort, boxes, records"), ("upload_ms", "upload")):
    print(f"| {text} | {median(large, 'prepare', key):.0f} ms |")
if built: print(f"| Embree builds its tree | {1e3 * median(built, 'build_s'):.0f} ms |")
for key, text in (("prepared_bytes", "resident, prepared"), ("resident_bytes", "resident, drawing"), ("peak_bytes", "at the peak")):
    more = median(large, "memory", key) - median(small, "memory", key)
    print(f"| {text} | {more / n:.1f} bytes a particle more than 1e3 ({median(large, 'memory', key) / 1e6:.0f} MB in all) |")
PY
}

others_table() {
  local n=1e7
  [ -z "$quick" ] || n=1e6
  echo; echo "## Other scenes and cameras, $SIZE"; echo
  echo "| what | expansion | ms |"
  echo "|---|---|---|"
  row() { # row TEXT ARGUMENTS...
    local text=$1
    shift
    bench "$scratch/row" "$@" --size "$SIZE"
    echo "| $text | $(cells expansion "$scratch/row") | $(cells median_ms "$scratch/row") |"
  }
  row "\`spheres:$n:inside\`" "spheres:$n:inside"
  row "crystal" "crystal:$n:fill"
  row "slab, nothing to hide" "slab:$n:fill"
  row "dust" "dust:$n:fill"
  row "\`spheres:$n:fill\`, 1° a frame" "spheres:$n:fill" --turn 1
  row "\`spheres:$n:fill\`, 2° a frame" "spheres:$n:fill" --turn 2
  row "\`spheres:$n:fill\`, a camera cut each frame" "spheres:$n:fill" --cut
}

parts_table() {
  echo; echo "## Parts of a frame, \`spheres:1e6:fill\`, $SIZE"; echo
  bench "$scratch/parts" spheres:1e6:fill --stages --size "$SIZE"
  python3 - "$scratch/parts" <<'PY'
import json, sys
print("| pass | part | ms |\n|---|---|---|")
for p in json.load(open(sys.argv[1]))["passes"]:
    print("| {} | | {} |".format(p["name"], p["gpu_ms"]))
    for name, ms in p.get("stages", {}).items(): print(f"| | {name} | {ms} |")
PY
}

expansions_table() {
  echo; echo "## Expansions, 1280x720"; echo
  echo "| scene | vertex, ms | geometry, ms | compute, ms |"
  echo "|---|---|---|---|"
  local name expansion line
  for name in spheres:1e3:fit spheres:1e5:fit spheres:1e5:fill; do
    line="| \`$name\` |"
    for expansion in vertex geometry compute; do
      bench "$scratch/$expansion" "$name" --expansion $expansion --size 1280x720
      line+=" $(cells median_ms "$scratch/$expansion") |"
    done
    echo "$line"
  done
}

date -u '+Measured on %Y-%m-%d,'
bench "$scratch/device" spheres:10 --size 16x16
cells device "$scratch/device"
echo
for table in frames sticks preparing others parts expansions; do
  ! wanted $table || ${table}_table
done
