// SPDX-License-Identifier: MIT
// A deflate compressor (RFC 1951) for filtered picture rows, an order faster than zlib's quickest
// setting on shaded particles: dynamic Huffman codes and runs of one byte (distance 1), no search for
// other repetitions, which difference rows hardly have. png_write.cpp deflates its strips with it;
// any inflater reads the result. Private to core/image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mote {

// Appends deflate blocks for `input` to `out`, ending on a byte: after the last part of a stream
// with the final bit set, else with an empty stored block (what zlib calls a sync flush).
void deflate_runs(std::span<const std::uint8_t> input, bool last, std::vector<std::byte>& out);

} // namespace mote
