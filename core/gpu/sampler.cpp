// SPDX-License-Identifier: MIT
// Sampler and QuerySet.
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {

Sampler Device::create_sampler(const SamplerDescriptor& d) {
  return vk::make<Sampler>(impl_->core, "create_sampler", "Sampler", d.label, [&](Sampler::Impl& sampler) {
    check_sampler(d);
    auto info = vk::init<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = vk::filter(d.mag_filter);
    info.minFilter = vk::filter(d.min_filter);
    info.mipmapMode = d.mipmap_filter == FilterMode::Linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = vk::address_mode(d.address_u);
    info.addressModeV = vk::address_mode(d.address_v);
    info.addressModeW = vk::address_mode(d.address_w);
    info.minLod = d.lod_min;
    info.maxLod = d.lod_max;
    info.compareEnable = d.compare != CompareFunction::Undefined;
    info.compareOp = vk::compare(d.compare);
    info.anisotropyEnable = d.max_anisotropy > 1;
    info.maxAnisotropy = static_cast<float>(d.max_anisotropy);
    vk::check(vkCreateSampler(impl_->core->device, &info, nullptr, &sampler.handle), "vkCreateSampler");
    impl_->core->name(VK_OBJECT_TYPE_SAMPLER, sampler.handle, sampler.label);
  });
}

QuerySet Device::create_query_set(const QuerySetDescriptor& d) {
  return vk::make<QuerySet>(impl_->core, "create_query_set", "QuerySet", d.label, [&](QuerySet::Impl& set) {
    check_query_set(impl_->core->facts, d);
    set.type = d.type;
    set.count = d.count;
    set.written.assign(d.count, false);
    auto info = vk::init<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = d.type == QueryType::Timestamp ? VK_QUERY_TYPE_TIMESTAMP : VK_QUERY_TYPE_PIPELINE_STATISTICS;
    info.queryCount = d.count;
    if (d.type == QueryType::PipelineStatistics) {
      // In the order of PipelineStatistics in types.hpp.
      info.pipelineStatistics =
          VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT | VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT |
          VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT | VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_INVOCATIONS_BIT |
          VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_PRIMITIVES_BIT | VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
          VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT | VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT;
    }
    vk::check(vkCreateQueryPool(impl_->core->device, &info, nullptr, &set.handle), "vkCreateQueryPool");
    vkResetQueryPool(impl_->core->device, set.handle, 0, d.count);
    impl_->core->name(VK_OBJECT_TYPE_QUERY_POOL, set.handle, set.label);
  });
}

} // namespace mote::gpu
