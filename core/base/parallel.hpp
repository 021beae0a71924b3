// SPDX-License-Identifier: MIT
// Work spread over the processor's cores: loops over independent blocks, and over equal parts of a
// range. What a caller computes never depends on the number of threads. Readers, the chunk builder and
// the reference tracer use these; nothing keeps threads between calls, and one block starts none.
//
// Which to take: blocks where their costs differ (they are handed out one by one), parts where each
// thread keeps something of its own (a histogram) or the order of the parts matters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace mote {

// The cores that this process may use (its affinity, not the machine's); at least 1.
[[nodiscard]] unsigned worker_count();

// Calls body(block) once for each block in 0..blocks-1, several at a time, blocks handed out in ascending
// order. `threads` 0: one a core. An exception of the lowest block that threw is thrown again after all have
// ended; blocks above a failed one may be left out.
void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body, unsigned threads = 0);

// Threads worth starting for `count` items of which one thread should get at least `grain`; at least 1.
[[nodiscard]] std::uint32_t thread_count(std::uint64_t count, std::uint64_t grain);

// Calls body(part, begin, end) for `parts` consecutive ranges of [0, count) of nearly equal size; part < parts.
void parallel_parts(std::uint64_t count, std::uint32_t parts,
                    const std::function<void(std::uint32_t, std::uint64_t, std::uint64_t)>& body);

} // namespace mote
