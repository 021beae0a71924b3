// SPDX-License-Identifier: MIT
// RenderPipeline and ComputePipeline. Viewport, scissor and blend constant are dynamic; everything
// else is fixed here, checked against the shaders' reflections first.
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

LayoutFacts layout_facts(const PipelineLayout::Impl& layout) {
  LayoutFacts facts{layout.label, {}, layout.push_constant_size};
  for (const auto& group : layout.groups) facts.groups.emplace_back(group->entries);
  return facts;
}

// One shader stage in Vulkan's words, with the memory they point to.
struct StageInfo {
  StageFacts facts{};
  std::shared_ptr<ShaderModule::Impl> module{};
  std::string entry_point{};
  std::vector<VkSpecializationMapEntry> map{};
  std::vector<std::uint32_t> data{};
  VkSpecializationInfo specialization{};

  StageInfo(vk::DeviceCore& core, const LayoutFacts& layout, ShaderStage stage, std::string_view field,
            const ProgrammableStage& programmable) {
    in_context([&] { return fmt::format("validating the {} stage", field); },
               [&] {
                 module = vk::require(programmable.module, "ShaderModule", core);
                 facts = check_stage(core.facts, layout, stage, field, module->label, module->reflection, programmable);
               });
    entry_point = programmable.entry_point;
    for (const SpecializationConstant& c : programmable.constants) {
      map.push_back({c.id, static_cast<std::uint32_t>(data.size() * 4), 4});
      data.push_back(c.bits);
    }
  }

  VkPipelineShaderStageCreateInfo info(ShaderStage stage) {
    specialization = {static_cast<std::uint32_t>(map.size()), map.data(), data.size() * 4, data.data()};
    auto result = vk::init<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    result.stage = static_cast<VkShaderStageFlagBits>(vk::shader_stages(stage));
    result.module = module->handle;
    result.pName = entry_point.c_str();
    result.pSpecializationInfo = map.empty() ? nullptr : &specialization;
    return result;
  }
};

// The fixed-function half of a graphics pipeline, with the memory its create info points to.
struct FixedState {
  std::vector<VkVertexInputBindingDescription> bindings{};
  std::vector<VkVertexInputAttributeDescription> attributes{};
  VkPipelineVertexInputStateCreateInfo vertex = vk::init<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  VkPipelineInputAssemblyStateCreateInfo assembly = vk::init<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  VkPipelineViewportStateCreateInfo viewport = vk::init<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  VkPipelineRasterizationStateCreateInfo raster = vk::init<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  VkPipelineMultisampleStateCreateInfo multisample = vk::init<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  VkPipelineDepthStencilStateCreateInfo depth = vk::init<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  std::vector<VkPipelineColorBlendAttachmentState> targets{};
  VkPipelineColorBlendStateCreateInfo blend = vk::init<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  std::vector<VkFormat> formats{};
  VkPipelineRenderingCreateInfo rendering = vk::init<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  std::array<VkDynamicState, 3> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_BLEND_CONSTANTS};
  VkPipelineDynamicStateCreateInfo dynamic = vk::init<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);

  explicit FixedState(const RenderPipelineDescriptor& d) {
    set_vertex(d);
    set_raster(d);
    set_depth(d);
    set_targets(d);
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();
  }

  void set_vertex(const RenderPipelineDescriptor& d) {
    for (std::uint32_t slot = 0; slot < d.vertex_buffers.size(); ++slot) {
      const VertexBufferLayout& layout = d.vertex_buffers[slot];
      bindings.push_back({slot, static_cast<std::uint32_t>(layout.stride),
                          layout.step == VertexStepMode::Instance ? VK_VERTEX_INPUT_RATE_INSTANCE : VK_VERTEX_INPUT_RATE_VERTEX});
      for (const VertexAttribute& a : layout.attributes) {
        attributes.push_back({a.location, slot, vk::vertex_format(a.format), static_cast<std::uint32_t>(a.offset)});
      }
    }
    vertex.vertexBindingDescriptionCount = static_cast<std::uint32_t>(bindings.size());
    vertex.pVertexBindingDescriptions = bindings.data();
    vertex.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    vertex.pVertexAttributeDescriptions = attributes.data();
    assembly.topology = vk::topology(d.topology);
  }

  void set_raster(const RenderPipelineDescriptor& d) {
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    raster.depthClampEnable = d.depth_clamp;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = vk::cull_mode(d.cull);
    raster.frontFace = d.front_face == FrontFace::Clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1.0f;
    multisample.rasterizationSamples = static_cast<VkSampleCountFlagBits>(d.sample_count);
  }

  void set_depth(const RenderPipelineDescriptor& d) {
    if (!d.depth) return;
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = d.depth->write;
    depth.depthCompareOp = vk::compare(d.depth->compare);
    rendering.depthAttachmentFormat = vk::format(d.depth->format);
  }

  void set_targets(const RenderPipelineDescriptor& d) {
    for (const ColorTargetState& target : d.targets) {
      VkPipelineColorBlendAttachmentState& state = targets.emplace_back();
      state.colorWriteMask = static_cast<VkColorComponentFlags>(target.write_mask);
      state.blendEnable = target.blend.has_value();
      const BlendState mix = target.blend.value_or(BlendState{});
      state.srcColorBlendFactor = vk::blend_factor(mix.color.src);
      state.dstColorBlendFactor = vk::blend_factor(mix.color.dst);
      state.colorBlendOp = vk::blend_operation(mix.color.operation);
      state.srcAlphaBlendFactor = vk::blend_factor(mix.alpha.src);
      state.dstAlphaBlendFactor = vk::blend_factor(mix.alpha.dst);
      state.alphaBlendOp = vk::blend_operation(mix.alpha.operation);
      formats.push_back(vk::format(target.format));
    }
    blend.attachmentCount = static_cast<std::uint32_t>(targets.size());
    blend.pAttachments = targets.data();
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
    rendering.pColorAttachmentFormats = formats.data();
  }

  void attach(VkGraphicsPipelineCreateInfo& info) {
    info.pNext = &rendering;
    info.pVertexInputState = &vertex;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
  }
};

