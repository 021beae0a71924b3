// SPDX-License-Identifier: MIT
#include "core/gpu/usage.hpp"

#include <array>
#include <bit>
#include <string_view>

namespace mote::gpu {

std::string to_string(Use use) {
  static constexpr std::array<std::string_view, 13> names{
      "Index",        "Vertex",  "Uniform",         "Indirect",  "CopySrc",    "CopyDst", "StorageRead",
      "StorageWrite", "Sampled", "ColorAttachment", "DepthRead", "DepthWrite", "Present"};
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if ((static_cast<std::uint32_t>(use) >> i & 1u) == 0) continue;
    if (!text.empty()) text += '|';
    text += names[i];
  }
  return text.empty() ? "None" : text;
}

bool compatible(Use all) {
  const bool several = std::popcount(static_cast<std::uint32_t>(all)) > 1;
  return !(several && any(all & exclusive_uses));
}

bool compatible_layouts(Use all) {
  if (!compatible(all)) return false;
  int layouts = 0; // of the kinds of reading
  for (const Use group : {Use::Sampled | Use::DepthRead, Use::StorageRead, Use::CopySrc}) layouts += any(all & group) ? 1 : 0;
  return layouts <= 1;
}

bool overlap(const SubresourceRange& a, const SubresourceRange& b) {
  return a.base_mip < b.base_mip + b.mips && b.base_mip < a.base_mip + a.mips &&
         a.base_layer < b.base_layer + b.layers && b.base_layer < a.base_layer + a.layers;
}

bool contains(const SubresourceRange& range, std::uint32_t mip, std::uint32_t layer) {
  return mip >= range.base_mip && mip < range.base_mip + range.mips && layer >= range.base_layer &&
         layer < range.base_layer + range.layers;
}

void ScopeList::begin(std::uint64_t serial) {
  serial_ = serial;
  scopes_.push_back({static_cast<std::uint32_t>(buffers_.size()), 0, static_cast<std::uint32_t>(textures_.size()), 0});
}

std::uint32_t ScopeList::end() {
  Scope& scope = scopes_.back();
  scope.buffer_count = static_cast<std::uint32_t>(buffers_.size()) - scope.first_buffer;
  scope.texture_count = static_cast<std::uint32_t>(textures_.size()) - scope.first_texture;
  return static_cast<std::uint32_t>(scopes_.size()) - 1;
}

void ScopeList::clear() {
  scopes_.clear();
  buffers_.clear();
  textures_.clear();
}

// The entry of a resource in the open scope, or no_entry. Normally its stamp says so; a stamp of a newer
// scope means that two scopes are being recorded in turns, and the older one searches.
std::uint32_t ScopeList::find(const BufferState& buffer) const {
  if (buffer.scope == serial_) return buffer.entry;
  if (buffer.scope < serial_) return no_entry;
  for (std::size_t i = scopes_.back().first_buffer; i < buffers_.size(); ++i) {
    if (buffers_[i].buffer == &buffer) return static_cast<std::uint32_t>(i);
  }
  return no_entry;
}

std::uint32_t ScopeList::find(const TextureState& texture) const {
  if (texture.scope == serial_) return texture.entry;
  if (texture.scope < serial_) return no_entry;
  for (std::size_t i = scopes_.back().first_texture; i < textures_.size(); ++i) {
    if (textures_[i].texture == &texture && textures_[i].head) return static_cast<std::uint32_t>(i);
  }
  return no_entry;
}

namespace {
template <class State> void stamp(State& state, std::uint64_t serial, std::size_t entry) {
  if (state.scope > serial) return;
  state.scope = serial;
  state.entry = static_cast<std::uint32_t>(entry);
}
} // namespace

std::optional<Conflict> ScopeList::add(BufferState& buffer, Use use) {
  const std::uint32_t entry = find(buffer);
  if (entry == no_entry) {
    stamp(buffer, serial_, buffers_.size());
    buffers_.push_back({&buffer, use});
    return std::nullopt;
  }
  Use& known = buffers_[entry].use;
  if (!compatible(known | use)) return Conflict{"Buffer", buffer.label, known, use};
  known |= use;
  return std::nullopt;
}

std::optional<Conflict> ScopeList::add(TextureState& texture, const SubresourceRange& range, Use use, bool discard) {
  const auto index = static_cast<std::uint32_t>(textures_.size());
  const std::uint32_t head = find(texture);
  if (head == no_entry) {
    stamp(texture, serial_, index);
    textures_.push_back({&texture, range, use, discard, no_entry, true});
    return std::nullopt;
  }
  std::uint32_t last = head;
  std::uint32_t same = no_entry;
  for (std::uint32_t i = head; i != no_entry; i = textures_[i].next) {
    const TextureUse& entry = textures_[i];
    if (overlap(entry.range, range) && !compatible_layouts(entry.use | use)) {
      return Conflict{"Texture", texture.label, entry.use, use};
    }
    if (entry.range == range) same = i;
    last = i;
  }
  if (same != no_entry) {
    textures_[same].use |= use;
    textures_[same].discard = textures_[same].discard && discard;
    return std::nullopt;
  }
  textures_[last].next = index;
  textures_.push_back({&texture, range, use, discard, no_entry, false});
  return std::nullopt;
}

} // namespace mote::gpu
