#!/bin/sh
# SPDX-License-Identifier: MIT
# app/run.sh [FILE...]: installs what is missing, builds build/release/mote and shows FILE, or a data
# set of this repository, in a window; without a display as mote.png.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/cmake/setup.sh"
# shellcheck disable=SC2086
install_packages $mote_packages
tests=OFF
[ -f "${MOTE_BUILD:-$root/build/release}/configured-tests-ON-werror-OFF" ] && tests=ON
build "$tests" mote_cli
[ $# -gt 0 ] || set -- "$root/app/scenes/packing.toml"
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then exec "$build_dir/mote" view "$@"; fi
"$build_dir/mote" render "$@" -o mote.png --size 1280x720
say "there is no display for a window; the picture is in $(pwd)/mote.png"
