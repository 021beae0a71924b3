// SPDX-License-Identifier: MIT
#include "passes/particles/expansion_cost.hpp"

#include "passes/particles/placement.hpp"
#include "passes/particles/tiles/tile_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace mote::passes {
namespace {

constexpr double stay = 0.75; // another expansion must cost less than this times the one in use

std::size_t index_of(Expansion expansion) {
  const auto it = std::find(costed_expansions.begin(), costed_expansions.end(), expansion);
  return it == costed_expansions.end() ? 0 : static_cast<std::size_t>(it - costed_expansions.begin());
}

// mote bench at 1280x720: sticks:1e5:fit, arrows:1e5:fit, and spheres:1e5:fit drawn as the other types.
constexpr std::array<TypeCosts, 8> measured_types{{{"sphere", 1.0, 1.0, 0.0},
                                                   {"capsule", 1.0, 3.8, 1500.0},
                                                   {"cylinder", 1.0, 3.8, 1500.0},
                                                   {"cone", 1.0, 4.5, 2000.0},
                                                   {"arrow", 1.0, 4.7, 2200.0},
                                                   {"ellipsoid", 1.7, 3.9, 1000.0},
                                                   {"box", 1.25, 2.6, 1400.0},
                                                   {"superquadric", 8.0, 34.0, 1500.0}}};

// Numbers of particles, units and pixels that the model multiplies its costs with.
std::array<double, 4> terms(Expansion expansion, const ViewContents& c) {
  const TypeCosts* known = type_costs(c.type);
  const double factor = !known ? 1.0 : expansion == Expansion::Compute ? known->tiles : known->raster;
  if (expansion != Expansion::Compute) return {1.0, factor * c.particles, factor * c.particles * c.fragments, c.pixels};
  const double depth = c.depth(), visible = depth > seen_layers ? c.particles * seen_layers / depth : c.particles;
  return {1.0, c.particles, factor * visible * c.tiles, c.pixels};
}

// Solves a symmetric 4x4 system restricted to the unknowns in `used`; the others are 0. Gauss elimination with a ridge that
// keeps it solvable when two terms are nearly the same.
std::array<double, 4> solve(std::array<std::array<double, 4>, 4> a, std::array<double, 4> b, const std::array<bool, 4>& used) {
  for (std::size_t i = 0; i < 4; ++i) {
    a[i][i] = a[i][i] * (1.0 + 1e-9) + 1e-300;
    if (used[i]) continue;
    for (std::size_t k = 0; k < 4; ++k) a[i][k] = a[k][i] = 0.0;
    a[i][i] = 1.0;
    b[i] = 0.0;
  }
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t r = i + 1; r < 4; ++r) {
      const double f = a[r][i] / a[i][i];
      for (std::size_t k = i; k < 4; ++k) a[r][k] -= f * a[i][k];
      b[r] -= f * b[i];
    }
  std::array<double, 4> x{};
  for (std::size_t i = 4; i-- > 0;) {
    x[i] = b[i];
    for (std::size_t k = i + 1; k < 4; ++k) x[i] -= a[i][k] * x[k];
    x[i] /= a[i][i];
  }
  return x;
}

// Sums over what is sampled of a view.
class Survey {
public:
  explicit Survey(const View& view) : view_(view), offset_(0.5 * glm::dvec2(view.size.width, view.size.height)) {}

