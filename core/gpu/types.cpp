// SPDX-License-Identifier: MIT
#include "core/gpu/types.hpp"

#include "core/gpu/format.hpp"

#include <array>
#include <span>
#include <utility>

namespace mote::gpu {
namespace {

template <class E, std::size_t N> std::string_view pick(E value, const std::array<std::string_view, N>& names) {
  const auto i = static_cast<std::size_t>(value);
  return i < N ? names[i] : std::string_view{"(out of range)"};
}

// "CopySrc|CopyDst"; names[i] belongs to bit i; no bits print as "None".
template <class E> std::string join(E set, std::span<const std::string_view> names) {
  std::string text;
  const auto bits = static_cast<std::uint32_t>(set);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((bits >> i & 1u) == 0) continue;
    if (!text.empty()) text += '|';
    text += names[i];
  }
  return text.empty() ? "None" : text;
}

} // namespace

std::string_view to_string(TextureFormat format) { return format_info(format).name; }

std::string_view to_string(TextureDimension dimension) {
  static constexpr std::array<std::string_view, 3> names{"1d", "2d", "3d"};
  return pick(dimension, names);
}
std::string_view to_string(TextureViewDimension dimension) {
  static constexpr std::array<std::string_view, 5> names{"undefined", "1d", "2d", "2d_array", "3d"};
  return pick(dimension, names);
}
std::string_view to_string(Topology topology) {
  static constexpr std::array<std::string_view, 5> names{"undefined", "point_list", "line_list", "triangle_list",
                                                         "triangle_strip"};
  return pick(topology, names);
}
std::string_view to_string(CompareFunction compare) {
  static constexpr std::array<std::string_view, 9> names{"undefined", "never",   "less",          "equal", "less_equal",
                                                         "greater",   "not_equal", "greater_equal", "always"};
  return pick(compare, names);
}
std::string_view to_string(BlendFactor factor) {
  static constexpr std::array<std::string_view, 13> names{
      "zero", "one",           "src",       "one_minus_src",       "src_alpha",           "one_minus_src_alpha", "dst",
      "one_minus_dst", "dst_alpha", "one_minus_dst_alpha", "src_alpha_saturated", "constant",            "one_minus_constant"};
  return pick(factor, names);
}
std::string_view to_string(BlendOperation operation) {
  static constexpr std::array<std::string_view, 5> names{"add", "subtract", "reverse_subtract", "min", "max"};
  return pick(operation, names);
}
std::string_view to_string(BindingType type) {
  static constexpr std::array<std::string_view, 8> names{"Undefined",      "UniformBuffer",          "StorageBuffer",
                                                         "ReadOnlyStorageBuffer", "SampledTexture", "StorageTexture",
                                                         "ReadOnlyStorageTexture", "Sampler"};
  return pick(type, names);
}
std::string_view to_string(SampleType type) {
  static constexpr std::array<std::string_view, 5> names{"Float", "UnfilterableFloat", "Depth", "Uint", "Sint"};
  return pick(type, names);
}
std::string_view to_string(VertexFormat format) {
  static constexpr std::array<std::string_view, 10> names{"undefined", "float32",  "float32x2", "float32x3", "float32x4",
                                                          "uint32",    "uint32x2", "uint32x3",  "uint32x4",  "unorm8x4"};
  return pick(format, names);
}
std::string_view to_string(QueryType type) {
  static constexpr std::array<std::string_view, 2> names{"Timestamp", "PipelineStatistics"};
  return pick(type, names);
}
std::string_view to_string(ErrorFilter filter) {
  static constexpr std::array<std::string_view, 3> names{"Validation", "OutOfMemory", "Internal"};
  return pick(filter, names);
}
std::string_view to_string(DeviceType type) {
  static constexpr std::array<std::string_view, 5> names{"Other", "IntegratedGpu", "DiscreteGpu", "VirtualGpu", "Cpu"};
  return pick(type, names);
}

std::string to_string(Feature set) {
  static constexpr std::array<std::string_view, 9> names{"GeometryShader", "TimestampQuery", "PipelineStatistics",
                                                         "ShaderFloat64",  "ShaderInt64",    "Int64Atomics",
                                                         "Subgroups",      "DepthClamp",     "HostMemory"};
  return join(set, names);
}
std::string to_string(BufferUsage set) {
  static constexpr std::array<std::string_view, 10> names{"MapRead", "MapWrite", "CopySrc", "CopyDst",  "Index",
                                                          "Vertex",  "Uniform",  "Storage", "Indirect", "QueryResolve"};
  return join(set, names);
}
std::string to_string(TextureUsage set) {
  static constexpr std::array<std::string_view, 5> names{"CopySrc", "CopyDst", "Sampled", "Storage", "RenderAttachment"};
  return join(set, names);
}
std::string to_string(ShaderStage set) {
  static constexpr std::array<std::string_view, 4> names{"Vertex", "Fragment", "Compute", "Geometry"};
  return join(set, names);
}

} // namespace mote::gpu
