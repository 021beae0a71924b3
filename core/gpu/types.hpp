// SPDX-License-Identifier: MIT
// Enumerations, flags and small values of the WebGPU-like layer. Names follow wgpu: types and
// enumerators CamelCase, functions and fields snake_case. Value 0 of an enumeration that has no
// natural default is `Undefined`, so that a forgotten field is an error and not a surprise.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace mote::gpu {

// ---- flags ------------------------------------------------------------------------------------
template <class E> struct IsFlags : std::false_type {};
template <class E>
concept Flags = std::is_enum_v<E> && IsFlags<E>::value;
template <Flags E> constexpr E operator|(E a, E b) {
  using U = std::underlying_type_t<E>;
  return static_cast<E>(static_cast<U>(a) | static_cast<U>(b));
}
template <Flags E> constexpr E operator&(E a, E b) {
  using U = std::underlying_type_t<E>;
  return static_cast<E>(static_cast<U>(a) & static_cast<U>(b));
}
template <Flags E> constexpr E& operator|=(E& a, E b) { return a = a | b; }
template <Flags E> constexpr bool any(E a) { return static_cast<std::underlying_type_t<E>>(a) != 0; }
template <Flags E> constexpr bool has(E set, E flags) { return (set & flags) == flags; }

// Optional abilities. WebGPU has none of these; each is asked for at device creation and its use
// without asking is V-FEAT-001. Everything in mote also works with none of them.
enum class Feature : std::uint32_t {
  None = 0,
  GeometryShader = 1, // native only: Metal, WebGPU and SwiftShader have no geometry stage
  TimestampQuery = 2,
  PipelineStatistics = 4,
  ShaderFloat64 = 8,
  ShaderInt64 = 16,
  Int64Atomics = 32, // on storage buffers
  Subgroups = 64,    // basic + vote + ballot + arithmetic + broadcast in compute; no size is promised
  DepthClamp = 128,
  HostMemory = 256,  // buffers may lie in the caller's memory; offered by drivers that draw on the processor only
};
template <> struct IsFlags<Feature> : std::true_type {};

enum class BufferUsage : std::uint32_t {
  None = 0, MapRead = 1, MapWrite = 2, CopySrc = 4, CopyDst = 8, Index = 16, Vertex = 32,
  Uniform = 64, Storage = 128, Indirect = 256, QueryResolve = 512,
};
template <> struct IsFlags<BufferUsage> : std::true_type {};

enum class TextureUsage : std::uint32_t {
  None = 0, CopySrc = 1, CopyDst = 2, Sampled = 4, Storage = 8, RenderAttachment = 16,
};
template <> struct IsFlags<TextureUsage> : std::true_type {};

enum class ShaderStage : std::uint32_t { None = 0, Vertex = 1, Fragment = 2, Compute = 4, Geometry = 8 };
template <> struct IsFlags<ShaderStage> : std::true_type {};

enum class ColorWrite : std::uint32_t { None = 0, Red = 1, Green = 2, Blue = 4, Alpha = 8, All = 15 };
template <> struct IsFlags<ColorWrite> : std::true_type {};

