// SPDX-License-Identifier: MIT
#include "core/gpu/reflection.hpp"

#include "core/gpu/error.hpp"

#include <spirv_cross/spirv_cross.hpp>

#include <algorithm>
#include <optional>

namespace mote::gpu {
namespace {

namespace cross = spirv_cross;

std::optional<ShaderStage> stage_of(spv::ExecutionModel model) {
  switch (model) {
    case spv::ExecutionModelVertex: return ShaderStage::Vertex;
    case spv::ExecutionModelGeometry: return ShaderStage::Geometry;
    case spv::ExecutionModelFragment: return ShaderStage::Fragment;
    case spv::ExecutionModelGLCompute: return ShaderStage::Compute;
    default: return std::nullopt;
  }
}

TextureFormat storage_format_of(spv::ImageFormat format) {
  switch (format) {
    case spv::ImageFormatR8: return TextureFormat::R8Unorm;
    case spv::ImageFormatRgba8: return TextureFormat::RGBA8Unorm;
    case spv::ImageFormatRgba16: return TextureFormat::RGBA16Unorm;
    case spv::ImageFormatR16f: return TextureFormat::R16Float;
    case spv::ImageFormatRgba16f: return TextureFormat::RGBA16Float;
    case spv::ImageFormatR32f: return TextureFormat::R32Float;
    case spv::ImageFormatRg32f: return TextureFormat::RG32Float;
    case spv::ImageFormatRgba32f: return TextureFormat::RGBA32Float;
    case spv::ImageFormatR32ui: return TextureFormat::R32Uint;
    case spv::ImageFormatRg32ui: return TextureFormat::RG32Uint;
    case spv::ImageFormatRgba32ui: return TextureFormat::RGBA32Uint;
    case spv::ImageFormatR32i: return TextureFormat::R32Sint;
    default: return TextureFormat::Undefined;
  }
}

FormatKind kind_of(const cross::SPIRType& type) {
  switch (type.basetype) {
    case cross::SPIRType::UInt: case cross::SPIRType::UInt64: return FormatKind::Uint;
    case cross::SPIRType::Int: case cross::SPIRType::Int64: return FormatKind::Sint;
    default: return FormatKind::Float;
  }
}

// One entry point of one parsed module.
class EntryReader {
public:
  EntryReader(cross::Compiler& compiler, const cross::EntryPoint& entry, ShaderStage stage) : compiler_(compiler) {
    compiler_.set_entry_point(entry.name, entry.execution_model);
    out_.name = entry.name;
    out_.stage = stage;
  }

  ReflectedEntryPoint read() {
    const auto active = compiler_.get_active_interface_variables();
    const cross::ShaderResources all = compiler_.get_shader_resources(active);
    for (const auto& r : all.uniform_buffers) add_buffer(r, BindingType::UniformBuffer);
    for (const auto& r : all.storage_buffers) {
      const bool read_only = compiler_.get_buffer_block_flags(r.id).get(spv::DecorationNonWritable);
      add_buffer(r, read_only ? BindingType::ReadOnlyStorageBuffer : BindingType::StorageBuffer);
    }
    for (const auto& r : all.separate_images) add_image(r, BindingType::SampledTexture);
    for (const auto& r : all.storage_images) {
      const bool read_only = compiler_.has_decoration(r.id, spv::DecorationNonWritable);
      add_image(r, read_only ? BindingType::ReadOnlyStorageTexture : BindingType::StorageTexture);
    }
    for (const auto& r : all.separate_samplers) place(r, BindingType::Sampler);
    refuse(all.sampled_images, "a combined image sampler; the layer has separate texture2D and sampler bindings only");
    refuse(all.subpass_inputs, "a subpass input");
    for (const auto& r : all.push_constant_buffers) {
      out_.push_constant_size =
          static_cast<std::uint32_t>(compiler_.get_declared_struct_size(compiler_.get_type(r.base_type_id)));
    }
    out_.inputs = variables(all.stage_inputs, out_.stage == ShaderStage::Geometry);
    out_.outputs = variables(all.stage_outputs, false);
    read_modes(all);
    std::sort(out_.bindings.begin(), out_.bindings.end(), [](const auto& a, const auto& b) {
      return std::pair(a.group, a.binding) < std::pair(b.group, b.binding);
    });
    return std::move(out_);
  }

private:
  ReflectedBinding& place(const cross::Resource& r, BindingType type) {
    ReflectedBinding b;
    b.group = compiler_.get_decoration(r.id, spv::DecorationDescriptorSet);
    b.binding = compiler_.get_decoration(r.id, spv::DecorationBinding);
    b.name = r.name;
    b.type = type;
    if (!compiler_.get_type(r.type_id).array.empty()) {
      invalid("V-SHDR-003", "Binding '{}' (group {}, binding {}) is an array of bindings, which the layer does not have.",
              r.name, b.group, b.binding);
    }
    return out_.bindings.emplace_back(std::move(b));
  }

