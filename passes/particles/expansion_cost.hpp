// SPDX-License-Identifier: MIT
// Which expansion draws a view at least cost: a small model of what a frame takes with each, and the choice
// between them. Pure: no device, no clock.
//
// A raster expansion (vertex, geometry) pays for each particle in view and for each fragment of its rectangle, hidden or
// not, since the fragment stage writes the depth. Tiles (compute) pay little for a particle in view, much for a (particle,
// tile) pair, but only for particles that are not hidden: where the view is `depth` layers of particles deep on
// average, all but about `seen_layers` of them are culled. All pay for pixels, for AOVs, and once for their pipelines.
//
// The numbers of a device come from `mote calibrate`; without it, shipped ones for its kind serve.
#pragma once

#include "core/gpu/types.hpp"
#include "core/math/camera.hpp"
#include "core/scene/scene.hpp"
#include "passes/frame.hpp"
#include "passes/particles/selection.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::passes {

struct ExpansionCosts {
  double fixed_ms{};    // of a frame, whatever it shows
  double particle_ns{}; // of each particle in view
  double unit_ns{};     // of each fragment (raster) or (visible particle, tile) pair (compute)
  double pixel_ns{};    // of each pixel of the picture, the display transform included
  double pipeline_ms{}; // once
  bool operator==(const ExpansionCosts&) const = default;
};

// Order of the candidates everywhere.
inline constexpr std::array<Expansion, 3> costed_expansions{Expansion::Vertex, Expansion::Geometry, Expansion::Compute};

struct DeviceCosts {
  std::string source{};                  // where the numbers are from, for people
  std::array<ExpansionCosts, 3> costs{}; // as costed_expansions
  double aov_ns{};                       // of each pixel of each AOV
  [[nodiscard]] const ExpansionCosts& of(Expansion expansion) const;
};
// Cpu: what mote calibrate found on lavapipe (two cores, Debian 12), of which only the ratios count elsewhere; estimates that no figure stands behind for other kinds.
DeviceCosts shipped_costs(gpu::DeviceType type);

// What particles of a type cost, times what the model says for spheres of their bounding balls, and once more for the larger
// pipelines of their tiles. Measured on lavapipe with 1e5 particles; ratios, so they serve elsewhere until something better is known.
struct TypeCosts {
  std::string_view type{};
  double raster{1.0}, tiles{1.0}, pipeline_ms{};
};
// Null: not measured.
const TypeCosts* type_costs(std::string_view type);

inline constexpr double seen_layers = 4.0; // of particles that tiles cast before the rest is culled

// What a view holds, on average; estimated from a sample of the chunks.
struct ViewContents {
  double particles{};  // in view
  double radius{};     // mean, projected, pixels
  double fragments{};  // of one particle's rectangle, mean, pixels
  double tiles{};      // that one particle covers, mean
  double span{};       // pixels of the rectangle that bounds what is in view
  double pixels{};     // of the picture
  std::uint32_t aovs{};
  std::string type{"sphere"}; // of most particles in view
  std::uint64_t chunks{}, chunks_total{}; // in view (estimated), of the scene
  [[nodiscard]] double depth() const;     // layers of particles, mean over the span
};
// At most `samples` chunks are looked at, evenly spread over all (instance, chunk) pairs that `selection` draws.
ViewContents survey(const Scene& scene, const View& view, const Selection& selection, std::uint32_t samples = 2048);

// ms of one frame, without pipelines.
double predict_ms(const DeviceCosts& costs, Expansion expansion, const ViewContents& contents);

struct ExpansionCandidate {
  Expansion expansion{};
  std::string refused{};  // why it cannot; empty: it can
  double frame_ms{};      // predicted
  double total_ms{};      // and its share of one-time costs: what is compared
};
struct ExpansionChoice {
  Expansion expansion{Expansion::Vertex};
  std::string why{};
  std::vector<ExpansionCandidate> candidates{}; // as costed_expansions
  ViewContents contents{};
};

// Chooses frame by frame. What was chosen last stays until another is cheaper by a quarter, so that a
// moving view does not flip between two that cost the same.
class ExpansionChooser {
public:
  // `refused`: reasons as costed_expansions, empty where one can serve; the first (vertex) always can. `frames`: how many
  // are expected; the one-time cost of an expansion that was not used before is divided by it.
  ExpansionChoice choose(const DeviceCosts& costs, const ViewContents& contents, std::span<const std::string, 3> refused, double frames);

private:
  std::optional<Expansion> current_{};
  std::array<bool, 3> made_{}; // pipelines are there
};

// One measured frame and what the model needs to know of it.
struct CostSample {
  ViewContents contents{};
  double ms{}; // measured, AOVs not wanted
};
// The costs that fit the samples best, none negative: least squares of the relative error. pipeline_ms is left at 0.
// Needs at least four samples that differ.
ExpansionCosts fit_costs(Expansion expansion, std::span<const CostSample> samples);

} // namespace mote::passes
