// SPDX-License-Identifier: MIT
#include "core/compare/compare.hpp"

#include "core/base/diagnostic.hpp"
#include "core/compare/codes.hpp"
#include "core/compare/color_difference.hpp"
#include "core/compare/flip.hpp"
#include "core/compare/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mote::compare {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_length(const CompareInput& p, std::string_view what, std::size_t n) {
  const std::size_t pixels = std::size_t{p.width} * p.height;
  if (n != 0 && n != pixels)
    fail(Exit::BadInput, compare_codes::wrong_length, {p.name},
         fmt::format("{} has {} values, but {} x {} pixels need {}.", what, n, p.width, p.height, pixels));
}

bool has_depth(const CompareInput& a, const CompareInput& b) { return !a.depth.empty() && !b.depth.empty(); }
bool has_ids(const CompareInput& a, const CompareInput& b) { return !a.id.empty() && !b.id.empty(); }
bool has_normals(const CompareInput& a, const CompareInput& b) {
  return !a.normal.empty() && !b.normal.empty();
}
bool has_colors(const CompareInput& a, const CompareInput& b) { return !a.color.empty() && !b.color.empty(); }

void check(const CompareInput& a, const CompareInput& b) {
  for (const CompareInput* p : {&a, &b}) {
    check_length(*p, "depth", p->depth.size());
    check_length(*p, "id", p->id.size());
    check_length(*p, "normal", p->normal.size());
    check_length(*p, "color", p->color.size());
    check_length(*p, "the ambiguity mask", p->ambiguous.size());
    check_length(*p, "projected_radius", p->projected_radius.size());
  }
  if (a.width != b.width || a.height != b.height)
    fail(
        Exit::BadInput, compare_codes::sizes_differ, {a.name},
        fmt::format("is {} x {} pixels, but '{}' is {} x {}.", a.width, a.height, b.name, b.width, b.height));
  if (!a.camera.empty() && !b.camera.empty() && a.camera != b.camera)
    fail(Exit::BadInput, compare_codes::cameras_differ, {a.name}, fmt::format("was drawn by another camera than '{}'.", b.name),
         {fmt::format("'{}': {}", a.name, a.camera), fmt::format("'{}': {}", b.name, b.camera)});
  if (has_depth(a, b) || has_ids(a, b) || has_normals(a, b) || has_colors(a, b)) return;
  const auto parts = [](const CompareInput& p) {
    std::vector<std::string> words;
    if (!p.depth.empty()) words.emplace_back("depth");
    if (!p.id.empty()) words.emplace_back("id");
    if (!p.normal.empty()) words.emplace_back("normal");
    if (!p.color.empty()) words.emplace_back("color");
    return list_of(words);
  };
  fail(Exit::BadInput, compare_codes::nothing_common, {a.name},
       fmt::format("has nothing that '{}' has too, so there is nothing to compare.", b.name),
       {fmt::format("'{}' has {}", a.name, parts(a)), fmt::format("'{}' has {}", b.name, parts(b))});
}

// What each pixel shows, as far as both pictures can tell: ids, or 0 / no_id from the depths, or nothing
// known.
std::vector<std::uint32_t> shown(const CompareInput& p, bool ids, bool depths) {
  if (ids) return p.id;
  std::vector<std::uint32_t> out(depths ? p.depth.size() : 0);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::isfinite(p.depth[i]) ? 0u : no_id;
  return out;
}

// The two pictures and what is common to all measures.
struct Pair {
  const CompareInput& a;
  const CompareInput& b;
  std::size_t pixels{};
  std::vector<std::uint32_t> seen_a{}, seen_b{}; // empty: neither ids nor depths
  Pair(const CompareInput& x, const CompareInput& y) : a(x), b(y) {
    check(a, b);
    pixels = std::size_t{a.width} * a.height;
    seen_a = shown(a, has_ids(a, b), has_depth(a, b));
    seen_b = shown(b, has_ids(a, b), has_depth(a, b));
  }
  [[nodiscard]] bool ambiguous(std::size_t i) const {
    return (!a.ambiguous.empty() && a.ambiguous[i]) || (!b.ambiguous.empty() && b.ambiguous[i]);
  }
  [[nodiscard]] bool same_surface(std::size_t i) const { // ... and something at all; unknown counts as yes
    return seen_a.empty() || (seen_a[i] == seen_b[i] && seen_b[i] != no_id);
  }
};

