// SPDX-License-Identifier: MIT
#include "core/gpu/observe.hpp"

#include "core/gpu/vk/handles.hpp"

#include <algorithm>

namespace mote::gpu {
namespace {

const ScopeList* scopes_of(const CommandEncoder& encoder) {
  const auto& impl = encoder.impl();
  return impl && impl->recording ? &impl->recording->scopes : nullptr;
}

template <class State> void note(std::vector<Observed>& seen, bool buffer, const State& state, Use use) {
  const auto known = std::find_if(seen.begin(), seen.end(), [&](const Observed& o) { return o.buffer == buffer && o.native == state.native; });
  if (known != seen.end()) known->use |= use;
  else seen.push_back({buffer, state.native, state.label, use});
}

} // namespace

std::size_t scope_count(const CommandEncoder& encoder) {
  const ScopeList* scopes = scopes_of(encoder);
  return scopes ? scopes->scopes().size() : 0;
}

std::vector<Observed> observe(const CommandEncoder& encoder, std::size_t first_scope) {
  std::vector<Observed> seen;
  const ScopeList* scopes = scopes_of(encoder);
  if (!scopes || first_scope >= scopes->scopes().size()) return seen;
  const Scope& first = scopes->scopes()[first_scope];
  for (std::size_t i = first.first_buffer; i < scopes->buffers().size(); ++i) note(seen, true, *scopes->buffers()[i].buffer, scopes->buffers()[i].use);
  for (std::size_t i = first.first_texture; i < scopes->textures().size(); ++i) note(seen, false, *scopes->textures()[i].texture, scopes->textures()[i].use);
  return seen;
}

std::uint32_t counted_passes(const CommandEncoder& encoder) {
  return encoder.impl() ? encoder.impl()->next_statistics - encoder.impl()->first_statistics : 0;
}

std::size_t command_count(const CommandEncoder& encoder) {
  const auto& impl = encoder.impl();
  return impl && impl->recording ? impl->recording->commands.size() : 0;
}

FragmentInputs fragment_inputs(const CommandEncoder& encoder, std::size_t first) {
  FragmentInputs most;
  for (std::size_t i = first; i < command_count(encoder); ++i)
    if (const auto* set = std::get_if<cmd::SetPipeline>(&encoder.impl()->recording->commands[i])) {
      most.interpolated = std::max(most.interpolated, set->interpolated);
      most.flat = std::max(most.flat, set->flat);
    }
  return most;
}

std::uint64_t native_id(const Buffer& buffer) { return buffer ? buffer.impl()->state.native : 0; }
std::uint64_t native_id(const Texture& texture) { return texture ? texture.impl()->state.native : 0; }

} // namespace mote::gpu