PipelineFacts pipeline_facts(const RenderPipelineDescriptor& d) {
  PipelineFacts facts;
  facts.label = d.label;
  for (const ColorTargetState& target : d.targets) facts.targets.push_back(target.format);
  facts.depth = d.depth ? d.depth->format : TextureFormat::Undefined;
  facts.depth_write = d.depth && d.depth->write;
  facts.samples = d.sample_count;
  facts.vertex_slots = static_cast<std::uint32_t>(d.vertex_buffers.size());
  for (const VertexBufferLayout& layout : d.vertex_buffers) {
    facts.vertex_strides.push_back(layout.stride);
    facts.vertex_steps.push_back(layout.step);
  }
  return facts;
}

void init_render_pipeline(RenderPipeline::Impl& pipeline, const RenderPipelineDescriptor& d) {
  vk::DeviceCore& core = *pipeline.core;
  pipeline.layout = vk::require(d.layout, "PipelineLayout", core);
  const LayoutFacts layout = layout_facts(*pipeline.layout);
  if (d.geometry) check_feature(core.facts, Feature::GeometryShader, "RenderPipelineDescriptor.geometry is set");
  StageInfo vertex(core, layout, ShaderStage::Vertex, "vertex", d.vertex);
  std::optional<StageInfo> geometry, fragment;
  if (d.geometry) geometry.emplace(core, layout, ShaderStage::Geometry, "geometry", *d.geometry);
  if (d.fragment) fragment.emplace(core, layout, ShaderStage::Fragment, "fragment", *d.fragment);
  const auto facts_of = [](const std::optional<StageInfo>& s) { return s ? std::optional(s->facts) : std::nullopt; };
  check_render_pipeline(core.facts, d, vertex.facts, facts_of(geometry), facts_of(fragment));
  pipeline.facts = pipeline_facts(d);
  for (const StageInfo* s : {&vertex, geometry ? &*geometry : nullptr, fragment ? &*fragment : nullptr}) {
    if (s != nullptr) pipeline.facts.push_constants_used = std::max(pipeline.facts.push_constants_used, s->facts.entry->push_constant_size);
  }
  if (fragment)
    for (const ReflectedVariable& input : fragment->facts.entry->inputs) (input.flat ? pipeline.facts.flat : pipeline.facts.interpolated) += input.components;
  std::vector<VkPipelineShaderStageCreateInfo> stages{vertex.info(ShaderStage::Vertex)};
  if (geometry) stages.push_back(geometry->info(ShaderStage::Geometry));
  if (fragment) stages.push_back(fragment->info(ShaderStage::Fragment));
  FixedState fixed(d);
  VkGraphicsPipelineCreateInfo info = vk::init<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.layout = pipeline.layout->handle;
  fixed.attach(info);
  vk::check(vkCreateGraphicsPipelines(core.device, core.pipeline_cache, 1, &info, nullptr, &pipeline.handle), "vkCreateGraphicsPipelines");
  core.name(VK_OBJECT_TYPE_PIPELINE, pipeline.handle, pipeline.label);
}

} // namespace

RenderPipeline Device::create_render_pipeline(const RenderPipelineDescriptor& d) {
  return vk::make<RenderPipeline>(impl_->core, "create_render_pipeline", "RenderPipeline", d.label,
                                  [&](RenderPipeline::Impl& pipeline) { init_render_pipeline(pipeline, d); });
}

ComputePipeline Device::create_compute_pipeline(const ComputePipelineDescriptor& d) {
  return vk::make<ComputePipeline>(impl_->core, "create_compute_pipeline", "ComputePipeline", d.label, [&](ComputePipeline::Impl& pipeline) {
    vk::DeviceCore& core = *impl_->core;
    pipeline.layout = vk::require(d.layout, "PipelineLayout", core);
    StageInfo stage(core, layout_facts(*pipeline.layout), ShaderStage::Compute, "compute", d.compute);
    check_compute(core.facts, stage.facts);
    pipeline.push_constants_used = stage.facts.entry->push_constant_size;
    auto info = vk::init<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage = stage.info(ShaderStage::Compute);
    info.layout = pipeline.layout->handle;
    vk::check(vkCreateComputePipelines(core.device, core.pipeline_cache, 1, &info, nullptr, &pipeline.handle), "vkCreateComputePipelines");
    core.name(VK_OBJECT_TYPE_PIPELINE, pipeline.handle, pipeline.label);
  });
}

} // namespace mote::gpu
