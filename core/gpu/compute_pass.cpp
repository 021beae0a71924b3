// SPDX-License-Identifier: MIT
#include "core/gpu/vk/handles.hpp"

namespace mote::gpu {

ComputePass CommandEncoder::begin_compute_pass(const ComputePassDescriptor& d) {
  auto pass = std::make_shared<ComputePass::Impl>(impl_->core, d.label);
  pass->valid = false;
  pass->encoder = impl_;
  impl_->call("begin_compute_pass", [&] {
    pass->take_timestamps(d.timestamps);
    pass->valid = true;
    impl_->in_pass = true;
  });
  return ComputePass(std::move(pass));
}

std::uint32_t ComputePass::Impl::prepare_dispatch(Buffer::Impl* indirect) {
  if (!pipeline) invalid("V-DISP-001", "A dispatch of {} has no pipeline set.", named("ComputePass", label));
  Recording& list = recording();
  if (!ready) {
    binds.apply(list, *pipeline->layout, pipeline->push_constants_used, named("ComputePipeline", pipeline->label), VK_PIPELINE_BIND_POINT_COMPUTE);
    ready = true;
  }
  list.scopes.begin(core->next_serial());
  for (std::size_t i = 0; i < pipeline->layout->groups.size(); ++i) {
    if (binds.groups[i]) use_group(list.scopes, *binds.groups[i]);
  }
  if (indirect != nullptr) use_buffer(list.scopes, *indirect, Use::Indirect);
  return list.scopes.end();
}

void ComputePass::Impl::end() {
  if (ended) return;
  call("ComputePass", "end()", [&] {
    record_timestamp(timestamps ? timestamps->end : std::nullopt);
    close();
  });
  ended = true;
  if (encoder && valid) encoder->in_pass = false;
}

void ComputePass::set_pipeline(const ComputePipeline& pipeline) {
  impl_->call("ComputePass", "set_pipeline", [&] {
    impl_->pipeline = vk::require(pipeline, "ComputePipeline", *impl_->core);
    impl_->recording().commands.push_back(cmd::SetPipeline{impl_->pipeline->handle, VK_PIPELINE_BIND_POINT_COMPUTE});
    impl_->recording().keep(impl_->pipeline);
    impl_->ready = false;
  });
}

void ComputePass::set_bind_group(std::uint32_t index, const BindGroup& group) {
  impl_->call("ComputePass", "set_bind_group", [&] {
    const auto& found = vk::require(group, "BindGroup", *impl_->core);
    impl_->binds.set_group(impl_->core->facts, index, found);
    impl_->recording().keep(found);
    impl_->ready = false;
  });
}

void ComputePass::set_push_constants(std::uint32_t offset, std::span<const std::byte> data) {
  impl_->call("ComputePass", "set_push_constants", [&] {
    impl_->binds.set_push(impl_->core->facts, offset, data);
    impl_->ready = false;
  });
}

void ComputePass::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  impl_->call("ComputePass", "dispatch", [&] {
    const std::uint32_t limit = impl_->core->facts.limits.max_compute_workgroups_per_dimension;
    if (x > limit || y > limit || z > limit) {
      invalid("V-DISP-002", "A dispatch asks for {}x{}x{} workgroups; {} allows {} per dimension.", x, y, z,
              named("Device", impl_->core->label), limit);
    }
    const std::uint32_t scope = impl_->prepare_dispatch(nullptr);
    impl_->recording().commands.push_back(cmd::Dispatch{x, y, z, scope});
  });
}

void ComputePass::dispatch_indirect(const Buffer& buffer, std::uint64_t offset) {
  impl_->call("ComputePass", "dispatch_indirect", [&] {
    const auto& arguments = vk::require(buffer, "Buffer", *impl_->core);
    const BufferFacts facts{arguments->label, arguments->size, arguments->usage};
    check_usage("the indirect arguments", facts, BufferUsage::Indirect);
    check_range("the indirect arguments", facts, offset, 12, 4);
    const std::uint32_t scope = impl_->prepare_dispatch(arguments.get());
    impl_->recording().commands.push_back(cmd::DispatchIndirect{arguments->handle, offset, scope});
    impl_->recording().keep(arguments);
  });
}

void ComputePass::push_debug_group(std::string_view label) {
  impl_->call("ComputePass", "push_debug_group", [&] { impl_->push_label(label); });
}
void ComputePass::pop_debug_group() {
  impl_->call("ComputePass", "pop_debug_group", [&] { impl_->pop_label(); });
}
void ComputePass::end() { impl_->end(); }

} // namespace mote::gpu
