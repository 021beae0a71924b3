// SPDX-License-Identifier: MIT
#include "passes/scratch.hpp"

#include "core/base/diagnostic.hpp"

#include <fmt/format.h>

namespace mote::passes {

bool make_scratch(gpu::Device& device, gpu::Texture& texture, std::string_view label, gpu::Extent3d size, gpu::TextureFormat format) {
  if (texture && texture.size() == size && texture.format() == format) return false;
  texture = {};
  device.push_error_scope(gpu::ErrorFilter::OutOfMemory);
  texture = device.create_texture({.label = label, .size = size, .format = format,
                                   .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::Sampled | gpu::TextureUsage::CopyDst});
  if (const auto error = device.pop_error_scope())
    fail(Exit::Failed, "G071", {}, fmt::format("'{}' cannot be made for a view of {}x{}: {}", label, size.width, size.height, error->message));
  return true;
}

} // namespace mote::passes
