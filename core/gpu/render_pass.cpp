// SPDX-License-Identifier: MIT
#include "core/gpu/vk/convert.hpp"
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {
namespace {

ViewFacts facts_of(const TextureView::Impl& view) { return {view.label, &view.texture->facts, view.dimension, view.range}; }
BufferFacts facts_of(const Buffer::Impl& buffer) { return {buffer.label, buffer.size, buffer.usage}; }

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout, LoadOp load, StoreOp store) {
  auto info = vk::init<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  info.imageView = view;
  info.imageLayout = layout;
  info.loadOp = vk::load_op(load);
  info.storeOp = vk::store_op(store);
  return info;
}

// Shared views of a descriptor, in its order, and their facts.
struct PassViews {
  std::vector<std::shared_ptr<TextureView::Impl>> colors{}, resolves{};
  std::shared_ptr<TextureView::Impl> depth{};
  RenderPassFacts facts{};

  PassViews(const vk::DeviceCore& core, const RenderPassDescriptor& d) {
    static constexpr std::string_view names[8] = {"colors[0]", "colors[1]", "colors[2]", "colors[3]",
                                                  "colors[4]", "colors[5]", "colors[6]", "colors[7]"};
    if (d.colors.size() > std::size(names) || d.colors.size() > core.facts.limits.max_color_attachments) {
      invalid("V-PASS-002", "The pass has {} color attachments; {} allows {}.", d.colors.size(), named("Device", core.label),
              std::min<std::size_t>(std::size(names), core.facts.limits.max_color_attachments));
    }
    for (std::size_t i = 0; i < d.colors.size(); ++i) {
      colors.push_back(vk::require(d.colors[i].view, "TextureView", core));
      facts.colors.push_back({names[i], facts_of(*colors[i])});
      resolves.push_back(d.colors[i].resolve_target ? vk::require(*d.colors[i].resolve_target, "TextureView", core) : nullptr);
      facts.resolves.push_back(resolves[i] ? std::optional(AttachmentFacts{names[i], facts_of(*resolves[i])}) : std::nullopt);
    }
    if (!d.depth) return;
    depth = vk::require(d.depth->view, "TextureView", core);
    facts.depth = AttachmentFacts{"depth", facts_of(*depth)};
    facts.depth_read_only = d.depth->read_only;
    facts.depth_load = d.depth->load;
    facts.depth_store = d.depth->store;
  }
};

} // namespace

RenderPass CommandEncoder::begin_render_pass(const RenderPassDescriptor& d) {
  auto pass = std::make_shared<RenderPass::Impl>(impl_->core, d.label);
  pass->valid = false;
  pass->encoder = impl_;
  impl_->call("begin_render_pass", [&] {
    pass->begin(d);
    pass->valid = true;
    impl_->in_pass = true;
  });
  return RenderPass(std::move(pass));
}

void RenderPass::Impl::begin(const RenderPassDescriptor& d) {
  const PassViews views(*core, d);
  facts = check_render_pass(views.facts);
  take_timestamps(d.timestamps);
  Recording& list = recording();
  index = static_cast<std::uint32_t>(list.passes.size());
  RecordedPass& pass = list.passes.emplace_back();
  pass.area = {{0, 0}, {facts.size.width, facts.size.height}};
  list.scopes.begin(core->next_serial());
  for (std::size_t i = 0; i < d.colors.size(); ++i) {
    const ColorAttachment& c = d.colors[i];
    TextureView::Impl& view = *views.colors[i];
    VkRenderingAttachmentInfo info = attachment(view.handle, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, c.load, c.store);
    info.clearValue.color = vk::clear_color(c.clear, view.texture->facts.format);
    use_texture(list.scopes, *view.texture, view.range, Use::ColorAttachment, c.load != LoadOp::Load);
    list.keep(views.colors[i]);
    if (const auto& resolve = views.resolves[i]) {
      info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
      info.resolveImageView = resolve->handle;
      info.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
      use_texture(list.scopes, *resolve->texture, resolve->range, Use::ColorAttachment, true);
      list.keep(resolve);
    }
    pass.colors.push_back(info);
  }
  if (d.depth) {
    const bool read_only = d.depth->read_only;
    const Use use = read_only ? Use::DepthRead : Use::DepthWrite;
    pass.has_depth = true;
    pass.depth = attachment(views.depth->handle, layout_of(use, true), d.depth->load, d.depth->store);
    if (read_only) pass.depth.storeOp = VK_ATTACHMENT_STORE_OP_NONE; // storing would be a write
    pass.depth.clearValue.depthStencil.depth = d.depth->clear;
    use_texture(list.scopes, *views.depth->texture, views.depth->range, use, d.depth->load != LoadOp::Load);
    list.keep(views.depth);
  }
  list.commands.push_back(cmd::BeginRender{index});
  // Within the pass, where the query belongs to its draws alone.
  const auto& set = encoder->statistics_set;
  counted = set && encoder->next_statistics < set->count;
  if (!counted) return;
  const cmd::BeginStatistics query{set.get(), encoder->next_statistics};
  list.passes[index].statistics.push_back(query);
  list.commands.push_back(query);
}

