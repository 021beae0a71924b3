// SPDX-License-Identifier: MIT
// One order over all particles of all batches, and what shaders need to draw them by it: pure, no
// device. Called by ordered_store.cpp, which puts the result on the device.
//
// The key of a particle is the power |m|^2 - r^2 of the eye (perspective) or the depth of its center
// (orthographic), in double: for disjoint spheres with the eye outside all of them that is the exact
// order (method book 8.1). Elsewhere it is approximate. Ties keep the order of batches, instances and
// chunks.
#pragma once

#include "core/scene/scene.hpp"
#include "passes/particles/particle_store.hpp"
#include "passes/particles/placement.hpp"
#include "passes/particles/selection.hpp"

#include <cstdint>
#include <vector>

namespace mote::passes {

enum class Order : std::uint8_t { BackToFront, FrontToBack, File };

// Particles that follow each other in the order and can be drawn by one pipeline.
struct OrderedRun {
  std::uint32_t first{}, count{}; // places in OrderedParticles::order
  std::uint32_t batch{};          // any batch of the run: what its pipeline must be able to do
  bool near_eye{}, affine{};
};

struct OrderedParticles {
  std::vector<PlacedChunk> placements{};   // near ones first; w counts in the store of their type
  std::vector<std::uint32_t> owners{};     // per placement: its row of `blocks`
  std::vector<NearPayload> near{};         // 64 a near placement
  std::vector<std::uint32_t> order{};      // 64 placement + slot
  std::vector<OrderedRun> runs{};
  std::vector<BatchBlock> blocks{};        // per (batch, instance) with something in view
};

// Where the chunks of a set start in the concatenated buffers of its type.
struct ChunkBase {
  const ChunkSet* set{};
  std::uint32_t first_chunk{};
};

// Everything of the selection that the view may see, in order. Particles of alpha 0 are left out.
OrderedParticles order_particles(const Scene& scene, const View& view, const Selection& selection, Order order,
                                 const std::vector<ChunkBase>& bases);

// Alpha of a record: its own times the batch's.
double alpha_of(const Batch& batch, std::uint64_t record);
bool in_selection(Opacity opacity, double alpha);

} // namespace mote::passes
