#!/bin/sh
# SPDX-License-Identifier: MIT
# Fuzzes every reader (or those named) under address and undefined-behavior sanitizers: tests/fuzz/run.sh [SECONDS [FORMAT...]]
# 600 seconds a reader if nothing is said. What broke a reader is kept as build/fuzz/fuzz-FORMAT.input.
set -e
cd "$(dirname "$0")/../.."
seconds=${1:-600}
[ $# -gt 0 ] && shift
cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOTE_SANITIZE=ON -DMOTE_FUZZ=ON -DMOTE_BUILD_TESTS=ON -DMOTE_BUILD_APP=OFF > /dev/null
ninja -C build/fuzz fuzz_readers
cd build/fuzz
formats=${*:-$(./tests/fuzz/fuzz_readers --list)}
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=2048 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
failed=0
for format in $formats; do
  ./tests/fuzz/fuzz_readers "$format" "$seconds" || { failed=1; echo "$format: see build/fuzz/fuzz-$format.input" >&2; }
done
exit $failed