  void add(const Chunk& chunk, double radius, const PlacedBox& box) {
    const bool perspective = view_.projection == Projection::Perspective;
    const double z = perspective ? std::max(box.center.z, std::max(radius, view_.depth_near)) : 1.0;
    const double r = radius * view_.focal / z, side = 2.0 * r + 1.0, tiles = 2.0 * r / tile_size + 1.0;
    const double pixels = double(view_.size.width) * view_.size.height;
    ++chunks;
    particles += chunk.count;
    radii += chunk.count * r;
    fragments += chunk.count * std::min(side * side, pixels);
    covered += chunk.count * std::min(tiles * tiles, pixels / (tile_size * tile_size) + 1.0);
    const glm::dvec2 center = glm::dvec2(box.center) / z * view_.focal + offset_, half = glm::dvec2(box.extent) / z * view_.focal;
    lo = glm::min(lo, center - half);
    hi = glm::max(hi, center + half);
  }
  [[nodiscard]] double span() const {
    const glm::dvec2 size = glm::min(hi, 2.0 * offset_) - glm::max(lo, glm::dvec2(0));
    return std::max(size.x, 1.0) * std::max(size.y, 1.0);
  }

  std::uint64_t chunks{};
  double particles{}, radii{}, fragments{}, covered{};

private:
  const View& view_;
  glm::dvec2 offset_, lo{1e30}, hi{-1e30};
};

} // namespace

const TypeCosts* type_costs(std::string_view type) {
  const auto it = std::find_if(measured_types.begin(), measured_types.end(), [&](const TypeCosts& t) { return t.type == type; });
  return it == measured_types.end() ? nullptr : &*it;
}

const ExpansionCosts& DeviceCosts::of(Expansion expansion) const { return costs[index_of(expansion)]; }

DeviceCosts shipped_costs(gpu::DeviceType type) {
  if (type == gpu::DeviceType::Cpu)
    return {"shipped for devices that are a processor (lavapipe, two cores)",
            {{{0.0, 1300.0, 8.5, 22.0, 30.0}, {0.0, 1300.0, 8.5, 22.0, 30.0}, {4.0, 5.0, 225.0, 2.5, 130.0}}},
            4.0};
  // A device of its own rasterizes quickly; estimated from published rates, no figure of ours stands behind them.
  return {"shipped for graphics processors (estimates)",
          {{{0.1, 1.0, 0.02, 0.05, 30.0}, {0.1, 2.0, 0.02, 0.05, 30.0}, {0.3, 0.2, 0.3, 0.05, 60.0}}},
          0.02};
}

double ViewContents::depth() const {
  return span > 0 ? particles * std::numbers::pi * radius * radius / span : 0.0;
}

