#!/bin/sh
# SPDX-License-Identifier: MIT
# Fuzzes every reader (or those named) under address and undefined-behavior sanitizers: tests/fuzz/run.sh [SECONDS [FORMAT...]]
# 600 seconds of processor time a reader if nothing is said, JOBS readers (1) at a time, different inputs by SEED (1). Run it
# under `chrt -i 0` to use only what nobody else needs; MOTE_HDF5=ON is with the format hdf5. What broke a reader is kept as build/fuzz/fuzz-FORMAT.input: a length
# of 8 bytes, then the file.
set -e
cd "$(dirname "$0")/../.."
seconds=${1:-600}
[ $# -gt 0 ] && shift
cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=Release -DMOTE_SANITIZE=ON -DMOTE_FUZZ=ON -DMOTE_BUILD_TESTS=ON -DMOTE_BUILD_APP=OFF -DMOTE_HDF5="${MOTE_HDF5:-OFF}" > /dev/null
ninja -C build/fuzz fuzz_readers
cd build/fuzz
formats=${*:-$(./tests/fuzz/fuzz_readers --list)}
export ASAN_OPTIONS=max_allocation_size_mb=2048 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
printf '%s\n' $formats | xargs -P "${JOBS:-1}" -I FORMAT \
  sh -c "./tests/fuzz/fuzz_readers FORMAT $seconds ${SEED:-1} || { echo 'FORMAT: see build/fuzz/fuzz-FORMAT.input' >&2; exit 1; }"
