// SPDX-License-Identifier: MIT
// The memory of exact transparency: lists of surfaces, one a pixel, in one buffer of bounded size
// (shaders/common/layer_lists.glsl). A picture whose lists need more is drawn in strips of rows, as many
// as are needed; that needs to be known beforehand, so rows() bounds from above how many particles each
// row of pixels can see. Used by sorted_glyphs with oit = "exact".
//
// Only a single row that needs more than the bound can overflow. What finds no place is counted all the same:
// report() says so, with what would have been needed.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/gpu/gpu.hpp"
#include "core/math/camera.hpp"
#include "passes/over.hpp"
#include "passes/particles/order.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mote::passes {

// The entries that each row of pixels needs at most.
std::vector<std::uint64_t> entries_per_row(const Scene& scene, const View& view, const Selection& selection);

// Consecutive rows that together need at most `capacity` entries; a row that needs more is a strip of its own.
std::vector<Rows> strips_of(std::span<const std::uint64_t> rows, std::uint64_t capacity);

class LayerLists {
public:
  static constexpr std::uint64_t entry_bytes = 32;

  explicit LayerLists(gpu::Device device) : device_(std::move(device)) {}
  // Buffers for the rows' needs, at most `bytes` of entries. True if buffers were made anew.
  bool reserve(std::span<const std::uint64_t> rows, std::uint32_t width, std::uint64_t bytes, const gpu::BindGroupLayout& layout);
  [[nodiscard]] std::span<const Rows> strips() const { return strips_; }
  [[nodiscard]] std::uint32_t capacity() const { return capacity_; }
  [[nodiscard]] const gpu::BindGroup& group() const { return group_; }
  void clear(gpu::CommandEncoder& encoder);   // before the first strip
  void collect(gpu::CommandEncoder& encoder); // after the last one: counters to the host
  // Of a frame that the device has finished: P005 where something found no place.
  void report(const std::string& pass, Diagnostics& out) const;

private:
  gpu::Device device_;
  gpu::Buffer heads_, entries_, counters_, readback_;
  gpu::BindGroup group_;
  std::vector<Rows> strips_;
  std::uint32_t capacity_{};
  bool collected_{};
};

} // namespace mote::passes
