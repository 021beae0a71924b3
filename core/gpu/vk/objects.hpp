// SPDX-License-Identifier: MIT
// The insides of the public handles. An Impl owns its Vulkan handles and shares the DeviceCore; a
// call that failed makes one with `valid` off, so that a later use can tell "reported already"
// from "never made". Private to core/gpu.
#pragma once

#include "core/gpu/reflection.hpp"
#include "core/gpu/usage.hpp"
#include "core/gpu/vk/core.hpp"
#include "core/gpu/vk/memory.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace mote::gpu {
namespace vk {

struct Object : std::enable_shared_from_this<Object> {
  std::shared_ptr<DeviceCore> core{};
  std::string label{};
  bool valid{true};
  std::uint64_t kept_by{}; // serial of the recording that shares ownership already

  Object() = default;
  Object(std::shared_ptr<DeviceCore> owner, std::string_view name) : core(std::move(owner)), label(name) {}
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  virtual ~Object() = default; // a recording keeps objects of every type alive in one list
};

} // namespace vk

struct Buffer::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::uint64_t size{};
  BufferUsage usage{};
  VkBuffer handle{};
  std::shared_ptr<const void> host{}; // whose memory it is, if not the device's
  vk::Allocation memory{};
  std::byte* mapped{};    // host-visible memory, whatever the usage
  BufferState state{};
  std::uint64_t pending{}; // serial of the queue's pending writes that touch it
};

struct Texture::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  TextureFacts facts{};
  VkImage handle{};
  bool owned{true}; // false: of a swapchain
  vk::Allocation memory{};
  TextureState state{};
};

struct TextureView::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::shared_ptr<Texture::Impl> texture{};
  SubresourceRange range{};
  TextureViewDimension dimension{};
  VkImageView handle{};
  [[nodiscard]] Extent3d size() const;
};

struct Sampler::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  VkSampler handle{};
};

struct BindGroupLayout::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::vector<BindGroupLayoutEntry> entries{}; // sorted by binding
  VkDescriptorSetLayout handle{};
  std::vector<VkDescriptorPool> pools{};
  std::vector<VkDescriptorSet> free_sets{}; // allocated, of no living group
};

struct BindGroup::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::shared_ptr<BindGroupLayout::Impl> layout{};
  VkDescriptorSet handle{};
  std::vector<BufferUse> buffers{};
  std::vector<TextureUse> textures{};
  std::vector<std::shared_ptr<Object>> resources{};
  std::uint64_t scope{}; // serial of the scope that counted it last
};

struct PipelineLayout::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::vector<std::shared_ptr<BindGroupLayout::Impl>> groups{};
  std::uint32_t push_constant_size{};
  VkPipelineLayout handle{};
};

struct ShaderModule::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  Reflection reflection{};
  VkShaderModule handle{};
};

struct RenderPipeline::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::shared_ptr<PipelineLayout::Impl> layout{};
  VkPipeline handle{};
  PipelineFacts facts{};
};

struct ComputePipeline::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  std::shared_ptr<PipelineLayout::Impl> layout{};
  VkPipeline handle{};
  std::uint32_t push_constants_used{}; // bytes
};

struct QuerySet::Impl : vk::Object {
  using Object::Object;
  ~Impl() override;
  VkQueryPool handle{};
  QueryType type{};
  std::uint32_t count{};
  std::vector<bool> written{}; // by submissions so far
};

namespace vk {

// The Impl behind a handle that must be usable. A default-made handle is V-OBJ-001, one of another
// device V-OBJ-002; one whose making failed is a secondary fault.
template <class Handle>
const std::shared_ptr<typename Handle::Impl>& require(const Handle& handle, std::string_view type, const DeviceCore& core) {
  if (!handle.impl()) invalid("V-OBJ-001", "{} was never made: it is an empty handle.", named(type, ""));
  if (!handle.impl()->valid) secondary_fault();
  if (handle.impl()->core.get() != &core) {
    invalid("V-OBJ-002", "{} belongs to {}, not to {}.", named(type, handle.label()),
            named("Device", handle.impl()->core->label), named("Device", core.label));
  }
  return handle.impl();
}
template <class Handle>
const std::shared_ptr<typename Handle::Impl>& require(const Handle* handle, std::string_view type, const DeviceCore& core) {
  if (handle == nullptr) invalid("V-OBJ-001", "{} is missing: the pointer is null.", named(type, ""));
  return require(*handle, type, core);
}

// Runs the body of a public call; reports what it throws.
template <class Note, class Body> void guarded(DeviceCore& core, Note&& note, Body&& body) {
  try {
    in_context(std::forward<Note>(note), std::forward<Body>(body));
  } catch (Fault& fault) {
    if (!fault.secondary()) core.errors.report(std::move(fault.error()));
  }
}

// Makes one object; on a fault it is reported and the object comes back invalid.
template <class Handle, class Body>
Handle make(const std::shared_ptr<DeviceCore>& core, std::string_view call, std::string_view type, std::string_view label,
            Body&& body) {
  auto impl = std::make_shared<typename Handle::Impl>(core, label);
  impl->valid = false;
  guarded(
      *core,
      [&] { return fmt::format("calling {}.{}({})", named("Device", core->label), call, named(fmt::format("{}Descriptor", type), label)); },
      [&] {
        body(*impl);
        impl->valid = true;
      });
  return Handle(std::move(impl));
}

void init_buffer(Buffer::Impl& buffer, const BufferDescriptor& descriptor, MemoryKind kind);
void init_texture(Texture::Impl& texture, const TextureDescriptor& descriptor);

} // namespace vk
} // namespace mote::gpu
