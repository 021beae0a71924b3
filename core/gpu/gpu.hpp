// SPDX-License-Identifier: MIT
// The WebGPU-like layer over Vulkan 1.3, in the spirit of wgpu. docs/gpu.md compares it with
// WebGPU object by object.
//
// Life cycle: Instance -> Adapter -> Device (+ its Queue) -> objects -> CommandEncoder ->
// CommandBuffer -> Queue::submit. Objects are values with shared ownership: copy them freely, drop
// them at once; a submission keeps what it uses alive until the device has finished with it.
//
// Encoders record commands to memory; Vulkan commands are made at submit, where the barriers
// between uses are planned by a pure function (barriers.hpp). One queue, one thread per device.
//
// Errors: an invalid call makes no change, returns an invalid object (`operator bool` is false) and
// reports to the innermost error scope of its kind, or else to the uncaptured handler, which
// prints and aborts unless the application set its own. Using an invalid object later is silent if
// its cause was reported. Codes ("V-BIND-004") are listed in docs/errors.md.
#pragma once

#include "core/gpu/descriptors.hpp"
#include "core/gpu/types.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mote::gpu {

struct Error {
  ErrorFilter kind{};
  std::string code{};                 // "V-BIND-004"
  std::string message{};              // one sentence naming both sides of a mismatch
  std::vector<std::string> context{}; // "While calling Device.create_bind_group([BindGroup \"frame\"])."
};
std::string to_string(const Error& error);

// Shared base of the object handles.
#define MOTE_GPU_OBJECT(Name)                                                                        \
public:                                                                                              \
  Name() = default;                                                                                  \
  struct Impl;                                                                                       \
  explicit Name(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}                              \
  explicit operator bool() const; /* false: default-made, or made by a call that failed */           \
  bool operator==(const Name&) const = default;                                                      \
  [[nodiscard]] const std::string& label() const;                                                    \
  [[nodiscard]] const std::shared_ptr<Impl>& impl() const { return impl_; }                          \
                                                                                                     \
private:                                                                                             \
  std::shared_ptr<Impl> impl_

class Buffer {
  MOTE_GPU_OBJECT(Buffer);

public:
  [[nodiscard]] std::uint64_t size() const;
  [[nodiscard]] BufferUsage usage() const;
  // MapRead/MapWrite buffers are mapped for life. Reading: after Queue::wait of the submission that
  // filled it. The span is empty for buffers without a map usage.
  [[nodiscard]] std::span<std::byte> mapped() const;
};
class TextureView {
  MOTE_GPU_OBJECT(TextureView);

public:
  [[nodiscard]] Texture texture() const;
  [[nodiscard]] TextureFormat format() const;
  [[nodiscard]] Extent3d size() const; // of its base mip level
};
class Texture {
  MOTE_GPU_OBJECT(Texture);

public:
  [[nodiscard]] Extent3d size() const;
  [[nodiscard]] TextureFormat format() const;
  [[nodiscard]] TextureUsage usage() const;
  [[nodiscard]] TextureDimension dimension() const;
  [[nodiscard]] std::uint32_t mip_level_count() const;
  [[nodiscard]] std::uint32_t sample_count() const;
  [[nodiscard]] TextureView create_view(const TextureViewDescriptor& descriptor = {}) const;
};
class Sampler { MOTE_GPU_OBJECT(Sampler); };
class BindGroupLayout { MOTE_GPU_OBJECT(BindGroupLayout); };
class BindGroup { MOTE_GPU_OBJECT(BindGroup); };
class PipelineLayout { MOTE_GPU_OBJECT(PipelineLayout); };
class ShaderModule { MOTE_GPU_OBJECT(ShaderModule); };
class RenderPipeline { MOTE_GPU_OBJECT(RenderPipeline); };
class ComputePipeline { MOTE_GPU_OBJECT(ComputePipeline); };
class QuerySet { MOTE_GPU_OBJECT(QuerySet); };
class CommandBuffer { MOTE_GPU_OBJECT(CommandBuffer); };

