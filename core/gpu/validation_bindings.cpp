// SPDX-License-Identifier: MIT
// Rules for bind group layouts, bind groups and pipeline layouts.
#include "core/gpu/error.hpp"
#include "core/gpu/validation.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

bool is_buffer(BindingType type) {
  return type == BindingType::UniformBuffer || type == BindingType::StorageBuffer || type == BindingType::ReadOnlyStorageBuffer;
}
bool is_texture(BindingType type) {
  return type == BindingType::SampledTexture || type == BindingType::StorageTexture || type == BindingType::ReadOnlyStorageTexture;
}

std::string_view resource_word(BindingType type) { return is_buffer(type) ? "a buffer" : is_texture(type) ? "a texture view" : "a sampler"; }

void check_layout_entry(const DeviceFacts& device, const BindGroupLayoutEntry& e, const std::string& name) {
  if (e.type == BindingType::Undefined) invalid("V-BGL-002", "The type of binding {} of {} is Undefined.", e.binding, name);
  if (!any(e.visibility)) invalid("V-BGL-003", "The visibility of binding {} of {} is None.", e.binding, name);
  if (any(e.visibility & ShaderStage::Geometry)) {
    check_feature(device, Feature::GeometryShader, fmt::format("Binding {} of {} is visible to the geometry stage", e.binding, name));
  }
  const bool storage_texture = e.type == BindingType::StorageTexture || e.type == BindingType::ReadOnlyStorageTexture;
  if (storage_texture && (e.storage_format == TextureFormat::Undefined || !caps_of(device.formats, e.storage_format).storage)) {
    invalid("V-BGL-004", "The storage format of binding {} of {} is {}, which {} does not offer for storage.", e.binding, name,
            to_string(e.storage_format), named("Device", device.label));
  }
  if (is_texture(e.type) && e.view_dimension == TextureViewDimension::Undefined) {
    invalid("V-BGL-005", "The view dimension of binding {} of {} is Undefined.", e.binding, name);
  }
}

} // namespace

void check_bind_group_layout(const DeviceFacts& device, const BindGroupLayoutDescriptor& d) {
  const std::string name = named("BindGroupLayoutDescriptor", d.label);
  for (std::size_t i = 0; i < d.entries.size(); ++i) {
    check_layout_entry(device, d.entries[i], name);
    for (std::size_t k = 0; k < i; ++k) {
      if (d.entries[k].binding == d.entries[i].binding) {
        invalid("V-BGL-001", "entries[{}] and entries[{}] of {} both have binding {}.", k, i, name, d.entries[i].binding);
      }
    }
  }
}

void check_pipeline_layout(const DeviceFacts& device, std::size_t group_count, std::uint32_t push_constant_size) {
  const std::size_t most = std::min<std::size_t>(8, device.limits.max_bind_groups);
  if (group_count > most) {
    invalid("V-PLAY-001", "The layout has {} bind groups; {} allows {}.", group_count, named("Device", device.label), most);
  }
  const std::uint32_t bytes = std::min(256u, device.limits.max_push_constant_size);
  if (push_constant_size % 4 != 0 || push_constant_size > bytes) {
    invalid("V-PLAY-002", "The push constant size is {}; it must be a multiple of 4 and at most {}.", push_constant_size, bytes);
  }
}

const BindGroupLayoutEntry* find_entry(std::span<const BindGroupLayoutEntry> entries, std::uint32_t binding) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.binding == binding; });
  return found == entries.end() ? nullptr : &*found;
}

void check_bind_group_entries(std::string_view layout_label, std::span<const BindGroupLayoutEntry> layout,
                              std::span<const BindGroupEntry> entries) {
  const std::string name = named("BindGroupLayout", layout_label);
  if (entries.size() != layout.size()) {
    invalid("V-BIND-001", "The group has {} entries; {} has {} bindings.", entries.size(), name, layout.size());
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const BindGroupEntry& e = entries[i];
    const BindGroupLayoutEntry* expected = find_entry(layout, e.binding);
    if (expected == nullptr) invalid("V-BIND-002", "entries[{}] has binding {}, which {} does not have.", i, e.binding, name);
    for (std::size_t k = 0; k < i; ++k) {
      if (entries[k].binding == e.binding) invalid("V-BIND-003", "entries[{}] and entries[{}] both have binding {}.", k, i, e.binding);
    }
    const bool has_buffer = e.buffer.buffer != nullptr, has_texture = e.texture != nullptr, has_sampler = e.sampler != nullptr;
    if (has_buffer + has_texture + has_sampler != 1) {
      invalid("V-BIND-004", "entries[{}], binding {}, sets {} resources; it must set one.", i, e.binding, has_buffer + has_texture + has_sampler);
    }
    const std::string_view given = has_buffer ? "a buffer" : has_texture ? "a texture view" : "a sampler";
    if (given != resource_word(expected->type)) {
      invalid("V-BIND-005", "entries[{}], binding {}, is {}; {} expects {} ({}).", i, e.binding, given, name, resource_word(expected->type),
              to_string(expected->type));
    }
  }
}

