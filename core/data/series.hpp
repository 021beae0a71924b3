// SPDX-License-Identifier: MIT
// Several files as one source of frames: a series of files one behind the other ('name_*.vtk' in the order
// of the numbers in their names, or a list), and a topology with the trajectory that moves it (md.gro with
// md.xtc). In every series a particle keeps its row: frames whose rows carry ids are put into the order of
// frame 0, particles that frame 0 does not have come behind in the order of their ids.
//
// Files are opened when a frame of them is asked for, and one at a time, so that a series of thousands needs
// the memory of one. Called by core/scene and the command line; readers know nothing of it.
#pragma once

#include "core/data/source.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace mote::data {

struct SeriesFiles {
  std::vector<std::filesystem::path> files{};      // names or patterns; with a trajectory: one file, the topology
  std::vector<std::filesystem::path> trajectory{}; // names or patterns; empty: none
};

// Has the last part of the name a '*' or '?' (and is it not the name of a file that exists)?
bool is_pattern(const std::filesystem::path& name);
// The files that a pattern means ('*': any characters, '?': one), numbers in their names compared as numbers:
// a_2 before a_10. A name that is no pattern is itself. D025 when nothing fits.
std::vector<std::filesystem::path> expand_pattern(const std::filesystem::path& pattern);
// By the ending (.gz, .xz, .zst looked through): a format that holds positions of particles described elsewhere.
bool is_trajectory_name(const std::filesystem::path& name);

// D025 (a pattern without files), D026 (topology and trajectory do not fit), and what open() and readers say.
std::unique_ptr<Source> open_series(const SeriesFiles& files);

// Index of frame `wanted` (negative: from the end, -1 is the last) of `count`. D017.
std::uint64_t frame_index(std::int64_t wanted, std::uint64_t count, const SourceLoc& loc);
// "7", "-1", "a:b", "a:b:step" as Python's slices (b not included, negative ones from the end, step below zero
// goes backward), several joined by commas. D027 for other words, D017 for a single index that is not there.
std::vector<std::uint64_t> frame_list(std::string_view text, std::uint64_t count, const SourceLoc& loc);

} // namespace mote::data