  void add_buffer(const cross::Resource& r, BindingType type) {
    const cross::SPIRType& block = compiler_.get_type(r.base_type_id);
    place(r, type).min_size = compiler_.get_declared_struct_size_runtime_array(block, 1);
  }

  void add_image(const cross::Resource& r, BindingType type) {
    const cross::SPIRType& t = compiler_.get_type(r.base_type_id);
    ReflectedBinding& b = place(r, type);
    b.multisampled = t.image.ms;
    switch (t.image.dim) {
      case spv::Dim1D: b.dimension = TextureViewDimension::D1; break;
      case spv::Dim2D: b.dimension = t.image.arrayed ? TextureViewDimension::D2Array : TextureViewDimension::D2; break;
      case spv::Dim3D: b.dimension = TextureViewDimension::D3; break;
      default:
        invalid("V-SHDR-003", "Binding '{}' (group {}, binding {}) is an image of a dimension that the layer does not have.",
                r.name, b.group, b.binding);
    }
    const FormatKind kind = kind_of(compiler_.get_type(t.image.type));
    b.sample_type = kind == FormatKind::Uint   ? SampleType::Uint
                    : kind == FormatKind::Sint ? SampleType::Sint
                                               : SampleType::Float;
    b.storage_format = storage_format_of(t.image.format);
  }

  template <class List> void refuse(const List& list, std::string_view what) {
    if (list.empty()) return;
    const auto& r = list.front();
    invalid("V-SHDR-003", "Binding '{}' (group {}, binding {}) is {}.", r.name,
            compiler_.get_decoration(r.id, spv::DecorationDescriptorSet), compiler_.get_decoration(r.id, spv::DecorationBinding),
            what);
  }

  // Locations; arrays and matrices take one location per column, the per-vertex array of a geometry input is no array.
  template <class List> std::vector<ReflectedVariable> variables(const List& list, bool per_vertex) {
    std::vector<ReflectedVariable> result;
    for (const auto& r : list) {
      const cross::SPIRType& outer = compiler_.get_type(r.type_id);
      const cross::SPIRType& type = compiler_.get_type(r.base_type_id);
      std::size_t dims = outer.array.size();
      if (per_vertex && dims > 0) --dims;
      std::uint32_t slots = std::max(1u, type.columns);
      for (std::size_t i = 0; i < dims; ++i) slots *= std::max(1u, outer.array[i]);
      const std::uint32_t location = compiler_.get_decoration(r.id, spv::DecorationLocation);
      const bool flat = compiler_.has_decoration(r.id, spv::DecorationFlat);
      for (std::uint32_t i = 0; i < slots; ++i) result.push_back({location + i, type.vecsize, kind_of(type), r.name, flat});
    }
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.location < b.location; });
    return result;
  }

