// SPDX-License-Identifier: MIT
#include "core/scene/chunks.hpp"

#include "core/base/parallel.hpp"
#include "core/scene/morton.hpp"
#include "core/scene/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mote {
namespace {

constexpr std::uint64_t chunks_per_thread = 256;

// A float32 offset of at most this many radii is off by at most 2^-25 * 16384 = 4.9e-4 radii: under the bar of 1e-3.
constexpr double reach_in_radii = 16384.0;
// Two neighbors in the order that lie this much farther apart than the run's median neighbors belong to different clusters.
constexpr double gap_factor = 256.0;

struct Sorted { // particles in Morton order
  std::vector<std::uint32_t> order{}; // index in the caller's arrays
  std::vector<glm::dvec3> centers{};
  std::vector<double> finest{};
};

Sorted sort_particles(const ParticleArrays& particles) {
  Sorted s;
  const std::span<const double> finest = particles.finest.empty() ? particles.radii : particles.finest;
  const std::size_t count = particles.centers.size();
  s.order = morton_order(particles.centers);
  s.centers.resize(count);
  s.finest.resize(count);
  parallel_parts(count, thread_count(count, chunks_per_thread * chunk_capacity),
                 [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
                   for (std::uint64_t k = begin; k < end; ++k) {
                     s.centers[k] = particles.centers[s.order[k]];
                     s.finest[k] = finest[s.order[k]];
                   }
                 });
  return s;
}

struct Run {
  std::uint64_t begin{}, end{};       // places in the Morton order
  glm::dvec3 min{0}, max{0};          // of the centers
  double smallest_radius{};
  std::uint64_t cut{};                // place in the order behind the widest step
  double widest_step{}, median_step{}; // between neighbors in the order; largest coordinate difference
  [[nodiscard]] double reach() const { return 0.5 * std::max({max.x - min.x, max.y - min.y, max.z - min.z}); }
  // Does the widest step lead to another cluster, or are offsets too coarse for the smallest radius?
  [[nodiscard]] bool too_wide() const {
    return end - begin > 1 &&
           (reach() > reach_in_radii * smallest_radius || widest_step > gap_factor * median_step);
  }
};

Run measure(const Sorted& in, std::uint64_t begin, std::uint64_t end) {
  Run run{begin, end, in.centers[begin], in.centers[begin], in.finest[begin], begin + 1, 0.0, 0.0};
  std::array<double, chunk_capacity> steps{};
  for (std::uint64_t k = begin + 1; k < end; ++k) {
    run.min = glm::min(run.min, in.centers[k]);
    run.max = glm::max(run.max, in.centers[k]);
    run.smallest_radius = std::min(run.smallest_radius, in.finest[k]);
    const glm::dvec3 step = glm::abs(in.centers[k] - in.centers[k - 1]);
    const double width = std::max({step.x, step.y, step.z});
    steps[k - begin - 1] = width;
    if (width > run.widest_step) {
      run.widest_step = width;
      run.cut = k;
    }
  }
  const auto count = static_cast<std::ptrdiff_t>(end - begin - 1);
  std::nth_element(steps.begin(), steps.begin() + count / 2, steps.begin() + count);
  run.median_step = steps[static_cast<std::size_t>(count / 2)];
  return run;
}

// Cuts a run that is too wide at its widest step, and goes on with both parts while `budget` (further chunks) lasts.
// The budget keeps dust (tiny radii, wide spacing) from filling one chunk per particle: there the error stays below
// 6e-8 of the chunk's extent.
void split(const Sorted& in, const Run& run, std::uint64_t& budget, std::vector<Run>& out) {
  if (budget == 0 || !run.too_wide()) {
    out.push_back(run);
    return;
  }
  --budget;
  split(in, measure(in, run.begin, run.cut), budget, out);
  split(in, measure(in, run.cut, run.end), budget, out);
}

std::vector<Run> make_runs(const Sorted& in) {
  const std::uint64_t n = in.order.size();
  std::vector<Run> full((n + chunk_capacity - 1) / chunk_capacity);
  parallel_parts(full.size(), thread_count(full.size(), chunks_per_thread),
                 [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
                   for (std::uint64_t c = begin; c < end; ++c)
                     full[c] = measure(in, c * chunk_capacity, std::min(n, (c + 1) * chunk_capacity));
                 });
  std::uint64_t budget = 4096 + full.size() / 2;
  std::vector<Run> runs;
  runs.reserve(full.size());
  for (const Run& run : full) split(in, run, budget, runs);
  return runs;
}

// The middle of the box on a grid of about 1/32 of its reach: a coordinate with few digits (one read from a
// float32) then has an offset that float32 holds without rounding.
glm::dvec3 rounded_origin(const Run& run) {
  const glm::dvec3 middle = run.min + (run.max - run.min) * 0.5;
  const double reach = run.reach();
  if (!(reach > 0.0)) return middle;
  const double step = std::exp2(std::floor(std::log2(reach)) - 5.0);
  glm::dvec3 origin = glm::round(middle / step) * step;
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(origin[k])) origin[k] = middle[k]; // middle / step beyond a double
  return origin;
}

