// SPDX-License-Identifier: MIT
// Formats and sizes: the kind's default, what the file changes, what `like` and drawing-over inherit.
#include "core/gpu/format.hpp"
#include "render_graph/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace mote::rg {
namespace {

using gpu::FormatKind;
using gpu::TextureDimension;

std::size_t at(int i) { return static_cast<std::size_t>(i); }
FormatKind class_of(gpu::TextureFormat format) {
  const FormatKind kind = gpu::format_info(format).kind;
  return kind == FormatKind::Unorm ? FormatKind::Float : kind;
}
std::string_view class_name(gpu::TextureFormat format) {
  switch (class_of(format)) {
  case FormatKind::Uint: return "unsigned";
  case FormatKind::Sint: return "signed";
  case FormatKind::Depth: return "depth";
  case FormatKind::Float: case FormatKind::Unorm: break;
  }
  return "float";
}

class Settler {
public:
  Settler(Resolved& resolved, Diagnostics& diagnostics) : r_(resolved), diagnostics_(diagnostics), state_(resolved.versions.size(), State::New) {}

  void run() {
    for (std::size_t v = 0; v < r_.versions.size(); ++v) settle(static_cast<int>(v));
    for (const Node& node : r_.nodes) {
      if (!node.pass || !node.desc->enabled) continue;
      for (std::size_t s = 0; s < node.slots.size(); ++s) check_use(node, s);
      check_attachments(node);
    }
  }

private:
  enum class State : std::uint8_t { New, Busy, Done };

  void settle(int id) {
    Version& v = r_.versions[at(id)];
    if (state_[at(id)] != State::New || !v.ok) return;
    state_[at(id)] = State::Busy;
    const Node& node = r_.nodes[at(v.node)];
    const std::string& slot = node.slots[at(v.slot)].name;
    const auto& outputs = node.desc->outputs;
    const auto change = std::find_if(outputs.begin(), outputs.end(), [&](const OutputDesc& o) { return o.slot.text == slot; });
    if (change != outputs.end()) v.loc = change->slot.loc;
    if (v.parent != none) {
      settle(v.parent);
      v.spec = r_.versions[at(v.parent)].spec;
      v.ok = r_.versions[at(v.parent)].ok;
      if (change != outputs.end())
        diagnostics_.error("G048", change->slot.loc, fmt::format("pass '{}' draws over '{}' in its output '{}', so it cannot change format or size.", node.name(), r_.name(v.parent), slot));
    } else if (auto* buffer = std::get_if<BufferSpec>(&v.spec)) {
      if (change != outputs.end()) change_buffer(node, *change, *buffer);
    } else {
      change_texture(node, change == outputs.end() ? nullptr : &*change, v, std::get<TextureSpec>(v.spec));
    }
    state_[at(id)] = State::Done;
  }

  void change_buffer(const Node& node, const OutputDesc& change, BufferSpec& spec) {
    if (change.format || change.size || change.layers || change.mips || change.dimension)
      diagnostics_.error("G047", change.slot.loc, fmt::format("pass '{}' output '{}' is a buffer; it has no format, size, layers, mips or dimension.", node.name(), change.slot.text), {"keys of a buffer: count."});
    if (change.count) spec.count = *change.count;
  }

