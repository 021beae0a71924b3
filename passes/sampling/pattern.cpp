// SPDX-License-Identifier: MIT
#include "passes/sampling/pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace mote::passes {
namespace {

constexpr std::array<std::string_view, 4> names{"regular", "random", "jittered", "poisson"};

// std::uniform_real_distribution differs between libraries; the bits of the engine do not.
double uniform(std::mt19937& random) { return (static_cast<double>(random()) + 0.5) / 4294967296.0; }

// Smallest distance to any of `points`, on the torus.
double distance_to(const std::vector<glm::dvec2>& points, const glm::dvec2& p) {
  double least = 2.0;
  for (const glm::dvec2& q : points) {
    const glm::dvec2 d = glm::abs(p - q);
    least = std::min(least, glm::length(glm::min(d, 1.0 - d)));
  }
  return least;
}

std::vector<glm::dvec2> best_candidates(std::uint32_t n, std::mt19937& random) {
  std::vector<glm::dvec2> points;
  while (points.size() < n) {
    glm::dvec2 best(0);
    double farthest = -1.0;
    for (std::size_t i = 0; i < 10 * (points.size() + 1); ++i) {
      const glm::dvec2 p(uniform(random), uniform(random));
      if (const double d = distance_to(points, p); d > farthest) farthest = d, best = p;
    }
    points.push_back(best);
  }
  return points;
}

std::uint32_t side_of(std::uint32_t n) { return static_cast<std::uint32_t>(std::lround(std::sqrt(double(n)))); }

} // namespace

std::span<const std::string_view> sample_pattern_names() { return names; }

std::optional<std::vector<glm::dvec2>> sample_offsets(SamplePattern pattern, std::uint32_t n) {
  if (n == 0 || n > most_samples) return std::nullopt;
  if (n == 1) return std::vector<glm::dvec2>{{0.5, 0.5}};
  std::mt19937 random(n * 4u + static_cast<std::uint32_t>(pattern));
  if (pattern == SamplePattern::Poisson) return best_candidates(n, random);
  std::vector<glm::dvec2> out;
  const std::uint32_t k = side_of(n);
  if (pattern != SamplePattern::Random && k * k != n) return std::nullopt;
  for (std::uint32_t i = 0; i < n; ++i) {
    const glm::dvec2 cell(i % k, i / k);
    if (pattern == SamplePattern::Regular) out.push_back((cell + 0.5) / double(k));
    if (pattern == SamplePattern::Random) out.push_back({uniform(random), uniform(random)});
    if (pattern == SamplePattern::Jittered) out.push_back((cell + glm::dvec2(uniform(random), uniform(random))) / double(k));
  }
  return out;
}

std::vector<glm::dvec2> read_samples(rg::Params& params) {
  const rg::Range range{.min = 1, .max = most_samples};
  SamplePattern pattern = SamplePattern::Jittered;
  std::uint32_t n = 1;
  std::string_view where = "samples";
  rg::Params* level = &params;
  rg::Params table = params;
  if (params.has("samples") && !params.is_table("samples")) {
    n = static_cast<std::uint32_t>(params.integer("samples", 1, range, "samples a pixel, or a table"));
  } else {
    table = params.table("samples", "where samples lie in a pixel; absent: one at its center");
    level = &table;
    where = "n";
    const std::string word = table.word("pattern", "jittered", {"regular", "random", "jittered", "poisson"}, "of the samples");
    pattern = static_cast<SamplePattern>(std::find(names.begin(), names.end(), word) - names.begin());
    n = static_cast<std::uint32_t>(table.integer("n", params.has("samples") ? 16 : 1, range, "samples a pixel"));
  }
  if (auto offsets = sample_offsets(pattern, n)) return *offsets;
  const std::uint32_t k = side_of(n), low = k * k < n ? k : k - 1;
  level->error("P007", where, fmt::format("is {}, but the pattern '{}' makes square numbers only", n, names[static_cast<std::size_t>(pattern)]),
               {fmt::format("The nearest are {} and {}; random and poisson make any number.", low * low, (low + 1) * (low + 1))});
  return {{0.5, 0.5}};
}

} // namespace mote::passes
