// SPDX-License-Identifier: MIT
// Rules for shader stages and pipelines: reflections against layouts, stages against each other.
#include "core/gpu/error.hpp"
#include "core/gpu/validation.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

// Whether a layout entry serves what a shader declares. A layout may promise more (StorageBuffer
// for a readonly block), never less.
bool serves(const BindGroupLayoutEntry& e, const ReflectedBinding& b) {
  if (e.type == b.type) return true;
  return (e.type == BindingType::StorageBuffer && b.type == BindingType::ReadOnlyStorageBuffer) ||
         (e.type == BindingType::StorageTexture && b.type == BindingType::ReadOnlyStorageTexture);
}

bool sample_type_serves(SampleType layout, SampleType shader) {
  if (shader == SampleType::Uint || shader == SampleType::Sint) return layout == shader;
  return layout != SampleType::Uint && layout != SampleType::Sint;
}

void check_binding(const BindGroupLayoutEntry& e, const ReflectedBinding& b, ShaderStage stage, const std::string& where) {
  if (!has(e.visibility, stage)) {
    invalid("V-PIPE-004", "{} is read by the {} stage; the layout makes it visible to {}.", where, to_string(stage), to_string(e.visibility));
  }
  if (!serves(e, b)) {
    invalid("V-PIPE-005", "{} is {} in the shader and {} in the layout.", where, to_string(b.type), to_string(e.type));
  }
  if (e.min_binding_size != 0 && b.min_size > e.min_binding_size) {
    invalid("V-PIPE-006", "{} is {} bytes in the shader; the layout's min_binding_size is {}.", where, b.min_size, e.min_binding_size);
  }
  const bool texture = b.type == BindingType::SampledTexture || b.type == BindingType::StorageTexture || b.type == BindingType::ReadOnlyStorageTexture;
  if (texture && b.dimension != e.view_dimension) {
    invalid("V-PIPE-007", "{} has dimension {} in the shader and {} in the layout.", where, to_string(b.dimension), to_string(e.view_dimension));
  }
  if (b.type == BindingType::SampledTexture && !sample_type_serves(e.sample_type, b.sample_type)) {
    invalid("V-PIPE-007", "{} is sampled as {} in the shader and as {} in the layout.", where, to_string(b.sample_type), to_string(e.sample_type));
  }
  if (texture && b.type != BindingType::SampledTexture && b.storage_format != TextureFormat::Undefined && b.storage_format != e.storage_format) {
    invalid("V-PIPE-007", "{} has format {} in the shader and {} in the layout.", where, to_string(b.storage_format), to_string(e.storage_format));
  }
}

void check_constants(const StageFacts& stage, std::span<const SpecializationConstant> constants) {
  for (const SpecializationConstant& c : constants) {
    const auto& known = stage.reflection->constants;
    if (std::none_of(known.begin(), known.end(), [&](const auto& k) { return k.id == c.id; })) {
      std::string ids;
      for (const auto& k : known) ids += fmt::format("{}{}", ids.empty() ? "" : ", ", k.id);
      invalid("V-PIPE-003", "Specialization constant {} is set; {} has: {}.", c.id, named("ShaderModule", stage.module), ids.empty() ? "(none)" : ids);
    }
  }
}

// Every input of `to` is an output of `from`, of the same kind of number.
void check_link(const StageFacts& from, const StageFacts& to) {
  for (const ReflectedVariable& in : to.entry->inputs) {
    const auto& outs = from.entry->outputs;
    const auto out = std::find_if(outs.begin(), outs.end(), [&](const auto& o) { return o.location == in.location; });
    if (out == outs.end()) {
      invalid("V-PIPE-010", "The {} stage of {} reads '{}' at location {}, which the {} stage of {} does not write.", to.field,
              named("ShaderModule", to.module), in.name, in.location, from.field, named("ShaderModule", from.module));
    }
    if (out->kind != in.kind || out->components < in.components) {
      invalid("V-PIPE-010", "Location {} is '{}' with {} components in the {} stage and '{}' with {} components in the {} stage.", in.location,
              out->name, out->components, from.field, in.name, in.components, to.field);
    }
  }
}

