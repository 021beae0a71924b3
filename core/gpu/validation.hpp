// SPDX-License-Identifier: MIT
// The rules of the layer: pure functions over descriptors, facts and reflections. A broken rule
// throws a Fault with its code; a kept one returns. No Vulkan here, so each rule has a unit test
// that needs no device. Objects call these before they touch Vulkan.
//
// `*Facts` are what a rule may know about an existing object.
#pragma once

#include "core/gpu/descriptors.hpp"
#include "core/gpu/format.hpp"
#include "core/gpu/reflection.hpp"
#include "core/gpu/usage.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mote::gpu {

struct DeviceFacts {
  std::string label{"device"};
  Feature features{}; // enabled
  Limits limits{};
  FormatTable formats{};
};
struct BufferFacts {
  std::string_view label{};
  std::uint64_t size{};
  BufferUsage usage{};
};
struct TextureFacts {
  std::string label{};
  Extent3d size{};
  TextureFormat format{};
  TextureUsage usage{};
  TextureDimension dimension{};
  std::uint32_t mips{1}, samples{1};
  [[nodiscard]] std::uint32_t layers() const { return dimension == TextureDimension::D3 ? 1 : size.depth_or_layers; }
};
struct ViewFacts {
  std::string_view label{};
  const TextureFacts* texture{};
  TextureViewDimension dimension{};
  SubresourceRange range{};
};
// What draws need to know of a render pipeline.
struct PipelineFacts {
  std::string label{};
  std::vector<TextureFormat> targets{};
  TextureFormat depth{};          // Undefined: none
  bool depth_write{};
  std::uint32_t samples{1};
  std::uint32_t vertex_slots{};   // vertex buffers it reads
  std::vector<std::uint64_t> vertex_strides{};
  std::vector<VertexStepMode> vertex_steps{};
  std::uint32_t push_constants_used{}; // bytes
  std::uint32_t interpolated{}, flat{}; // components that a fragment gets from the rasterizer
};

void check_feature(const DeviceFacts& device, Feature feature, std::string_view what); // V-FEAT-001

// ---- resources (validation_resources.cpp)
void check_buffer(const DeviceFacts& device, const BufferDescriptor& descriptor);
void check_texture(const DeviceFacts& device, const TextureDescriptor& descriptor);
// Fills in the defaults (dimension, counts) and checks the rest.
ViewFacts check_view(const TextureFacts& texture, const TextureViewDescriptor& descriptor);
void check_sampler(const SamplerDescriptor& descriptor);
void check_query_set(const DeviceFacts& device, const QuerySetDescriptor& descriptor);

// ---- bindings (validation_bindings.cpp)
void check_bind_group_layout(const DeviceFacts& device, const BindGroupLayoutDescriptor& descriptor);
void check_pipeline_layout(const DeviceFacts& device, std::size_t group_count, std::uint32_t push_constant_size);
const BindGroupLayoutEntry* find_entry(std::span<const BindGroupLayoutEntry> entries, std::uint32_t binding);
// Every binding given exactly once, with one resource each.
void check_bind_group_entries(std::string_view layout_label, std::span<const BindGroupLayoutEntry> layout,
                              std::span<const BindGroupEntry> entries);
// The bytes bound, `size` 0 resolved.
std::uint64_t check_buffer_binding(const DeviceFacts& device, const BindGroupLayoutEntry& entry, const BufferFacts& buffer,
                                   std::uint64_t offset, std::uint64_t size);
void check_texture_binding(const DeviceFacts& device, const BindGroupLayoutEntry& entry, const ViewFacts& view);
void check_sampler_binding(const BindGroupLayoutEntry& entry);
// Whether a group made with layout `a` fits where `b` is expected.
bool same_layout(std::span<const BindGroupLayoutEntry> a, std::span<const BindGroupLayoutEntry> b);

// ---- pipelines (validation_pipeline.cpp)
struct LayoutFacts {
  std::string_view label{};
  std::vector<std::span<const BindGroupLayoutEntry>> groups{};
  std::uint32_t push_constant_size{};
};
struct StageFacts {
  std::string_view field{};  // "vertex"
  std::string_view module{}; // its label
  const Reflection* reflection{};
  const ReflectedEntryPoint* entry{};
};
// Finds the entry point and checks it and its constants against the device and the layout.
StageFacts check_stage(const DeviceFacts& device, const LayoutFacts& layout, ShaderStage stage, std::string_view field,
                       std::string_view module_label, const Reflection& reflection, const ProgrammableStage& programmable);
void check_shader_features(const DeviceFacts& device, const Reflection& reflection);
void check_compute(const DeviceFacts& device, const StageFacts& compute);
void check_render_pipeline(const DeviceFacts& device, const RenderPipelineDescriptor& descriptor, const StageFacts& vertex,
                           const std::optional<StageFacts>& geometry, const std::optional<StageFacts>& fragment);

// ---- commands (validation_commands.cpp)
struct AttachmentFacts {
  std::string_view name{}; // "colors[1]", "depth"
  ViewFacts view{};
};
struct PassFacts { // result of check_render_pass
  Extent3d size{};
  std::vector<TextureFormat> targets{};
  TextureFormat depth{};
  bool depth_read_only{};
  std::uint32_t samples{1};
};
struct RenderPassFacts {
  std::vector<AttachmentFacts> colors{};
  std::vector<std::optional<AttachmentFacts>> resolves{}; // one per color
  std::optional<AttachmentFacts> depth{};
  bool depth_read_only{};
  LoadOp depth_load{};
  StoreOp depth_store{};
};
PassFacts check_render_pass(const RenderPassFacts& pass);
void check_pipeline_in_pass(const PassFacts& pass, const PipelineFacts& pipeline);
// Bytes [offset, offset + size) lie inside the buffer; size 0 is the rest and is resolved.
std::uint64_t check_range(std::string_view what, const BufferFacts& buffer, std::uint64_t offset, std::uint64_t size,
                          std::uint64_t alignment);
void check_usage(std::string_view what, const BufferFacts& buffer, BufferUsage needed);
void check_usage(std::string_view what, const TextureFacts& texture, TextureUsage needed);
void check_vertex_range(const PipelineFacts& pipeline, std::uint32_t slot, std::uint64_t bound_bytes, std::uint64_t first,
                        std::uint64_t count, VertexStepMode step);
void check_query(std::string_view what, std::string_view set_label, QueryType type, std::uint32_t count, QueryType needed,
                 std::uint64_t index);

struct CopyLayout { // a picture in a buffer, defaults resolved
  std::uint32_t bytes_per_row{}, rows_per_image{};
  std::uint64_t bytes{}; // from its offset to its end
};
// Texture side of a copy: mip, origin and size inside the texture.
void check_texture_copy(std::string_view what, const TextureFacts& texture, std::uint32_t mip, Origin3d origin, Extent3d size);
CopyLayout check_buffer_copy(std::string_view what, const BufferFacts& buffer, std::uint64_t offset, std::uint32_t bytes_per_row,
                             std::uint32_t rows_per_image, TextureFormat format, Extent3d size);
void check_texture_pair(const TextureFacts& src, const TextureFacts& dst);
// Subresources that a copy at `origin` of `size` touches.
SubresourceRange copy_range(const TextureFacts& texture, std::uint32_t mip, Origin3d origin, Extent3d size);

} // namespace mote::gpu
