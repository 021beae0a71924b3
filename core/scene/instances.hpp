// SPDX-License-Identifier: MIT
// Where the copies of a data set stand: its transform, the replicas of its cell, the copies of an assembly. Values only;
// realize.cpp asks it for a new scene, and place_again() for one whose data sets were only moved. Private to core/scene.
#pragma once

#include "core/scene/annotations.hpp"
#include "core/scene/assembly.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_file.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mote {

// Of all particles of a chunk set under an affine map: exact for none, the box around the chunks' boxes otherwise.
[[nodiscard]] Bounds world_bounds(const ChunkSet& set, const glm::dmat4& world_from_data);
// The box around a box under an affine map.
[[nodiscard]] Bounds moved(const Bounds& bounds, const glm::dmat4& m);

// Copies along the edges of the cell, the cell itself first. Empty with S-codes in `diagnostics` where there is no cell.
[[nodiscard]] std::vector<glm::dmat4> replicas_of(const DataDesc& desc, const data::Frame& frame, const std::string& name, Diagnostics& diagnostics);
// World from data: transform * replica * copy, replicas outside.
[[nodiscard]] std::vector<Instance> instances_of(const DataDesc& desc, const std::vector<glm::dmat4>& replicas, const std::vector<glm::dmat4>& copies);

// The edges of the frame's cell under the transform; nothing where none is to be drawn or the frame has none.
[[nodiscard]] std::optional<CellOutline> cell_of(const DataDesc& desc, const data::Frame& frame);

} // namespace mote