std::uint64_t check_buffer_binding(const DeviceFacts& device, const BindGroupLayoutEntry& entry, const BufferFacts& buffer,
                                   std::uint64_t offset, std::uint64_t size) {
  const std::string name = named("Buffer", buffer.label);
  const bool uniform = entry.type == BindingType::UniformBuffer;
  check_usage("the bound buffer", buffer, uniform ? BufferUsage::Uniform : BufferUsage::Storage);
  const std::uint32_t alignment = uniform ? device.limits.min_uniform_buffer_offset_alignment : device.limits.min_storage_buffer_offset_alignment;
  if (alignment != 0 && offset % alignment != 0) {
    invalid("V-BIND-006", "{} is bound at offset {}, which is no multiple of {}.", name, offset, alignment);
  }
  const std::uint64_t bytes = check_range("the bound range", buffer, offset, size, 1);
  const std::uint64_t most = uniform ? device.limits.max_uniform_buffer_binding_size : device.limits.max_storage_buffer_binding_size;
  if (bytes > most) {
    invalid("V-BIND-007", "{} bytes of {} are bound as {}; {} allows {} per binding. Bind a smaller range of the buffer.", bytes, name,
            to_string(entry.type), named("Device", device.label), most);
  }
  if (bytes == 0 || bytes < entry.min_binding_size) {
    invalid("V-BIND-008", "{} bytes of {} are bound; the layout's min_binding_size is {}.", bytes, name, std::max<std::uint64_t>(1, entry.min_binding_size));
  }
  return bytes;
}

void check_texture_binding(const DeviceFacts& device, const BindGroupLayoutEntry& entry, const ViewFacts& view) {
  const TextureFacts& texture = *view.texture;
  const std::string name = named("TextureView", view.label);
  const bool sampled = entry.type == BindingType::SampledTexture;
  check_usage("the bound texture", texture, sampled ? TextureUsage::Sampled : TextureUsage::Storage);
  if (view.dimension != entry.view_dimension) {
    invalid("V-BIND-009", "{} has dimension {}; the layout expects {}.", name, to_string(view.dimension), to_string(entry.view_dimension));
  }
  if (!sampled) {
    if (texture.format != entry.storage_format) {
      invalid("V-BIND-011", "{} has format {}; the layout expects {}.", name, to_string(texture.format), to_string(entry.storage_format));
    }
    if (view.range.mips != 1) invalid("V-BIND-012", "{} has {} mip levels; a storage texture is one.", name, view.range.mips);
    return;
  }
  const FormatKind kind = format_info(texture.format).kind;
  bool fits = false;
  switch (entry.sample_type) {
    case SampleType::Float: fits = caps_of(device.formats, texture.format).filterable && (kind == FormatKind::Float || kind == FormatKind::Unorm); break;
    case SampleType::UnfilterableFloat: fits = kind != FormatKind::Uint && kind != FormatKind::Sint; break;
    case SampleType::Depth: fits = kind == FormatKind::Depth; break;
    case SampleType::Uint: fits = kind == FormatKind::Uint; break;
    case SampleType::Sint: fits = kind == FormatKind::Sint; break;
  }
  if (!fits) {
    invalid("V-BIND-013", "{} has format {}, which cannot be sampled as {} on {}.", name, to_string(texture.format), to_string(entry.sample_type),
            named("Device", device.label));
  }
}

void check_sampler_binding(const BindGroupLayoutEntry& entry) {
  if (entry.type != BindingType::Sampler) invalid("V-BIND-005", "Binding {} is a sampler; the layout expects {}.", entry.binding, to_string(entry.type));
}

bool same_layout(std::span<const BindGroupLayoutEntry> a, std::span<const BindGroupLayoutEntry> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const BindGroupLayoutEntry& x, const BindGroupLayoutEntry& y) {
    return x.binding == y.binding && x.visibility == y.visibility && x.type == y.type && x.min_binding_size == y.min_binding_size &&
           x.sample_type == y.sample_type && x.view_dimension == y.view_dimension && x.storage_format == y.storage_format;
  });
}

} // namespace mote::gpu
