// SPDX-License-Identifier: MIT
// Work of reading spread over the processor's cores: a loop over independent blocks. The result never
// depends on the number of threads. Used inside core/data only; it starts no threads for one block.
#pragma once

#include <cstddef>
#include <functional>

namespace mote::data {

// The cores that this process may use (its affinity, not the machine's), 1..16.
[[nodiscard]] unsigned worker_count();
// Calls body(block) once for each block in 0..blocks-1, several at a time, blocks handed out in
// ascending order. An exception of the lowest block that threw is thrown again after all have ended;
// blocks above a failed one may be left out.
void for_each_block(std::size_t blocks, const std::function<void(std::size_t)>& body);

} // namespace mote::data
