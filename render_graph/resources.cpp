// SPDX-License-Identifier: MIT
#include "render_graph/resources.hpp"

#include "core/gpu/format.hpp"
#include "core/gpu/observe.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::rg {
namespace {

gpu::TextureViewDescriptor view_of(const Use& use, const TextureSpec& spec) {
  gpu::TextureViewDescriptor out{.label = use.gives.empty() ? use.source : use.gives};
  if (use.access == Access::Sampled) return out;
  out.mip_level_count = 1;
  if (!is_attachment(use.access)) return out;
  out.array_layer_count = 1;
  if (spec.dimension == gpu::TextureDimension::D2) out.dimension = gpu::TextureViewDimension::D2;
  return out;
}

// The descriptors' union: usage of all textures that share memory, name of the first.
template <class Planned> auto usage_of(const std::vector<Planned>& resources, std::uint32_t physical) {
  auto usage = decltype(Planned::usage)::None;
  for (const Planned& r : resources)
    if (r.physical == physical) usage |= r.usage;
  return usage;
}
template <class Planned> std::size_t count_physical(const std::vector<Planned>& resources) {
  std::size_t count = 0;
  for (const Planned& r : resources) count = std::max<std::size_t>(count, r.physical + 1u);
  return count;
}

template <class Planned> [[noreturn]] void out_of_memory(const Plan& plan, ViewSize view, const Planned& planned, const std::string& why) {
  fail(Exit::Failed, "G071", place_of(plan, planned), fmt::format("'{}' cannot be made for a view of {}x{}: {}", planned.name, view.width, view.height, why),
       {fmt::format("the whole graph takes {} MiB at this size.", bytes_of(plan, view.width, view.height) >> 20)});
}

} // namespace

Resources::Resources(gpu::Device device, const Plan& plan)
    : device_(std::move(device)), plan_(plan), textures_(count_physical(plan.textures)), buffers_(count_physical(plan.buffers)),
      fresh_textures_(plan.textures.size()), fresh_buffers_(plan.buffers.size()) {}

bool Resources::realize(ViewSize view) {
  if (view == view_) return false;
  const Diagnostics problems = check_limits(plan_, device_.limits(), view.width, view.height);
  if (problems.has_errors()) throw Failure(Exit::Failed, problems.list().front());
  view_ = {}; // a failure on the way leaves "nothing is made", so that the next call makes all that is missing
  const bool textures = make_textures(view), buffers = make_buffers(view);
  if (textures || buffers) make_views();
  view_ = view;
  return textures || buffers;
}

bool Resources::make_textures(ViewSize view) {
  bool made = false;
  for (std::size_t i = 0; i < plan_.textures.size(); ++i) {
    const PlannedTexture& planned = plan_.textures[i];
    const gpu::Extent3d size = extent_of(planned.spec, view.width, view.height);
    gpu::Texture& texture = textures_[planned.physical];
    if (texture && texture.size() == size) continue;
    texture = {}; // free first: two sizes at once may not fit
    device_.push_error_scope(gpu::ErrorFilter::OutOfMemory);
    texture = device_.create_texture({.label = planned.name, .size = size, .format = planned.spec.format, .usage = usage_of(plan_.textures, planned.physical),
                                      .dimension = planned.spec.dimension, .mip_level_count = planned.spec.mips});
    if (const auto error = device_.pop_error_scope()) out_of_memory(plan_, view, planned, error->message);
    fresh_textures_[i] = planned.state;
    made = true;
  }
  return made;
}

bool Resources::make_buffers(ViewSize view) {
  bool made = false;
  for (std::size_t i = 0; i < plan_.buffers.size(); ++i) {
    const PlannedBuffer& planned = plan_.buffers[i];
    const std::uint64_t size = bytes_of(planned.spec, view.width, view.height);
    gpu::Buffer& buffer = buffers_[planned.physical];
    if (buffer && buffer.size() == size) continue;
    buffer = {};
    device_.push_error_scope(gpu::ErrorFilter::OutOfMemory);
    buffer = device_.create_buffer({.label = planned.name, .size = size, .usage = usage_of(plan_.buffers, planned.physical)});
    if (const auto error = device_.pop_error_scope()) out_of_memory(plan_, view, planned, error->message);
    fresh_buffers_[i] = planned.state;
    made = true;
  }
  return made;
}

void Resources::make_views() {
  views_.clear();
  for (const PlannedPass& pass : plan_.passes) {
    auto& views = views_.emplace_back();
    for (const Use& use : pass.uses)
      views.push_back(use.buffer ? gpu::TextureView{} : texture(use.resource).create_view(view_of(use, plan_.textures[use.resource].spec)));
  }
}

std::optional<std::uint32_t> Resources::find(bool buffer, std::uint64_t native) const {
  const auto look = [native](const auto& resources) -> std::optional<std::uint32_t> {
    for (std::size_t i = 0; i < resources.size(); ++i)
      if (gpu::native_id(resources[i]) == native) return static_cast<std::uint32_t>(i);
    return std::nullopt;
  };
  return buffer ? look(buffers_) : look(textures_);
}

void Resources::mark_state(bool fresh) {
  for (std::size_t i = 0; i < plan_.textures.size(); ++i) fresh_textures_[i] = fresh && plan_.textures[i].state;
  for (std::size_t i = 0; i < plan_.buffers.size(); ++i) fresh_buffers_[i] = fresh && plan_.buffers[i].state;
}
void Resources::reset_state() { mark_state(true); }

void Resources::zero_fresh_state(gpu::CommandEncoder& encoder) {
  for (std::size_t i = 0; i < plan_.buffers.size(); ++i)
    if (fresh_buffers_[i]) encoder.clear_buffer(buffer(static_cast<std::uint32_t>(i)));
  for (std::size_t i = 0; i < plan_.textures.size(); ++i) {
    const PlannedTexture& planned = plan_.textures[i];
    if (!fresh_textures_[i] || has(planned.usage, gpu::TextureUsage::RenderAttachment)) continue;
    const gpu::Texture& target = texture(static_cast<std::uint32_t>(i));
    for (std::uint32_t level = 0; level < planned.spec.mips; ++level) {
      const gpu::Extent3d size = gpu::mip_extent(target.size(), planned.spec.dimension, level);
      const std::uint32_t row = size.width * gpu::format_info(planned.spec.format).bytes;
      const std::vector<std::byte> zeros(std::size_t{row} * size.height * size.depth_or_layers);
      device_.queue().write_texture({.texture = &target, .mip_level = level}, zeros, row, size.height, size);
    }
  }
}

} // namespace mote::rg