  void change_texture(const Node& node, const OutputDesc* change, Version& v, TextureSpec& spec) {
    const SourceLoc loc = change ? change->size_loc.line ? change->size_loc : change->slot.loc : v.loc;
    if (change && change->count)
      diagnostics_.error("G047", change->shape_loc, fmt::format("pass '{}' output '{}' is a texture; it has no count.", node.name(), change->slot.text), {"keys of a texture: format, size, layers, mips, dimension."});
    const bool resized = change && change->size, no_format = spec.format == gpu::TextureFormat::Undefined;
    if (spec.size.kind == SizeSpec::Kind::Like && (!resized || no_format) && !inherit_size(node, v, spec, loc)) return;
    if (resized) spec.size = *change->size;
    if (resized && spec.size.kind == SizeSpec::Kind::Like && !inherit_size(node, v, spec, loc)) return;
    if (!change) return;
    if (change->format) change_format(node, *change, spec);
    if (change->layers) spec.layers = *change->layers;
    if (change->mips) spec.mips = *change->mips;
    if (change->dimension) spec.dimension = change->dimension->text == "1d" ? TextureDimension::D1 : change->dimension->text == "3d" ? TextureDimension::D3 : TextureDimension::D2;
    if (const std::string_view wrong = shape_problem(node.slots[at(v.slot)].access, spec); !wrong.empty())
      diagnostics_.error("G046", change->shape_loc, fmt::format("pass '{}' output '{}' cannot be {}: {}.", node.name(), change->slot.text, to_text(ResourceSpec{spec}), wrong));
  }

  void change_format(const Node& node, const OutputDesc& change, TextureSpec& spec) {
    const auto format = *gpu::parse_format(change.format->text);
    if (spec.format == gpu::TextureFormat::Undefined || class_of(format) == class_of(spec.format)) {
      spec.format = format;
      return;
    }
    std::vector<std::string> fitting;
    for (const std::string& name : gpu::format_names())
      if (class_of(*gpu::parse_format(name)) == class_of(spec.format)) fitting.push_back(name);
    diagnostics_.error("G041", change.format->loc,
                       fmt::format("pass '{}' output '{}' holds {} numbers, but '{}' holds {} ones.", node.name(), change.slot.text, class_name(spec.format), change.format->text, class_name(format)),
                       {"formats: " + list_of(fitting) + "."});
  }

  static std::string_view shape_problem(Access access, const TextureSpec& spec) {
    if (spec.dimension == TextureDimension::D3 && spec.layers > 1) return "a 3d texture has no layers";
    if (spec.dimension != TextureDimension::D3 && spec.size.depth > 1) return "only a 3d texture has a depth";
    if (spec.dimension != TextureDimension::D2 && is_attachment(access)) return "an attachment is 2d";
    if (spec.dimension == TextureDimension::D1 && spec.size.kind == SizeSpec::Kind::Fixed && spec.size.height > 1) return "a 1d texture has height 1";
    const std::uint32_t side = std::max({spec.size.width, spec.size.height, spec.size.depth});
    if (spec.size.kind == SizeSpec::Kind::Fixed && spec.mips > static_cast<std::uint32_t>(std::bit_width(side))) return "it has more mips than its size allows";
    return {};
  }

  // The version that `like` means: an own input's ("color"), or any source ("opaque.color").
  int like_target(const Node& node, const std::string& like, bool& own) const {
    const auto source = split_source(like);
    own = !source;
    for (const Node& other : r_.nodes) {
      if (source ? other.name() != source->pass : &other != &node) continue;
      for (std::size_t s = 0; s < other.slots.size(); ++s) {
        if (source && other.slots[s].name == source->slot && other.out[s] >= 0) return other.out[s];
        if (!source && other.slots[s].name == like && reads(other.slots[s].access)) return other.in[s];
      }
    }
    return none;
  }

