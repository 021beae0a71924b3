// SPDX-License-Identifier: MIT
#include "render_graph/lifetimes.hpp"

#include <algorithm>
#include <numeric>

namespace mote::rg {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

gpu::TextureUsage texture_usage(Access access) {
  using gpu::TextureUsage;
  switch (access) {
  case Access::Sampled: return TextureUsage::Sampled;
  case Access::DepthRead: return TextureUsage::RenderAttachment | TextureUsage::Sampled;
  case Access::ColorWrite: case Access::ColorReadWrite: case Access::DepthWrite: case Access::DepthReadWrite: return TextureUsage::RenderAttachment;
  case Access::StorageRead: case Access::StorageWrite: case Access::StorageReadWrite: return TextureUsage::Storage;
  case Access::Indirect: break;
  }
  return TextureUsage::None;
}
gpu::BufferUsage buffer_usage(Access access) {
  return access == Access::Indirect ? gpu::BufferUsage::Indirect : gpu::BufferUsage::Storage;
}

class Planner {
public:
  Planner(const Resolved& r, const Order& order, Plan& plan) : r_(r), order_(order), plan_(plan), resource_(r.versions.size(), none) {}

  void run() {
    for (int n : order_.nodes) add_pass(n);
    for (const auto& [text, version] : r_.roots) add_root(text.text, version);
    share(plan_.textures);
    share(plan_.buffers);
  }

private:
  [[nodiscard]] bool is_root(int v) const {
    return std::any_of(r_.roots.begin(), r_.roots.end(), [&](const auto& root) { return root.second == v; });
  }
  [[nodiscard]] bool runs_overwriter(int v) const { return r_.versions[at(v)].overwriter != none && order_.live[at(r_.versions[at(v)].overwriter)]; }
  // Does anybody look at this version after it was written?
  [[nodiscard]] bool wanted(int v) const {
    const Version& version = r_.versions[at(v)];
    return is_root(v) || runs_overwriter(v) ||
           std::any_of(version.readers.begin(), version.readers.end(), [&](const auto& reader) { return order_.live[at(reader.first)]; });
  }
  // Is there a reader after pass `n` has used the version (plan order)?
  [[nodiscard]] bool read_later(int v, std::size_t position) const {
    const Version& version = r_.versions[at(v)];
    const auto later = [&](int n) {
      const auto it = std::find(order_.nodes.begin(), order_.nodes.end(), n);
      return it != order_.nodes.end() && static_cast<std::size_t>(it - order_.nodes.begin()) > position;
    };
    return is_root(v) || (version.overwriter != none && later(version.overwriter)) ||
           std::any_of(version.readers.begin(), version.readers.end(), [&](const auto& reader) { return later(reader.first); });
  }

  void add_pass(int n) {
    const Node& node = r_.nodes[at(n)];
    const auto position = static_cast<std::uint32_t>(plan_.passes.size());
    PlannedPass pass{node.name(), node.desc->kind.text, {}, {}};
    for (std::size_t s = 0; s < node.slots.size(); ++s) {
      const Slot& slot = node.slots[s];
      const int in = node.in[s], out = node.out[s];
      const bool left_out = in < 0 && (out < 0 || (slot.optional && !wanted(out)));
      if (left_out) {
        if (slot.optional) pass.left_out.push_back(slot.name);
        continue;
      }
      pass.uses.push_back(make_use(node, slot, in, out, position));
      touch(pass.uses.back(), position);
      if (slot.copied_into && out >= 0) plan_.textures[pass.uses.back().resource].usage |= gpu::TextureUsage::CopyDst;
      if (slot.sampled_too && out >= 0) plan_.textures[pass.uses.back().resource].usage |= gpu::TextureUsage::Sampled;
    }
    plan_.passes.push_back(std::move(pass));
  }

  Use make_use(const Node&, const Slot& slot, int in, int out, std::uint32_t position) {
    const int v = out >= 0 ? out : in;
    Use use{.slot = slot.name, .access = slot.access, .optional = slot.optional || (slot.makes && in >= 0), .state = slot.state, .sampled_too = slot.sampled_too};
    use.buffer = std::holds_alternative<BufferSpec>(r_.versions[at(v)].spec);
    if (in >= 0) use.source = r_.name(in);
    if (out >= 0) use.gives = r_.name(out);
    if (out >= 0) resource_[at(out)] = in >= 0 ? resource_[at(in)] : make_resource(out, slot.state, position);
    use.resource = static_cast<std::uint32_t>(resource_[at(v)]);
    if (!is_attachment(slot.access)) return use;
    const bool fresh = in < 0 && !slot.state;
    use.load = !fresh ? gpu::LoadOp::Load : slot.covers ? gpu::LoadOp::DontCare : gpu::LoadOp::Clear;
    const bool keep = slot.access == Access::DepthRead || slot.state || read_later(v, position);
    use.store = keep ? gpu::StoreOp::Store : gpu::StoreOp::Discard;
    return use;
  }