// ---- enumerations -----------------------------------------------------------------------------
enum class TextureFormat : std::uint8_t {
  Undefined,
  R8Unorm, RGBA8Unorm, RGBA8UnormSrgb, BGRA8Unorm, RGBA16Unorm,
  R16Float, RGBA16Float, R32Float, RG32Float, RGBA32Float,
  R32Uint, RG32Uint, RGBA32Uint, R32Sint,
  Depth32Float,
};
enum class TextureDimension : std::uint8_t { D1, D2, D3 };
enum class TextureViewDimension : std::uint8_t { Undefined, D1, D2, D2Array, D3 };
enum class Topology : std::uint8_t { Undefined, PointList, LineList, TriangleList, TriangleStrip };
enum class CullMode : std::uint8_t { None, Front, Back };
enum class FrontFace : std::uint8_t { CounterClockwise, Clockwise };
enum class CompareFunction : std::uint8_t { Undefined, Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };
enum class BlendFactor : std::uint8_t {
  Zero, One, Src, OneMinusSrc, SrcAlpha, OneMinusSrcAlpha, Dst, OneMinusDst, DstAlpha, OneMinusDstAlpha,
  SrcAlphaSaturated, Constant, OneMinusConstant,
};
enum class BlendOperation : std::uint8_t { Add, Subtract, ReverseSubtract, Min, Max };
enum class FilterMode : std::uint8_t { Nearest, Linear };
enum class AddressMode : std::uint8_t { ClampToEdge, Repeat, MirrorRepeat };
enum class IndexFormat : std::uint8_t { Undefined, Uint16, Uint32 };
enum class VertexFormat : std::uint8_t { Undefined, Float32, Float32x2, Float32x3, Float32x4, Uint32, Uint32x2, Uint32x3, Uint32x4, Unorm8x4 };
enum class VertexStepMode : std::uint8_t { Vertex, Instance };
enum class LoadOp : std::uint8_t { Clear, Load, DontCare };
enum class StoreOp : std::uint8_t { Store, Discard };
enum class BindingType : std::uint8_t {
  Undefined, UniformBuffer, StorageBuffer, ReadOnlyStorageBuffer, SampledTexture, StorageTexture,
  ReadOnlyStorageTexture, Sampler,
};
enum class SampleType : std::uint8_t { Float, UnfilterableFloat, Depth, Uint, Sint };
enum class QueryType : std::uint8_t { Timestamp, PipelineStatistics };
// What resolve_query_set writes for one PipelineStatistics query: eight 64-bit counts.
struct PipelineStatistics {
  std::uint64_t vertices{}, primitives{}, vertex_invocations{}, geometry_invocations{}, geometry_primitives{},
      clipping_invocations{}, clipping_primitives{}, fragment_invocations{};
};
enum class ErrorFilter : std::uint8_t { Validation, OutOfMemory, Internal };
enum class DeviceType : std::uint8_t { Other, IntegratedGpu, DiscreteGpu, VirtualGpu, Cpu };
enum class PresentMode : std::uint8_t { Fifo, Mailbox, Immediate };

// Every enumeration and flag set prints as it is spelled in files and messages: formats and other
// words that a graph file uses in lower snake case ("rgba16float"), the rest as the enumerator.
std::string_view to_string(TextureFormat);
std::string_view to_string(TextureDimension);
std::string_view to_string(TextureViewDimension);
std::string_view to_string(Topology);
std::string_view to_string(CompareFunction);
std::string_view to_string(BlendFactor);
std::string_view to_string(BlendOperation);
std::string_view to_string(BindingType);
std::string_view to_string(SampleType);
std::string_view to_string(VertexFormat);
std::string_view to_string(QueryType);
std::string_view to_string(ErrorFilter);
std::string_view to_string(DeviceType);
std::string to_string(Feature);
std::string to_string(BufferUsage);
std::string to_string(TextureUsage);
std::string to_string(ShaderStage);

// ---- small values -----------------------------------------------------------------------------
struct Extent3d {
  std::uint32_t width{1}, height{1}, depth_or_layers{1};
  bool operator==(const Extent3d&) const = default;
};
struct Origin3d { std::uint32_t x{}, y{}, z{}; };
struct Color { double r{}, g{}, b{}, a{1.0}; };

struct Limits {
  std::uint32_t max_texture_dimension_1d{}, max_texture_dimension_2d{}, max_texture_dimension_3d{};
  std::uint32_t max_texture_array_layers{};
  std::uint32_t max_bind_groups{};
  std::uint64_t max_uniform_buffer_binding_size{}, max_storage_buffer_binding_size{}, max_buffer_size{};
  std::uint32_t min_uniform_buffer_offset_alignment{}, min_storage_buffer_offset_alignment{};
  std::uint32_t max_push_constant_size{};
  std::uint32_t max_color_attachments{};
  std::uint32_t max_compute_workgroup_size_x{}, max_compute_workgroup_size_y{}, max_compute_workgroup_size_z{};
  std::uint32_t max_compute_invocations_per_workgroup{}, max_compute_workgroups_per_dimension{};
  std::uint32_t max_compute_shared_memory_size{};
  std::uint32_t max_geometry_output_vertices{}, max_geometry_total_output_components{};
  std::uint32_t subgroup_size{}; // as the driver reports it; nothing may assume a value
  std::uint32_t min_subgroup_size{}; // no subgroup of a full workgroup is narrower
  float timestamp_period_ns{};
};

} // namespace mote::gpu
