#!/bin/sh
# SPDX-License-Identifier: MIT
# docs/course.sh: makes the pictures of docs/course.md. Needs build/release/mote (or $MOTE).
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mote=${MOTE:-$root/build/release/mote}
course=$root/app/scenes/course
draw() { # NAME SCENE [OPTIONS...]
  name=$1 scene=$2
  shift 2
  "$mote" render "$course/$scene.toml" --size 240x160 "$@" -o "$root/docs/images/course_$name.png"
}
for step in proxy discard shade depth points quadratic; do
  scene=spheres
  [ $step = quadratic ] && scene=far_sphere
  draw $step $scene --set opaque.steps=$step
done
draw arrows arrows --set legend=false
draw acne acne --set shadow.method=depth --set shadow.normal_offset=0 --set shadow.pcf=0
draw phong phong
draw maxima maxima --view Raw
draw layers layers
draw plane plane --samples 1