  int make_resource(int v, bool state, std::uint32_t position) {
    const Version& version = r_.versions[at(v)];
    if (const auto* buffer = std::get_if<BufferSpec>(&version.spec)) {
      plan_.buffers.push_back({r_.name(v), *buffer, gpu::BufferUsage::CopyDst, position, position, 0, state, version.loc}); // CopyDst: passes clear and fill
      return static_cast<int>(plan_.buffers.size()) - 1;
    }
    const auto usage = state ? gpu::TextureUsage::CopyDst : gpu::TextureUsage::None; // set to zero when reset
    plan_.textures.push_back({r_.name(v), std::get<TextureSpec>(version.spec), usage, position, position, 0, state, version.loc});
    return static_cast<int>(plan_.textures.size()) - 1;
  }

  void touch(const Use& use, std::uint32_t position) {
    if (use.buffer) {
      plan_.buffers[use.resource].last = position;
      plan_.buffers[use.resource].usage |= buffer_usage(use.access);
    } else {
      plan_.textures[use.resource].last = position;
      plan_.textures[use.resource].usage |= texture_usage(use.access);
    }
  }

  // A root that is drawn over later gets a resource of its own and a copy right after its writer.
  void add_root(const std::string& source, int v) {
    const bool buffer = std::holds_alternative<BufferSpec>(r_.versions[at(v)].spec);
    auto resource = static_cast<std::uint32_t>(resource_[at(v)]);
    if (runs_overwriter(v)) {
      const auto it = std::find(order_.nodes.begin(), order_.nodes.end(), r_.versions[at(v)].node);
      const auto after = static_cast<std::uint32_t>(it - order_.nodes.begin());
      const std::uint32_t from = resource;
      resource = static_cast<std::uint32_t>(make_resource(v, false, after));
      if (buffer) plan_.buffers[from].usage |= gpu::BufferUsage::CopySrc;
      else {
        plan_.textures[from].usage |= gpu::TextureUsage::CopySrc;
        plan_.textures[resource].usage |= gpu::TextureUsage::CopyDst;
      }
      plan_.copies.push_back({after, buffer, from, resource});
    }
    if (buffer) plan_.buffers[resource].usage |= gpu::BufferUsage::CopySrc;
    else plan_.textures[resource].usage |= gpu::TextureUsage::CopySrc;
    plan_.roots.push_back({source, buffer, resource});
  }

  template <class Resources> void share(Resources& resources) {
    std::vector<Life> lives;
    for (std::size_t i = 0; i < resources.size(); ++i) {
      auto& resource = resources[i];
      constexpr bool buffers = std::is_same_v<Resources, std::vector<PlannedBuffer>>;
      const bool keep = std::any_of(plan_.roots.begin(), plan_.roots.end(), [&](const Root& root) { return root.buffer == buffers && root.resource == i; });
      if (keep) resource.last = static_cast<std::uint32_t>(plan_.passes.size() - 1);
      const auto same = std::find_if(resources.begin(), resources.end(), [&](const auto& other) { return other.spec == resource.spec; });
      lives.push_back({resource.first, resource.last, resource.state, keep, static_cast<std::size_t>(same - resources.begin())});
    }
    const auto physical = share_memory(lives);
    for (std::size_t i = 0; i < resources.size(); ++i) resources[i].physical = physical[i];
  }

  const Resolved& r_;
  const Order& order_;
  Plan& plan_;
  std::vector<int> resource_; // per version: index into textures or buffers
};

} // namespace

std::vector<std::uint32_t> share_memory(const std::vector<Life>& lives) {
  std::vector<std::size_t> by_first(lives.size());
  std::iota(by_first.begin(), by_first.end(), std::size_t{0});
  std::stable_sort(by_first.begin(), by_first.end(), [&](std::size_t a, std::size_t b) { return lives[a].first < lives[b].first; });
  std::vector<const Life*> holder; // the latest life in each physical resource
  std::vector<std::uint32_t> out(lives.size());
  for (std::size_t i : by_first) {
    const Life& life = lives[i];
    std::size_t p = 0;
    while (p < holder.size() && (life.state || holder[p]->state || holder[p]->keep || holder[p]->same != life.same || holder[p]->last >= life.first)) ++p;
    if (p == holder.size()) holder.push_back(nullptr);
    holder[p] = &life;
    out[i] = static_cast<std::uint32_t>(p);
  }
  return out;
}

void plan_resources(const Resolved& resolved, const Order& order, Plan& plan) { Planner(resolved, order, plan).run(); }

} // namespace mote::rg
