#!/bin/sh
# SPDX-License-Identifier: MIT
# docs/tour.sh: makes the pictures of docs/tour.md, and of the window in README.md, by playing docs/tour/*.txt in a real window on a
# virtual display. Needs Xvfb and build/release/mote (or $MOTE).
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mote=${MOTE:-$root/build/release/mote}
command -v Xvfb >/dev/null || { echo "docs/tour.sh: Xvfb is missing: apt-get install xvfb" >&2; exit 1; }
work=$(mktemp -d)
Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp 3>"$work/display" 2>/dev/null &
xvfb=$!
trap 'kill $xvfb; rm -rf "$work"' EXIT
for _ in $(seq 200); do [ -s "$work/display" ] && break; sleep 0.05; done
DISPLAY=:$(cat "$work/display")
export DISPLAY
cd "$work"
cp -r "$root/app/scenes" scenes
for script in "$root"/docs/tour/*.txt; do
  scene=$(sed -n 's/^# scene: //p' "$script")
  # shellcheck disable=SC2086
  "$mote" view $scene --size 1280x720 --script "$script"
done
mkdir -p "$root/docs/images"
mv ./*.png "$root/docs/images/"
