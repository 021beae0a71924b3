// SPDX-License-Identifier: MIT
#include "passes/particles/tiles/tiled_drawing.hpp"

#include "passes/particles/particle_type.hpp"

#include <algorithm>
#include <map>

namespace mote::passes {
namespace {

std::string type_of_most(const Scene& scene) {
  std::map<std::string, std::uint64_t> counts;
  for (const Batch& batch : scene.batches) counts[batch.type] += batch.chunks->chunks.size() * batch.instances.size();
  const auto most = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "sphere" : most->first;
}

} // namespace

// The scene without the batches that are not the pass's.
const Scene& TiledDrawing::selected(const Scene& scene, const Selection& selection) {
  const auto mine = [&](const Batch& batch) { return selection.draws(batch); };
  if (std::all_of(scene.batches.begin(), scene.batches.end(), mine)) return scene;
  selected_ = scene;
  std::erase_if(selected_.batches, [&](const Batch& batch) { return !mine(batch); });
  return selected_;
}

bool TiledDrawing::place(gpu::Device device, const ParticleStore& store, const gpu::BindGroupLayout& frame, const TileWish& wish) {
  const Scene& scene = selected(wish.scene, wish.selection);
  const std::string type = wish.type.empty() ? type_of_most(scene) : wish.type;
  TilePlacing placing = wish.placing;
  placing.splats = !wish.edges && TileKernels::splats(device, type);
  if (wish.edges) placing.margin = edge_margin;
  store.place_tiles(scene, wish.view, type, placing, tiled_, wish.slot);
  if (tiled_.chunks.empty()) return false;
  if (!tiles_) tiles_ = std::make_unique<TileRenderer>(std::move(device), frame);
  tiles_->update(tiled_, wish.view.size.width, wish.view.size.height, wish.edges);
  bool mixed = false;
  key_ = key_for_all(scene, wish.view, mixed); // never mixed: why_not() has looked
  key_.type = type;
  key_.phase = wish.phase;
  key_.proxy_slack = wish.slack;
  key_.show_depth_violation = wish.alarm;
  if (wish.phase != Phase::Opaque) unlit(key_);
  if (wish.phase == Phase::Shadow) {
    key_.per_particle_color = false;
    key_.type_number = number_of(*find_particle_type(type));
  }
  return true;
}

void TiledDrawing::record(gpu::CommandEncoder& encoder, const gpu::BindGroup& frame_group, const TileTargets& targets, const TileRenderer::Mark& mark) {
  tiles_->record(encoder, tiled_, frame_group, key_, targets, mark);
}

} // namespace mote::passes
