// SPDX-License-Identifier: MIT
#include "render_graph/idle.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace mote::rg {
namespace {

struct Need {
  bool soft{}; // a running pass reads it
  bool hard{}; // ... and cannot do without, or a root is
};

bool passes_through(const Use& use) { return !use.source.empty() && !use.gives.empty(); }
// The set of attachments of a pass never changes, so a read-only one cannot go missing.
bool can_miss(const Use& use) { return use.optional && (!is_attachment(use.access) || writes(use.access)); }

} // namespace

FrameChoice choose_passes(const Plan& plan, const std::vector<std::string>& idle_reasons) {
  FrameChoice out{std::vector<std::string>(plan.passes.size()), {}};
  std::map<std::string, Need> need;
  for (const Root& root : plan.roots) need[root.source] = {true, true};
  for (std::size_t i = plan.passes.size(); i-- > 0;) {
    const PlannedPass& pass = plan.passes[i];
    bool can_skip = true, wanted = false;
    for (const Use& use : pass.uses) {
      const Need of_use = use.gives.empty() ? Need{} : need[use.gives];
      can_skip = can_skip && (passes_through(use) || !of_use.hard);
      wanted = wanted || of_use.soft || use.state;
    }
    if (!wanted) out.skipped[i] = "nothing reads it in this frame";
    else if (can_skip) out.skipped[i] = idle_reasons[i];
    for (const Use& use : pass.uses) {
      if (use.source.empty()) continue;
      const Need given = use.gives.empty() ? Need{} : need[use.gives];
      Need& source = need[use.source];
      if (out.skipped[i].empty()) source = {true, source.hard || !can_miss(use)};
      else if (passes_through(use)) source = {source.soft || given.soft, source.hard || given.hard};
    }
  }
  std::set<std::string> gone;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    std::vector<bool>& missing = out.missing.emplace_back();
    for (const Use& use : plan.passes[i].uses) {
      missing.push_back(!use.source.empty() && gone.contains(use.source));
      const bool fresh = use.source.empty() || missing.back();
      if (!out.skipped[i].empty() && !use.gives.empty() && fresh) gone.insert(use.gives);
    }
  }
  return out;
}

} // namespace mote::rg