// Value below which a share of the values lies (nearest rank); 0 of none. Reorders.
double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * double(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Spread spread(std::vector<double>& values) {
  return {percentile(values, 0.5), percentile(values, 0.99), percentile(values, 1.0)};
}

// The spacing of float32 numbers at |x|.
double float_ulp(double x) {
  const float f = static_cast<float>(std::abs(x));
  return double(std::nextafter(f, std::numeric_limits<float>::infinity())) - double(f);
}

double not_nan(double x) { return std::isnan(x) ? infinity : x; }

IdDifference compare_ids(const Pair& p) {
  IdDifference d;
  for (std::size_t i = 0; i < p.pixels; ++i) {
    if (p.ambiguous(i)) continue;
    ++d.compared;
    const std::uint32_t a = p.seen_a[i], b = p.seen_b[i];
    if (a == b) continue;
    ++(b == no_id ? d.extra : a == no_id ? d.missing : d.wrong);
  }
  return d;
}

DepthDifference compare_depths(const Pair& p) {
  std::vector<double> relative, ulps;
  for (std::size_t i = 0; i < p.pixels; ++i) {
    if (p.ambiguous(i) || !p.same_surface(i)) continue;
    const double a = p.a.depth[i], b = p.b.depth[i], error = a == b ? 0.0 : std::abs(a - b);
    relative.push_back(not_nan(error == 0.0 ? 0.0 : error / std::abs(b)));
    ulps.push_back(not_nan(error == 0.0 ? 0.0 : error / float_ulp(b)));
  }
  return {relative.size(), spread(relative), spread(ulps)};
}

NormalDifference compare_normals(const Pair& p) {
  std::vector<double> angles;
  const bool barred = !p.b.projected_radius.empty();
  std::uint64_t beyond = 0;
  for (std::size_t i = 0; i < p.pixels; ++i) {
    if (p.ambiguous(i) || !p.same_surface(i)) continue;
    const glm::dvec3 a(p.a.normal[i]), b(p.b.normal[i]);
    const bool none_a = a == glm::dvec3(0), none_b = b == glm::dvec3(0);
    if (none_a && none_b) continue; // the background of a picture without ids and depths
    // exact for small angles, unlike the arc cosine
    const double angle =
        none_a != none_b ? infinity : not_nan(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
    angles.push_back(angle);
    if (barred && !(angle <= normal_bar(double(p.b.projected_radius[i])))) ++beyond;
  }
  NormalDifference d{angles.size(), spread(angles), {}};
  if (barred) d.beyond_bar = beyond;
  return d;
}

// Display values times alpha, or nullopt where a number is not finite.
std::optional<glm::dvec4> display(const CompareInput& p, std::size_t i) {
  glm::dvec4 c(p.color[i]);
  for (int k = 0; k < 4; ++k)
    if (!std::isfinite(c[k])) return std::nullopt;
  if (p.encoding == Encoding::Linear)
    for (int k = 0; k < 3; ++k) c[k] = srgb_encode(c[k]);
  return glm::dvec4(glm::dvec3(c) * c.a, c.a);
}

ColorDifference compare_colors(const Pair& p) {
  ColorDifference d;
  std::vector<double> differences;
  double squares = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < p.pixels; ++i) {
    if (p.ambiguous(i)) continue;
    ++d.compared;
    const auto a = display(p.a, i), b = display(p.b, i);
    if (!a || !b) ++d.not_finite;
    const glm::dvec4 steps = a && b ? glm::abs(*a - *b) * 255.0 : glm::dvec4(255.0);
    squares += glm::dot(glm::dvec3(steps), glm::dvec3(steps));
    d.max = std::max({d.max, steps.r, steps.g, steps.b});
    d.alpha_max = std::max(d.alpha_max, steps.a);
    const bool equal = glm::dvec3(steps) == glm::dvec3(0.0);
    const double de = equal    ? 0.0
                      : a && b ? ciede2000(lab_from_srgb(glm::dvec3(*a)), lab_from_srgb(glm::dvec3(*b)))
                               : 100.0;
    differences.push_back(de);
    sum += de;
  }
  if (d.compared) {
    d.rms = std::sqrt(squares / (3.0 * double(d.compared)));
    d.de_mean = sum / double(d.compared);
  }
  d.de_p95 = percentile(differences, 0.95);
  d.de_max = percentile(differences, 1.0);
  return d;
}

// FLIP of what is shown: clamped, black where transparent or not a number.
void add_flip(const Pair& p, ColorDifference& d) {
  auto linear = [&](const CompareInput& x) {
    std::vector<glm::dvec3> out(p.pixels);
    for (std::size_t i = 0; i < p.pixels; ++i)
      if (const auto c = display(x, i))
        for (int k = 0; k < 3; ++k) out[i][k] = srgb_decode((*c)[k]);
    return out;
  };
  const std::vector<double> errors = flip(linear(p.a), linear(p.b), p.a.width, p.a.height);
  for (const double e : errors) {
    d.flip_mean += e / double(errors.size());
    d.flip_max = std::max(d.flip_max, e);
  }
}

} // namespace

