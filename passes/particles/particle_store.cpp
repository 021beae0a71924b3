// SPDX-License-Identifier: MIT
#include "passes/particles/particle_store.hpp"

#include "core/base/parallel.hpp"
#include "core/math/principal_axes.hpp"
#include "passes/particles/placement.hpp"
#include "passes/particles/sprites.hpp"
#include "passes/particles/tiles/tile_placement.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace mote::passes {
namespace {

template <class T> std::span<const std::byte> bytes_of(std::span<const T> values) { return std::as_bytes(values); }

// A run of chunks of one set whose buffers fit a binding.
struct Slice {
  std::uint64_t first_chunk{}, chunk_count{};
  SliceBuffers buffers{};
};

struct Resident {
  std::shared_ptr<const ChunkSet> set{}; // kept: the key is its address
  std::vector<Slice> slices{};
};

// Chunks of one slice and instance that are drawn together.
struct Run {
  const Batch* batch{};
  std::size_t instance{};
  const Slice* slice{};
  std::uint32_t first{}, count{};  // among the placements
  std::uint32_t first_near{};      // among the near payloads
  bool near_eye{}, sprites{};
};

} // namespace

struct ParticleStore::Impl {
  gpu::Device device;
  std::uint64_t largest_binding{}; // bytes of a slice's records at most
  gpu::BindGroupLayout layout;
  gpu::Buffer nothing; // bound where there are no colors or no near particles; never read
  std::map<const ChunkSet*, Resident> residents;
  ShadowMaps shadow_maps;
  struct Placements {
    gpu::Buffer buffer{}, near_buffer{};
    SliceBuffers near_slice{}; // of the compute expansion
    std::vector<PlacedChunk> chunks{};
    std::vector<NearPayload> payloads{};
    std::map<const Slice*, gpu::BindGroup> groups{};
    std::vector<PlacedForTiles> parts{}; // kept for their memory
    // What was placed of a slice and instance, as runs to draw.
    void append(std::vector<Run>& runs, const Batch& batch, std::size_t instance, const Slice& slice, const PlacedChunks& placed);
  };
  std::map<std::uint32_t, Placements> placements;

  gpu::Buffer storage(std::string_view label, std::span<const std::byte> contents, const std::shared_ptr<const void>& owner = {}) {
    return device.create_buffer({.label = label, .size = contents.size(), .usage = gpu::BufferUsage::Storage, .contents = contents, .contents_owner = owner});
  }
  Resident make_resident(const std::shared_ptr<const ChunkSet>& set);
  gpu::BindGroup group_for(Placements& placed, const Slice& slice);
  void write(gpu::Buffer& buffer, std::string_view label, std::span<const std::byte> contents, Placements& placed);
  PlacedView finish(const std::vector<Run>& runs, const View& view, Placements& placed);
  std::vector<Run> place_all(const Scene& scene, const View& view, Placements& placed, std::uint64_t& total, double largest_point) const;
  void add_near_slice(PlacedForTiles& placed_chunks, TiledView& out, Placements& placed);
};

ParticleStore::ParticleStore(gpu::Device device) : ParticleStore(device, device.limits().max_storage_buffer_binding_size) {}

ParticleStore::ParticleStore(gpu::Device device, std::uint64_t largest_binding) : impl_(std::make_unique<Impl>()) {
  impl_->device = std::move(device);
  impl_->largest_binding = largest_binding;
  std::array<gpu::BindGroupLayoutEntry, 6> entries;
  for (std::uint32_t i = 0; i < entries.size(); ++i)
    entries[i] = {.binding = i,
                  .visibility = gpu::ShaderStage::Vertex, // every expansion loads its record there
                  .type = gpu::BindingType::ReadOnlyStorageBuffer};
  impl_->layout = impl_->device.create_bind_group_layout({.label = "particles", .entries = entries});
  const std::array<std::uint32_t, 4> none{};
  impl_->nothing = impl_->storage("particles.nothing", std::as_bytes(std::span(none)));
}

