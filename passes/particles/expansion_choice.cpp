// SPDX-License-Identifier: MIT
#include "passes/particles/expansion_choice.hpp"

#include "core/base/diagnostic.hpp"
#include "core/gpu/points.hpp"
#include "passes/particles/pipelines.hpp"
#include "passes/particles/tiles/tile_renderer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::passes {
namespace {

constexpr std::uint32_t widest_tiled = 4096 * tile_size; // corners hold 12 bits

std::string why_not_type(Expansion expansion, const ExpansionNeeds& needs) {
  for (const Batch& batch : needs.scene.batches) {
    const ParticleType* type = find_particle_type(batch.type);
    if (needs.selection.draws(batch) && (!type || !supports(*type, expansion, needs.phase)))
      return fmt::format("particle type '{}' cannot be drawn by expansion '{}'", batch.type, to_string(expansion));
  }
  return {};
}

std::string why_not_tiles(const ExpansionNeeds& needs) {
  if (std::string lacks = device_lacks_tiles(needs.device); !lacks.empty())
    return fmt::format("the device has {}, so expansion 'compute' cannot be used", lacks);
  if (!TileRenderer::works(needs.device, needs.color))
    return fmt::format("expansion 'compute' writes rgba8unorm, rgba16float and rgba32float, not {}", gpu::to_string(needs.color));
  if (needs.view.size.width > widest_tiled || needs.view.size.height > widest_tiled)
    return fmt::format("expansion 'compute' draws at most {0} x {0} pixels", widest_tiled);
  if (!needs.beyond_tiles.empty()) return fmt::format("expansion 'compute' cannot draw with {}", needs.beyond_tiles);
  std::uint32_t model = 0; // specular, of the batches so far
  bool mixed = false;
  for (const Batch& batch : needs.scene.batches) {
    if (!needs.selection.draws(batch)) continue;
    if (needs.selection.opacity == Opacity::Opaque && has_own_alpha(batch))
      return fmt::format("expansion 'compute' cannot tell the opaque particles of '{}' from its transparent ones", batch.name);
    const std::uint32_t own = key_for(needs.scene, needs.view, batch).specular_model;
    mixed = mixed || (own != 0 && model != 0 && own != model);
    model = std::max(model, own);
  }
  if (mixed) return "expansion 'compute' draws with one specular model a pass; this scene has Phong and Blinn-Phong materials";
  return {};
}

// Why the model cannot say what tiles would cost; empty: it can.
std::string why_no_costs(const ExpansionNeeds& needs, const std::string& type) {
  if (!type_costs(type)) return fmt::format("what tiles cost with particles of type '{}' was never measured", type);
  for (const Batch& batch : needs.scene.batches)
    if (needs.selection.draws(batch) && batch.type != type)
      return fmt::format("tiles would hold the type '{}' only; what they cost beside particles of type '{}' is not known", type, batch.type);
  return {};
}

} // namespace

std::string device_lacks_tiles(const gpu::Device& device) {
  if (!gpu::has(device.features(), gpu::Feature::Subgroups)) return "no subgroup operations in compute shaders";
  if (TileKernels::lanes(device) == 0) return fmt::format("subgroups of {} invocations, fewer than 4", device.limits().min_subgroup_size);
  return {};
}

std::string why_not(Expansion expansion, const ExpansionNeeds& needs) {
  if (expansion == Expansion::Geometry && !gpu::has(needs.device.features(), gpu::Feature::GeometryShader))
    return "the device has no geometry stage, so expansion 'geometry' cannot be used";
  if (expansion == Expansion::Point && gpu::max_point_size(needs.device) < 8.0f) return "the device has no large points, so expansion 'point' cannot be used";
  const DrawStates tested{.cull = expansion == Expansion::Compute ? Cull::None : needs.states.cull};
  if ((expansion == Expansion::Compute || expansion == Expansion::Point) && needs.states != tested)
    return fmt::format("expansion '{}' draws with the default depth_test, depth_write, blend and cull only", to_string(expansion));
  if (std::string step = why_not(needs.step, expansion); !step.empty()) return step;
  if (std::string type = why_not_type(expansion, needs); !type.empty()) return type;
  return expansion == Expansion::Compute ? why_not_tiles(needs) : std::string();
}

static_assert(costed_expansions.back() == Expansion::Compute);

ExpansionChoice choose_expansion(const ExpansionNeeds& needs, const FrameOptions& options, ExpansionChooser& chooser) {
  std::array<std::string, costed_expansions.size()> refused;
  for (std::size_t i = 0; i < refused.size(); ++i) refused[i] = why_not(costed_expansions[i], needs);
  ExpansionChoice choice;
  if (options.expansion == Expansion::Auto) {
    if (!refused[0].empty()) fail(Exit::Failed, "P001", {}, refused[0], {"mote graph --kinds prints what works together"});
    ViewContents contents = survey(needs.scene, needs.view, needs.selection);
    contents.aovs = needs.aovs;
    if (std::string unknown = why_no_costs(needs, contents.type); !unknown.empty())
      for (std::size_t i = 0; i < refused.size(); ++i)
        if (costed_expansions[i] == Expansion::Compute && refused[i].empty()) refused[i] = unknown;
    const bool edges_by_tiles = needs.edges && refused.back().empty();
    if (edges_by_tiles)
      for (std::size_t i = 0; i + 1 < refused.size(); ++i) refused[i] = "outlines are better by tiles";
    choice = chooser.choose(options.costs ? *options.costs : shipped_costs(gpu::DeviceType::Cpu), contents, refused, options.frames);
    if (edges_by_tiles) choice.why = "tiles have the better outlines";
  } else {
    const std::string reason = why_not(options.expansion, needs);
    std::vector<std::string> can;
    for (std::size_t i = 0; i < refused.size(); ++i)
      if (refused[i].empty()) can.emplace_back(to_string(costed_expansions[i]));
    if (!reason.empty())
      fail(Exit::Failed, "P001", {}, reason, {fmt::format("expansions that work here: {}", list_of(can)), "mote graph --kinds prints what works together"});
    choice.expansion = options.expansion;
    choice.why = "asked for";
  }
  return choice;
}

} // namespace mote::passes
