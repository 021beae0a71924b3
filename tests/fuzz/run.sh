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
# The HDF5 library asks for whatever size a changed file names, and is told that there is none; when a file is refused it keeps memory.
export HDF5_OPTIONS=$ASAN_OPTIONS:allocator_may_return_null=1:detect_leaks=0
printf '%s\n' $formats | xargs -P "${JOBS:-1}" -I FORMAT \
  sh -c "case FORMAT in hdf5) export ASAN_OPTIONS=\$HDF5_OPTIONS ;; esac
    ./tests/fuzz/fuzz_readers FORMAT $seconds ${SEED:-1} 2> fuzz-FORMAT.log || { cat fuzz-FORMAT.log; echo 'FORMAT: see build/fuzz/fuzz-FORMAT.input'; exit 1; } >&2"