void RenderPass::Impl::end() {
  if (ended) return;
  call("RenderPass", "end()", [&] {
    if (statistics) invalid("V-QRY-004", "{} ends with an open pipeline statistics query.", named("RenderPass", label));
    Recording& list = recording();
    if (counted) list.commands.push_back(cmd::EndStatistics{encoder->statistics_set.get(), encoder->next_statistics++});
    list.passes[index].scope = list.scopes.end();
    list.commands.push_back(cmd::EndRender{index});
    record_timestamp(timestamps ? timestamps->end : std::nullopt);
    close();
  });
  ended = true;
  if (encoder && valid) encoder->in_pass = false;
}

void RenderPass::Impl::prepare_draw() {
  if (ready) return;
  if (!pipeline) invalid("V-DRAW-001", "A draw of {} has no pipeline set.", named("RenderPass", label));
  for (std::uint32_t slot = 0; slot < pipeline->facts.vertex_slots; ++slot) {
    if (!vertex_bytes[slot]) {
      invalid("V-DRAW-005", "{} reads vertex buffer {}, but none is set.", named("RenderPipeline", pipeline->label), slot);
    }
  }
  binds.apply(recording(), *pipeline->layout, pipeline->facts.push_constants_used, named("RenderPipeline", pipeline->label),
              VK_PIPELINE_BIND_POINT_GRAPHICS);
  ready = true;
}

void RenderPass::Impl::check_vertices(std::uint64_t first, std::uint64_t count, VertexStepMode step) const {
  for (std::uint32_t slot = 0; slot < pipeline->facts.vertex_slots; ++slot) {
    check_vertex_range(pipeline->facts, slot, *vertex_bytes[slot], first, count, step);
  }
}

void RenderPass::set_pipeline(const RenderPipeline& pipeline) {
  impl_->call("RenderPass", "set_pipeline", [&] {
    const auto& found = vk::require(pipeline, "RenderPipeline", *impl_->core);
    check_pipeline_in_pass(impl_->facts, found->facts);
    impl_->pipeline = found;
    impl_->recording().commands.push_back(cmd::SetPipeline{found->handle, VK_PIPELINE_BIND_POINT_GRAPHICS, found->facts.interpolated, found->facts.flat});
    impl_->recording().keep(found);
    impl_->ready = false;
  });
}

void RenderPass::set_bind_group(std::uint32_t index, const BindGroup& group) {
  impl_->call("RenderPass", "set_bind_group", [&] {
    const auto& found = vk::require(group, "BindGroup", *impl_->core);
    impl_->binds.set_group(impl_->core->facts, index, found);
    use_group(impl_->recording().scopes, *found);
    impl_->recording().keep(found);
    impl_->ready = false;
  });
}

void RenderPass::set_push_constants(std::uint32_t offset, std::span<const std::byte> data) {
  impl_->call("RenderPass", "set_push_constants", [&] {
    impl_->binds.set_push(impl_->core->facts, offset, data);
    impl_->ready = false;
  });
}

