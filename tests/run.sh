#!/bin/sh
# SPDX-License-Identifier: MIT
# tests/run.sh [ctest options]: installs what is missing, builds everything and runs all tests on
# lavapipe with the Vulkan validation layer.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/cmake/setup.sh"
# shellcheck disable=SC2086
install_packages $mote_packages $mote_test_packages
build ON
cd "$build_dir"
exec ctest --output-on-failure -j 2 "$@"
