// SPDX-License-Identifier: MIT
// Every descriptor of the layer, all defaults visible on one page. Aggregates for designated
// initialisers; `label` comes first and reappears in every message about the object. Pointers,
// spans and string views are read during the call only.
#pragma once

#include "core/gpu/types.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace mote::gpu {

class Buffer;
class Texture;
class TextureView;
class Sampler;
class BindGroupLayout;
class BindGroup;
class PipelineLayout;
class ShaderModule;
class QuerySet;

struct InstanceDescriptor {
  std::string_view application{"mote"};
  bool validation{};        // Khronos layer with synchronization validation; MOTE_VALIDATION=1 turns it on, too
  bool surface{};           // enable the window-system extensions named below
  std::span<const char* const> surface_extensions{}; // from glfwGetRequiredInstanceExtensions
};

// Choice: MOTE_ADAPTER or `name` (case-insensitive substring of the device's name) wins; then a
// discrete GPU, an integrated one, a virtual one, and lavapipe when nothing else is there.
struct AdapterOptions {
  std::string_view name{};
};

struct DeviceDescriptor {
  std::string_view label{"device"};
  Feature required_features{Feature::None}; // V-FEAT-002 when the adapter lacks one
  std::string cache_directory{};     // pipeline cache file lives here; empty: none
  std::uint64_t memory_budget{};     // bytes of device memory this device may hold; 0: no limit of ours
  bool fill_new_memory{};            // tests: fresh buffers and textures hold a loud value, never zeros
};

constexpr std::uint64_t host_page = 4096; // bytes
struct BufferDescriptor {
  std::string_view label{};
  std::uint64_t size{};              // bytes, > 0
  BufferUsage usage{};
  std::span<const std::byte> contents{}; // optional first contents; its size <= size; needs no CopyDst
  // Of the memory that `contents` lie in. With Feature::HostMemory, and where they fill the buffer and start at a multiple of
  // host_page bytes, the buffer *is* that memory and keeps it alive; it must be readable up to the
  // next such multiple, and nobody may change it. Otherwise contents are copied, as without an owner.
  std::shared_ptr<const void> contents_owner{};
};

struct TextureDescriptor {
  std::string_view label{};
  Extent3d size{};
  TextureFormat format{};
  TextureUsage usage{};
  TextureDimension dimension{TextureDimension::D2};
  std::uint32_t mip_level_count{1};
  std::uint32_t sample_count{1};
};

struct TextureViewDescriptor {
  std::string_view label{};
  TextureViewDimension dimension{};  // Undefined: as the texture (2D with layers: D2Array)
  std::uint32_t base_mip_level{}, mip_level_count{};   // count 0: all that remain
  std::uint32_t base_array_layer{}, array_layer_count{};
};

struct SamplerDescriptor {
  std::string_view label{};
  FilterMode mag_filter{FilterMode::Nearest}, min_filter{FilterMode::Nearest}, mipmap_filter{FilterMode::Nearest};
  AddressMode address_u{AddressMode::ClampToEdge}, address_v{AddressMode::ClampToEdge}, address_w{AddressMode::ClampToEdge};
  float lod_min{0.0f}, lod_max{32.0f};
  CompareFunction compare{};         // Undefined: no comparison
  std::uint32_t max_anisotropy{1};
};

struct BindGroupLayoutEntry {
  std::uint32_t binding{};
  ShaderStage visibility{};
  BindingType type{};
  std::uint64_t min_binding_size{};                      // buffers; 0: unchecked
  SampleType sample_type{SampleType::Float};             // SampledTexture
  TextureViewDimension view_dimension{TextureViewDimension::D2}; // textures
  TextureFormat storage_format{};                        // StorageTexture
};
struct BindGroupLayoutDescriptor {
  std::string_view label{};
  std::span<const BindGroupLayoutEntry> entries{};
};

struct BufferBinding { const Buffer* buffer{}; std::uint64_t offset{}; std::uint64_t size{}; }; // size 0: the rest
struct BindGroupEntry {              // exactly one of the three is set
  std::uint32_t binding{};
  BufferBinding buffer{};
  const TextureView* texture{};
  const Sampler* sampler{};
};
struct BindGroupDescriptor {
  std::string_view label{};
  const BindGroupLayout* layout{};
  std::span<const BindGroupEntry> entries{};
};

struct PipelineLayoutDescriptor {
  std::string_view label{};
  std::span<const BindGroupLayout* const> bind_group_layouts{};
  std::uint32_t push_constant_size{}; // bytes, multiple of 4; one range, all stages
};

