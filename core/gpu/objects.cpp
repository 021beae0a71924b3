// SPDX-License-Identifier: MIT
// What every handle answers, and how every object ends.
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {
namespace {
const std::string& no_label() {
  static const std::string empty;
  return empty;
}
} // namespace

#define MOTE_GPU_HANDLE(Name)                                                  \
  Name::operator bool() const { return impl_ && impl_->valid; }                \
  const std::string& Name::label() const { return impl_ ? impl_->label : no_label(); }
MOTE_GPU_HANDLE(Buffer)
MOTE_GPU_HANDLE(Texture)
MOTE_GPU_HANDLE(TextureView)
MOTE_GPU_HANDLE(Sampler)
MOTE_GPU_HANDLE(BindGroupLayout)
MOTE_GPU_HANDLE(BindGroup)
MOTE_GPU_HANDLE(PipelineLayout)
MOTE_GPU_HANDLE(ShaderModule)
MOTE_GPU_HANDLE(RenderPipeline)
MOTE_GPU_HANDLE(ComputePipeline)
MOTE_GPU_HANDLE(QuerySet)
MOTE_GPU_HANDLE(CommandBuffer)
MOTE_GPU_HANDLE(RenderPass)
MOTE_GPU_HANDLE(ComputePass)
MOTE_GPU_HANDLE(CommandEncoder)
MOTE_GPU_HANDLE(Queue)
MOTE_GPU_HANDLE(Device)
MOTE_GPU_HANDLE(Adapter)
MOTE_GPU_HANDLE(Instance)
#undef MOTE_GPU_HANDLE

// Destroying a null handle is allowed by Vulkan, so half-made objects end here, too.
Buffer::Impl::~Impl() { vkDestroyBuffer(core->device, handle, nullptr); }
Texture::Impl::~Impl() {
  if (owned) vkDestroyImage(core->device, handle, nullptr);
}
TextureView::Impl::~Impl() { vkDestroyImageView(core->device, handle, nullptr); }
Sampler::Impl::~Impl() { vkDestroySampler(core->device, handle, nullptr); }
BindGroupLayout::Impl::~Impl() {
  for (VkDescriptorPool pool : pools) vkDestroyDescriptorPool(core->device, pool, nullptr);
  vkDestroyDescriptorSetLayout(core->device, handle, nullptr);
}
BindGroup::Impl::~Impl() {
  if (handle != VK_NULL_HANDLE) layout->free_sets.push_back(handle);
}
PipelineLayout::Impl::~Impl() { vkDestroyPipelineLayout(core->device, handle, nullptr); }
ShaderModule::Impl::~Impl() { vkDestroyShaderModule(core->device, handle, nullptr); }
RenderPipeline::Impl::~Impl() { vkDestroyPipeline(core->device, handle, nullptr); }
ComputePipeline::Impl::~Impl() { vkDestroyPipeline(core->device, handle, nullptr); }
QuerySet::Impl::~Impl() { vkDestroyQueryPool(core->device, handle, nullptr); }

CommandEncoder::Impl::~Impl() {
  if (recording) give_back(*core, std::move(recording));
}
CommandBuffer::Impl::~Impl() {
  if (recording) give_back(*core, std::move(recording));
}

void Recording::clear() {
  commands.clear();
  scopes.clear();
  passes.clear();
  buffer_texture_regions.clear();
  texture_regions.clear();
  bytes.clear();
  texts.clear();
  kept.clear();
}

std::unique_ptr<Recording> take_recording(vk::DeviceCore& core) {
  std::unique_ptr<Recording> recording;
  if (core.recordings.empty()) {
    recording = std::make_unique<Recording>();
  } else {
    recording = std::move(core.recordings.back());
    core.recordings.pop_back();
  }
  recording->serial = core.next_serial();
  return recording;
}

void give_back(vk::DeviceCore& core, std::unique_ptr<Recording> recording) {
  // Emptying may end objects whose last owner this was, and they may hold the core's last reference; the
  // caller holds one.
  recording->clear();
  if (core.recordings.size() < 16) core.recordings.push_back(std::move(recording));
}

} // namespace mote::gpu
