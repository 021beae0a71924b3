// SPDX-License-Identifier: MIT
// BindGroupLayout, BindGroup, PipelineLayout. A layout owns the descriptor pools of its groups; the
// set of a group that ends goes back to the layout and is written anew for the next one, so making a
// group costs one vkUpdateDescriptorSets.
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

constexpr std::uint32_t sets_per_pool = 32;

void init_layout(BindGroupLayout::Impl& layout, const BindGroupLayoutDescriptor& d) {
  layout.entries.assign(d.entries.begin(), d.entries.end());
  std::sort(layout.entries.begin(), layout.entries.end(), [](const auto& a, const auto& b) { return a.binding < b.binding; });
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const BindGroupLayoutEntry& e : layout.entries) {
    bindings.push_back({e.binding, vk::descriptor_type(e.type), 1, vk::shader_stages(e.visibility), nullptr});
  }
  auto info = vk::init<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  vk::check(vkCreateDescriptorSetLayout(layout.core->device, &info, nullptr, &layout.handle), "vkCreateDescriptorSetLayout");
  layout.core->name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout.handle, layout.label);
}

void grow(BindGroupLayout::Impl& layout) {
  std::vector<VkDescriptorPoolSize> sizes;
  for (const BindGroupLayoutEntry& e : layout.entries) sizes.push_back({vk::descriptor_type(e.type), sets_per_pool});
  if (sizes.empty()) sizes.push_back({VK_DESCRIPTOR_TYPE_SAMPLER, 1});
  auto info = vk::init<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  info.maxSets = sets_per_pool;
  info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool pool{};
  vk::check(vkCreateDescriptorPool(layout.core->device, &info, nullptr, &pool), "vkCreateDescriptorPool");
  layout.pools.push_back(pool);
  const std::vector<VkDescriptorSetLayout> layouts(sets_per_pool, layout.handle);
  auto allocate = vk::init<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate.descriptorPool = pool;
  allocate.descriptorSetCount = sets_per_pool;
  allocate.pSetLayouts = layouts.data();
  layout.free_sets.resize(sets_per_pool);
  const VkResult result = vkAllocateDescriptorSets(layout.core->device, &allocate, layout.free_sets.data());
  if (result != VK_SUCCESS) layout.free_sets.clear();
  vk::check(result, "vkAllocateDescriptorSets");
}

// Collects the descriptor writes of one group and its uses.
class GroupWriter {
public:
  explicit GroupWriter(BindGroup::Impl& group, std::size_t count) : group_(group) {
    buffers_.reserve(count); // the writes point into these
    images_.reserve(count);
    writes_.reserve(count);
  }

  void add(const BindGroupLayoutEntry& layout, const BindGroupEntry& entry) {
    const vk::DeviceCore& core = *group_.core;
    VkWriteDescriptorSet& write = writes_.emplace_back();
    write = vk::init<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstBinding = layout.binding;
    write.descriptorCount = 1;
    write.descriptorType = vk::descriptor_type(layout.type);
    if (entry.buffer.buffer != nullptr) {
      add_buffer(layout, entry.buffer, vk::require(*entry.buffer.buffer, "Buffer", core), write);
    } else if (entry.texture != nullptr) {
      add_texture(layout, vk::require(*entry.texture, "TextureView", core), write);
    } else {
      check_sampler_binding(layout);
      const auto& sampler = vk::require(*entry.sampler, "Sampler", core);
      images_.push_back({sampler->handle, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED});
      write.pImageInfo = &images_.back();
      group_.resources.push_back(sampler);
    }
  }

  void update(VkDescriptorSet set) {
    for (VkWriteDescriptorSet& write : writes_) write.dstSet = set;
    vkUpdateDescriptorSets(group_.core->device, static_cast<std::uint32_t>(writes_.size()), writes_.data(), 0, nullptr);
  }

private:
  void add_buffer(const BindGroupLayoutEntry& layout, const BufferBinding& binding, const std::shared_ptr<Buffer::Impl>& buffer,
                  VkWriteDescriptorSet& write) {
    const std::uint64_t size = check_buffer_binding(group_.core->facts, layout, {buffer->label, buffer->size, buffer->usage},
                                                    binding.offset, binding.size);
    buffers_.push_back({buffer->handle, binding.offset, size});
    write.pBufferInfo = &buffers_.back();
    const Use use = layout.type == BindingType::UniformBuffer   ? Use::Uniform
                    : layout.type == BindingType::StorageBuffer ? Use::StorageWrite
                                                                : Use::StorageRead;
    group_.buffers.push_back({&buffer->state, use});
    group_.resources.push_back(buffer);
  }

