// SPDX-License-Identifier: MIT
// What a command does to a resource, and the scopes these uses are collected in. A scope is the
// unit of synchronization: one render pass, one dispatch, one copy. Inside a scope a resource is
// either read in any number of ways of one layout, or written in exactly one way; everything else is
// a conflict, found while recording. Between scopes barriers.hpp does its work at submit.
//
// Pure: no Vulkan handle is looked at. States live inside the resources (a `native` number says
// which), so that finding one costs a pointer and no hash.
#pragma once

#include "core/gpu/types.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mote::gpu {

enum class Use : std::uint32_t {
  None = 0,
  Index = 1, Vertex = 2, Uniform = 4, Indirect = 8,                             // buffers
  CopySrc = 0x10, CopyDst = 0x20, StorageRead = 0x40, StorageWrite = 0x80,      // both
  Sampled = 0x100, ColorAttachment = 0x200, DepthRead = 0x400, DepthWrite = 0x800, Present = 0x1000, // textures
};
template <> struct IsFlags<Use> : std::true_type {};
std::string to_string(Use use); // "Sampled|DepthRead"

// Uses that forbid any other use in the same scope. Present writes nothing, but needs its layout.
inline constexpr Use write_uses = Use::CopyDst | Use::StorageWrite | Use::ColorAttachment | Use::DepthWrite;
inline constexpr Use exclusive_uses = write_uses | Use::Present;

// Whether one buffer may have all of these uses in one scope; for a texture they must also share a layout.
bool compatible(Use all);
bool compatible_layouts(Use all);

// The synchronization of one buffer or texture subresource, after the scopes planned so far.
// `layout` is the VkImageLayout as a number (0: undefined), unused by buffers.
struct SyncState {
  Use write{};  // the use that wrote last; None: no write so far
  Use reads{};  // reads synchronized with that write and with `layout` since
  std::uint32_t layout{};
  bool operator==(const SyncState&) const = default;
};

struct BufferState {
  std::uint64_t native{};
  std::string label{};
  SyncState sync{};
  bool host_reads{};               // MapRead: device writes must be made visible to the host
  std::uint64_t last_submission{}; // counts as Submission; 0: never used
  std::uint64_t scope{};           // serial of the scope that touched it last, and its entry there
  std::uint32_t entry{};
};

struct SubresourceRange {
  std::uint32_t base_mip{}, mips{1}, base_layer{}, layers{1};
  bool operator==(const SubresourceRange&) const = default;
};
bool overlap(const SubresourceRange& a, const SubresourceRange& b);
bool contains(const SubresourceRange& range, std::uint32_t mip, std::uint32_t layer);

struct TextureState {
  std::uint64_t native{};
  std::string label{};
  bool depth{};
  std::uint32_t mips{1}, layers{1}; // 3D textures have one layer
  SyncState whole{};                // of every subresource while `parts` is empty
  std::vector<SyncState> parts{};   // [mip * layers + layer]
  std::uint64_t scope{};
  std::uint32_t entry{};
};

inline constexpr std::uint32_t no_entry = std::numeric_limits<std::uint32_t>::max();

struct BufferUse {
  BufferState* buffer{};
  Use use{};
};
struct TextureUse {
  TextureState* texture{};
  SubresourceRange range{};
  Use use{};
  bool discard{};                // old contents are not needed (cleared or fully overwritten)
  std::uint32_t next{no_entry};  // further entry of the same texture in this scope
  bool head{true};               // false: reached through another entry's `next`
};
struct Scope {
  std::uint32_t first_buffer{}, buffer_count{}, first_texture{}, texture_count{};
};

// What was wrong with an addition; the pass that records turns it into V-USE-001.
struct Conflict {
  std::string type{}, label{}; // "Buffer", its label
  Use before{}, added{};
};

// All scopes of one recording, in order. begin() opens a scope, end() closes it and gives its index.
class ScopeList {
public:
  void begin(std::uint64_t serial); // serial: never used before on these resources
  std::optional<Conflict> add(BufferState& buffer, Use use);
  std::optional<Conflict> add(TextureState& texture, const SubresourceRange& range, Use use, bool discard = false);
  std::uint32_t end();
  void clear();

  [[nodiscard]] std::uint64_t serial() const { return serial_; }
  [[nodiscard]] const std::vector<Scope>& scopes() const { return scopes_; }
  [[nodiscard]] const std::vector<BufferUse>& buffers() const { return buffers_; }
  [[nodiscard]] const std::vector<TextureUse>& textures() const { return textures_; }

private:
  [[nodiscard]] std::uint32_t find(const BufferState& buffer) const;
  [[nodiscard]] std::uint32_t find(const TextureState& texture) const;
  std::uint64_t serial_{};
  std::vector<Scope> scopes_;
  std::vector<BufferUse> buffers_;
  std::vector<TextureUse> textures_;
};

} // namespace mote::gpu