void RenderPass::set_vertex_buffer(std::uint32_t slot, const Buffer& buffer, std::uint64_t offset, std::uint64_t size) {
  impl_->call("RenderPass", "set_vertex_buffer", [&] {
    const auto& found = vk::require(buffer, "Buffer", *impl_->core);
    if (slot >= impl_->vertex_bytes.size()) invalid("V-DRAW-006", "Vertex buffer slot {} is set; there are {}.", slot, impl_->vertex_bytes.size());
    check_usage("the vertex buffer", facts_of(*found), BufferUsage::Vertex);
    impl_->vertex_bytes[slot] = check_range("the vertex buffer", facts_of(*found), offset, size, 4);
    use_buffer(impl_->recording().scopes, *found, Use::Vertex);
    impl_->recording().commands.push_back(cmd::SetVertexBuffer{found->handle, offset, slot});
    impl_->recording().keep(found);
    impl_->ready = false;
  });
}

void RenderPass::set_index_buffer(const Buffer& buffer, IndexFormat format, std::uint64_t offset, std::uint64_t size) {
  impl_->call("RenderPass", "set_index_buffer", [&] {
    const auto& found = vk::require(buffer, "Buffer", *impl_->core);
    if (format == IndexFormat::Undefined) invalid("V-DRAW-007", "The index format of {} is Undefined.", named("Buffer", found->label));
    check_usage("the index buffer", facts_of(*found), BufferUsage::Index);
    impl_->index_size = format == IndexFormat::Uint16 ? 2 : 4;
    impl_->index_bytes = check_range("the index buffer", facts_of(*found), offset, size, impl_->index_size);
    use_buffer(impl_->recording().scopes, *found, Use::Index);
    const VkIndexType type = format == IndexFormat::Uint16 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32;
    impl_->recording().commands.push_back(cmd::SetIndexBuffer{found->handle, offset, type});
    impl_->recording().keep(found);
  });
}

void RenderPass::set_viewport(float x, float y, float width, float height, float min_depth, float max_depth) {
  impl_->call("RenderPass", "set_viewport", [&] {
    if (!(width > 0) || !(height > 0) || !(min_depth >= 0 && min_depth <= 1 && max_depth >= 0 && max_depth <= 1)) {
      invalid("V-DRAW-008", "The viewport is {}x{} with depth range [{}, {}]; sides must be positive and depths in [0, 1].", width,
              height, min_depth, max_depth);
    }
    impl_->recording().commands.push_back(cmd::SetViewport{{x, y, width, height, min_depth, max_depth}});
  });
}

void RenderPass::set_scissor(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
  impl_->call("RenderPass", "set_scissor", [&] {
    const Extent3d size = impl_->facts.size;
    if (std::uint64_t{x} + width > size.width || std::uint64_t{y} + height > size.height) {
      invalid("V-DRAW-009", "The scissor rectangle ({}, {}) of {}x{} is not inside the attachments, which are {}x{}.", x, y, width,
              height, size.width, size.height);
    }
    impl_->recording().commands.push_back(
        cmd::SetScissor{{{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}, {width, height}}});
  });
}

void RenderPass::set_blend_constant(Color c) {
  impl_->call("RenderPass", "set_blend_constant", [&] {
    impl_->recording().commands.push_back(
        cmd::SetBlendConstant{{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b), static_cast<float>(c.a)}});
  });
}

void RenderPass::draw(std::uint32_t vertex_count, std::uint32_t instance_count, std::uint32_t first_vertex, std::uint32_t first_instance) {
  impl_->call("RenderPass", "draw", [&] {
    impl_->prepare_draw();
    impl_->check_vertices(first_vertex, vertex_count, VertexStepMode::Vertex);
    impl_->check_vertices(first_instance, instance_count, VertexStepMode::Instance);
    impl_->recording().commands.push_back(cmd::Draw{vertex_count, instance_count, first_vertex, first_instance});
  });
}

