// SPDX-License-Identifier: MIT
// The insides of the handles that are no resources: Instance, Adapter, Device, Queue, encoders and
// passes. Private to core/gpu.
#pragma once

#include "core/gpu/barriers.hpp"
#include "core/gpu/commands.hpp"
#include "core/gpu/vk/core.hpp"
#include "core/gpu/vk/objects.hpp"

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mote::gpu {

struct Instance::Impl {
  std::string label{};
  bool valid{true};
  std::shared_ptr<vk::InstanceCore> core{};
  std::optional<std::vector<std::shared_ptr<vk::AdapterCore>>> adapters{}; // asked once
};

struct Adapter::Impl {
  std::string label{};
  bool valid{true};
  std::shared_ptr<vk::AdapterCore> core{};
};

// A piece of upload memory; write_buffer and write_texture fill it front to back.
struct StagingChunk {
  std::shared_ptr<Buffer::Impl> buffer{};
  std::uint64_t used{};
};

// What the device still works on.
struct InFlight {
  Submission value{};
  VkCommandPool pool{};
  VkCommandBuffer commands{};
  std::vector<std::unique_ptr<Recording>> recordings{};
  std::vector<StagingChunk> chunks{};
};

struct Queue::Impl {
  std::string label{"queue"};
  bool valid{true};
  std::shared_ptr<vk::DeviceCore> core{};
  VkSemaphore timeline{};
  Submission last{}, completed{};
  std::deque<InFlight> in_flight{};
  std::vector<InFlight> idle{};                 // finished, their pools and lists to be used again
  std::unique_ptr<Recording> pending{};         // write_buffer, write_texture: in front of the next submission
  std::vector<StagingChunk> pending_chunks{}, idle_chunks{};
  Replayer replayer{};

  explicit Impl(std::shared_ptr<vk::DeviceCore> owner);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();

  Submission submit(std::vector<std::unique_ptr<Recording>> recordings, VkSemaphore signal = VK_NULL_HANDLE);
  void wait(Submission submission);
  void poll(); // retires what has finished
  [[nodiscard]] bool busy(const Buffer::Impl& buffer) const; // unsubmitted or unfinished uses
  void write(const std::shared_ptr<Buffer::Impl>& buffer, std::uint64_t offset, std::span<const std::byte> data);
  void write(const std::shared_ptr<Texture::Impl>& texture, const TexelCopyTexture& dst, std::span<const std::byte> data,
             std::uint32_t row_texels, std::uint32_t image_rows, Extent3d size);
  void fill_new(const std::shared_ptr<Buffer::Impl>& buffer);
  void fill_new(const std::shared_ptr<Texture::Impl>& texture);
  Recording& open_pending();

private:
  struct Staged {
    Buffer::Impl* buffer{};
    std::uint64_t offset{};
  };
  Staged stage(std::span<const std::byte> data);
  InFlight take_slot();
  void record(InFlight& slot);
  void retire(InFlight& slot);
  void mark_used(const Recording& recording, Submission value);
};

struct Device::Impl {
  std::string label{};
  bool valid{true};
  std::shared_ptr<vk::DeviceCore> core{};
  std::shared_ptr<Queue::Impl> queue{};
};

struct Surface::Impl {
  std::string label{};
  bool valid{true};
  std::shared_ptr<vk::InstanceCore> instance{};
  VkSurfaceKHR surface{};
  std::shared_ptr<vk::DeviceCore> core{};   // since configure
  std::shared_ptr<Queue::Impl> queue{};
  SurfaceConfiguration configuration{};
  TextureFormat format{};
  VkSwapchainKHR swapchain{};
  VkExtent2D extent{};
  VkFence acquired{};
  std::vector<Texture> pictures{};
  std::vector<VkSemaphore> drawn{};         // one per picture
  std::optional<std::uint32_t> current{};   // acquired, not presented

  ~Impl();
  void configure();
  void drop_swapchain();
};

struct CommandEncoder::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::unique_ptr<Recording> recording{}; // null once finished
  bool in_pass{};
  bool failed{};                          // a call failed: finish() gives an invalid CommandBuffer
  std::uint32_t debug_groups{};
  std::shared_ptr<QuerySet::Impl> statistics_set{}; // that render passes count into, or null
  std::uint32_t first_statistics{}, next_statistics{};
  void require_open() const; // V-ENC-001, V-ENC-002

  // Runs one recording call. A fault is reported and fails the encoder; after that calls do nothing.
  template <class Body> void call(std::string_view name, Body&& body) {
    if (failed || !valid) return;
    bool done = false;
    vk::guarded(
        *core, [&] { return fmt::format("calling {}.{}", named("CommandEncoder", label), name); },
        [&] {
          require_open();
          body();
          done = true;
        });
    failed = !done;
  }
};

