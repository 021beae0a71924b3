// SPDX-License-Identifier: MIT
// Textures that a pass keeps to itself, because whether it needs them depends on what is connected to
// it or on its parameters: no slot, no source, never seen by the graph. Attachments that are sampled, or copied into.
#pragma once

#include "core/gpu/gpu.hpp"

#include <string_view>

namespace mote::passes {

// Makes `texture` anew unless it has this size, and says whether it did. Throws Failure G071 (exit 1) when the device
// has no memory for it.
bool make_scratch(gpu::Device& device, gpu::Texture& texture, std::string_view label, gpu::Extent3d size, gpu::TextureFormat format);

} // namespace mote::passes