  bool inherit_size(const Node& node, Version& v, TextureSpec& spec, const SourceLoc& loc) {
    bool own = false;
    const int target = like_target(node, spec.size.like, own);
    const std::string& slot = node.slots[at(v.slot)].name;
    const std::string like = std::exchange(spec.size, SizeSpec{}).like;
    if (target == none && own && find_input(node, like)) { // an input that is not connected: the view
      if (spec.format == gpu::TextureFormat::Undefined) spec.format = gpu::TextureFormat::RGBA16Float;
      return true;
    }
    if (target < 0) {
      if (target == none) diagnostics_.error("G044", loc, fmt::format("pass '{}' output '{}' is sized like '{}', which does not exist.", node.name(), slot, like), {"like = \"pass.slot\", or the name of an input of the same pass."});
      return v.ok = false;
    }
    if (state_[at(target)] == State::Busy) {
      diagnostics_.error("G044", loc, fmt::format("pass '{}' output '{}' is sized like '{}', which in turn is sized like it.", node.name(), slot, like));
      return v.ok = false;
    }
    settle(target);
    const Version& model = r_.versions[at(target)];
    const auto* texture = std::get_if<TextureSpec>(&model.spec);
    if (!model.ok) return v.ok = false;
    if (!texture) {
      diagnostics_.error("G044", loc, fmt::format("pass '{}' output '{}' is sized like '{}', which is a buffer.", node.name(), slot, like));
      return v.ok = false;
    }
    spec.size = texture->size;
    if (spec.format == gpu::TextureFormat::Undefined) spec.format = texture->format;
    return true;
  }
  static bool find_input(const Node& node, std::string_view name) {
    return std::any_of(node.slots.begin(), node.slots.end(), [&](const Slot& s) { return s.name == name && reads(s.access); });
  }

  // Does what a slot reads or makes suit its access?
  void check_use(const Node& node, std::size_t s) {
    const Slot& slot = node.slots[s];
    const int id = node.in[s] >= 0 ? node.in[s] : node.out[s];
    if (id < 0 || !r_.versions[at(id)].ok) return;
    const Version& version = r_.versions[at(id)];
    SourceLoc loc = version.loc;
    for (const InputDesc& input : node.desc->inputs)
      if (input.slot.text == slot.name && node.in[s] >= 0) loc = input.source.loc;
    const auto* texture = std::get_if<TextureSpec>(&version.spec);
    const bool wants_buffer = slot.makes ? std::holds_alternative<BufferSpec>(*slot.makes) : slot.buffer;
    if (wants_buffer == (texture != nullptr)) {
      diagnostics_.error("G018", loc, fmt::format("pass '{}' slot '{}' takes a {}, but '{}' is a {}.", node.name(), slot.name, wants_buffer ? "buffer" : "texture", r_.name(id), texture ? "texture" : "buffer"));
      return;
    }
    if (!texture) return;
    const bool depth = class_of(texture->format) == FormatKind::Depth;
    const bool storage = !is_attachment(slot.access) && slot.access != Access::Sampled;
    if (is_depth(slot.access) != depth && (is_attachment(slot.access) || (storage && depth)))
      diagnostics_.error("G045", loc, fmt::format("pass '{}' slot '{}' ({}) cannot take '{}', which is {}.", node.name(), slot.name, to_string(slot.access), r_.name(id), to_text(version.spec)));
  }

  // All attachments of a pass have one size.
  void check_attachments(const Node& node) {
    int first = none;
    std::string first_slot;
    for (std::size_t s = 0; s < node.slots.size() && !node.pass->opens_attachments(); ++s) {
      const int id = node.out[s] >= 0 ? node.out[s] : node.in[s];
      if (!is_attachment(node.slots[s].access) || id < 0 || !r_.versions[at(id)].ok) continue;
      const auto* texture = std::get_if<TextureSpec>(&r_.versions[at(id)].spec);
      if (!texture) continue;
      if (first == none) {
        first = id;
        first_slot = node.slots[s].name;
        continue;
      }
      const auto& other = std::get<TextureSpec>(r_.versions[at(first)].spec);
      if (texture->size == other.size) continue;
      diagnostics_.error("G042", r_.versions[at(id)].loc,
                         fmt::format("pass '{}' draws into '{}' ({}) and '{}' ({}), but all its attachments must have one size.", node.name(), first_slot, to_text(other.size), node.slots[s].name, to_text(texture->size)));
    }
  }

  Resolved& r_;
  Diagnostics& diagnostics_;
  std::vector<State> state_;
};

} // namespace

void settle_specs(Resolved& resolved, Diagnostics& diagnostics) { Settler(resolved, diagnostics).run(); }

} // namespace mote::rg
