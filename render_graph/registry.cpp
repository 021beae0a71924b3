// SPDX-License-Identifier: MIT
#include "render_graph/registry.hpp"

#include "core/gpu/format.hpp"
#include "render_graph/graph_desc.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace mote::rg {

void Registry::add(PassKind kind) {
  if (!valid_name(kind.name) || !kind.make) throw std::logic_error(fmt::format("pass kind '{}' has no proper name or no factory", kind.name));
  const std::string name = kind.name;
  if (!kinds_.emplace(name, std::move(kind)).second) throw std::logic_error(fmt::format("pass kind '{}' is registered twice", name));
}

const PassKind* Registry::find(std::string_view name) const {
  auto it = kinds_.find(name);
  return it == kinds_.end() ? nullptr : &it->second;
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> out;
  for (const auto& [name, kind] : kinds_) out.push_back(name);
  return out;
}

void check_slots(std::string_view kind, const std::vector<Slot>& slots) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const Slot& slot = slots[i];
    const auto bug = [&](std::string_view what) {
      throw std::logic_error(fmt::format("kind '{}' slot '{}': {}", kind, slot.name, what));
    };
    const bool in = reads(slot.access), out = writes(slot.access);
    for (std::size_t j = 0; j < i; ++j)
      if (slots[j].name == slot.name && ((in && reads(slots[j].access)) || (out && writes(slots[j].access)))) bug("declared twice");
    if (!valid_name(slot.name)) bug("is not a name");
    if (!in && !slot.makes) bug("is written, but says not what it makes");
    if (!out && slot.makes) bug("is read only, but makes something");
    if (slot.state && !(in && out && slot.makes)) bug("is state, but not a ReadWrite slot that makes something");
    const bool buffer = slot.makes ? std::holds_alternative<BufferSpec>(*slot.makes) : slot.buffer;
    if (buffer != slot.buffer && slot.buffer) bug("is a buffer, but makes a texture");
    if (buffer && (is_attachment(slot.access) || slot.access == Access::Sampled)) bug("is a buffer with an access for textures");
    const auto* texture = slot.makes ? std::get_if<TextureSpec>(&*slot.makes) : nullptr;
    if (texture && texture->format == gpu::TextureFormat::Undefined && texture->size.kind != SizeSpec::Kind::Like) bug("makes a texture without a format");
    if (!buffer && slot.access == Access::Indirect) bug("is indirect, but not a buffer");
  }
}

std::vector<KindInfo> describe(const Registry& registry) {
  std::vector<KindInfo> out;
  for (const std::string& name : registry.names()) {
    const PassKind& kind = *registry.find(name);
    KindInfo info{kind.name, kind.summary, {}, {}, false};
    Params params;
    kind.make()->declare(info.slots, params);
    check_slots(name, info.slots);
    info.params = params.asked();
    info.draws = params.asked_draw();
    out.push_back(std::move(info));
  }
  return out;
}

std::string to_text(const SizeSpec& size) {
  switch (size.kind) {
  case SizeSpec::Kind::View: return size.factor == 1.0 ? "view" : fmt::format("view*{}", size.factor);
  case SizeSpec::Kind::Fixed:
    return size.depth == 1 ? fmt::format("{}x{}", size.width, size.height) : fmt::format("{}x{}x{}", size.width, size.height, size.depth);
  case SizeSpec::Kind::Like: return "like " + size.like;
  }
  return "?";
}

std::string to_text(const ResourceSpec& resource) {
  if (const auto* buffer = std::get_if<BufferSpec>(&resource))
    return fmt::format("buffer {} bytes x {}{}", buffer->record_bytes, buffer->count, buffer->per_pixel ? " per pixel" : "");
  const auto& texture = std::get<TextureSpec>(resource);
  const bool inherited = texture.format == gpu::TextureFormat::Undefined;
  std::string out = fmt::format("{} {}", inherited ? "same format" : gpu::format_info(texture.format).name, to_text(texture.size));
  if (texture.dimension == gpu::TextureDimension::D1) out += " 1d";
  if (texture.dimension == gpu::TextureDimension::D3) out += " 3d";
  if (texture.layers > 1) out += fmt::format(" {} layers", texture.layers);
  if (texture.mips > 1) out += fmt::format(" {} mips", texture.mips);
  return out;
}

namespace {

std::string flags_of(const Slot& slot) {
  std::string out;
  if (slot.optional) out += ", optional";
  if (slot.state) out += ", state";
  if (slot.buffer && !slot.makes) out += ", buffer";
  return out;
}

} // namespace

std::string kinds_text(const Registry& registry) {
  std::string out;
  for (const KindInfo& kind : describe(registry)) {
    out += fmt::format("{}{}  {}{}\n", out.empty() ? "" : "\n", kind.name, kind.summary, kind.draws ? "  (takes 'draw')" : "");
    for (const Slot& slot : kind.slots)
      out += fmt::format("  {:<6} {:<14} {}{}{}  {}\n", !writes(slot.access) ? "input" : reads(slot.access) ? "in/out" : "output", slot.name,
                         to_string(slot.access), flags_of(slot), slot.makes ? ", " + to_text(*slot.makes) : "", slot.summary);
    for (const ParamInfo& param : kind.params)
      out += fmt::format("  param  {:<14} {}{}{}  {}\n", param.name, param.type, param.fallback.empty() ? "" : " = " + param.fallback,
                         param.range.empty() ? "" : fmt::format(" ({})", param.range), param.summary);
  }
  return out;
}

std::string kinds_json(const Registry& registry) {
  using nlohmann::ordered_json;
  ordered_json kinds = ordered_json::array();
  for (const KindInfo& kind : describe(registry)) {
    ordered_json inputs = ordered_json::array(), outputs = ordered_json::array(), params = ordered_json::array();
    for (const Slot& slot : kind.slots) {
      ordered_json entry{{"name", slot.name}, {"access", to_string(slot.access)}, {"summary", slot.summary}, {"optional", slot.optional}};
      const bool buffer = slot.buffer || (slot.makes && std::holds_alternative<BufferSpec>(*slot.makes));
      entry["type"] = buffer ? "buffer" : "texture";
      if (reads(slot.access) && !slot.state) inputs.push_back(entry);
      if (!writes(slot.access)) continue;
      entry["state"] = slot.state;
      if (slot.makes) entry["makes"] = to_text(*slot.makes);
      outputs.push_back(entry);
    }
    for (const ParamInfo& p : kind.params)
      params.push_back({{"name", p.name}, {"type", p.type}, {"default", p.fallback}, {"range", p.range}, {"summary", p.summary}});
    kinds.push_back({{"name", kind.name}, {"summary", kind.summary}, {"draws", kind.draws}, {"inputs", inputs}, {"outputs", outputs}, {"params", params}});
  }
  return ordered_json{{"kinds", kinds}}.dump(2) + "\n";
}

} // namespace mote::rg
