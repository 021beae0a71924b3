// SPDX-License-Identifier: MIT
// The states of a drawing pass as a graph file says them: depth_test, depth_write, blend, cull. Read
// by the pass kinds that draw particles, turned into a pipeline by particles/pipelines.cpp.
//
// Words mean distance from the eye and surfaces of particles, whatever the encoding: depth is n / z
// (reverse-Z), so `less` becomes Greater on the device; a particle's front surface is where the ray
// enters it, its back surface where the ray leaves. Unknown words are G020 and G023 at their place.
#pragma once

#include "core/gpu/descriptors.hpp"
#include "render_graph/params.hpp"

#include <cstdint>
#include <optional>

namespace mote::passes {

// The surfaces that are not drawn. None of them for an opaque particle: its entry, or the inner wall where the
// entry is cut off; Back: entries only; Front: exits only.
enum class Cull : std::uint32_t { None, Front, Back };

struct DrawStates {
  gpu::CompareFunction depth_test{gpu::CompareFunction::Less}; // of distances: drawn if (its own) TEST (what is there)
  bool depth_write{true};
  std::uint32_t blend{}; // packed by pack(); 0: the fragment replaces what is there
  Cull cull{Cull::None};
  auto operator<=>(const DrawStates&) const = default;
};

// A blend state in one number that compares; never 0.
std::uint32_t pack(const gpu::BlendState& blend);
std::optional<gpu::BlendState> unpack_blend(std::uint32_t packed);

// rgb = source alpha * source + (1 - source alpha) * destination, of straight colors; alpha adds up as coverage.
gpu::BlendState blend_over();
// The same with a source that is already multiplied by its alpha.
gpu::BlendState blend_over_premultiplied();

// The comparison of encoded depths that means this comparison of distances.
gpu::CompareFunction encoded(gpu::CompareFunction distance);
// The encoded depth that every surface passes against at the start: infinitely far, or distance 0 where only what is
// farther (`greater`, `greater_equal`) is drawn.
double cleared_depth(const DrawStates& states);

// Asks for all four. `defaults` are the kind's own.
DrawStates read_states(rg::Params& params, const DrawStates& defaults = {});

} // namespace mote::passes
