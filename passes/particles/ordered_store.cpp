// SPDX-License-Identifier: MIT
#include "passes/particles/ordered_store.hpp"

#include "core/base/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace mote::passes {
namespace {

constexpr std::uint32_t white = 0xFFFFFFFFu; // times the batch's color
constexpr std::uint32_t bindings = 8; // shaders/particles/particle.glsl with ORDERED

// Rows as std430 lays them out.
constexpr std::size_t block_stride = (sizeof(BatchBlock) + 15) / 16 * 16;

std::vector<std::byte> rows_of(const std::vector<BatchBlock>& blocks) {
  std::vector<std::byte> bytes(blocks.size() * block_stride);
  for (std::size_t i = 0; i < blocks.size(); ++i) std::memcpy(&bytes[i * block_stride], &blocks[i], sizeof(BatchBlock));
  return bytes;
}

void add(std::vector<double>& out, const glm::dvec3& v) { out.insert(out.end(), {v.x, v.y, v.z}); }

} // namespace

OrderedStore::OrderedStore(gpu::Device device) : device_(std::move(device)) {
  const bool geometry = gpu::has(device_.features(), gpu::Feature::GeometryShader);
  std::array<gpu::BindGroupLayoutEntry, bindings> entries;
  for (std::uint32_t i = 0; i < bindings; ++i)
    entries[i] = {.binding = i,
                  .visibility = gpu::ShaderStage::Vertex | gpu::ShaderStage::Fragment | (geometry ? gpu::ShaderStage::Geometry : gpu::ShaderStage::None),
                  .type = gpu::BindingType::ReadOnlyStorageBuffer};
  layout_ = device_.create_bind_group_layout({.label = "ordered", .entries = entries});
  nothing_ = device_.create_buffer({.label = "ordered.nothing", .size = 256, .usage = gpu::BufferUsage::Storage});
}

OrderedStore::Signature OrderedStore::signature_of(const Scene& scene, const View& view, const Selection& selection, Order order) {
  Signature s;
  std::vector<double>& v = s.values;
  v = {double(view.projection), view.focal, double(view.size.width), double(view.size.height), view.near_cut, view.far_cut, double(order),
       view.center().x, view.center().y};
  add(v, view.eye);
  for (int i = 0; i < 3; ++i) add(v, view.rotation[i]);
  for (const Light& light : scene.lights) v.push_back(double(light.kind)); // what pipelines differ by
  for (const Batch& batch : scene.batches) {
    if (!selection.draws(batch)) continue;
    s.sets.push_back(batch.chunks);
    add(v, batch.color);
    const Material& m = batch.material;
    v.insert(v.end(), {batch.alpha, batch.density, double(m.model), m.ambient, m.diffuse, m.specular, m.exponent, double(batch.id_base), double(batch.row_count)});
    for (const Instance& instance : batch.instances)
      for (int c = 0; c < 4; ++c) add(v, glm::dvec3(instance.world_from_data[c]));
  }
  return s;
}

bool OrderedStore::update(const Scene& scene, const View& view, const Selection& selection, Order order) {
  Signature now = signature_of(scene, view, selection, order);
  if (valid_ && now == last_) return false;
  if (!valid_ || now.sets != last_.sets) upload_sets(scene, selection);
  last_ = std::move(now);
  particles_ = order_particles(scene, view, selection, order, bases_);
  upload_order();
  valid_ = true;
  return true;
}

void OrderedStore::upload_sets(const Scene& scene, const Selection& selection) {
  struct Lists {
    std::vector<glm::vec4> records{};
    std::vector<std::uint32_t> rows{}, colors{};
  };
  std::map<std::string, Lists> lists;
  bases_.clear();
  sets_.clear();
  has_colors_ = false;
  for (const Batch& batch : scene.batches) {
    if (!selection.draws(batch) || std::find(sets_.begin(), sets_.end(), batch.chunks) != sets_.end()) continue;
    const ChunkSet& set = *batch.chunks;
    Lists& list = lists[batch.type];
    sets_.push_back(batch.chunks);
    bases_.push_back({&set, static_cast<std::uint32_t>(list.rows.size() / chunk_capacity)});
    list.records.insert(list.records.end(), set.records.begin(), set.records.end());
    list.rows.insert(list.rows.end(), set.rows.begin(), set.rows.end());
    for (std::uint64_t i = 0; i < set.record_count(); ++i) list.colors.push_back(set.colors.empty() ? white : set.color_of(i));
    has_colors_ |= !set.colors.empty();
  }
  types_.clear();
  groups_.clear();
  for (const auto& [type, list] : lists) {
    const std::uint64_t most = device_.limits().max_storage_buffer_binding_size;
    if (list.records.size() * sizeof(glm::vec4) > most)
      fail(Exit::Failed, "P004", {}, fmt::format("the scene has {} transparent particles of type '{}'; one order holds {} on this device", list.rows.size(),
                                                 type, most / sizeof(glm::vec4) / (list.records.size() / list.rows.size())));
    TypeBuffers& buffers = types_[type];
    auto make = [&](std::string_view label, std::span<const std::byte> bytes) {
      return bytes.empty() ? nothing_ : device_.create_buffer({.label = label, .size = bytes.size(), .usage = gpu::BufferUsage::Storage, .contents = bytes});
    };
    buffers.records = make("ordered.records", std::as_bytes(std::span(list.records)));
    buffers.rows = make("ordered.rows", std::as_bytes(std::span(list.rows)));
    buffers.colors = has_colors_ ? make("ordered.colors", std::as_bytes(std::span(list.colors))) : nothing_;
  }
}

void OrderedStore::write(gpu::Buffer& buffer, std::string_view label, std::span<const std::byte> contents) {
  if (!buffer || buffer.size() < contents.size()) {
    groups_.clear();
    buffer = device_.create_buffer({.label = label, .size = std::max<std::uint64_t>(256, contents.size() + contents.size() / 2),
                                    .usage = gpu::BufferUsage::Storage | gpu::BufferUsage::CopyDst});
  }
  if (!contents.empty()) device_.queue().write_buffer(buffer, 0, contents);
}

void OrderedStore::upload_order() {
  const std::vector<std::byte> rows = rows_of(particles_.blocks);
  write(placements_, "ordered.placements", std::as_bytes(std::span(particles_.placements)));
  write(near_, "ordered.near", std::as_bytes(std::span(particles_.near)));
  write(order_, "ordered.order", std::as_bytes(std::span(particles_.order)));
  write(owners_, "ordered.owners", std::as_bytes(std::span(particles_.owners)));
  write(blocks_, "ordered.blocks", rows);
  for (const auto& [type, buffers] : types_) {
    gpu::BindGroup& group = groups_[type];
    if (group) continue;
    const std::array<gpu::BindGroupEntry, bindings> entries{{{.binding = 0, .buffer = {&buffers.records}},
                                                             {.binding = 1, .buffer = {&buffers.rows}},
                                                             {.binding = 2, .buffer = {&buffers.colors}},
                                                             {.binding = 3, .buffer = {&placements_}},
                                                             {.binding = 4, .buffer = {&near_}},
                                                             {.binding = 5, .buffer = {&order_}},
                                                             {.binding = 6, .buffer = {&owners_}},
                                                             {.binding = 7, .buffer = {&blocks_}}}};
    group = device_.create_bind_group({.label = "ordered", .layout = &layout_, .entries = entries});
  }
}

} // namespace mote::passes