void check_vertex_input(const RenderPipelineDescriptor& d, const StageFacts& vertex) {
  if (d.vertex_buffers.size() > 8) invalid("V-PIPE-011", "The pipeline has {} vertex buffers; there may be 8.", d.vertex_buffers.size());
  std::vector<const VertexAttribute*> attributes;
  for (std::size_t slot = 0; slot < d.vertex_buffers.size(); ++slot) {
    for (const VertexAttribute& a : d.vertex_buffers[slot].attributes) {
      const VertexFormatInfo info = vertex_format_info(a.format);
      if (info.bytes == 0) invalid("V-PIPE-011", "The format of the attribute at location {} is Undefined.", a.location);
      if (a.offset + info.bytes > d.vertex_buffers[slot].stride) {
        invalid("V-PIPE-011", "The attribute at location {} ends at byte {}; the stride of vertex buffer {} is {}.", a.location,
                a.offset + info.bytes, slot, d.vertex_buffers[slot].stride);
      }
      for (const VertexAttribute* other : attributes) {
        if (other->location == a.location) invalid("V-PIPE-011", "Two attributes have location {}.", a.location);
      }
      attributes.push_back(&a);
    }
  }
  for (const ReflectedVariable& in : vertex.entry->inputs) {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto* a) { return a->location == in.location; });
    if (found == attributes.end()) {
      invalid("V-PIPE-012", "The vertex stage of {} reads '{}' at location {}, which no vertex buffer has.", named("ShaderModule", vertex.module),
              in.name, in.location);
    }
    if (vertex_format_info((*found)->format).kind != in.kind) {
      invalid("V-PIPE-012", "The attribute at location {} has format {}; the vertex stage reads '{}' as another kind of number.", in.location,
              to_string((*found)->format), in.name);
    }
  }
}

void check_geometry(const DeviceFacts& device, const RenderPipelineDescriptor& d, const StageFacts& geometry) {
  const ReflectedGeometry& g = geometry.entry->geometry;
  const bool triangles = d.topology == Topology::TriangleList || d.topology == Topology::TriangleStrip;
  if (!(g.input == d.topology || (g.input == Topology::TriangleList && triangles))) {
    invalid("V-PIPE-013", "The topology is {}; the geometry stage of {} takes {}.", to_string(d.topology), named("ShaderModule", geometry.module),
            to_string(g.input));
  }
  const Limits& l = device.limits;
  if (g.max_vertices > l.max_geometry_output_vertices) {
    invalid("V-PIPE-014", "The geometry stage of {} may write {} vertices; {} allows {}.", named("ShaderModule", geometry.module), g.max_vertices,
            named("Device", device.label), l.max_geometry_output_vertices);
  }
  std::uint64_t components = 4; // gl_Position
  for (const ReflectedVariable& out : geometry.entry->outputs) components += out.components;
  if (components * g.max_vertices > l.max_geometry_total_output_components) {
    invalid("V-PIPE-014", "The geometry stage of {} may write {} vertices of {} components; {} allows {} components in all.",
            named("ShaderModule", geometry.module), g.max_vertices, components, named("Device", device.label), l.max_geometry_total_output_components);
  }
}

void check_targets(const DeviceFacts& device, const RenderPipelineDescriptor& d, const std::optional<StageFacts>& fragment) {
  const std::uint32_t most = std::min(8u, device.limits.max_color_attachments);
  if (d.targets.size() > most) invalid("V-PIPE-015", "The pipeline has {} color targets; {} allows {}.", d.targets.size(), named("Device", device.label), most);
  for (std::size_t i = 0; i < d.targets.size(); ++i) {
    const ColorTargetState& target = d.targets[i];
    const FormatInfo& info = format_info(target.format);
    const FormatCaps& caps = caps_of(device.formats, target.format);
    if (info.kind == FormatKind::Depth || !caps.renderable) {
      invalid("V-PIPE-016", "targets[{}] has format {}, which {} cannot render to.", i, to_string(target.format), named("Device", device.label));
    }
    if (target.blend && !caps.blendable) {
      invalid("V-PIPE-017", "targets[{}] blends, which {} does not offer for format {}.", i, named("Device", device.label), to_string(target.format));
    }
    if (!fragment || !any(target.write_mask)) continue;
    const auto& outs = fragment->entry->outputs;
    const auto out = std::find_if(outs.begin(), outs.end(), [&](const auto& o) { return o.location == i; });
    if (out == outs.end()) {
      invalid("V-PIPE-018", "targets[{}] is written, but the fragment stage of {} has no output at location {}.", i,
              named("ShaderModule", fragment->module), i);
    }
    const FormatKind kind = info.kind == FormatKind::Unorm ? FormatKind::Float : info.kind;
    if (out->kind != kind) {
      invalid("V-PIPE-018", "targets[{}] has format {}; the fragment stage writes '{}' as another kind of number.", i, to_string(target.format), out->name);
    }
  }
}

} // namespace

