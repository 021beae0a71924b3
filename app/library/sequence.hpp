// SPDX-License-Identifier: MIT
// Many pictures: file names with numbers, which of them a job of an array draws, and whether a file that is there
// already is complete. Nothing here draws.
#pragma once

#include "core/math/camera.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mote::app {

// Has the name "%d" or "%04d" in it? "%%" is a percent sign.
[[nodiscard]] bool is_numbered(std::string_view name);
// "out_%04d.png", 7 -> "out_0007.png". Throws A018 for a name with several numbers or other % words.
[[nodiscard]] std::string numbered(std::string_view name, std::uint64_t number);

// Part K of N of a list: every N-th item. K counts from 0 or from 1, as the job array does: N and 0 are the same part.
struct Shard {
  std::uint64_t part{}, parts{1};
};
[[nodiscard]] Shard parse_shard(std::string_view text); // "3/8"; throws A019
[[nodiscard]] std::vector<std::uint64_t> part_of(const std::vector<std::uint64_t>& all, const Shard& shard);

// Is `path` a whole picture or array of this size? PNG: signature, size and end mark; EXR and NPY: it reads.
[[nodiscard]] bool is_complete(const std::string& path, Size2d size);

} // namespace mote::app