// Draws inside one set of attachments. end() (or destruction) closes it; the encoder is locked
// meanwhile. Groups, vertex and index buffers, push constants stay set across pipelines of
// compatible layout.
class RenderPass {
  MOTE_GPU_OBJECT(RenderPass);

public:
  void set_pipeline(const RenderPipeline& pipeline);
  void set_bind_group(std::uint32_t index, const BindGroup& group);
  void set_push_constants(std::uint32_t offset, std::span<const std::byte> data);
  void set_vertex_buffer(std::uint32_t slot, const Buffer& buffer, std::uint64_t offset = 0, std::uint64_t size = 0);
  void set_index_buffer(const Buffer& buffer, IndexFormat format, std::uint64_t offset = 0, std::uint64_t size = 0);
  void set_viewport(float x, float y, float width, float height, float min_depth = 0, float max_depth = 1);
  void set_scissor(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height);
  void set_blend_constant(Color color);
  void draw(std::uint32_t vertex_count, std::uint32_t instance_count = 1, std::uint32_t first_vertex = 0, std::uint32_t first_instance = 0);
  void draw_indexed(std::uint32_t index_count, std::uint32_t instance_count = 1, std::uint32_t first_index = 0, std::int32_t base_vertex = 0, std::uint32_t first_instance = 0);
  void draw_indirect(const Buffer& buffer, std::uint64_t offset);
  void draw_indexed_indirect(const Buffer& buffer, std::uint64_t offset);
  void begin_pipeline_statistics(const QuerySet& set, std::uint32_t index);
  void end_pipeline_statistics();
  void push_debug_group(std::string_view label);
  void pop_debug_group();
  void end();
};

// Each dispatch is a synchronization scope of its own: writes of one are visible to the next.
class ComputePass {
  MOTE_GPU_OBJECT(ComputePass);

public:
  void set_pipeline(const ComputePipeline& pipeline);
  void set_bind_group(std::uint32_t index, const BindGroup& group);
  void set_push_constants(std::uint32_t offset, std::span<const std::byte> data);
  void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
  void dispatch_indirect(const Buffer& buffer, std::uint64_t offset);
  void push_debug_group(std::string_view label);
  void pop_debug_group();
  void end();
};

class CommandEncoder {
  MOTE_GPU_OBJECT(CommandEncoder);

public:
  [[nodiscard]] RenderPass begin_render_pass(const RenderPassDescriptor& descriptor);
  [[nodiscard]] ComputePass begin_compute_pass(const ComputePassDescriptor& descriptor = {});
  void copy_buffer_to_buffer(const Buffer& src, std::uint64_t src_offset, const Buffer& dst, std::uint64_t dst_offset, std::uint64_t size);
  void copy_buffer_to_texture(const TexelCopyBuffer& src, const TexelCopyTexture& dst, Extent3d size);
  void copy_texture_to_buffer(const TexelCopyTexture& src, const TexelCopyBuffer& dst, Extent3d size);
  void copy_texture_to_texture(const TexelCopyTexture& src, const TexelCopyTexture& dst, Extent3d size);
  void clear_buffer(const Buffer& buffer, std::uint64_t offset = 0, std::uint64_t size = 0, std::uint32_t value = 0);
  void write_timestamp(const QuerySet& set, std::uint32_t index);
  // Each render pass until the end takes one query of the set, from `index` on; the set's end ends it, too (observe.hpp).
  void begin_pipeline_statistics(const QuerySet& set, std::uint32_t index);
  void end_pipeline_statistics();
  void resolve_query_set(const QuerySet& set, std::uint32_t first, std::uint32_t count, const Buffer& dst, std::uint64_t offset); // 64-bit values
  void push_debug_group(std::string_view label);
  void pop_debug_group();
  [[nodiscard]] CommandBuffer finish();
};

using Submission = std::uint64_t; // counts up from 1

class Queue {
  MOTE_GPU_OBJECT(Queue);

public:
  Submission submit(std::span<const CommandBuffer> commands);
  Submission submit(const CommandBuffer& commands) { return submit(std::span(&commands, 1)); }
  // Ordered before later submissions. Need CopyDst.
  void write_buffer(const Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data);
  void write_texture(const TexelCopyTexture& dst, std::span<const std::byte> data, std::uint32_t bytes_per_row, std::uint32_t rows_per_image, Extent3d size);
  void wait(Submission submission); // blocks until the device has finished it
  void wait_idle();
};

struct MemoryReport {
  std::uint64_t bytes{}, peak_bytes{}, budget{}; // budget 0: none of ours
  std::uint32_t allocations{};
};