struct ShaderModuleDescriptor {
  std::string_view label{};
  std::span<const std::uint32_t> spirv{};
};

struct SpecializationConstant { // id as in layout(constant_id = id); 32-bit scalars
  std::uint32_t id{};
  std::uint32_t bits{};
};
inline SpecializationConstant spec(std::uint32_t id, std::uint32_t value) { return {id, value}; }
inline SpecializationConstant spec(std::uint32_t id, bool value) { return {id, value ? 1u : 0u}; }
inline SpecializationConstant spec(std::uint32_t id, float value) {
  return {id, __builtin_bit_cast(std::uint32_t, value)};
}

struct ProgrammableStage {
  const ShaderModule* module{};
  std::string_view entry_point{"main"};
  std::span<const SpecializationConstant> constants{};
};

struct VertexAttribute { VertexFormat format{}; std::uint64_t offset{}; std::uint32_t location{}; };
struct VertexBufferLayout {
  std::uint64_t stride{};
  VertexStepMode step{VertexStepMode::Vertex};
  std::span<const VertexAttribute> attributes{};
};

struct BlendComponent {
  BlendFactor src{BlendFactor::One}, dst{BlendFactor::Zero};
  BlendOperation operation{BlendOperation::Add};
  bool operator==(const BlendComponent&) const = default;
};
struct BlendState { BlendComponent color{}, alpha{}; bool operator==(const BlendState&) const = default; };
struct ColorTargetState {
  TextureFormat format{};
  std::optional<BlendState> blend{};
  ColorWrite write_mask{ColorWrite::All};
};
struct DepthState {
  TextureFormat format{TextureFormat::Depth32Float};
  bool write{true};
  CompareFunction compare{CompareFunction::Greater}; // reverse-Z
};

struct RenderPipelineDescriptor {
  std::string_view label{};
  const PipelineLayout* layout{};
  ProgrammableStage vertex{};
  std::optional<ProgrammableStage> geometry{}; // needs Feature::GeometryShader; not in WebGPU
  std::optional<ProgrammableStage> fragment{};
  std::span<const VertexBufferLayout> vertex_buffers{};
  Topology topology{Topology::TriangleList};
  CullMode cull{CullMode::None};
  FrontFace front_face{FrontFace::CounterClockwise};
  std::optional<DepthState> depth{};
  std::span<const ColorTargetState> targets{};
  std::uint32_t sample_count{1};
  bool depth_clamp{};                // needs Feature::DepthClamp
};

struct ComputePipelineDescriptor {
  std::string_view label{};
  const PipelineLayout* layout{};
  ProgrammableStage compute{};
};

struct QuerySetDescriptor {
  std::string_view label{};
  QueryType type{QueryType::Timestamp};
  std::uint32_t count{};
};

struct ColorAttachment {
  const TextureView* view{};
  const TextureView* resolve_target{};
  LoadOp load{LoadOp::Clear};
  StoreOp store{StoreOp::Store};
  Color clear{0, 0, 0, 0};           // integer formats take the rounded value; 4294967295 fits a double
};
struct DepthAttachment {
  const TextureView* view{};
  LoadOp load{LoadOp::Clear};
  StoreOp store{StoreOp::Store};
  float clear{0.0f};                 // reverse-Z: 0 is infinitely far
  bool read_only{};                  // may be sampled in the same pass; pipelines must not write depth
};
struct TimestampWrites {
  const QuerySet* query_set{};
  std::optional<std::uint32_t> begin{}, end{}; // query indices
};
struct RenderPassDescriptor {
  std::string_view label{};
  std::span<const ColorAttachment> colors{};
  std::optional<DepthAttachment> depth{};
  std::optional<TimestampWrites> timestamps{};
};
struct ComputePassDescriptor {
  std::string_view label{};
  std::optional<TimestampWrites> timestamps{};
};

struct TexelCopyBuffer { const Buffer* buffer{}; std::uint64_t offset{}; std::uint32_t bytes_per_row{}, rows_per_image{}; }; // 0: tight
struct TexelCopyTexture { const Texture* texture{}; std::uint32_t mip_level{}; Origin3d origin{}; };

// What a window system must supply; core knows no window library.
struct SurfaceDescriptor {
  std::string_view label{"surface"};
  // Gets a VkInstance, returns a VkSurfaceKHR (both as opaque pointers), or null with `error` set.
  std::function<void*(void* vk_instance, std::string& error)> create{};
};
struct SurfaceConfiguration {
  std::uint32_t width{}, height{};
  PresentMode present_mode{PresentMode::Fifo};
};

} // namespace mote::gpu