ParticleStore::~ParticleStore() = default;

const gpu::BindGroupLayout& ParticleStore::layout() const { return impl_->layout; }
ShadowMaps& ParticleStore::shadow_maps() const { return impl_->shadow_maps; }

static_assert(page_bytes % gpu::host_page == 0);
Resident ParticleStore::Impl::make_resident(const std::shared_ptr<const ChunkSet>& set) {
  Resident resident{set, {}};
  const std::uint64_t chunk_bytes = std::uint64_t{chunk_capacity} * set->vec4s_per_record * sizeof(glm::vec4);
  // Slices start at pages of memory, of the list with a byte a record, too: a device on the processor then has no copy of its own.
  const std::uint64_t chunks_per_page = page_bytes / chunk_capacity, most = largest_binding / chunk_bytes;
  const std::uint64_t chunks_per_slice = std::max(chunks_per_page, most / chunks_per_page * chunks_per_page);
  for (std::uint64_t first = 0; first < set->chunks.size(); first += chunks_per_slice) {
    Slice slice;
    slice.first_chunk = first;
    slice.chunk_count = std::min<std::uint64_t>(chunks_per_slice, set->chunks.size() - first);
    const std::uint64_t record = first * chunk_capacity, count = slice.chunk_count * chunk_capacity;
    SliceBuffers& buffers = slice.buffers;
    buffers.records = storage("particles.records", bytes_of(std::span(set->records).subspan(record * set->vec4s_per_record, count * set->vec4s_per_record)), set);
    buffers.rows = storage("particles.rows", bytes_of(std::span(set->rows).subspan(record, count)), set);
    buffers.paletted = set->paletted();
    const std::span colors(set->colors);
    buffers.colors = colors.empty() ? nothing : storage("particles.colors", bytes_of(buffers.paletted ? colors : colors.subspan(record, count)), set);
    buffers.color_indices = buffers.paletted ? storage("particles.color_indices", bytes_of(std::span(set->color_indices).subspan(record, count)), set) : nothing;
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
    const SliceBuffers& buffers = slice.buffers;
    const std::array<gpu::BindGroupEntry, 6> entries{{{.binding = 0, .buffer = {&buffers.records}},
                                                      {.binding = 1, .buffer = {&buffers.rows}},
                                                      {.binding = 2, .buffer = {&buffers.colors}},
                                                      {.binding = 3, .buffer = {&placed.buffer}},
                                                      {.binding = 4, .buffer = {placed.near_buffer ? &placed.near_buffer : &nothing}},
                                                      {.binding = 5, .buffer = {&buffers.color_indices}}}};
    group = device.create_bind_group({.label = "particles", .layout = &layout, .entries = entries});
  }
  return group;
}

void ParticleStore::Impl::write(gpu::Buffer& buffer, std::string_view label, std::span<const std::byte> contents, Placements& placed) {
  if (contents.empty()) return;
  if (!buffer || buffer.size() < contents.size()) {
    placed.groups.clear();
    buffer = device.create_buffer({.label = label, .size = contents.size() + contents.size() / 2,
                                   .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopyDst});
  }
  device.queue().write_buffer(buffer, 0, contents);
}

void ParticleStore::Impl::Placements::append(std::vector<Run>& runs, const Batch& batch, std::size_t instance, const Slice& slice, const PlacedChunks& placed) {
  auto add = [&](const std::vector<PlacedChunk>& visible, bool near_eye, bool sprites = false) {
    if (visible.empty()) return;
    runs.push_back({&batch, instance, &slice, static_cast<std::uint32_t>(chunks.size()), static_cast<std::uint32_t>(visible.size()),
                    static_cast<std::uint32_t>(payloads.size()), near_eye, sprites});
    chunks.insert(chunks.end(), visible.begin(), visible.end());
  };
  add(placed.far, false);
  add(placed.sprites, false, true);
  add(placed.near, true);
  payloads.insert(payloads.end(), placed.payloads.begin(), placed.payloads.end());
}

