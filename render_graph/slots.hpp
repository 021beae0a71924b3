// SPDX-License-Identifier: MIT
// What a pass takes and gives. A slot has a name, an access and, for what the pass makes, a spec of
// the texture or buffer. Slots come from the kind (C++), never from the file; the file names the
// sources of inputs ("opaque.color") and may change format and size of outputs.
#pragma once

#include "core/gpu/types.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mote::rg {

// How a pass touches a slot. ReadWrite slots consume their source and give it on under the pass's
// own name (opaque.color -> glyphs.color); Write slots make a new resource.
enum class Access : std::uint8_t {
  Sampled,        // texture, read in shaders
  ColorWrite,     // color attachment, all of it
  ColorReadWrite, // color attachment, drawn over
  DepthWrite, DepthReadWrite, // depth attachment
  DepthRead,      // depth attachment for testing; may be sampled in the same pass
  StorageRead, StorageWrite, StorageReadWrite, // texture or buffer in shaders
  Indirect,       // buffer of draw or dispatch arguments
};
std::string_view to_string(Access access);
bool reads(Access access);
bool writes(Access access);
bool is_color(Access access);
bool is_depth(Access access);
bool is_attachment(Access access); // color or depth

// Size of a texture: fixed, or a factor of the view ("view", { view = 0.5 }), or like another source.
struct SizeSpec {
  enum class Kind : std::uint8_t { View, Fixed, Like } kind{Kind::View};
  double factor{1.0};
  std::uint32_t width{}, height{}, depth{1};
  std::string like{}; // "pass.slot", or the name of an input slot of the same pass
  bool operator==(const SizeSpec&) const = default;
};
struct TextureSpec {
  gpu::TextureFormat format{}; // Undefined with a size of kind Like: that of the other texture
  SizeSpec size{};
  gpu::TextureDimension dimension{gpu::TextureDimension::D2};
  std::uint32_t layers{1}, mips{1};
  bool operator==(const TextureSpec&) const = default;
};
struct BufferSpec {
  std::uint32_t record_bytes{}; // size of one record
  std::uint64_t count{};        // records, at least 1; with per_pixel: records per view pixel
  bool per_pixel{};
  bool operator==(const BufferSpec&) const = default;
};
using ResourceSpec = std::variant<TextureSpec, BufferSpec>;

// A ReadWrite slot that has `makes` may stay unconnected: the pass then starts from a fresh resource
// (cleared, if it is an attachment). An output that nobody reads and that is not optional is the
// pass's scratch. One input and one output of a pass may share a name ("color" in, "color" out).
struct Slot {
  std::string name{};
  Access access{};
  std::string summary{};               // one line for --kinds and docs
  std::optional<ResourceSpec> makes{}; // set for Write accesses: what is made by default
  bool optional{};                     // an input that may stay unconnected, an output that is made only when wanted
  bool state{};                        // ReadWrite + makes, kept between frames, zero after a camera cut, a reload or a resize
  bool buffer{};                       // an input slot that takes a buffer
  bool sampled_too{};                  // attachment: the pass also reads it in shaders, between RenderPasses that it opens itself
  bool covers{};                       // attachment: the pass writes every pixel, so that it is not cleared first
  bool copied_into{};                  // attachment: the pass may also fill it by a copy, outside of drawing
};

} // namespace mote::rg
