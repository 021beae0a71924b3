// SPDX-License-Identifier: MIT
// What will be done, as pure data: the passes in order, what each touches and how, the textures and
// buffers with their lifetimes, what was left out and why. No device, no view size ("view" stays a
// symbol). Comparable with ==; the same file always gives the same plan.
//
// compile() makes it; to_text(), to_dot() and the Executor read it.
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/gpu/types.hpp"
#include "render_graph/slots.hpp"

#include <string>
#include <vector>

namespace mote::rg {

// One slot of a pass, joined to a resource: an index into Plan::textures, or Plan::buffers if `buffer`.
struct Use {
  std::string slot{};
  Access access{};
  bool buffer{};
  std::uint32_t resource{};
  std::string source{}; // "opaque.color" that is read; empty: the pass starts afresh
  std::string gives{};  // "glyphs.color" that is written; empty: read only
  bool optional{};      // the pass can do without it (inputs)
  bool state{};
  bool sampled_too{};   // the pass also reads what it writes, as Slot says
  gpu::LoadOp load{gpu::LoadOp::Load};    // attachments
  gpu::StoreOp store{gpu::StoreOp::Store}; // attachments
  bool operator==(const Use&) const = default;
};

struct PlannedPass {
  std::string name{}, kind{};
  std::vector<Use> uses{};            // in the order of the kind's slots
  std::vector<std::string> left_out{}; // optional slots that are not connected or not wanted
  bool operator==(const PlannedPass&) const = default;
};

struct PlannedTexture {
  std::string name{}; // "opaque.color": the source that made it
  TextureSpec spec{}; // its size is View or Fixed
  gpu::TextureUsage usage{};
  std::uint32_t first{}, last{}; // passes, inclusive
  std::uint32_t physical{};      // textures with the same number share memory, one after the other
  bool state{};
  SourceLoc loc{};               // where the file speaks of it, else its pass; does not count in ==
  bool operator==(const PlannedTexture& o) const {
    return name == o.name && spec == o.spec && usage == o.usage && first == o.first && last == o.last && physical == o.physical && state == o.state;
  }
};
struct PlannedBuffer {
  std::string name{};
  BufferSpec spec{};
  gpu::BufferUsage usage{};
  std::uint32_t first{}, last{}, physical{};
  bool state{};
  SourceLoc loc{};
  bool operator==(const PlannedBuffer& o) const {
    return name == o.name && spec == o.spec && usage == o.usage && first == o.first && last == o.last && physical == o.physical && state == o.state;
  }
};

// A source that somebody wants after the frame. If a later pass draws over it, it is copied first.
struct Root {
  std::string source{};
  bool buffer{};
  std::uint32_t resource{};
  bool operator==(const Root&) const = default;
};
struct Copy {
  std::uint32_t after{}; // pass
  bool buffer{};
  std::uint32_t from{}, to{};
  bool operator==(const Copy&) const = default;
};
struct Culled {
  std::string name{}, kind{}, reason{};
  bool operator==(const Culled&) const = default;
};

struct Plan {
  std::string name{};
  std::vector<PlannedPass> passes{};
  std::vector<PlannedTexture> textures{};
  std::vector<PlannedBuffer> buffers{};
  std::vector<Copy> copies{};
  std::vector<Culled> culled{}; // in file order
  std::vector<Root> roots{};    // the output first
  bool operator==(const Plan&) const = default;
};

std::string to_text(const Plan& plan);
std::string to_dot(const Plan& plan); // Graphviz: passes boxes, resources ellipses, culled passes dashed

// What of the plan this device and view size do not allow: G070. Pure.
Diagnostics check_limits(const Plan& plan, const gpu::Limits& limits, std::uint32_t view_width, std::uint32_t view_height);
// Where a texture or buffer is spoken of; the plan's name where nobody does.
template <class Planned> SourceLoc place_of(const Plan& plan, const Planned& planned) {
  return planned.loc.file.empty() ? SourceLoc{plan.name} : planned.loc;
}
// Size of a texture for a view, and bytes of a buffer. Factors round to the nearest, at least 1.
gpu::Extent3d extent_of(const TextureSpec& spec, std::uint32_t view_width, std::uint32_t view_height);
std::uint64_t bytes_of(const BufferSpec& spec, std::uint32_t view_width, std::uint32_t view_height);
// Bytes of all physical textures (every mip and layer) and buffers together; state included.
std::uint64_t bytes_of(const Plan& plan, std::uint32_t view_width, std::uint32_t view_height);

} // namespace mote::rg
