#!/bin/sh
# SPDX-License-Identifier: MIT
# Line coverage of each reader by the tests of core/data: tests/fuzz/coverage.sh [LEAST]. Exit status 1 when a reader lies
# below LEAST percent (80 if nothing is said). Builds without optimization in build/coverage; needs gcov.
set -e
cd "$(dirname "$0")/../.."
least=${1:-80}
cmake -S . -B build/coverage -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="--coverage -O0" -DMOTE_BUILD_TESTS=ON -DMOTE_BUILD_APP=OFF > /dev/null
ninja -C build/coverage data_unit data_fields data_molecular data_hdf5 fuzz_short
find build/coverage -name '*.gcda' -delete
for test in data/data_unit data_fields/data_fields data_molecular/data_molecular data_hdf5/data_hdf5 fuzz/fuzz_short; do build/coverage/tests/$test > /dev/null || true; done
objects=build/coverage/core/data/CMakeFiles/mote_data.dir
low=0
for source in core/data/reader_*.cpp; do
  percent=$(gcov -n -o "$objects" "$objects/$(basename "$source").gcda" 2>/dev/null | grep -A1 "File '.*$source'" | sed -n 's/Lines executed:\([0-9.]*\)%.*/\1/p' | head -1)
  echo "$(basename "$source" .cpp) ${percent:-0} %"
  [ "$(printf '%.0f' "${percent:-0}")" -ge "$least" ] || low=1
done
exit $low
