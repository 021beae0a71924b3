#!/usr/bin/env bash
# Compares two builds of mote, in turns, so that a machine whose speed drifts treats both alike.
#
#   tests/paired.sh A B SCENE...        A, B: mote programs; SCENE: anything that `mote bench` takes
#
# SIZE (1920x1080), FRAMES (9), TURNS (5) and OPTIONS (further options of bench, like --cut) come from the environment.
# Prints for each scene the median over the turns of each build and of their ratios; B/A below 1: B is faster.
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
a=$1 b=$2
shift 2
: "${SIZE:=1920x1080}" "${FRAMES:=9}" "${TURNS:=5}" "${OPTIONS:=}"
ms() { # shellcheck disable=SC2086
  "$1" bench "$2" --size "$SIZE" --frames "$FRAMES" --json $OPTIONS | python3 -c 'import json,sys; print(json.load(sys.stdin)["median_ms"])'
}
printf '%-24s %10s %10s %8s   %s\n' scene "A, ms" "B, ms" B/A "ratios of the turns"
for scene in "$@"; do
  pairs=""
  for ((turn = 0; turn < TURNS; ++turn)); do
    if ((turn % 2)); then y=$(ms "$b" "$scene") x=$(ms "$a" "$scene"); else x=$(ms "$a" "$scene") y=$(ms "$b" "$scene"); fi
    pairs+="$x $y "
  done
  python3 - "$scene" $pairs <<'PY'
import statistics, sys
values = [float(v) for v in sys.argv[2:]]
a, b = values[0::2], values[1::2]
ratios = sorted(y / x for x, y in zip(a, b))
print(f"{sys.argv[1]:<24} {statistics.median(a):10.2f} {statistics.median(b):10.2f} {statistics.median(ratios):8.3f}   {' '.join(f'{r:.3f}' for r in ratios)}")
PY
done
