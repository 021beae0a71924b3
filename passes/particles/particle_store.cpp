// SPDX-License-Identifier: MIT
#include "passes/particles/particle_store.hpp"

#include "passes/particles/placement.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace mote::passes {
namespace {

template <class T> std::span<const std::byte> bytes_of(std::span<const T> values) { return std::as_bytes(values); }

// A run of chunks of one set whose buffers fit a binding.
struct Slice {
  std::uint64_t first_chunk{}, chunk_count{};
  gpu::Buffer records{}, rows{}, colors{};
};

struct Resident {
  std::shared_ptr<const ChunkSet> set{}; // kept: the key is its address
  std::vector<Slice> slices{};
};

} // namespace

struct ParticleStore::Impl {
  gpu::Device device;
  gpu::BindGroupLayout layout;
  gpu::Buffer no_colors; // bound where a set has none; never read
  std::map<const ChunkSet*, Resident> residents;
  struct Placements {
    gpu::Buffer buffer{};
    std::vector<PlacedChunk> chunks{};
    std::map<const Slice*, gpu::BindGroup> groups{};
  };
  std::map<std::uint32_t, Placements> placements;

  gpu::Buffer storage(std::string_view label, std::span<const std::byte> contents) {
    return device.create_buffer({.label = label, .size = contents.size(), .usage = gpu::BufferUsage::Storage, .contents = contents});
  }
  Resident make_resident(const std::shared_ptr<const ChunkSet>& set);
  gpu::BindGroup group_for(Placements& placed, const Slice& slice);
};

ParticleStore::ParticleStore(gpu::Device device) : impl_(std::make_unique<Impl>()) {
  impl_->device = std::move(device);
  std::array<gpu::BindGroupLayoutEntry, 4> entries;
  for (std::uint32_t i = 0; i < entries.size(); ++i)
    entries[i] = {.binding = i,
                  .visibility = gpu::ShaderStage::Vertex, // every expansion loads its record there
                  .type = gpu::BindingType::ReadOnlyStorageBuffer};
  impl_->layout = impl_->device.create_bind_group_layout({.label = "particles", .entries = entries});
  const std::array<std::uint32_t, 4> none{};
  impl_->no_colors = impl_->storage("particles.no_colors", std::as_bytes(std::span(none)));
}

ParticleStore::~ParticleStore() = default;

const gpu::BindGroupLayout& ParticleStore::layout() const { return impl_->layout; }

Resident ParticleStore::Impl::make_resident(const std::shared_ptr<const ChunkSet>& set) {
  Resident resident{set, {}};
  const std::uint64_t chunk_bytes = std::uint64_t{chunk_capacity} * set->vec4s_per_record * sizeof(glm::vec4);
  const std::uint64_t chunks_per_slice = std::max<std::uint64_t>(1, device.limits().max_storage_buffer_binding_size / chunk_bytes);
  for (std::uint64_t first = 0; first < set->chunks.size(); first += chunks_per_slice) {
    Slice slice;
    slice.first_chunk = first;
    slice.chunk_count = std::min<std::uint64_t>(chunks_per_slice, set->chunks.size() - first);
    const std::uint64_t record = first * chunk_capacity, count = slice.chunk_count * chunk_capacity;
    slice.records = storage("particles.records", bytes_of(std::span(set->records).subspan(record * set->vec4s_per_record, count * set->vec4s_per_record)));
    slice.rows = storage("particles.rows", bytes_of(std::span(set->rows).subspan(record, count)));
    slice.colors = set->colors.empty() ? no_colors : storage("particles.colors", bytes_of(std::span(set->colors).subspan(record, count)));
    resident.slices.push_back(std::move(slice));
  }
  return resident;
}