  void add_texture(const BindGroupLayoutEntry& layout, const std::shared_ptr<TextureView::Impl>& view, VkWriteDescriptorSet& write) {
    check_texture_binding(group_.core->facts, layout, {view->label, &view->texture->facts, view->dimension, view->range});
    const Use use = layout.type == BindingType::SampledTexture   ? Use::Sampled
                    : layout.type == BindingType::StorageTexture ? Use::StorageWrite
                                                                 : Use::StorageRead;
    images_.push_back({VK_NULL_HANDLE, view->handle, layout_of(use, view->texture->state.depth)});
    write.pImageInfo = &images_.back();
    group_.textures.push_back({&view->texture->state, view->range, use});
    group_.resources.push_back(view);
  }

  BindGroup::Impl& group_;
  std::vector<VkDescriptorBufferInfo> buffers_;
  std::vector<VkDescriptorImageInfo> images_;
  std::vector<VkWriteDescriptorSet> writes_;
};

// Two bindings of one group that cannot be used in one scope are an error of the group already.
void check_uses(const BindGroup::Impl& group) {
  for (std::size_t i = 0; i < group.buffers.size(); ++i) {
    for (std::size_t k = i + 1; k < group.buffers.size(); ++k) {
      const BufferUse &a = group.buffers[i], &b = group.buffers[k];
      if (a.buffer == b.buffer && !compatible(a.use | b.use)) conflict_fault({"Buffer", a.buffer->label, a.use, b.use});
    }
  }
  for (std::size_t i = 0; i < group.textures.size(); ++i) {
    for (std::size_t k = i + 1; k < group.textures.size(); ++k) {
      const TextureUse &a = group.textures[i], &b = group.textures[k];
      if (a.texture == b.texture && overlap(a.range, b.range) && !compatible_layouts(a.use | b.use)) {
        conflict_fault({"Texture", a.texture->label, a.use, b.use});
      }
    }
  }
}

} // namespace

BindGroupLayout Device::create_bind_group_layout(const BindGroupLayoutDescriptor& d) {
  return vk::make<BindGroupLayout>(impl_->core, "create_bind_group_layout", "BindGroupLayout", d.label,
                                   [&](BindGroupLayout::Impl& layout) {
                                     check_bind_group_layout(impl_->core->facts, d);
                                     init_layout(layout, d);
                                   });
}

BindGroup Device::create_bind_group(const BindGroupDescriptor& d) {
  return vk::make<BindGroup>(impl_->core, "create_bind_group", "BindGroup", d.label, [&](BindGroup::Impl& group) {
    group.layout = vk::require(d.layout, "BindGroupLayout", *impl_->core);
    check_bind_group_entries(group.layout->label, group.layout->entries, d.entries);
    GroupWriter writer(group, d.entries.size());
    for (std::size_t i = 0; i < d.entries.size(); ++i) {
      in_context([&] { return fmt::format("validating entries[{}], binding {}", i, d.entries[i].binding); },
                 [&] { writer.add(*find_entry(group.layout->entries, d.entries[i].binding), d.entries[i]); });
    }
    check_uses(group);
    if (group.layout->free_sets.empty()) grow(*group.layout);
    group.handle = group.layout->free_sets.back();
    group.layout->free_sets.pop_back();
    writer.update(group.handle);
    impl_->core->name(VK_OBJECT_TYPE_DESCRIPTOR_SET, group.handle, group.label);
  });
}

PipelineLayout Device::create_pipeline_layout(const PipelineLayoutDescriptor& d) {
  return vk::make<PipelineLayout>(impl_->core, "create_pipeline_layout", "PipelineLayout", d.label, [&](PipelineLayout::Impl& layout) {
    const DeviceFacts& facts = impl_->core->facts;
    check_pipeline_layout(facts, d.bind_group_layouts.size(), d.push_constant_size);
    std::vector<VkDescriptorSetLayout> sets;
    for (const BindGroupLayout* group : d.bind_group_layouts) {
      layout.groups.push_back(vk::require(group, "BindGroupLayout", *impl_->core));
      sets.push_back(layout.groups.back()->handle);
    }
    layout.push_constant_size = d.push_constant_size;
    VkPushConstantRange range{vk::push_constant_stages(facts.features), 0, d.push_constant_size};
    auto info = vk::init<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = static_cast<std::uint32_t>(sets.size());
    info.pSetLayouts = sets.data();
    info.pushConstantRangeCount = d.push_constant_size > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    vk::check(vkCreatePipelineLayout(impl_->core->device, &info, nullptr, &layout.handle), "vkCreatePipelineLayout");
    impl_->core->name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout.handle, layout.label);
  });
}

} // namespace mote::gpu
