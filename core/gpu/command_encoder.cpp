// SPDX-License-Identifier: MIT
// CommandEncoder: copies, clears, queries, debug groups, finish. Passes are in their own files.
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {

void conflict_fault(const Conflict& c) {
  invalid("V-USE-001", "{} is used as {} and as {} in one synchronization scope; a resource that is written there can have no other use.",
          named(c.type, c.label), to_string(c.before), to_string(c.added));
}
void use_buffer(ScopeList& scopes, Buffer::Impl& buffer, Use use) {
  if (const auto conflict = scopes.add(buffer.state, use)) conflict_fault(*conflict);
}
void use_texture(ScopeList& scopes, Texture::Impl& texture, const SubresourceRange& range, Use use, bool discard) {
  if (const auto conflict = scopes.add(texture.state, range, use, discard)) conflict_fault(*conflict);
}
void use_group(ScopeList& scopes, BindGroup::Impl& group) {
  if (group.scope == scopes.serial()) return;
  group.scope = scopes.serial();
  for (const BufferUse& use : group.buffers) {
    if (const auto conflict = scopes.add(*use.buffer, use.use)) conflict_fault(*conflict);
  }
  for (const TextureUse& use : group.textures) {
    if (const auto conflict = scopes.add(*use.texture, use.range, use.use)) conflict_fault(*conflict);
  }
}

namespace {

BufferFacts facts_of(const Buffer::Impl& buffer) { return {buffer.label, buffer.size, buffer.usage}; }

VkImageSubresourceLayers layers_of(const Texture::Impl& texture, std::uint32_t mip, const SubresourceRange& range) {
  const VkImageAspectFlags aspect = texture.state.depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  return {aspect, mip, range.base_layer, range.layers};
}
VkOffset3D offset_of(const Texture::Impl& texture, Origin3d o) {
  const std::uint32_t z = texture.facts.dimension == TextureDimension::D3 ? o.z : 0;
  return {static_cast<std::int32_t>(o.x), static_cast<std::int32_t>(o.y), static_cast<std::int32_t>(z)};
}
VkExtent3D extent_of(const Texture::Impl& texture, Extent3d e) {
  return {e.width, e.height, texture.facts.dimension == TextureDimension::D3 ? e.depth_or_layers : 1};
}
bool empty(Extent3d e) { return e.width == 0 || e.height == 0 || e.depth_or_layers == 0; }

// Both directions between a buffer and a texture.
void copy_buffer_texture(CommandEncoder::Impl& encoder, const TexelCopyBuffer& b, const TexelCopyTexture& t, Extent3d size, bool to_texture) {
  vk::DeviceCore& core = *encoder.core;
  const auto& buffer = vk::require(b.buffer, "Buffer", core);
  const auto& texture = vk::require(t.texture, "Texture", core);
  const TextureFacts& facts = texture->facts;
  check_usage(to_texture ? "the source" : "the destination", facts_of(*buffer), to_texture ? BufferUsage::CopySrc : BufferUsage::CopyDst);
  check_usage(to_texture ? "the destination" : "the source", facts, to_texture ? TextureUsage::CopyDst : TextureUsage::CopySrc);
  check_texture_copy(to_texture ? "the destination" : "the source", facts, t.mip_level, t.origin, size);
  const CopyLayout layout = check_buffer_copy(to_texture ? "the source" : "the destination", facts_of(*buffer), b.offset,
                                              b.bytes_per_row, b.rows_per_image, facts.format, size);
  if (empty(size)) return;
  Recording& recording = *encoder.recording;
  const SubresourceRange range = copy_range(facts, t.mip_level, t.origin, size);
  recording.scopes.begin(core.next_serial());
  use_buffer(recording.scopes, *buffer, to_texture ? Use::CopySrc : Use::CopyDst);
  use_texture(recording.scopes, *texture, range, to_texture ? Use::CopyDst : Use::CopySrc, false);
  VkBufferImageCopy region{};
  region.bufferOffset = b.offset;
  region.bufferRowLength = layout.bytes_per_row / format_info(facts.format).bytes;
  region.bufferImageHeight = layout.rows_per_image;
  region.imageSubresource = layers_of(*texture, t.mip_level, range);
  region.imageOffset = offset_of(*texture, t.origin);
  region.imageExtent = extent_of(*texture, size);
  recording.commands.push_back(cmd::CopyBufferTexture{buffer->handle, texture->handle,
                                                      static_cast<std::uint32_t>(recording.buffer_texture_regions.size()),
                                                      recording.scopes.end(), to_texture});
  recording.buffer_texture_regions.push_back(region);
  recording.keep(buffer);
  recording.keep(texture);
}

} // namespace

void CommandEncoder::Impl::require_open() const {
  if (!recording) invalid("V-ENC-001", "{} has been finished already.", named("CommandEncoder", label));
  if (in_pass) invalid("V-ENC-002", "{} is locked: a pass of it has not ended.", named("CommandEncoder", label));
}

CommandEncoder Device::create_command_encoder(std::string_view label) {
  auto impl = std::make_shared<CommandEncoder::Impl>(impl_->core, label);
  impl->recording = take_recording(*impl_->core);
  return CommandEncoder(std::move(impl));
}

void CommandEncoder::copy_buffer_to_buffer(const Buffer& src, std::uint64_t src_offset, const Buffer& dst, std::uint64_t dst_offset, std::uint64_t size) {
  impl_->call("copy_buffer_to_buffer", [&] {
    vk::DeviceCore& core = *impl_->core;
    const auto& from = vk::require(src, "Buffer", core);
    const auto& to = vk::require(dst, "Buffer", core);
    check_usage("the source", facts_of(*from), BufferUsage::CopySrc);
    check_usage("the destination", facts_of(*to), BufferUsage::CopyDst);
    if (from == to) invalid("V-COPY-001", "{} is both source and destination of a copy.", named("Buffer", from->label));
    if (size == 0) return;
    check_range("the range to copy from", facts_of(*from), src_offset, size, 1);
    check_range("the range to copy to", facts_of(*to), dst_offset, size, 1);
    Recording& recording = *impl_->recording;
    recording.scopes.begin(core.next_serial());
    use_buffer(recording.scopes, *from, Use::CopySrc);
    use_buffer(recording.scopes, *to, Use::CopyDst);
    recording.commands.push_back(cmd::CopyBuffer{from->handle, to->handle, {src_offset, dst_offset, size}, recording.scopes.end()});
    recording.keep(from);
    recording.keep(to);
  });
}

void CommandEncoder::copy_buffer_to_texture(const TexelCopyBuffer& src, const TexelCopyTexture& dst, Extent3d size) {
  impl_->call("copy_buffer_to_texture", [&] { copy_buffer_texture(*impl_, src, dst, size, true); });
}
void CommandEncoder::copy_texture_to_buffer(const TexelCopyTexture& src, const TexelCopyBuffer& dst, Extent3d size) {
  impl_->call("copy_texture_to_buffer", [&] { copy_buffer_texture(*impl_, dst, src, size, false); });
}

void CommandEncoder::copy_texture_to_texture(const TexelCopyTexture& src, const TexelCopyTexture& dst, Extent3d size) {
  impl_->call("copy_texture_to_texture", [&] {
    vk::DeviceCore& core = *impl_->core;
    const auto& from = vk::require(src.texture, "Texture", core);
    const auto& to = vk::require(dst.texture, "Texture", core);
    check_usage("the source", from->facts, TextureUsage::CopySrc);
    check_usage("the destination", to->facts, TextureUsage::CopyDst);
    check_texture_pair(from->facts, to->facts);
    check_texture_copy("the source", from->facts, src.mip_level, src.origin, size);
    check_texture_copy("the destination", to->facts, dst.mip_level, dst.origin, size);
    if (empty(size)) return;
    Recording& recording = *impl_->recording;
    const SubresourceRange from_range = copy_range(from->facts, src.mip_level, src.origin, size);
    const SubresourceRange to_range = copy_range(to->facts, dst.mip_level, dst.origin, size);
    recording.scopes.begin(core.next_serial());
    use_texture(recording.scopes, *from, from_range, Use::CopySrc, false);
    use_texture(recording.scopes, *to, to_range, Use::CopyDst, false);
    VkImageCopy region{};
    region.srcSubresource = layers_of(*from, src.mip_level, from_range);
    region.srcOffset = offset_of(*from, src.origin);
    region.dstSubresource = layers_of(*to, dst.mip_level, to_range);
    region.dstOffset = offset_of(*to, dst.origin);
    region.extent = extent_of(*from, size);
    if (to->facts.dimension == TextureDimension::D3) region.extent.depth = size.depth_or_layers;
    recording.commands.push_back(cmd::CopyTexture{from->handle, to->handle, static_cast<std::uint32_t>(recording.texture_regions.size()),
                                                  recording.scopes.end()});
    recording.texture_regions.push_back(region);
    recording.keep(from);
    recording.keep(to);
  });
}

void CommandEncoder::clear_buffer(const Buffer& buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t value) {
  impl_->call("clear_buffer", [&] {
    const auto& target = vk::require(buffer, "Buffer", *impl_->core);
    check_usage("the buffer to clear", facts_of(*target), BufferUsage::CopyDst);
    const std::uint64_t bytes = check_range("the range to clear", facts_of(*target), offset, size, 4);
    if (bytes == 0) return;
    Recording& recording = *impl_->recording;
    recording.scopes.begin(impl_->core->next_serial());
    use_buffer(recording.scopes, *target, Use::CopyDst);
    recording.commands.push_back(cmd::FillBuffer{target->handle, offset, (bytes + 3) / 4 * 4, value, recording.scopes.end()});
    recording.keep(target);
  });
}

void CommandEncoder::write_timestamp(const QuerySet& set, std::uint32_t index) {
  impl_->call("write_timestamp", [&] {
    const auto& queries = vk::require(set, "QuerySet", *impl_->core);
    check_query("the timestamp", queries->label, queries->type, queries->count, QueryType::Timestamp, index);
    impl_->recording->commands.push_back(cmd::Timestamp{queries.get(), index});
    impl_->recording->keep(queries);
  });
}

void CommandEncoder::begin_pipeline_statistics(const QuerySet& set, std::uint32_t index) {
  impl_->call("begin_pipeline_statistics", [&] {
    const auto& queries = vk::require(set, "QuerySet", *impl_->core);
    check_query("the query", queries->label, queries->type, queries->count, QueryType::PipelineStatistics, index);
    if (impl_->statistics_set) invalid("V-QRY-004", "{} counts pipeline statistics already.", named("CommandEncoder", impl_->label));
    impl_->recording->keep(queries);
    impl_->statistics_set = queries;
    impl_->first_statistics = impl_->next_statistics = index;
  });
}
void CommandEncoder::end_pipeline_statistics() {
  impl_->call("end_pipeline_statistics", [&] {
    if (!impl_->statistics_set) invalid("V-QRY-004", "{} does not count pipeline statistics.", named("CommandEncoder", impl_->label));
    impl_->statistics_set.reset();
  });
}

void CommandEncoder::resolve_query_set(const QuerySet& set, std::uint32_t first, std::uint32_t count, const Buffer& dst, std::uint64_t offset) {
  impl_->call("resolve_query_set", [&] {
    const auto& queries = vk::require(set, "QuerySet", *impl_->core);
    const auto& target = vk::require(dst, "Buffer", *impl_->core);
    if (count == 0) return;
    check_query("the last query", queries->label, queries->type, queries->count, queries->type, std::uint64_t{first} + count - 1);
    check_usage("the destination", facts_of(*target), BufferUsage::QueryResolve);
    const std::uint64_t values = queries->type == QueryType::Timestamp ? 1 : sizeof(PipelineStatistics) / 8;
    check_range("the range to resolve to", facts_of(*target), offset, count * values * 8, 8);
    Recording& recording = *impl_->recording;
    recording.scopes.begin(impl_->core->next_serial());
    use_buffer(recording.scopes, *target, Use::CopyDst);
    recording.commands.push_back(cmd::ResolveQueries{queries.get(), first, count, recording.scopes.end(), target->handle, offset});
    recording.keep(queries);
    recording.keep(target);
  });
}

void CommandEncoder::push_debug_group(std::string_view label) {
  impl_->call("push_debug_group", [&] {
    impl_->recording->commands.push_back(cmd::BeginLabel{static_cast<std::uint32_t>(impl_->recording->texts.size())});
    impl_->recording->texts.emplace_back(label);
    ++impl_->debug_groups;
  });
}
void CommandEncoder::pop_debug_group() {
  impl_->call("pop_debug_group", [&] {
    if (impl_->debug_groups == 0) invalid("V-ENC-003", "{} has no open debug group to pop.", named("CommandEncoder", impl_->label));
    impl_->recording->commands.push_back(cmd::EndLabel{});
    --impl_->debug_groups;
  });
}

CommandBuffer CommandEncoder::finish() {
  auto commands = std::make_shared<CommandBuffer::Impl>(impl_->core, impl_->label);
  commands->valid = false;
  impl_->call("finish", [&] {
    if (impl_->debug_groups > 0) {
      invalid("V-ENC-003", "{} is finished with {} open debug groups.", named("CommandEncoder", impl_->label), impl_->debug_groups);
    }
    if (impl_->statistics_set) invalid("V-QRY-004", "{} is finished while it counts pipeline statistics.", named("CommandEncoder", impl_->label));
    commands->recording = std::move(impl_->recording);
    commands->valid = true;
  });
  return CommandBuffer(std::move(commands));
}

} // namespace mote::gpu
