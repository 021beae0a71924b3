// SPDX-License-Identifier: MIT
#include "core/compare/flip.hpp"

#include "core/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mote::compare {
namespace {

using std::numbers::pi;
using Image = std::vector<double>;
constexpr double pixels_per_degree = 67.0206; // 0.7 m, 0.7 m, 3840 px
const glm::dvec3 white(0.950428545, 1.0, 1.088900371);

const glm::dmat3 xyz_from_rgb = glm::transpose(glm::dmat3(10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0, //
                                                          2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,  //
                                                          1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));

glm::dvec3 opponent(const glm::dvec3& rgb) { // Y, Cx, Cz: L*a*b* without its cube root
  const glm::dvec3 v = xyz_from_rgb * rgb / white;
  return {116.0 * v.y - 16.0, 500.0 * (v.x - v.y), 200.0 * (v.y - v.z)};
}
glm::dvec3 rgb_of(const glm::dvec3& o) {
  static const glm::dmat3 rgb_from_xyz = glm::inverse(xyz_from_rgb);
  const double y = (o.x + 16.0) / 116.0;
  return rgb_from_xyz * (glm::dvec3(o.y / 500.0 + y, y, y - o.z / 200.0) * white);
}
glm::dvec3 hunt_lab(const glm::dvec3& rgb) {
  auto curve = [](double t) {
    constexpr double d = 6.0 / 29.0;
    return t > d * d * d ? std::cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
  };
  const glm::dvec3 v = xyz_from_rgb * rgb / white;
  const double fx = curve(v.x), fy = curve(v.y), fz = curve(v.z), l = 116.0 * fy - 16.0;
  return {l, 0.01 * l * 500.0 * (fx - fy), 0.01 * l * 200.0 * (fy - fz)};
}
double hyab(const glm::dvec3& p, const glm::dvec3& q) { return std::abs(p.x - q.x) + std::hypot(p.y - q.y, p.z - q.z); }

using Taps = std::vector<double>; // odd length
Taps taps(int radius, auto&& value) {
  Taps out;
  for (int i = -radius; i <= radius; ++i) out.push_back(value(static_cast<double>(i)));
  return out;
}
double sum_of(const Taps& t) {
  double s = 0.0;
  for (const double v : t) s += v;
  return s;
}

// Along rows with `across`, then columns with `down`; the border repeats.
Image filtered(const Image& image, int w, int h, const Taps& across, const Taps& down) {
  Image middle(image.size()), out(image.size());
  auto pass = [&](const Image& from, Image& to, const Taps& t, bool rows) {
    const int radius = static_cast<int>(t.size()) / 2;
    for_each_block(static_cast<std::size_t>(h), [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < w; ++x) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k) {
          const int u = rows ? std::clamp(x + k, 0, w - 1) : x, v = rows ? y : std::clamp(y + k, 0, h - 1);
          sum += t[static_cast<std::size_t>(k + radius)] * from[static_cast<std::size_t>(v) * static_cast<std::size_t>(w) + static_cast<std::size_t>(u)];
        }
        to[row * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)] = sum;
      }
    });
  };
  pass(image, middle, across, true);
  pass(middle, out, down, false);
  return out;
}

// One term a sqrt(pi / b) exp(-pi^2 d^2 / b) of a contrast sensitivity, d in degrees.
struct Sensitivity {
  double a, b;
};
Image seen(const Image& channel, int w, int h, std::span<const Sensitivity> terms) {
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * pixels_per_degree));
  Image out(channel.size());
  double total = 0.0;
  for (const Sensitivity& s : terms) {
    const Taps t = taps(radius, [&](double d) { return std::exp(-pi * pi * (d / pixels_per_degree) * (d / pixels_per_degree) / s.b); });
    const double weight = s.a * std::sqrt(pi / s.b);
    total += weight * sum_of(t) * sum_of(t);
    const Image part = filtered(channel, w, h, t, t);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * part[i];
  }
  for (double& v : out) v /= total;
  return out;
}

// What the eye sees of it, as Hunt-adjusted L*a*b*.
std::vector<glm::dvec3> seen_colors(const std::array<Image, 3>& channels, int w, int h) {
  constexpr std::array<Sensitivity, 1> achromatic{{{1.0, 0.0047}}}, red_green{{{1.0, 0.0053}}};
  constexpr std::array<Sensitivity, 2> blue_yellow{{{34.1, 0.04}, {13.5, 0.025}}};
  const Image y = seen(channels[0], w, h, achromatic), x = seen(channels[1], w, h, red_green), z = seen(channels[2], w, h, blue_yellow);
  std::vector<glm::dvec3> out(y.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = hunt_lab(glm::clamp(rgb_of({y[i], x[i], z[i]}), 0.0, 1.0));
  return out;
}

// Strength of edges (first derivative) or points (second) in the lightness.
Image strength(const Image& lightness, int w, int h, bool points) {
  const double sd = 0.5 * 0.082 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * sd));
  auto gauss = [&](double d) { return std::exp(-d * d / (2.0 * sd * sd)); };
  const Taps smooth = taps(radius, gauss);
  Taps slope = taps(radius, [&](double d) { return points ? (d * d / (sd * sd) - 1.0) * gauss(d) : -d * gauss(d); });
  const double across = sum_of(smooth); // weights of each sign add up to one over the whole filter
  double positive = 0.0, negative = 0.0;
  for (const double v : slope) (v > 0.0 ? positive : negative) += std::abs(v) * across;
  for (double& v : slope) v /= v > 0.0 ? positive : negative;
  const Image gx = filtered(lightness, w, h, slope, smooth), gy = filtered(lightness, w, h, smooth, slope);
  Image out(gx.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(gx[i], gy[i]);
  return out;
}

std::array<Image, 3> channels_of(std::span<const glm::dvec3> rgb) {
  std::array<Image, 3> out;
  for (const glm::dvec3& c : rgb) {
    const glm::dvec3 o = opponent(c);
    for (int k = 0; k < 3; ++k) out[static_cast<std::size_t>(k)].push_back(o[k]);
  }
  return out;
}
Image lightness_of(const Image& y) {
  Image out(y);
  for (double& v : out) v = (v + 16.0) / 116.0;
  return out;
}

// HyAB to the power 0.7, stretched so that small differences fill most of 0..1.
double color_error(const glm::dvec3& p, const glm::dvec3& q) {
  static const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
  constexpr double pc = 0.4, pt = 0.95;
  const double e = std::pow(hyab(p, q), 0.7), knee = pc * most;
  return e < knee ? pt / knee * e : pt + (e - knee) / (most - knee) * (1.0 - pt);
}

} // namespace

std::vector<double> flip(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, std::uint32_t width, std::uint32_t height) {
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  const std::array<Image, 3> ca = channels_of(a), cb = channels_of(b);
  const std::vector<glm::dvec3> sa = seen_colors(ca, w, h), sb = seen_colors(cb, w, h);
  const Image la = lightness_of(ca[0]), lb = lightness_of(cb[0]);
  const Image ea = strength(la, w, h, false), eb = strength(lb, w, h, false), pa = strength(la, w, h, true), pb = strength(lb, w, h, true);
  std::vector<double> out(a.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double color = std::clamp(color_error(sa[i], sb[i]), 0.0, 1.0);
    const double feature = std::sqrt(std::max(std::abs(ea[i] - eb[i]), std::abs(pa[i] - pb[i])) / std::numbers::sqrt2);
    out[i] = color > 0.0 ? std::pow(color, 1.0 - std::min(feature, 1.0)) : 0.0;
  }
  return out;
}

} // namespace mote::compare
