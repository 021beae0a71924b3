// SPDX-License-Identifier: MIT
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {

ShaderModule Device::create_shader_module(const ShaderModuleDescriptor& d) {
  return vk::make<ShaderModule>(impl_->core, "create_shader_module", "ShaderModule", d.label, [&](ShaderModule::Impl& module) {
    module.reflection = reflect(d.spirv);
    check_shader_features(impl_->core->facts, module.reflection);
    auto info = vk::init<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = d.spirv.size_bytes();
    info.pCode = d.spirv.data();
    vk::check(vkCreateShaderModule(impl_->core->device, &info, nullptr, &module.handle), "vkCreateShaderModule");
    impl_->core->name(VK_OBJECT_TYPE_SHADER_MODULE, module.handle, module.label);
  });
}

} // namespace mote::gpu