  void read_modes(const cross::ShaderResources& all) {
    const auto& entry = compiler_.get_entry_point(out_.name, compiler_.get_execution_model());
    const auto has_mode = [&](spv::ExecutionMode mode) { return entry.flags.get(mode); };
    if (out_.stage == ShaderStage::Compute) {
      for (unsigned i = 0; i < 3; ++i) {
        out_.local_size[i] = compiler_.get_execution_mode_argument(spv::ExecutionModeLocalSize, i);
      }
    }
    for (const auto& b : all.builtin_outputs) out_.writes_depth |= b.builtin == spv::BuiltInFragDepth;
    if (out_.stage != ShaderStage::Geometry) return;
    out_.geometry.input = has_mode(spv::ExecutionModeInputPoints)  ? Topology::PointList
                          : has_mode(spv::ExecutionModeInputLines) ? Topology::LineList
                          : has_mode(spv::ExecutionModeTriangles)  ? Topology::TriangleList
                                                                   : Topology::Undefined; // with adjacency
    out_.geometry.output = has_mode(spv::ExecutionModeOutputPoints)      ? Topology::PointList
                           : has_mode(spv::ExecutionModeOutputLineStrip) ? Topology::LineList
                                                                         : Topology::TriangleStrip;
    out_.geometry.max_vertices = compiler_.get_execution_mode_argument(spv::ExecutionModeOutputVertices);
    out_.geometry.invocations = std::max(1u, entry.invocations);
  }

  cross::Compiler& compiler_;
  ReflectedEntryPoint out_;
};

Feature features_of(const cross::Compiler& compiler) {
  Feature features{};
  for (const spv::Capability c : compiler.get_declared_capabilities()) {
    switch (c) {
      case spv::CapabilityGeometry: features |= Feature::GeometryShader; break;
      case spv::CapabilityFloat64: features |= Feature::ShaderFloat64; break;
      case spv::CapabilityInt64: features |= Feature::ShaderInt64; break;
      case spv::CapabilityInt64Atomics: features |= Feature::Int64Atomics; break;
      case spv::CapabilityGroupNonUniform:
      case spv::CapabilityGroupNonUniformVote:
      case spv::CapabilityGroupNonUniformArithmetic:
      case spv::CapabilityGroupNonUniformBallot:
      case spv::CapabilityGroupNonUniformShuffle:
      case spv::CapabilityGroupNonUniformShuffleRelative: features |= Feature::Subgroups; break;
      default: break;
    }
  }
  return features;
}

Reflection read_module(std::span<const std::uint32_t> spirv) {
  cross::Compiler compiler(spirv.data(), spirv.size());
  Reflection result;
  result.features = features_of(compiler);
  for (const cross::EntryPoint& entry : compiler.get_entry_points_and_stages()) {
    if (const auto stage = stage_of(entry.execution_model)) {
      result.entry_points.push_back(EntryReader(compiler, entry, *stage).read());
    }
  }
  for (const cross::SpecializationConstant& c : compiler.get_specialization_constants()) {
    result.constants.push_back({c.constant_id, compiler.get_name(c.id), compiler.get_constant(c.id).scalar()});
  }
  std::sort(result.constants.begin(), result.constants.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return result;
}

} // namespace

Reflection reflect(std::span<const std::uint32_t> spirv) {
  if (spirv.size() < 5 || spirv[0] != spv::MagicNumber) {
    invalid("V-SHDR-001", "The code is not SPIR-V: it has {} words and starts with {:#010x}, not {:#010x}.", spirv.size(),
            spirv.empty() ? 0u : spirv[0], static_cast<std::uint32_t>(spv::MagicNumber));
  }
  Reflection result;
  try {
    result = read_module(spirv);
  } catch (const cross::CompilerError& error) {
    invalid("V-SHDR-001", "The code is not valid SPIR-V: {}", error.what());
  }
  if (result.entry_points.empty()) {
    invalid("V-SHDR-002", "The module has no entry point of a vertex, geometry, fragment or compute stage.");
  }
  return result;
}

const ReflectedEntryPoint* find_entry_point(const Reflection& reflection, std::string_view name, ShaderStage stage) {
  for (const ReflectedEntryPoint& entry : reflection.entry_points) {
    if (entry.name == name && entry.stage == stage) return &entry;
  }
  return nullptr;
}

} // namespace mote::gpu