float below(double x) {
  const float f = static_cast<float>(x);
  return f <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
float above(double x) {
  const float f = static_cast<float>(x);
  return f >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

void fill_chunk(const ParticleArrays& from, const Sorted& in, const Run& run, std::uint64_t c, const std::optional<Palette>& palette, ChunkSet& set) {
  const std::uint64_t rest = set.vec4s_per_record - 1;
  Chunk chunk;
  chunk.origin = rounded_origin(run);
  chunk.count = static_cast<std::uint32_t>(run.end - run.begin);
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (std::uint64_t k = run.begin; k < run.end; ++k) {
    const std::uint32_t i = in.order[k];
    const std::uint64_t place = c * chunk_capacity + (k - run.begin);
    const glm::vec4 record(glm::vec3(in.centers[k] - chunk.origin), static_cast<float>(from.radii[i]));
    const auto to = set.records.begin() + static_cast<std::ptrdiff_t>(place * set.vec4s_per_record);
    *to = record;
    std::copy_n(from.rest.begin() + static_cast<std::ptrdiff_t>(i * rest), rest, to + 1);
    chunk.max_radius = std::max(chunk.max_radius, record.w);
    set.rows[place] = from.rows[i];
    if (palette) set.color_indices[place] = palette->index_of(from.colors[i]);
    else if (!from.colors.empty()) set.colors[place] = from.colors[i];
    const glm::dvec3 half = from.half.empty() ? glm::dvec3(double{record.w}) : from.half[i];
    low = glm::min(low, glm::dvec3(record) - half);
    high = glm::max(high, glm::dvec3(record) + half);
  }
  for (int k = 0; k < 3; ++k) {
    chunk.box_min[k] = below(low[k]);
    chunk.box_max[k] = above(high[k]);
  }
  set.chunks[c] = chunk;
}

} // namespace

ChunkSet build_chunks(const ParticleArrays& particles) {
  ChunkSet set;
  set.vec4s_per_record = particles.vec4s_per_record;
  if (particles.centers.empty()) return set;
  const Sorted in = sort_particles(particles);
  const std::vector<Run> runs = make_runs(in);
  set.chunks.resize(runs.size());
  set.records.assign(set.record_count() * set.vec4s_per_record, glm::vec4(0.0f));
  set.rows.assign(set.record_count(), no_row);
  const std::optional<Palette> palette = find_palette(particles.colors);
  if (palette) {
    set.colors.assign(palette->colors().begin(), palette->colors().end());
    set.color_indices.assign(set.record_count(), std::uint8_t{0});
  } else if (!particles.colors.empty()) {
    set.colors.assign(set.record_count(), 0u);
  }
  parallel_parts(runs.size(), thread_count(runs.size(), chunks_per_thread),
                 [&](std::uint32_t, std::uint64_t begin, std::uint64_t end) {
                   for (std::uint64_t c = begin; c < end; ++c) fill_chunk(particles, in, runs[c], c, palette, set);
                 });
  for (const Chunk& chunk : set.chunks) {
    set.bounds.add(chunk.origin + glm::dvec3(chunk.box_min));
    set.bounds.add(chunk.origin + glm::dvec3(chunk.box_max));
  }
  return set;
}

ChunkSet build_spheres(std::span<const glm::dvec3> centers, std::span<const double> radii,
                       std::span<const std::uint32_t> rows, std::span<const std::uint32_t> colors) {
  return build_chunks({.centers = centers, .radii = radii, .rows = rows, .colors = colors});
}

} // namespace mote