// Places every slice of every instance, in scene order; near chunks are a run of their own.
std::vector<Run> ParticleStore::Impl::place_all(const Scene& scene, const View& view, Placements& placed, std::uint64_t& total, double largest_point) const {
  std::vector<Run> runs;
  const ViewCuller culler(view);
  const SpriteRule sprites(view, largest_point);
  PlacedChunks chunks;
  for (const Batch& batch : scene.batches)
    for (std::size_t k = 0; k < batch.instances.size(); ++k)
      for (const Slice& slice : residents.at(batch.chunks.get()).slices) {
        chunks.far.clear(), chunks.near.clear(), chunks.sprites.clear(), chunks.payloads.clear();
        place_chunks(*batch.chunks, slice.first_chunk, slice.chunk_count, batch.instances[k], view, culler, chunks, largest_point > 0 ? &sprites : nullptr);
        total += slice.chunk_count;
        placed.append(runs, batch, k, slice, chunks);
      }
  return runs;
}

namespace {
// A placement that is no similarity, as U S V^T: S the half axes of what the unit sphere becomes, U their directions, V how
// records are turned, as modified Rodrigues parameters (Shuster, J. Astronaut. Sci. 41(4), 1993). Where it mirrors, S is negative.
void set_shape(const glm::dmat3& linear, BatchBlock& block) {
  const PrincipalAxes shape = principal_axes(linear);
  const glm::dvec3 s = glm::determinant(linear) < 0.0 ? -shape.lengths : shape.lengths;
  block.linear0_scale.w = static_cast<float>(s.x);
  block.linear1.w = static_cast<float>(s.y);
  block.linear2.w = static_cast<float>(s.z);
  for (int i = 0; i < 6; ++i) block.axes[static_cast<std::size_t>(i)] = static_cast<float>(shape.axes[i / 3][i % 3]);
  glm::dmat3 u = shape.axes;
  for (int k = 0; k < 3; ++k) u[k] /= s[k];
  const glm::dquat q = glm::normalize(glm::quat_cast(glm::transpose(linear) * u));
  const glm::dvec3 turn = glm::dvec3(q.x, q.y, q.z) * (q.w < 0.0 ? -1.0 : 1.0) / (1.0 + std::abs(q.w));
  for (int k = 0; k < 3; ++k) block.turn[static_cast<std::size_t>(k)] = static_cast<float>(turn[k]);
}
} // namespace

BatchBlock batch_block(const Batch& batch, std::size_t instance, const View& view) {
  const glm::dmat4& m = batch.instances[instance].world_from_data;
  const glm::dmat3 linear = view.rotation * glm::dmat3(m);
  const Material& material = batch.material;
  BatchBlock block;
  block.linear0_scale = glm::vec4(glm::vec3(linear[0]), static_cast<float>(similarity_scale(m).value_or(1.0)));
  block.linear1 = glm::vec4(glm::vec3(linear[1]), 0.0f);
  block.linear2 = glm::vec4(glm::vec3(linear[2]), 0.0f);
  if (!similarity_scale(m)) set_shape(linear, block);
  block.color = glm::vec4(glm::vec3(batch.color), static_cast<float>(batch.density > 0.0 ? -batch.density : batch.alpha));
  block.material = glm::vec4(glm::dvec4(material.ambient, material.diffuse, material.specular, material.exponent));
  block.id_base = static_cast<std::uint32_t>(batch.id_base + instance * batch.row_count);
  return block;
}

namespace {
BatchBlock block_of(const Run& run, const View& view) {
  BatchBlock block = batch_block(*run.batch, run.instance, view);
  block.first_placement = run.first;
  block.first_near = run.first_near;
  return block;
}
} // namespace

