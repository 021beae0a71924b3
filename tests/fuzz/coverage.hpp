// SPDX-License-Identifier: MIT
// Which ways through core/data an input took: every jump between blocks of code that the compiler marks
// (-fsanitize-coverage=trace-pc) counts in a table, in steps of 1, 2, 3, 4, 8, 16, 32 and 128 times. For fuzz_readers only.
#pragma once

namespace mote::fuzz {

void clear_coverage();
// True when since clear_coverage() a jump was taken, or taken more often, as never before in this process.
bool covered_anything_new();

} // namespace mote::fuzz