class Device {
  MOTE_GPU_OBJECT(Device);

public:
  [[nodiscard]] Queue queue() const;
  [[nodiscard]] Feature features() const;
  [[nodiscard]] const Limits& limits() const;
  [[nodiscard]] MemoryReport memory() const;

  [[nodiscard]] Buffer create_buffer(const BufferDescriptor&);
  [[nodiscard]] Texture create_texture(const TextureDescriptor&);
  [[nodiscard]] Sampler create_sampler(const SamplerDescriptor&);
  [[nodiscard]] BindGroupLayout create_bind_group_layout(const BindGroupLayoutDescriptor&);
  [[nodiscard]] BindGroup create_bind_group(const BindGroupDescriptor&);
  [[nodiscard]] PipelineLayout create_pipeline_layout(const PipelineLayoutDescriptor&);
  [[nodiscard]] ShaderModule create_shader_module(const ShaderModuleDescriptor&);
  [[nodiscard]] RenderPipeline create_render_pipeline(const RenderPipelineDescriptor&);
  [[nodiscard]] ComputePipeline create_compute_pipeline(const ComputePipelineDescriptor&);
  [[nodiscard]] QuerySet create_query_set(const QuerySetDescriptor&);
  [[nodiscard]] CommandEncoder create_command_encoder(std::string_view label = {});

  // Convenience: copies to a staging buffer, waits, returns tightly packed bytes (one mip, all layers).
  [[nodiscard]] std::vector<std::byte> read_buffer(const Buffer& buffer, std::uint64_t offset = 0, std::uint64_t size = 0);
  [[nodiscard]] std::vector<std::byte> read_texture(const Texture& texture, std::uint32_t mip_level = 0);

  void push_error_scope(ErrorFilter filter);
  [[nodiscard]] std::optional<Error> pop_error_scope();
  void on_uncaptured_error(std::function<void(const Error&)> handler);
  void save_pipeline_cache(); // to DeviceDescriptor::cache_directory; written aside and renamed; no-op without
};

struct AdapterInfo {
  std::string name{}, driver{}, driver_info{};
  DeviceType type{};
  std::string device_uuid{}; // hexadecimal; with the driver version the key of caches
  std::uint32_t api_version{}, driver_version{};
};

class Adapter {
  MOTE_GPU_OBJECT(Adapter);

public:
  [[nodiscard]] const AdapterInfo& info() const;
  [[nodiscard]] const Limits& limits() const;
  [[nodiscard]] Feature features() const;
  // On failure: an invalid Device and `error`. Of an empty Adapter: an `error` that is set already stays as
  // it is, so that instance, adapter and device can be asked for in a row and `error` read once.
  [[nodiscard]] Device request_device(const DeviceDescriptor& descriptor, Error& error) const;
};

// A window's swapchain. Not part of any graph: the application copies its picture to the texture of
// current_texture() and presents. Extent 0x0 (minimized): acquire returns an invalid texture.
class Surface {
  MOTE_GPU_OBJECT(Surface);

public:
  // Formats: BGRA8Unorm or RGBA8Unorm (never sRGB: the display transform encodes). The texture can be
  // rendered to and copied from and to.
  void configure(const Device& device, const SurfaceConfiguration& configuration);
  [[nodiscard]] TextureFormat format() const;
  [[nodiscard]] Texture acquire(); // invalid: out of date or minimized; configure again
  bool present();                  // false: out of date
};

class Instance {
  MOTE_GPU_OBJECT(Instance);

public:
  // On failure: an invalid Instance and `error` (code V-INST-001 names the package to install when there
  // is no loader or no driver).
  [[nodiscard]] static Instance create(const InstanceDescriptor& descriptor, Error& error);
  [[nodiscard]] std::vector<Adapter> adapters() const;
  [[nodiscard]] Adapter request_adapter(const AdapterOptions& options, Error& error) const;
  [[nodiscard]] Surface create_surface(const SurfaceDescriptor& descriptor, Error& error) const;
  // Messages of the validation layer so far (errors and warnings); tests require it to be empty.
  [[nodiscard]] std::vector<std::string> validation_messages() const;
};

#undef MOTE_GPU_OBJECT

} // namespace mote::gpu
