// SPDX-License-Identifier: MIT
#include "render_graph/plan.hpp"
#include "render_graph/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mote::rg {
namespace {

std::string_view load_word(gpu::LoadOp op) {
  switch (op) {
  case gpu::LoadOp::Clear: return "clear";
  case gpu::LoadOp::Load: return "load";
  case gpu::LoadOp::DontCare: return "overwrite";
  }
  return "?";
}

std::string resource_name(const Use& use) { return fmt::format("{}{}", use.buffer ? 'b' : 't', use.resource); }

std::string use_line(const Use& use) {
  std::string out = fmt::format("      {:<12} {:<18} {:<4}", use.slot, to_string(use.access), resource_name(use));
  if (!use.source.empty()) out += " <- " + use.source;
  if (!use.gives.empty()) out += " -> " + use.gives;
  if (is_attachment(use.access)) out += fmt::format("  ({}, {})", load_word(use.load), use.store == gpu::StoreOp::Store ? "store" : "discard");
  if (use.state) out += "  state";
  return out + "\n";
}

std::string texture_usages(gpu::TextureUsage usage) {
  using gpu::TextureUsage;
  std::string out;
  for (auto [flag, word] : {std::pair{TextureUsage::RenderAttachment, "attachment"}, {TextureUsage::Sampled, "sampled"}, {TextureUsage::Storage, "storage"},
                            {TextureUsage::CopySrc, "copy-from"}, {TextureUsage::CopyDst, "copy-to"}})
    if (has(usage, flag)) out += fmt::format("{}{}", out.empty() ? "" : ", ", word);
  return out;
}
std::string buffer_usages(gpu::BufferUsage usage) {
  using gpu::BufferUsage;
  std::string out;
  for (auto [flag, word] : {std::pair{BufferUsage::Storage, "storage"}, {BufferUsage::Indirect, "indirect"}, {BufferUsage::CopySrc, "copy-from"}, {BufferUsage::CopyDst, "copy-to"}})
    if (has(usage, flag)) out += fmt::format("{}{}", out.empty() ? "" : ", ", word);
  return out;
}

template <class Resource> std::string resource_line(char letter, std::size_t i, const Resource& r, const std::string& usages) {
  const std::string passes = r.first == r.last ? fmt::format("pass {}", r.first + 1) : fmt::format("passes {}-{}", r.first + 1, r.last + 1);
  return fmt::format("  {:<4}{:<24} {:<28} {}; memory {}{}; {}\n", fmt::format("{}{}", letter, i), r.name, to_text(ResourceSpec{r.spec}), passes, r.physical, r.state ? "; state" : "", usages);
}

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

} // namespace

std::string to_text(const Plan& plan) {
  std::string out = fmt::format("graph '{}'\n", plan.name);
  for (const Root& root : plan.roots)
    out += fmt::format("  {} {} ({}{})\n", &root == plan.roots.data() ? "output " : "also   ", root.source, root.buffer ? 'b' : 't', root.resource);
  out += "passes\n";
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const PlannedPass& pass = plan.passes[i];
    out += fmt::format("  {} {} ({})\n", i + 1, pass.name, pass.kind);
    for (const Use& use : pass.uses) out += use_line(use);
    if (!pass.left_out.empty()) out += fmt::format("      left out: {}\n", list_of(pass.left_out));
    for (const Copy& copy : plan.copies)
      if (copy.after == i) out += fmt::format("      then copy {0}{1} to {0}{2}\n", copy.buffer ? 'b' : 't', copy.from, copy.to);
  }
  if (!plan.textures.empty()) out += "textures\n";
  for (std::size_t i = 0; i < plan.textures.size(); ++i) out += resource_line('t', i, plan.textures[i], texture_usages(plan.textures[i].usage));
  if (!plan.buffers.empty()) out += "buffers\n";
  for (std::size_t i = 0; i < plan.buffers.size(); ++i) out += resource_line('b', i, plan.buffers[i], buffer_usages(plan.buffers[i].usage));
  if (!plan.culled.empty()) out += "culled\n";
  for (const Culled& culled : plan.culled) out += fmt::format("  {} ({}): {}\n", culled.name, culled.kind, culled.reason);
  return out;
}

std::string to_dot(const Plan& plan) {
  std::string out = fmt::format("digraph \"{}\" {{\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n", escaped(plan.name));
  for (const PlannedPass& pass : plan.passes) out += fmt::format("  \"pass {0}\" [shape=box, style=filled, fillcolor=\"#ffd9a8\", label=\"{0}\\n{1}\"];\n", pass.name, pass.kind);
  for (const Culled& pass : plan.culled)
    out += fmt::format("  \"pass {0}\" [shape=box, style=dashed, color=gray50, fontcolor=gray50, label=\"{0}\\n{1}\\nculled: {2}\"];\n", pass.name, pass.kind, escaped(pass.reason));
  std::string edges;
  for (const PlannedPass& pass : plan.passes)
    for (const Use& use : pass.uses) { // one ellipse per version: what a pass gives
      if (!use.gives.empty()) {
        const ResourceSpec spec = use.buffer ? ResourceSpec{plan.buffers[use.resource].spec} : ResourceSpec{plan.textures[use.resource].spec};
        const bool root = std::any_of(plan.roots.begin(), plan.roots.end(), [&](const Root& r) { return r.source == use.gives; });
        out += fmt::format("  \"{0}\" [shape=ellipse, style=filled, fillcolor=\"#b8d8f0\"{1}, label=\"{0}\\n{2}\"];\n", use.gives, root ? ", penwidth=3" : "", to_text(spec));
        edges += fmt::format("  \"pass {}\" -> \"{}\" [label=\"{}\"];\n", pass.name, use.gives, to_string(use.access));
      }
      if (!use.source.empty())
        edges += fmt::format("  \"{}\" -> \"pass {}\" [label=\"{}: {}\"];\n", use.source, pass.name, use.slot, to_string(use.access));
    }
  return out + edges + "}\n";
}

} // namespace mote::rg
