// SPDX-License-Identifier: MIT
// Which rows of a frame are drawn, and where copies of them stand: the biological assembly that a file
// describes, or the bare rows. Private to core/scene and `mote info`.
#pragma once

#include "core/data/dataset.hpp"
#include "core/scene/scene_file.hpp"

#include <string>
#include <vector>

namespace mote {

// Rows that have the same copies; one or more transforms.
struct Copies {
  std::vector<bool> rows{};              // one per row; empty: all of them
  std::vector<glm::dmat4> transforms{};  // data -> data, rigid
};

// `wanted`: an assembly's name, "none" for the bare rows, nothing for the file's first assembly (bare rows where it has
// none). The transforms of files carry six decimals; they are made exactly rigid. Errors: S016 (no such assembly; the
// message lists what there is), S014 (a transform that is far from rigid).
std::vector<Copies> copies_of(const data::Frame& frame, const std::optional<Located<std::string>>& wanted,
                              const std::string& file, Diagnostics& diagnostics);

} // namespace mote