PlacedView ParticleStore::Impl::finish(const std::vector<Run>& runs, const View& view, Placements& placed) {
  PlacedView result;
  result.chunks_placed = placed.chunks.size();
  write(placed.buffer, "particles.placements", bytes_of(std::span<const PlacedChunk>(placed.chunks)), placed);
  write(placed.near_buffer, "particles.near", bytes_of(std::span<const NearPayload>(placed.payloads)), placed);
  for (const Run& run : runs)
    result.draws.push_back({.batch = run.batch,
                            .group = group_for(placed, *run.slice),
                            .block = block_of(run, view),
                            .particles = run.count * chunk_capacity,
                            .sprites = run.sprites,
                            .near_eye = run.near_eye,
                            .affine = !similarity_scale(run.batch->instances[run.instance].world_from_data)});
  return result;
}

PlacedView ParticleStore::place(const Scene& scene, const View& view, std::uint32_t slot, double largest_point) const {
  Impl::Placements& placed = impl_->placements[slot];
  placed.chunks.clear();
  placed.payloads.clear();
  std::uint64_t total = 0;
  const std::vector<Run> runs = impl_->place_all(scene, view, placed, total, largest_point);
  PlacedView result = impl_->finish(runs, view, placed);
  result.chunks_total = total;
  return result;
}

namespace {
TileDraw tile_draw(const Batch& batch, std::size_t instance, const View& view, std::vector<glm::vec4>& materials) {
  BatchBlock block = block_of({.batch = &batch, .instance = instance}, view);
  if (batch.material.model == ShadingModel::Lambert) block.material.z = 0.0f; // another batch may have highlights
  const auto known = std::find(materials.begin(), materials.end(), block.material);
  const auto material = static_cast<std::uint32_t>(known - materials.begin());
  if (known == materials.end()) materials.push_back(block.material);
  return {.linear0 = glm::vec3(block.linear0_scale), .scale = block.linear0_scale.w, .linear1 = glm::vec3(block.linear1), .id_base = block.id_base,
          .linear2 = glm::vec3(block.linear2), .color = glm::vec3(block.color), .material = material & 0xFFFFu,
          .colored = !batch.chunks->colors.empty()};
}
// Chunks of one slice and instance that tiles may serve.
struct TileJob {
  const Batch* batch{};
  std::size_t instance{};
  const Slice* slice{};
  std::uint64_t start{}; // chunks of the jobs before
};
std::size_t first_job(const std::vector<TileJob>& jobs, std::uint64_t chunk) {
  const auto after = std::upper_bound(jobs.begin(), jobs.end(), chunk, [](std::uint64_t c, const TileJob& job) { return c < job.start; });
  return after == jobs.begin() ? 0 : static_cast<std::size_t>(after - jobs.begin()) - 1;
}

// Particles of the same (batch, instance) that are in view space already.
TileDraw near_draw(TileDraw draw) {
  draw.linear0 = {1, 0, 0};
  draw.linear1 = {0, 1, 0};
  draw.linear2 = {0, 0, 1};
  draw.scale = 1;
  return draw;
}
} // namespace

// Chunks near the eye, as a slice of their own with draws of their own.
void ParticleStore::Impl::add_near_slice(PlacedForTiles& chunks, TiledView& out, Placements& placed) {
  std::map<std::uint32_t, std::uint32_t> draws;
  for (TileChunk& chunk : chunks.near) {
    const auto [known, added] = draws.try_emplace(chunk.draw, static_cast<std::uint32_t>(out.draws.size()));
    if (added) {
      out.draws.push_back(near_draw(out.draws[known->first]));
      out.draws.back().slice = static_cast<std::uint32_t>(out.slices.size()) & 0x7FFFu;
      out.draws.back().first_flag = out.flags;
    }
    chunk.draw = known->second & 0x3FFFFFFFu;
  }
  out.chunks.insert(out.chunks.end(), chunks.near.begin(), chunks.near.end());
  out.flags += static_cast<std::uint32_t>(chunks.near.size());
  SliceBuffers& buffers = placed.near_slice;
  write(buffers.records, "particles.near_records", bytes_of(std::span<const glm::vec4>(chunks.near_records)), placed);
  write(buffers.rows, "particles.near_rows", bytes_of(std::span<const std::uint32_t>(chunks.near_rows)), placed);
  write(buffers.colors, "particles.near_colors", bytes_of(std::span<const std::uint32_t>(chunks.near_colors)), placed);
  buffers.color_indices = nothing;
  out.slices.push_back(buffers);
}

