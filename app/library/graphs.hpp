// SPDX-License-Identifier: MIT
// Which graph draws, and what of it is wanted. Finds the graph (shipped ones are embedded, so that the
// library needs no files), applies settings, works out which sources answer AOVs and linear pictures,
// and compiles. No device.
#pragma once

#include "core/base/diagnostic.hpp"
#include "render_graph/compile.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::app {

enum class Aov : std::uint8_t { Depth, Id, Normal };
inline constexpr std::array<std::string_view, 3> aov_names{"depth", "id", "normal"};

struct GraphRequest {
  std::string graph{"default"};             // shipped name or path
  SourceLoc loc{};                          // where that stands
  std::filesystem::path folder{};           // that a relative path is relative to
  std::vector<std::string> settings{};      // "pass.parameter=value"
  std::vector<std::string> opaque_settings{}; // "parameter=value" for every pass of kind opaque_impostors
  bool opaque_settings_yield{};             // to passes that say something of samples, edges, blend or steps themselves
  std::vector<Aov> aovs{};
  bool every_aov{};                         // whatever AOVs the graph makes
  std::vector<rg::LocatedString> dumps{};   // further sources
  bool linear{};                            // the picture before the display transform, too
  bool deep{};                              // the output in float instead of 8 bits
  bool depth_if_made{};                     // depth as well, if the graph makes it
};

// What the display pass at the end of a graph says about its transform.
struct PassDisplay {
  std::string display{}, view{}; // empty: it leaves them to others
  double exposure{};             // stops
};

struct ReadyGraph {
  rg::Plan plan{};
  std::vector<std::shared_ptr<rg::Pass>> passes{};
  std::string output{}; // source of the picture
  std::string linear{}; // source of the scene-linear picture; empty if not asked for
  std::map<Aov, std::string> aovs{};
  PassDisplay shown{};
  std::set<std::string> blending{}; // passes of kind opaque_impostors that draw transparent particles, too
};

std::vector<std::string> shipped_graphs();
// What --set may name first: the passes of the graph. Empty when the graph cannot be read.
std::vector<std::string> pass_names(const rg::GraphDesc& graph);

// Throws Failure (Usage, A006) for a shipped name that does not exist; other problems go to `diagnostics`.
rg::GraphDesc load_graph(const GraphRequest& request, Diagnostics& diagnostics);
// The files that the graph is made of: its own, what it includes, shaders of its passes and their pass.toml; also those that are not there or
// broken, so that a change of them is a reason to read it again. Empty for shipped graphs.
std::vector<std::string> graph_files(const GraphRequest& request);
// Nothing when `diagnostics` then has errors.
std::optional<ReadyGraph> ready_graph(const GraphRequest& request, Diagnostics& diagnostics);

// Whether transparent particles have one surface in this graph (`surfaces = "front"` of its sorted_glyphs pass); false
// where there is no such graph or pass.
bool has_front_surfaces_only(const GraphRequest& request);

// All kinds that mote has.
const rg::Registry& registry();

// "scene key" or "pass": what a setting's path starts with.
std::string_view first_word(std::string_view setting);
struct Settings {
  std::vector<std::string> scene{}, graph{};
};
// Those that start with a key of the scene file, and the rest.
Settings split_settings(std::span<const std::string> settings);

} // namespace mote::app
