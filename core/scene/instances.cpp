// SPDX-License-Identifier: MIT
#include "core/scene/instances.hpp"

#include "core/scene/codes.hpp"
#include "core/scene/realize.hpp"
#include "core/scene/scene_source.hpp"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace mote {

Bounds world_bounds(const ChunkSet& set, const glm::dmat4& world_from_data) {
  Bounds out;
  if (world_from_data == glm::dmat4(1.0)) return set.bounds;
  for (const Chunk& chunk : set.chunks)
    out.add(moved({chunk.origin + glm::dvec3(chunk.box_min), chunk.origin + glm::dvec3(chunk.box_max)}, world_from_data));
  return out;
}

Bounds moved(const Bounds& bounds, const glm::dmat4& m) {
  Bounds out;
  for (int i = 0; i < 8 && !bounds.empty(); ++i)
    out.add(glm::dvec3(m * glm::dvec4(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y, i & 4 ? bounds.max.z : bounds.min.z, 1.0)));
  return out;
}

std::vector<glm::dmat4> replicas_of(const DataDesc& desc, const data::Frame& frame, const std::string& name, Diagnostics& diagnostics) {
  if (desc.replicas == glm::ivec3(1)) return {glm::dmat4(1.0)};
  if (!frame.box) {
    diagnostics.error(code::no_cell, desc.loc, fmt::format("{} has no cell to repeat", name));
    return {};
  }
  std::vector<glm::dmat4> out;
  for (int x = 0; x < desc.replicas.x; ++x)
    for (int y = 0; y < desc.replicas.y; ++y)
      for (int z = 0; z < desc.replicas.z; ++z) out.push_back(glm::translate(glm::dmat4(1.0), frame.box->edges * glm::dvec3(x, y, z)));
  return out;
}

std::vector<Instance> instances_of(const DataDesc& desc, const std::vector<glm::dmat4>& replicas, const std::vector<glm::dmat4>& copies) {
  std::vector<Instance> out;
  for (const glm::dmat4& replica : replicas)
    for (const glm::dmat4& copy : copies) out.push_back({desc.transform * replica * copy});
  return out;
}

std::optional<CellOutline> cell_of(const DataDesc& desc, const data::Frame& frame) {
  if (!desc.cell.drawn || !frame.box) return std::nullopt;
  const glm::dmat3 linear(desc.transform);
  return CellOutline{glm::dvec3(desc.transform * glm::dvec4(frame.box->origin, 1.0)), linear * frame.box->edges, desc.cell.color, desc.cell.width};
}

namespace {

// What a generated scene's particles come without: a file, a cell, an assembly.
struct Placed {
  std::vector<glm::dmat4> replicas{glm::dmat4(1.0)};
  std::vector<Copies> groups{{{}, {glm::dmat4(1.0)}}};
};

Placed placed(const DataDesc& data, const data::Frame* frame, Diagnostics& diagnostics) {
  if (!frame) return {};
  const std::string name = data.file.value.string();
  return {replicas_of(data, *frame, name, diagnostics), copies_of(*frame, data.assembly, name, diagnostics)};
}

// As Realizer::add_series_bounds(), which has run for this data set.
void grow_by_series(const DataDesc& data, SceneSource& source, std::size_t i, const Placed& where, Scene& scene, Diagnostics& diagnostics) {
  SceneSource::Reach& reach = *source.reach(i);
  reach.transforms.clear();
  for (const Copies& copies : where.groups)
    for (const Instance& instance : instances_of(data, where.replicas, copies.transforms)) reach.transforms.push_back(instance.world_from_data);
  const Bounds centers = source.series_centers(i, diagnostics);
  Bounds grown;
  if (!centers.empty()) {
    grown.add(centers.min, reach.radius);
    grown.add(centers.max, reach.radius);
  }
  for (const glm::dmat4& m : reach.transforms) scene.bounds.add(moved(grown, m));
}

} // namespace

bool place_again(Scene& scene, const SceneDesc& desc, SceneSource& source, std::optional<std::uint64_t> index, Diagnostics& diagnostics) {
  Scene next = scene;
  next.bounds = {};
  next.annotations.cells.clear();
  for (std::size_t i = 0; i < desc.data.size(); ++i) {
    const DataDesc& data = desc.data[i];
    const std::shared_ptr<const data::Frame> frame = data.generated ? nullptr : source.frame(i, index, diagnostics);
    if (!data.generated && !frame) return false;
    const Placed where = placed(data, frame.get(), diagnostics);
    if (diagnostics.has_errors()) return false;
    if (frame)
      if (const auto cell = cell_of(data, *frame)) next.annotations.cells.push_back(*cell);
    const bool over_series = index && !data.generated && source.reach(i);
    if (over_series) grow_by_series(data, source, i, index == 0u ? where : placed(data, source.frame(i, 0, diagnostics).get(), diagnostics), next, diagnostics);
    for (Batch& batch : next.batches) {
      if (batch.data != i) continue;
      if (batch.group >= where.groups.size()) return false;
      batch.instances = instances_of(data, where.replicas, where.groups[batch.group].transforms);
      if (over_series) continue;
      for (const Instance& instance : batch.instances) next.bounds.add(world_bounds(*batch.chunks, instance.world_from_data));
    }
  }
  if (diagnostics.has_errors()) return false;
  scene = std::move(next);
  return true;
}

} // namespace mote
