// SPDX-License-Identifier: MIT
// What a plan comes to for a view size: extents, bytes, and what a device does not allow.
#include "core/gpu/format.hpp"
#include "render_graph/plan.hpp"
#include "render_graph/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace mote::rg {

gpu::Extent3d extent_of(const TextureSpec& spec, std::uint32_t view_width, std::uint32_t view_height) {
  gpu::Extent3d out{spec.size.width, spec.size.height, spec.dimension == gpu::TextureDimension::D3 ? spec.size.depth : spec.layers};
  if (spec.size.kind == SizeSpec::Kind::View) {
    const auto scaled = [&](std::uint32_t side) { return static_cast<std::uint32_t>(std::max(1.0, std::floor(side * spec.size.factor + 0.5))); };
    out.width = scaled(view_width);
    out.height = spec.dimension == gpu::TextureDimension::D1 ? 1 : scaled(view_height);
  }
  return out;
}

std::uint64_t bytes_of(const BufferSpec& spec, std::uint32_t view_width, std::uint32_t view_height) {
  const std::uint64_t pixels = spec.per_pixel ? std::uint64_t{view_width} * view_height : 1;
  return (std::max<std::uint64_t>(spec.record_bytes * spec.count * pixels, 4) + 3) / 4 * 4;
}

std::uint64_t bytes_of(const Plan& plan, std::uint32_t view_width, std::uint32_t view_height) {
  std::map<std::uint32_t, std::uint64_t> textures, buffers; // by physical number
  for (const PlannedTexture& t : plan.textures) {
    const gpu::Extent3d base = extent_of(t.spec, view_width, view_height);
    std::uint64_t texels = 0;
    for (std::uint32_t level = 0; level < t.spec.mips; ++level) {
      const gpu::Extent3d mip = gpu::mip_extent(base, t.spec.dimension, level);
      texels += std::uint64_t{mip.width} * mip.height * mip.depth_or_layers;
    }
    textures[t.physical] = texels * gpu::format_info(t.spec.format).bytes;
  }
  for (const PlannedBuffer& b : plan.buffers) buffers[b.physical] = bytes_of(b.spec, view_width, view_height);
  std::uint64_t sum = 0;
  for (const auto& [physical, bytes] : textures) sum += bytes;
  for (const auto& [physical, bytes] : buffers) sum += bytes;
  return sum;
}

Diagnostics check_limits(const Plan& plan, const gpu::Limits& limits, std::uint32_t view_width, std::uint32_t view_height) {
  Diagnostics out;
  SourceLoc place{plan.name};
  const auto check = [&](std::string_view what, std::string_view name, std::uint64_t value, std::uint64_t limit) {
    if (value > limit)
      out.error("G070", place, fmt::format("{} of '{}' is {} for a view of {}x{}, but the device allows {}.", what, name, value, view_width, view_height, limit));
  };
  for (const PlannedTexture& t : plan.textures) {
    const gpu::Extent3d size = extent_of(t.spec, view_width, view_height);
    place = place_of(plan, t);
    const bool d3 = t.spec.dimension == gpu::TextureDimension::D3;
    const std::uint32_t side = d3 ? limits.max_texture_dimension_3d : t.spec.dimension == gpu::TextureDimension::D1 ? limits.max_texture_dimension_1d : limits.max_texture_dimension_2d;
    check("the width", t.name, size.width, side);
    check("the height", t.name, size.height, side);
    check(d3 ? "the depth" : "the number of layers", t.name, size.depth_or_layers, d3 ? side : limits.max_texture_array_layers);
    check("the number of mips", t.name, t.spec.mips, gpu::max_mip_levels(size, t.spec.dimension));
  }
  for (const PlannedBuffer& b : plan.buffers) {
    place = place_of(plan, b);
    check("the size in bytes", b.name, bytes_of(b.spec, view_width, view_height), std::min(limits.max_buffer_size, limits.max_storage_buffer_binding_size));
  }
  place = {plan.name};
  for (const PlannedPass& pass : plan.passes) {
    const auto colors = std::count_if(pass.uses.begin(), pass.uses.end(), [](const Use& use) { return is_color(use.access); });
    check("the number of color attachments", pass.name, static_cast<std::uint64_t>(colors), limits.max_color_attachments);
  }
  return out;
}

} // namespace mote::rg
