// SPDX-License-Identifier: MIT
#include "render_graph/uses.hpp"

#include <fmt/format.h>

namespace mote::rg {

gpu::Use allowed_uses(Access access, bool buffer) {
  switch (access) {
  case Access::Sampled: return gpu::Use::Sampled;
  case Access::ColorWrite:
  case Access::ColorReadWrite: return gpu::Use::ColorAttachment;
  case Access::DepthWrite:
  case Access::DepthReadWrite: return gpu::Use::DepthWrite | gpu::Use::DepthRead;
  case Access::DepthRead: return gpu::Use::DepthRead | gpu::Use::Sampled;
  case Access::StorageRead: return gpu::Use::StorageRead;
  case Access::StorageWrite:
  case Access::StorageReadWrite: // passes clear and fill buffers
    return gpu::Use::StorageRead | gpu::Use::StorageWrite | (buffer ? gpu::Use::CopyDst : gpu::Use::None);
  case Access::Indirect: return gpu::Use::Indirect;
  }
  return gpu::Use::None;
}

gpu::Use needed_uses(Access access, bool buffer) {
  const gpu::Use allowed = allowed_uses(access, buffer);
  return writes(access) ? allowed & gpu::write_uses : allowed;
}

UseCheck::UseCheck(const Plan& plan) : plan_(plan), ran_(plan.passes.size()) {
  for (const PlannedPass& pass : plan.passes) used_.emplace_back(pass.uses.size());
}

std::uint32_t UseCheck::physical(const Use& use) const {
  return use.buffer ? plan_.buffers[use.resource].physical : plan_.textures[use.resource].physical;
}

// The source that lives in this memory while the pass runs, or else any that ever does.
std::string UseCheck::name(const SeenUse& seen, std::size_t pass) const {
  std::string found;
  const auto look = [&](const auto& resources) {
    for (const auto& r : resources)
      if (r.physical == seen.physical && (found.empty() || (r.first <= pass && pass <= r.last))) found = r.name;
  };
  if (seen.buffer) look(plan_.buffers);
  else look(plan_.textures);
  return found;
}

gpu::Use UseCheck::allows(const Use& use, const SeenUse& seen) const {
  if (use.buffer != seen.buffer || physical(use) != seen.physical) return gpu::Use::None;
  gpu::Use allowed = allowed_uses(use.access, use.buffer);
  if (use.sampled_too) allowed |= gpu::Use::Sampled;
  // Attachments that are filled by copies have the usage for it.
  if (!use.buffer && writes(use.access) && gpu::has(plan_.textures[use.resource].usage, gpu::TextureUsage::CopyDst)) allowed |= gpu::Use::CopyDst;
  return allowed;
}

void UseCheck::recorded(std::size_t i, std::span<const SeenUse> seen, bool successors_work) {
  const PlannedPass& pass = plan_.passes[i];
  ran_[i] = true;
  for (const SeenUse& s : seen) {
    gpu::Use allowed{};
    std::vector<std::string> declared;
    for (std::size_t u = 0; u < pass.uses.size(); ++u) {
      const Use& use = pass.uses[u];
      const gpu::Use by_this = allows(use, s);
      if (!any(by_this)) continue;
      allowed |= by_this;
      declared.push_back(fmt::format("slot '{}' as {}", use.slot, to_string(use.access)));
      if (any(s.use & needed_uses(use.access, use.buffer))) used_[i][u] = true;
    }
    if (successors_work)
      for (const Use& use : plan_.passes[i + 1].uses) allowed |= allows(use, s);
    const auto beyond = static_cast<gpu::Use>(static_cast<std::uint32_t>(s.use) & ~static_cast<std::uint32_t>(allowed));
    if (!any(beyond)) continue;
    fail(Exit::Failed, "G072", {plan_.name},
         fmt::format("pass '{}' (kind '{}') used {} '{}' as {}, which it did not declare.", pass.name, pass.kind,
                     s.buffer ? "the buffer" : "the texture", name(s, i), to_string(beyond)),
         {"it declared of it: " + list_of(declared)});
  }
}

Diagnostics UseCheck::unused() const {
  Diagnostics out;
  for (std::size_t i = 0; i < plan_.passes.size(); ++i)
    for (std::size_t u = 0; ran_[i] && u < plan_.passes[i].uses.size(); ++u) {
      const Use& use = plan_.passes[i].uses[u];
      if (used_[i][u]) continue;
      out.note("G073", {plan_.name}, fmt::format("pass '{}' (kind '{}') declares the slot '{}' as {}, but has not used it in any frame.", plan_.passes[i].name,
                                                 plan_.passes[i].kind, use.slot, to_string(use.access)));
    }
  return out;
}

} // namespace mote::rg
