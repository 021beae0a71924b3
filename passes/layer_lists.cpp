// SPDX-License-Identifier: MIT
#include "passes/layer_lists.hpp"

#include "core/math/principal_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace mote::passes {
namespace {

constexpr double slack = 0.05; // pixels: margins of proxies and rounding

// Pixels [begin, end) whose sample may see the extent [center - r, center + r] at depths z +- r. What reaches the eye
// plane may be seen everywhere.
struct Extent {
  std::int64_t begin{}, end{};
};
Extent extent(double center, double z, double r, const View& view, double size, double axis, double sample) {
  double lo = center - r, hi = center + r;
  if (view.projection == Projection::Perspective) {
    const double near = z - r, far = z + r;
    if (near <= 1e-9 * far) return {0, static_cast<std::int64_t>(size)};
    lo = std::min(lo / near, lo / far);
    hi = std::max(hi / near, hi / far);
  }
  const double first = std::ceil(lo * view.focal + axis - sample - slack), last = std::floor(hi * view.focal + axis - sample + slack);
  return {static_cast<std::int64_t>(std::clamp(first, 0.0, size)), static_cast<std::int64_t>(std::clamp(last + 1.0, 0.0, size))};
}

// Number of particles that begin or end to be seen at each row, times their width in pixels.
struct RowCounter {
  const View& view;
  std::vector<std::int64_t> change;

  void add(const glm::dvec3& c, double r) {
    if (view.projection == Projection::Perspective && c.z + r <= 0.0) return;
    const Extent x = extent(c.x, c.z, r, view, view.size.width, view.center().x, view.sample_offset.x);
    const Extent y = extent(c.y, c.z, r, view, view.size.height, view.center().y, view.sample_offset.y);
    if (x.begin >= x.end || y.begin >= y.end) return;
    change[static_cast<std::size_t>(y.begin)] += x.end - x.begin;
    change[static_cast<std::size_t>(y.end)] -= x.end - x.begin;
  }
};

} // namespace

std::vector<std::uint64_t> entries_per_row(const Scene& scene, const View& view, const Selection& selection) {
  RowCounter counter{view, std::vector<std::int64_t>(view.size.height + 1)};
  for (const Batch& batch : scene.batches) {
    if (!selection.draws(batch)) continue;
    const ChunkSet& set = *batch.chunks;
    for (const Instance& instance : batch.instances) {
      const glm::dmat3 instance_linear(instance.world_from_data), linear = view.rotation * instance_linear;
      const glm::dvec3 translation = glm::dvec3(instance.world_from_data[3]) - view.eye;
      const double scale = similarity_scale(instance.world_from_data).value_or(principal_axes(linear).longest());
      for (std::size_t c = 0; c < set.chunks.size(); ++c) {
        const glm::dvec3 origin = view.rotation * (instance_linear * set.chunks[c].origin + translation);
        for (std::uint64_t i = c * chunk_capacity; i < c * chunk_capacity + set.chunks[c].count; ++i) {
          const glm::vec4& record = set.records[i * set.vec4s_per_record];
          if (in_selection(selection.opacity, alpha_of(batch, i))) counter.add(origin + linear * glm::dvec3(record), double(record.w) * scale);
        }
      }
    }
  }
  std::vector<std::uint64_t> rows(view.size.height);
  std::int64_t sum = 0;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    sum += counter.change[y];
    rows[y] = static_cast<std::uint64_t>(sum);
  }
  return rows;
}

std::vector<Rows> strips_of(std::span<const std::uint64_t> rows, std::uint64_t capacity) {
  std::vector<Rows> strips;
  std::uint64_t sum = 0;
  for (std::uint32_t y = 0; y < rows.size(); ++y) {
    if (strips.empty() || sum + rows[y] > capacity) {
      strips.push_back({y, y});
      sum = 0;
    }
    sum += rows[y];
    strips.back().end = y + 1;
  }
  return strips;
}

bool LayerLists::reserve(std::span<const std::uint64_t> rows, std::uint32_t width, std::uint64_t bytes, const gpu::BindGroupLayout& layout) {
  using gpu::BufferUsage;
  const std::uint64_t most = std::min(bytes, device_.limits().max_storage_buffer_binding_size) / entry_bytes;
  std::uint64_t wanted = 0;
  for (const std::uint64_t row : rows) wanted += row;
  const std::uint64_t capacity = std::clamp<std::uint64_t>(wanted, 1, most);
  bool made = false;
  auto make = [&](gpu::Buffer& buffer, std::string_view label, std::uint64_t size, BufferUsage usage) {
    if (buffer && buffer.size() >= size) return;
    buffer = device_.create_buffer({.label = label, .size = size, .usage = usage});
    made = true;
  };
  if (!entries_ || entries_.size() < capacity * entry_bytes) // with room, so that a turning camera makes it once
    make(entries_, "layers.entries", std::min(capacity + capacity / 4, most) * entry_bytes, BufferUsage::Storage);
  capacity_ = static_cast<std::uint32_t>(std::min(entries_.size() / entry_bytes, most));
  strips_ = strips_of(rows, capacity_);
  make(heads_, "layers.heads", std::uint64_t{4} * width * rows.size(), BufferUsage::Storage | BufferUsage::CopyDst);
  make(counters_, "layers.counters", 4 * rows.size(), BufferUsage::Storage | BufferUsage::CopyDst | BufferUsage::CopySrc);
  make(readback_, "layers.readback", 4 * rows.size(), BufferUsage::MapRead | BufferUsage::CopyDst);
  if (made || !group_) {
    const std::array entries{gpu::BindGroupEntry{.binding = 0, .buffer = {&heads_}}, gpu::BindGroupEntry{.binding = 1, .buffer = {&entries_}},
                             gpu::BindGroupEntry{.binding = 2, .buffer = {&counters_}}};
    group_ = device_.create_bind_group({.label = "layers", .layout = &layout, .entries = entries});
  }
  return made;
}

void LayerLists::clear(gpu::CommandEncoder& encoder) {
  encoder.clear_buffer(heads_);
  encoder.clear_buffer(counters_);
}

void LayerLists::collect(gpu::CommandEncoder& encoder) {
  encoder.copy_buffer_to_buffer(counters_, 0, readback_, 0, 4 * strips_.size());
  collected_ = true;
}

void LayerLists::report(const std::string& pass, Diagnostics& out) const {
  if (!collected_) return;
  std::vector<std::uint32_t> counts(strips_.size());
  std::memcpy(counts.data(), readback_.mapped().data(), counts.size() * 4);
  std::uint64_t lost = 0, needed = 0;
  for (const std::uint32_t count : counts) {
    if (count > capacity_) lost += count - capacity_;
    needed = std::max<std::uint64_t>(needed, count);
  }
  if (lost == 0) return;
  constexpr std::uint64_t mebibyte = 1024 * 1024;
  out.warning("P005", {}, fmt::format("pass '{}' left out {} transparent particles of some pixels: its lists hold {} and one row needs {}", pass, lost, capacity_, needed),
              {fmt::format("memory = {} (MiB) would hold them; it is {} now", (needed * entry_bytes + mebibyte - 1) / mebibyte,
                           capacity_ * entry_bytes / mebibyte)});
}

} // namespace mote::passes