void check_shader_features(const DeviceFacts& device, const Reflection& reflection) {
  for (std::uint32_t bit = 1; bit <= static_cast<std::uint32_t>(Feature::DepthClamp); bit <<= 1) {
    const auto feature = static_cast<Feature>(bit);
    if (has(reflection.features, feature)) check_feature(device, feature, "The shader's capabilities ask for it,");
  }
}

StageFacts check_stage(const DeviceFacts& device, const LayoutFacts& layout, ShaderStage stage, std::string_view field,
                       std::string_view module_label, const Reflection& reflection, const ProgrammableStage& programmable) {
  StageFacts facts{field, module_label, &reflection, find_entry_point(reflection, programmable.entry_point, stage)};
  if (facts.entry == nullptr) {
    std::string all;
    for (const auto& e : reflection.entry_points) all += fmt::format("{}'{}' ({})", all.empty() ? "" : ", ", e.name, to_string(e.stage));
    invalid("V-PIPE-001", "{} has no entry point '{}' of the {} stage; it has: {}.", named("ShaderModule", module_label), programmable.entry_point,
            to_string(stage), all);
  }
  for (const ReflectedBinding& b : facts.entry->bindings) {
    const std::string where = fmt::format("Binding '{}' (group {}, binding {}) of {}", b.name, b.group, b.binding, named("ShaderModule", module_label));
    const BindGroupLayoutEntry* entry = b.group < layout.groups.size() ? find_entry(layout.groups[b.group], b.binding) : nullptr;
    if (entry == nullptr) invalid("V-PIPE-002", "{} is not in {}.", where, named("PipelineLayout", layout.label));
    check_binding(*entry, b, stage, where);
  }
  if (facts.entry->push_constant_size > layout.push_constant_size) {
    invalid("V-PIPE-008", "{} has {} bytes of push constants; {} has {}.", named("ShaderModule", module_label), facts.entry->push_constant_size,
            named("PipelineLayout", layout.label), layout.push_constant_size);
  }
  check_constants(facts, programmable.constants);
  check_shader_features(device, reflection);
  return facts;
}

void check_compute(const DeviceFacts& device, const StageFacts& compute) {
  const auto& s = compute.entry->local_size;
  const Limits& l = device.limits;
  if (s[0] > l.max_compute_workgroup_size_x || s[1] > l.max_compute_workgroup_size_y || s[2] > l.max_compute_workgroup_size_z ||
      std::uint64_t{s[0]} * s[1] * s[2] > l.max_compute_invocations_per_workgroup) {
    invalid("V-PIPE-019", "The workgroup of {} is {}x{}x{}; {} allows {}x{}x{} and {} in all.", named("ShaderModule", compute.module), s[0], s[1], s[2],
            named("Device", device.label), l.max_compute_workgroup_size_x, l.max_compute_workgroup_size_y, l.max_compute_workgroup_size_z,
            l.max_compute_invocations_per_workgroup);
  }
}

void check_render_pipeline(const DeviceFacts& device, const RenderPipelineDescriptor& d, const StageFacts& vertex,
                           const std::optional<StageFacts>& geometry, const std::optional<StageFacts>& fragment) {
  if (d.topology == Topology::Undefined) invalid("V-PIPE-009", "The topology of {} is Undefined.", named("RenderPipelineDescriptor", d.label));
  if (d.sample_count != 1 && d.sample_count != 4) invalid("V-PIPE-020", "The sample count is {}; there are 1 and 4.", d.sample_count);
  if (d.targets.empty() && !d.depth) invalid("V-PIPE-021", "{} has neither a color target nor depth.", named("RenderPipelineDescriptor", d.label));
  if (d.depth && format_info(d.depth->format).kind != FormatKind::Depth) {
    invalid("V-PIPE-022", "The depth format is {}; only depth formats are.", to_string(d.depth->format));
  }
  if (d.depth && d.depth->compare == CompareFunction::Undefined) invalid("V-PIPE-022", "The depth comparison is Undefined; Always tests nothing.");
  if (d.depth_clamp) check_feature(device, Feature::DepthClamp, "RenderPipelineDescriptor.depth_clamp is set");
  check_vertex_input(d, vertex);
  if (geometry) {
    check_geometry(device, d, *geometry);
    check_link(vertex, *geometry);
  }
  if (fragment) check_link(geometry ? *geometry : vertex, *fragment);
  check_targets(device, d, fragment);
}

} // namespace mote::gpu