void RenderPass::draw_indexed(std::uint32_t index_count, std::uint32_t instance_count, std::uint32_t first_index, std::int32_t base_vertex,
                              std::uint32_t first_instance) {
  impl_->call("RenderPass", "draw_indexed", [&] {
    impl_->prepare_draw();
    if (impl_->index_size == 0) invalid("V-DRAW-010", "An indexed draw of {} has no index buffer set.", named("RenderPass", impl_->label));
    if ((std::uint64_t{first_index} + index_count) * impl_->index_size > impl_->index_bytes) {
      invalid("V-DRAW-011", "Indices [{}, {}) are drawn; the index buffer holds {}.", first_index, std::uint64_t{first_index} + index_count,
              impl_->index_bytes / impl_->index_size);
    }
    impl_->check_vertices(first_instance, instance_count, VertexStepMode::Instance);
    impl_->recording().commands.push_back(cmd::DrawIndexed{index_count, instance_count, first_index, base_vertex, first_instance});
  });
}

namespace {
void record_indirect(RenderPass::Impl& pass, const Buffer& buffer, std::uint64_t offset, bool indexed) {
  const auto& arguments = vk::require(buffer, "Buffer", *pass.core);
  pass.prepare_draw();
  if (indexed && pass.index_size == 0) invalid("V-DRAW-010", "An indexed draw of {} has no index buffer set.", named("RenderPass", pass.label));
  check_usage("the indirect arguments", facts_of(*arguments), BufferUsage::Indirect);
  check_range("the indirect arguments", facts_of(*arguments), offset, indexed ? 20 : 16, 4);
  use_buffer(pass.recording().scopes, *arguments, Use::Indirect);
  pass.recording().commands.push_back(cmd::DrawIndirect{arguments->handle, offset, indexed});
  pass.recording().keep(arguments);
}
} // namespace

void RenderPass::draw_indirect(const Buffer& buffer, std::uint64_t offset) {
  impl_->call("RenderPass", "draw_indirect", [&] { record_indirect(*impl_, buffer, offset, false); });
}
void RenderPass::draw_indexed_indirect(const Buffer& buffer, std::uint64_t offset) {
  impl_->call("RenderPass", "draw_indexed_indirect", [&] { record_indirect(*impl_, buffer, offset, true); });
}

void RenderPass::begin_pipeline_statistics(const QuerySet& set, std::uint32_t index) {
  impl_->call("RenderPass", "begin_pipeline_statistics", [&] {
    const auto& queries = vk::require(set, "QuerySet", *impl_->core);
    check_query("the query", queries->label, queries->type, queries->count, QueryType::PipelineStatistics, index);
    if (impl_->statistics) invalid("V-QRY-004", "{} has an open pipeline statistics query already.", named("RenderPass", impl_->label));
    if (impl_->counted) invalid("V-QRY-004", "{} counts pipeline statistics of all its passes already.", named("CommandEncoder", impl_->encoder->label));
    const cmd::BeginStatistics begin{queries.get(), index};
    impl_->recording().passes[impl_->index].statistics.push_back(begin);
    impl_->recording().commands.push_back(begin);
    impl_->recording().keep(queries);
    impl_->statistics_set = queries;
    impl_->statistics = index;
  });
}
void RenderPass::end_pipeline_statistics() {
  impl_->call("RenderPass", "end_pipeline_statistics", [&] {
    if (!impl_->statistics) invalid("V-QRY-004", "{} has no open pipeline statistics query.", named("RenderPass", impl_->label));
    impl_->recording().commands.push_back(cmd::EndStatistics{impl_->statistics_set.get(), *impl_->statistics});
    impl_->statistics.reset();
  });
}

void RenderPass::push_debug_group(std::string_view label) {
  impl_->call("RenderPass", "push_debug_group", [&] { impl_->push_label(label); });
}
void RenderPass::pop_debug_group() {
  impl_->call("RenderPass", "pop_debug_group", [&] { impl_->pop_label(); });
}
void RenderPass::end() { impl_->end(); }

} // namespace mote::gpu
