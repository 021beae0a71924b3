// SPDX-License-Identifier: MIT
// What recorded commands did to resources: a look into an encoder that has not been finished. Whoever
// promised something about a part of a recording (a render graph: which pass touches what) notes
// scope_count() before that part, asks observe() after it and compares.
//
// Every use counts that barriers are planned for: attachments, bind groups of draws and dispatches,
// vertex, index and indirect buffers, copies and clears. What goes through Queue::write_buffer and
// write_texture is no command of an encoder and is not seen.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/gpu/usage.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mote::gpu {

struct Observed {
  bool buffer{};
  std::uint64_t native{}; // native_id() of the resource
  std::string label{};
  Use use{};              // all uses together, of all subresources
};

// Scopes recorded so far; 0 for an encoder that is finished or invalid. No pass of it may be open.
[[nodiscard]] std::size_t scope_count(const CommandEncoder& encoder);
// One entry a resource, in the order of first use, over the scopes from `first_scope` on.
[[nodiscard]] std::vector<Observed> observe(const CommandEncoder& encoder, std::size_t first_scope = 0);

// What each fragment of recorded draws gets from the rasterizer, in components: the most of any pipeline that was
// set from command `first` on (as command_count() gave it).
struct FragmentInputs {
  std::uint32_t interpolated{}, flat{};
};
// Queries that render passes have taken since begin_pipeline_statistics().
[[nodiscard]] std::uint32_t counted_passes(const CommandEncoder& encoder);
[[nodiscard]] std::size_t command_count(const CommandEncoder& encoder);
[[nodiscard]] FragmentInputs fragment_inputs(const CommandEncoder& encoder, std::size_t first);

// Equal for handles of the same object, and for no two living ones of a type. 0: an invalid handle.
[[nodiscard]] std::uint64_t native_id(const Buffer& buffer);
[[nodiscard]] std::uint64_t native_id(const Texture& texture);

} // namespace mote::gpu