std::vector<glm::vec4> color_from_rgba8(std::span<const std::uint8_t> rgba) {
  std::vector<glm::vec4> out(rgba.size() / 4);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = glm::vec4(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]) / 255.0f;
  return out;
}

std::vector<glm::vec4> color_from_rgba16(std::span<const std::uint16_t> rgba) {
  std::vector<glm::vec4> out(rgba.size() / 4);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = glm::vec4(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]) / 65535.0f;
  return out;
}

double normal_bar(double projected_radius) { return 1e-6 + 1.5e-4 / projected_radius; }

CompareResult compare(const CompareInput& a, const CompareInput& b) {
  const Pair pair(a, b);
  CompareResult r;
  r.width = a.width;
  r.height = a.height;
  r.pixels = pair.pixels;
  for (std::size_t i = 0; i < pair.pixels; ++i) r.ambiguous += pair.ambiguous(i) ? 1 : 0;
  if (!pair.seen_a.empty()) {
    r.id = compare_ids(pair);
    r.outline = compare_outlines(pair.seen_a, pair.seen_b, a.width, a.height);
  }
  if (has_depth(a, b)) r.depth = compare_depths(pair);
  if (has_normals(a, b)) r.normal = compare_normals(pair);
  if (has_colors(a, b)) {
    r.color = compare_colors(pair);
    if (r.color->max > 0.0) add_flip(pair, *r.color);
  }
  return r;
}

std::vector<std::uint8_t> difference_picture(const CompareInput& a, const CompareInput& b, double gain) {
  const Pair pair(a, b);
  std::vector<std::uint8_t> out(pair.pixels * 4, 255);
  const auto gray = [&](std::size_t i) {
    if (has_colors(a, b)) {
      const auto x = display(a, i), y = display(b, i);
      if (!x || !y) return 255.0;
      const glm::dvec4 d = glm::abs(*x - *y) * 255.0;
      return std::max({d.r, d.g, d.b, d.a}) * gain;
    }
    if (!has_depth(a, b) || a.depth[i] == b.depth[i]) return 0.0;
    const double relative = not_nan(std::abs(a.depth[i] - b.depth[i]) / std::abs(b.depth[i]));
    return (std::log10(std::max(relative, 1e-12)) + 9.0) / 6.0 * 255.0;
  };
  for (std::size_t i = 0; i < pair.pixels; ++i) {
    std::uint8_t* rgb = &out[4 * i];
    if (!pair.seen_a.empty() && pair.seen_a[i] != pair.seen_b[i]) {
      rgb[0] = 255;
      rgb[1] = pair.ambiguous(i) ? 220 : 0;
      rgb[2] = 0;
      continue;
    }
    const auto value = static_cast<std::uint8_t>(std::lround(std::clamp(gray(i), 0.0, 255.0)));
    rgb[0] = rgb[1] = rgb[2] = value;
  }
  return out;
}

} // namespace mote::compare