void ParticleStore::place_tiles(const Scene& scene, const View& view, std::string_view type, const TilePlacing& placing, TiledView& out, std::uint32_t slot) const {
  Impl::Placements& placed = impl_->placements[slot];
  placed.chunks.clear();
  placed.payloads.clear();
  out.chunks.clear();
  out.draws.clear();
  out.materials.clear();
  out.slices.clear();
  out.flags = 0;
  out.ids = 0;
  for (const Batch& batch : scene.batches) out.ids = std::max(out.ids, batch.id_base + batch.instances.size() * batch.row_count);
  // What is of the type, by threads that take equal numbers of chunks; what is not, and what tiles do not serve, as runs to draw.
  std::map<const Slice*, std::uint32_t> slices;
  std::vector<Run> runs;
  const ViewCuller culler(view);
  std::vector<TileJob> jobs;
  std::uint64_t total = 0;
  for (const Batch& batch : scene.batches)
    for (std::size_t k = 0; k < batch.instances.size(); ++k)
      for (const Slice& slice : impl_->residents.at(batch.chunks.get()).slices) {
        total += slice.chunk_count;
        if (batch.type != type) {
          PlacedChunks own;
          place_chunks(*batch.chunks, slice.first_chunk, slice.chunk_count, batch.instances[k], view, culler, own);
          placed.append(runs, batch, k, slice, own);
          continue;
        }
        const auto [known, added] = slices.try_emplace(&slice, static_cast<std::uint32_t>(out.slices.size()));
        if (added) out.slices.push_back(slice.buffers);
        out.draws.push_back(tile_draw(batch, k, view, out.materials));
        if (placing.material) out.draws.back().material = placing.material(batch) & 0xFFFFu;
        out.draws.back().slice = known->second & 0x7FFFu;
        out.draws.back().first_flag = out.flags;
        jobs.push_back({&batch, k, &slice, out.flags});
        out.flags += static_cast<std::uint32_t>(slice.chunk_count);
      }
  const std::uint32_t threads = thread_count(out.flags, 4096);
  placed.parts.resize(std::max<std::size_t>(placed.parts.size(), threads));
  std::vector<std::vector<std::pair<std::size_t, PlacedChunks>>> rests(threads); // of each thread, by job
  placed.parts.front().tiled.swap(out.chunks);
  parallel_parts(out.flags, threads, [&](std::uint32_t part, std::uint64_t begin, std::uint64_t end) {
    PlacedForTiles& own = placed.parts[part];
    own.clear();
    for (std::size_t j = first_job(jobs, begin); j < jobs.size() && jobs[j].start < end; ++j) {
      const auto& [batch, instance, slice, start] = jobs[j];
      place_for_tiles(*batch->chunks, slice->first_chunk, std::max(begin, start) - start, std::min(end - start, slice->chunk_count), batch->instances[instance], view,
                      culler, {static_cast<std::uint32_t>(j), placing.exact, placing.margin, placing.splats, placing.whole}, own);
      if (own.rest.far.empty() && own.rest.near.empty()) continue;
      rests[part].emplace_back(j, std::move(own.rest));
      own.rest = {};
    }
  });
  PlacedForTiles& chunks = placed.parts.front();
  for (std::uint32_t part = 1; part < threads; ++part) chunks.add(placed.parts[part]);
  for (const auto& rest : rests)
    for (const auto& [j, own] : rest) placed.append(runs, *jobs[j].batch, jobs[j].instance, *jobs[j].slice, own);
  out.chunks.swap(chunks.tiled);
  if (!chunks.near.empty()) impl_->add_near_slice(chunks, out, placed);
  out.rest = impl_->finish(runs, view, placed);
  out.rest.chunks_total = total;
}

} // namespace mote::passes
