// SPDX-License-Identifier: MIT
#include "passes/particles/selection.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/particles/particle_type.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::passes {
namespace {
constexpr std::array<std::string_view, 3> words{"opaque", "transparent", "all"}; // order of Opacity
}

Selection read_selection(rg::Params& params, Opacity fallback) {
  Selection selection;
  selection.opacity = fallback;
  for (const rg::LocatedString& item : params.draw()) {
    const auto word = std::find(words.begin(), words.end(), item.text);
    if (word != words.end()) {
      selection.opacity = static_cast<Opacity>(word - words.begin());
    } else if (find_particle_type(item.text)) {
      selection.types.push_back(item.text);
    } else {
      std::vector<std::string> known = particle_type_names();
      const std::string types = list_of(known);
      known.insert(known.end(), words.begin(), words.end());
      params.error_at("G031", item.loc, fmt::format("there is no particle type '{}'", item.text),
                      {fmt::format("particle types: {}; besides: opaque, transparent, all", types), did_you_mean(item.text, known)});
    }
  }
  return selection;
}

bool has_own_alpha(const Batch& batch) {
  struct Known {
    std::weak_ptr<const ChunkSet> set;
    bool alpha{};
  };
  static thread_local std::vector<Known> known; // so that nobody looks at every particle in every frame
  if (!batch.chunks || batch.chunks->colors.empty()) return false;
  for (const Known& k : known)
    if (k.set.lock() == batch.chunks) return k.alpha;
  const ChunkSet& set = *batch.chunks;
  bool alpha = false;
  for (std::size_t i = 0; i < set.colors.size() && !alpha; ++i) alpha = set.colors[i] >> 24 != 255u && (set.paletted() || set.rows[i] != no_row);
  std::erase_if(known, [](const Known& k) { return k.set.expired(); });
  known.push_back({batch.chunks, alpha});
  return alpha;
}

bool may_be_transparent(const Batch& batch) { return batch.alpha < 1.0 || has_own_alpha(batch); }

bool Selection::draws(const Batch& batch) const {
  const std::string name = batch.type.substr(0, batch.type.find('#')); // of a type from files whose text has changed
  if (!types.empty() && std::find(types.begin(), types.end(), name) == types.end()) return false;
  if (opacity == Opacity::Opaque) return batch.alpha >= 1.0;
  return opacity == Opacity::All || may_be_transparent(batch);
}

} // namespace mote::passes
