// SPDX-License-Identifier: MIT
// Rules for features, buffers, textures, views, samplers and query sets.
#include "core/gpu/error.hpp"
#include "core/gpu/validation.hpp"

#include <algorithm>
#include <cmath>

namespace mote::gpu {

void check_feature(const DeviceFacts& device, Feature feature, std::string_view what) {
  if (has(device.features, feature)) return;
  invalid("V-FEAT-001", "{} but Feature {} is not enabled on {}.", what, to_string(feature), named("Device", device.label));
}

void check_buffer(const DeviceFacts& device, const BufferDescriptor& d) {
  const std::string name = named("BufferDescriptor", d.label);
  if (d.size == 0) invalid("V-BUF-001", "The size of {} is 0.", name);
  if (d.size > device.limits.max_buffer_size) {
    invalid("V-BUF-002", "The size of {} is {} bytes; {} allows {} (max_buffer_size).", name, d.size, named("Device", device.label),
            device.limits.max_buffer_size);
  }
  if (!any(d.usage)) invalid("V-BUF-003", "The usage of {} is None.", name);
  const auto others = [&](BufferUsage allowed) {
    return static_cast<BufferUsage>(static_cast<std::uint32_t>(d.usage) & ~static_cast<std::uint32_t>(allowed));
  };
  if (any(d.usage & BufferUsage::MapRead) && any(others(BufferUsage::MapRead | BufferUsage::CopyDst | BufferUsage::QueryResolve))) {
    invalid("V-BUF-004", "The usage of {} is {}; MapRead combines with CopyDst and QueryResolve only.", name, to_string(d.usage));
  }
  if (any(d.usage & BufferUsage::MapWrite) && any(others(BufferUsage::MapWrite | BufferUsage::CopySrc))) {
    invalid("V-BUF-004", "The usage of {} is {}; MapWrite combines with CopySrc only.", name, to_string(d.usage));
  }
  if (d.contents.size() > d.size) {
    invalid("V-BUF-005", "The contents of {} are {} bytes; its size is {}.", name, d.contents.size(), d.size);
  }
}

namespace {

void check_texture_size(const DeviceFacts& device, const TextureDescriptor& d, const std::string& name) {
  const Extent3d s = d.size;
  if (s.width == 0 || s.height == 0 || s.depth_or_layers == 0) {
    invalid("V-TEX-001", "The size of {} is {}x{}x{}; no side may be 0.", name, s.width, s.height, s.depth_or_layers);
  }
  const Limits& l = device.limits;
  Extent3d most{l.max_texture_dimension_2d, l.max_texture_dimension_2d, l.max_texture_array_layers};
  if (d.dimension == TextureDimension::D1) most = {l.max_texture_dimension_1d, 1, 1};
  if (d.dimension == TextureDimension::D3) most = {l.max_texture_dimension_3d, l.max_texture_dimension_3d, l.max_texture_dimension_3d};
  if (s.width > most.width || s.height > most.height || s.depth_or_layers > most.depth_or_layers) {
    invalid("V-TEX-002", "The size of {} is {}x{}x{}; {} allows {}x{}x{} for dimension {}.", name, s.width, s.height, s.depth_or_layers,
            named("Device", device.label), most.width, most.height, most.depth_or_layers, to_string(d.dimension));
  }
  const std::uint32_t levels = max_mip_levels(s, d.dimension);
  if (d.mip_level_count == 0 || d.mip_level_count > levels) {
    invalid("V-TEX-003", "{} asks for {} mip levels; a size of {}x{}x{} has 1 to {}.", name, d.mip_level_count, s.width, s.height,
            s.depth_or_layers, levels);
  }
}

void check_texture_usage(const DeviceFacts& device, const TextureDescriptor& d, const std::string& name) {
  if (d.format == TextureFormat::Undefined) invalid("V-TEX-004", "The format of {} is Undefined.", name);
  if (!any(d.usage)) invalid("V-TEX-005", "The usage of {} is None.", name);
  const FormatCaps& caps = caps_of(device.formats, d.format);
  const auto need = [&](TextureUsage usage, bool offered) {
    if (any(d.usage & usage) && !offered) {
      invalid("V-TEX-006", "The usage of {} has {}, which {} does not offer for format {}.", name, to_string(usage),
              named("Device", device.label), to_string(d.format));
    }
  };
  need(TextureUsage::Sampled, caps.sampled);
  need(TextureUsage::Storage, caps.storage);
  need(TextureUsage::RenderAttachment, caps.renderable && d.dimension == TextureDimension::D2);
}

void check_samples(const DeviceFacts& device, const TextureDescriptor& d, const std::string& name) {
  if (d.sample_count == 1) return;
  if (d.sample_count != 4) invalid("V-TEX-007", "The sample count of {} is {}; there are 1 and 4.", name, d.sample_count);
  if (!caps_of(device.formats, d.format).multisample) {
    invalid("V-TEX-007", "The sample count of {} is 4, which {} does not offer for format {}.", name, named("Device", device.label),
            to_string(d.format));
  }
  if (d.dimension != TextureDimension::D2 || d.mip_level_count != 1 || d.size.depth_or_layers != 1 || any(d.usage & TextureUsage::Storage) ||
      !any(d.usage & TextureUsage::RenderAttachment)) {
    invalid("V-TEX-008", "{} has 4 samples; that needs dimension 2d, one mip level, one layer, RenderAttachment and no Storage usage.", name);
  }
}

} // namespace

void check_texture(const DeviceFacts& device, const TextureDescriptor& d) {
  const std::string name = named("TextureDescriptor", d.label);
  check_texture_size(device, d, name);
  check_texture_usage(device, d, name);
  check_samples(device, d, name);
}

ViewFacts check_view(const TextureFacts& texture, const TextureViewDescriptor& d) {
  ViewFacts view{d.label, &texture, d.dimension, {}};
  const std::string name = named("TextureViewDescriptor", d.label);
  const std::string of = named("Texture", texture.label);
  const std::uint32_t layers = texture.layers();
  if (d.base_mip_level >= texture.mips || d.mip_level_count > texture.mips - d.base_mip_level) {
    invalid("V-VIEW-001", "Mip levels [{}, {}) of {} are not inside {}, which has {}.", d.base_mip_level,
            std::uint64_t{d.base_mip_level} + std::max(1u, d.mip_level_count), name, of, texture.mips);
  }
  if (d.base_array_layer >= layers || d.array_layer_count > layers - d.base_array_layer) {
    invalid("V-VIEW-002", "Layers [{}, {}) of {} are not inside {}, which has {}.", d.base_array_layer,
            std::uint64_t{d.base_array_layer} + std::max(1u, d.array_layer_count), name, of, layers);
  }
  view.range.base_mip = d.base_mip_level;
  view.range.mips = d.mip_level_count != 0 ? d.mip_level_count : texture.mips - d.base_mip_level;
  view.range.base_layer = d.base_array_layer;
  using enum TextureViewDimension;
  if (view.dimension == Undefined) {
    view.dimension = texture.dimension == TextureDimension::D1   ? D1
                     : texture.dimension == TextureDimension::D3 ? D3
                     : layers > 1 && d.array_layer_count != 1    ? D2Array
                                                                 : D2;
  }
  view.range.layers = d.array_layer_count != 0 ? d.array_layer_count : view.dimension == D2 ? 1 : layers - d.base_array_layer;
  const bool flat = view.dimension == D2 || view.dimension == D2Array;
  const bool fits = texture.dimension == TextureDimension::D1   ? view.dimension == D1
                    : texture.dimension == TextureDimension::D3 ? view.dimension == D3
                                                                : flat;
  if (!fits) {
    invalid("V-VIEW-003", "{} has dimension {}; {} has dimension {}.", name, to_string(view.dimension), of, to_string(texture.dimension));
  }
  if (view.dimension == D2 && view.range.layers != 1) {
    invalid("V-VIEW-004", "{} has dimension 2d and {} layers; 2d is one layer, several are 2d_array.", name, view.range.layers);
  }
  return view;
}

void check_sampler(const SamplerDescriptor& d) {
  const std::string name = named("SamplerDescriptor", d.label);
  if (!(d.lod_min >= 0) || !(d.lod_max >= d.lod_min)) {
    invalid("V-SAMP-001", "The level range of {} is [{}, {}]; it must be ordered and not negative.", name, d.lod_min, d.lod_max);
  }
  const bool linear = d.mag_filter == FilterMode::Linear && d.min_filter == FilterMode::Linear && d.mipmap_filter == FilterMode::Linear;
  if (d.max_anisotropy < 1 || d.max_anisotropy > 16 || (d.max_anisotropy > 1 && !linear)) {
    invalid("V-SAMP-002", "The max_anisotropy of {} is {}; it must be 1 to 16, and above 1 all three filters must be linear.", name,
            d.max_anisotropy);
  }
}

void check_query_set(const DeviceFacts& device, const QuerySetDescriptor& d) {
  const std::string name = named("QuerySetDescriptor", d.label);
  const Feature needed = d.type == QueryType::Timestamp ? Feature::TimestampQuery : Feature::PipelineStatistics;
  check_feature(device, needed, fmt::format("The type of {} is {}", name, to_string(d.type)));
  if (d.count == 0 || d.count > 4096) invalid("V-QRY-001", "The count of {} is {}; it must be 1 to 4096.", name, d.count);
}

} // namespace mote::gpu