ViewContents survey(const Scene& scene, const View& view, const Selection& selection, std::uint32_t samples) {
  ViewContents out;
  out.pixels = double(view.size.width) * view.size.height;
  for (const Batch& batch : scene.batches)
    if (selection.draws(batch)) out.chunks_total += batch.chunks->chunks.size() * batch.instances.size();
  const std::uint64_t step = std::max<std::uint64_t>(1, out.chunks_total / std::max(samples, 1u)) | 1u; // odd: in step with few numbers of chunks
  const ViewCuller culler(view);
  Survey sums(view);
  std::map<std::string, double> of_types; // particles
  std::uint64_t at = 0, looked = 0; // at: offset of the next sample in this batch's (instance, chunk) pairs
  for (const Batch& batch : scene.batches) {
    if (!selection.draws(batch)) continue;
    const ChunkSet& set = *batch.chunks;
    const std::uint64_t chunks = set.chunks.size(), pairs = chunks * batch.instances.size();
    PlacedBox box;
    for (; at < pairs; at += step, ++looked) {
      const ChunkPlacer placer(batch.instances[at / chunks], view, culler);
      const Chunk& chunk = set.chunks[at % chunks];
      if (chunk.count == 0 || !placer.place(chunk, box)) continue;
      const std::uint64_t record = (at % chunks) * chunk_capacity + looked % chunk.count; // one stands for all of its chunk
      of_types[batch.type] += chunk.count;
      sums.add(chunk, placer.scale() * double{set.records[record * set.vec4s_per_record].w}, box);
    }
    at -= pairs;
  }
  if (sums.chunks == 0) return out;
  const double each = double(out.chunks_total) / double(std::max<std::uint64_t>(looked, 1));
  out.chunks = static_cast<std::uint64_t>(std::llround(double(sums.chunks) * each));
  out.particles = sums.particles * each;
  out.radius = sums.radii / sums.particles;
  out.fragments = sums.fragments / sums.particles;
  out.tiles = sums.covered / sums.particles;
  out.span = sums.span();
  out.type = std::max_element(of_types.begin(), of_types.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
  return out;
}

double predict_ms(const DeviceCosts& costs, Expansion expansion, const ViewContents& contents) {
  const ExpansionCosts& c = costs.of(expansion);
  const std::array<double, 4> n = terms(expansion, contents);
  return c.fixed_ms + 1e-6 * (n[1] * c.particle_ns + n[2] * c.unit_ns + n[3] * (c.pixel_ns + contents.aovs * costs.aov_ns));
}

ExpansionChoice ExpansionChooser::choose(const DeviceCosts& costs, const ViewContents& contents, std::span<const std::string, 3> refused, double frames) {
  ExpansionChoice out;
  out.contents = contents;
  const ExpansionCandidate* best = nullptr;
  out.candidates.resize(costed_expansions.size());
  for (std::size_t i = 0; i < costed_expansions.size(); ++i) {
    ExpansionCandidate& candidate = out.candidates[i];
    candidate = {costed_expansions[i], refused[i], predict_ms(costs, costed_expansions[i], contents), 0.0};
    const TypeCosts* type = costed_expansions[i] == Expansion::Compute ? type_costs(contents.type) : nullptr;
    const double once = costs.costs[i].pipeline_ms + (type ? type->pipeline_ms : 0.0);
    candidate.total_ms = candidate.frame_ms + (made_[i] ? 0.0 : once / std::max(frames, 1.0));
    if (candidate.refused.empty() && (!best || candidate.total_ms < best->total_ms)) best = &candidate;
  }
  if (!best) best = &out.candidates.front();
  out.why = "the least predicted cost";
  if (current_ && *current_ != best->expansion) {
    const ExpansionCandidate& now = out.candidates[index_of(*current_)];
    if (now.refused.empty() && best->total_ms > stay * now.total_ms) {
      out.why = fmt::format("{} is not cheaper by a quarter", to_string(best->expansion));
      best = &now;
    }
  }
  out.expansion = best->expansion;
  current_ = best->expansion;
  made_[index_of(best->expansion)] = true;
  return out;
}

ExpansionCosts fit_costs(Expansion expansion, std::span<const CostSample> samples) {
  std::array<std::array<double, 4>, 4> a{};
  std::array<double, 4> b{};
  const std::array<double, 4> scale{1.0, 1e-6, 1e-6, 1e-6};
  for (const CostSample& sample : samples) {
    std::array<double, 4> row = terms(expansion, sample.contents);
    for (std::size_t i = 0; i < 4; ++i) row[i] *= scale[i] / sample.ms; // relative error
    for (std::size_t i = 0; i < 4; ++i) {
      b[i] += row[i];
      for (std::size_t k = 0; k < 4; ++k) a[i][k] += row[i] * row[k];
    }
  }
  // Few unknowns: of all sets of them whose solution is not negative, the best.
  std::array<double, 4> best{};
  double least = 1e300;
  for (unsigned mask = 1; mask < 16; ++mask) {
    const std::array<double, 4> x = solve(a, b, {(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0, (mask & 8) != 0});
    if (std::any_of(x.begin(), x.end(), [](double v) { return !(v >= 0.0); })) continue;
    double error = 0.0; // sum of squares, up to a constant
    for (std::size_t i = 0; i < 4; ++i) {
      error -= 2.0 * x[i] * b[i];
      for (std::size_t k = 0; k < 4; ++k) error += x[i] * a[i][k] * x[k];
    }
    if (error < least) {
      least = error;
      best = x;
    }
  }
  return {best[0], best[1], best[2], best[3], 0.0};
}

} // namespace mote::passes