struct CommandBuffer::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::unique_ptr<Recording> recording{}; // null once submitted
};

// Bind groups and push constants as both kinds of pass keep them.
struct BindState {
  static constexpr std::size_t max_groups = 8, max_push_bytes = 256;
  std::array<std::shared_ptr<BindGroup::Impl>, max_groups> groups{};
  std::array<bool, max_groups> dirty{};
  std::array<std::byte, max_push_bytes> push{};
  std::uint64_t push_words{}; // bit i: bytes [4i, 4i + 4) were set
  bool push_dirty{};
  VkPipelineLayout layout{};  // that the last commands were recorded with

  void set_group(const DeviceFacts& device, std::uint32_t index, std::shared_ptr<BindGroup::Impl> group);
  void set_push(const DeviceFacts& device, std::uint32_t offset, std::span<const std::byte> data);
  // Checks groups and push constants against a pipeline's layout and records what has changed.
  void apply(Recording& recording, const PipelineLayout::Impl& pipeline_layout, std::uint32_t push_needed,
             std::string_view pipeline_name, VkPipelineBindPoint point);
};

// What render and compute passes have in common: the encoder that is locked while they are open.
struct PassBase : vk::Object {
  using Object::Object;
  std::shared_ptr<CommandEncoder::Impl> encoder{};
  bool ended{};
  std::optional<TimestampWrites> timestamps{};
  std::shared_ptr<QuerySet::Impl> timestamp_set{};
  BindState binds{};
  bool ready{}; // nothing was set since the last draw or dispatch
  std::uint32_t debug_groups{};

  [[nodiscard]] Recording& recording() const { return *encoder->recording; }
  void take_timestamps(const std::optional<TimestampWrites>& writes); // V-QRY-..., and records the first
  void record_timestamp(const std::optional<std::uint32_t>& index);
  void push_label(std::string_view text);
  void pop_label();
  void close(); // V-ENC-003 for open debug groups; unlocks the encoder

  template <class Body> void call(std::string_view type, std::string_view name, Body&& body) {
    if (!valid || encoder->failed) return;
    bool done = false;
    vk::guarded(
        *core, [&] { return fmt::format("calling {}.{}", named(type, label), name); },
        [&] {
          if (ended) invalid("V-PASS-001", "{} has ended already.", named(type, label));
          body();
          done = true;
        });
    if (!done) encoder->failed = true;
  }
};

struct RenderPass::Impl : PassBase {
  using PassBase::PassBase;
  ~Impl() override { end(); }
  std::uint32_t index{}; // in Recording::passes
  PassFacts facts{};
  std::shared_ptr<RenderPipeline::Impl> pipeline{};
  std::array<std::optional<std::uint64_t>, 8> vertex_bytes{}; // bound bytes of each slot
  std::uint64_t index_bytes{};
  std::uint32_t index_size{}; // bytes of one index; 0: none set
  std::shared_ptr<QuerySet::Impl> statistics_set{};
  std::optional<std::uint32_t> statistics{};
  bool counted{}; // by a query of the encoder's set

  void begin(const RenderPassDescriptor& descriptor);
  void prepare_draw();
  void check_vertices(std::uint64_t first, std::uint64_t count, VertexStepMode step) const;
  void end();
};

struct ComputePass::Impl : PassBase {
  using PassBase::PassBase;
  ~Impl() override { end(); }
  std::shared_ptr<ComputePipeline::Impl> pipeline{};

  std::uint32_t prepare_dispatch(Buffer::Impl* indirect); // gives the scope
  void end();
};

// Adds every use of a group to the open scope; V-USE-001 on conflict.
void use_group(ScopeList& scopes, BindGroup::Impl& group);
void use_buffer(ScopeList& scopes, Buffer::Impl& buffer, Use use);
void use_texture(ScopeList& scopes, Texture::Impl& texture, const SubresourceRange& range, Use use, bool discard);
[[noreturn]] void conflict_fault(const Conflict& conflict);

} // namespace mote::gpu