void ParticleStore::upload(const Scene& scene) {
  std::map<const ChunkSet*, Resident> kept;
  bool changed = false;
  for (const Batch& batch : scene.batches) {
    const ChunkSet* key = batch.chunks.get();
    if (kept.contains(key)) continue;
    auto known = impl_->residents.find(key);
    if (known != impl_->residents.end())
      kept.insert(impl_->residents.extract(known));
    else {
      kept.emplace(key, impl_->make_resident(batch.chunks));
      changed = true;
    }
  }
  changed |= !impl_->residents.empty(); // what is left there is used no more
  impl_->residents = std::move(kept);
  if (changed)
    for (auto& [slot, placed] : impl_->placements) placed.groups.clear();
}

gpu::BindGroup ParticleStore::Impl::group_for(Placements& placed, const Slice& slice) {
  gpu::BindGroup& group = placed.groups[&slice];
  if (!group) {
    const std::array<gpu::BindGroupEntry, 4> entries{{{.binding = 0, .buffer = {&slice.records}},
                                                      {.binding = 1, .buffer = {&slice.rows}},
                                                      {.binding = 2, .buffer = {&slice.colors}},
                                                      {.binding = 3, .buffer = {&placed.buffer}}}};
    group = device.create_bind_group({.label = "particles", .layout = &layout, .entries = entries});
  }
  return group;
}

PlacedView ParticleStore::place(const Scene& scene, const View& view, std::uint32_t slot) const {
  Impl::Placements& placed = impl_->placements[slot];
  placed.chunks.clear();
  struct Run { const Batch* batch; const Instance* instance; std::uint64_t instance_index; const Slice* slice; std::uint32_t first, count; };
  std::vector<Run> runs;
  PlacedView result;
  const ViewCuller culler(view);
  for (const Batch& batch : scene.batches) {
    const Resident& resident = impl_->residents.at(batch.chunks.get());
    for (std::size_t k = 0; k < batch.instances.size(); ++k)
      for (const Slice& slice : resident.slices) {
        const std::size_t first = placed.chunks.size();
        place_chunks(*batch.chunks, slice.first_chunk, slice.chunk_count, batch.instances[k], view, culler, placed.chunks);
        result.chunks_total += slice.chunk_count;
        if (placed.chunks.size() > first)
          runs.push_back({&batch, &batch.instances[k], k, &slice, static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(placed.chunks.size() - first)});
      }
  }
  result.chunks_placed = placed.chunks.size();
  if (placed.chunks.empty()) return result;

  const std::uint64_t size = placed.chunks.size() * sizeof(PlacedChunk);
  if (!placed.buffer || placed.buffer.size() < size) {
    placed.groups.clear();
    placed.buffer = impl_->device.create_buffer({.label = "particles.placements",
                                                 .size = size + size / 2,
                                                 .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopyDst});
  }
  impl_->device.queue().write_buffer(placed.buffer, 0, bytes_of(std::span<const PlacedChunk>(placed.chunks)));

  for (const Run& run : runs) {
    const glm::dmat3 linear = view.rotation * glm::dmat3(run.instance->world_from_data);
    const Material& m = run.batch->material;
    ParticleDraw draw;
    draw.batch = run.batch;
    draw.group = impl_->group_for(placed, *run.slice);
    draw.particles = run.count * chunk_capacity;
    draw.block.linear0_scale = glm::vec4(glm::vec3(linear[0]), static_cast<float>(similarity_scale(run.instance->world_from_data).value_or(1.0)));
    draw.block.linear1 = glm::vec4(glm::vec3(linear[1]), 0.0f);
    draw.block.linear2 = glm::vec4(glm::vec3(linear[2]), 0.0f);
    draw.block.color = glm::vec4(glm::vec3(run.batch->color), static_cast<float>(run.batch->alpha));
    draw.block.material = glm::vec4(glm::dvec4(m.ambient, m.diffuse, m.specular, m.exponent));
    draw.block.id_base = static_cast<std::uint32_t>(run.batch->id_base + run.instance_index * run.batch->row_count);
    draw.block.first_placement = run.first;
    result.draws.push_back(std::move(draw));
  }
  return result;
}

} // namespace mote::passes
