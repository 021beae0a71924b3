// SPDX-License-Identifier: MIT
#include "render_graph/successors.hpp"

#include <algorithm>

namespace mote::rg {
namespace {

bool is_root(const Plan& plan, std::uint32_t texture) {
  return std::any_of(plan.roots.begin(), plan.roots.end(), [&](const Root& root) { return !root.buffer && root.resource == texture; }) ||
         std::any_of(plan.copies.begin(), plan.copies.end(), [&](const Copy& copy) { return !copy.buffer && copy.from == texture; });
}

} // namespace

std::optional<std::size_t> successor_use(const Plan& plan, std::size_t pass, std::string_view slot) {
  if (pass + 1 >= plan.passes.size()) return std::nullopt;
  const auto& uses = plan.passes[pass].uses;
  const auto made = std::find_if(uses.begin(), uses.end(), [&](const Use& use) { return use.slot == slot && !use.buffer && writes(use.access); });
  if (made == uses.end() || !made->source.empty() || made->state || is_root(plan, made->resource)) return std::nullopt;
  const PlannedTexture& between = plan.textures[made->resource];
  if (between.first != pass || between.last != pass + 1) return std::nullopt;

  const auto& next = plan.passes[pass + 1].uses;
  if (next.size() != 2) return std::nullopt;
  const std::size_t in = next[0].access == Access::Sampled ? 0 : 1, out = 1 - in;
  const bool maps = !next[in].buffer && next[in].access == Access::Sampled && next[in].resource == made->resource && !next[out].buffer &&
                    next[out].access == Access::ColorWrite && next[out].source.empty() && next[out].load == gpu::LoadOp::DontCare;
  if (!maps) return std::nullopt;
  const PlannedTexture& target = plan.textures[next[out].resource];
  if (!(target.spec.size == between.spec.size) || target.first != pass + 1 || !has(target.usage, gpu::TextureUsage::CopyDst)) return std::nullopt;
  for (std::size_t i = 0; i < plan.textures.size(); ++i)
    if (i != next[out].resource && plan.textures[i].physical == target.physical && plan.textures[i].last >= pass) return std::nullopt;
  return out;
}

bool only_sampled_by(const Plan& plan, std::size_t pass, std::string_view slot, std::string_view kind) {
  const auto& uses = plan.passes[pass].uses;
  const auto made = std::find_if(uses.begin(), uses.end(), [&](const Use& use) { return use.slot == slot && !use.buffer && writes(use.access); });
  if (made == uses.end() || !made->source.empty() || made->state || is_root(plan, made->resource)) return false;
  bool read = false;
  for (std::size_t i = 0; i < plan.passes.size(); ++i)
    for (const Use& use : plan.passes[i].uses) {
      if (i == pass || use.buffer || use.resource != made->resource) continue;
      if (use.access != Access::Sampled || plan.passes[i].kind != kind) return false;
      read = true;
    }
  return read;
}

} // namespace mote::rg
