// SPDX-License-Identifier: MIT
// Changes that break readers: bits, bytes, pieces, numbers as text and as bytes, mixtures of two files. The same
// generator state gives the same change on every machine.
#pragma once

#include <random>
#include <string>
#include <string_view>

namespace mote::fuzz {

using Random = std::mt19937_64;

// `content` changed in one to eight places; `other` lends pieces. At most `most` bytes.
std::string mutated(std::string_view content, std::string_view other, Random& random, std::size_t most = 1 << 16);

} // namespace mote::fuzz
