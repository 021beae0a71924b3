// SPDX-License-Identifier: MIT
#include "core/compare/color_difference.hpp"

#include <algorithm>
#include <cmath>

namespace mote::compare {

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

double lab_curve(double t) { // CIE 15:2004
  constexpr double d = 6.0 / 29.0;
  return t > d * d * d ? std::cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
}

double hue(double a, double b) { // degrees in [0, 360); 0 for gray
  if (a == 0.0 && b == 0.0) return 0.0;
  const double h = std::atan2(b, a) / degree;
  return h < 0.0 ? h + 360.0 : h;
}

double seventh_root_term(double chroma) { // sqrt(C^7 / (C^7 + 25^7))
  const double c7 = std::pow(chroma, 7.0);
  return std::sqrt(c7 / (c7 + 6103515625.0));
}

// Mean hue of two colors, over the shorter arc; the sum where either is gray.
double mean_hue(double h1, double h2, bool gray) {
  if (gray) return h1 + h2;
  if (std::abs(h1 - h2) <= 180.0) return 0.5 * (h1 + h2);
  return h1 + h2 < 360.0 ? 0.5 * (h1 + h2 + 360.0) : 0.5 * (h1 + h2 - 360.0);
}

} // namespace

double srgb_encode(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  const double x = std::clamp(encoded, 0.0, 1.0);
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

glm::dvec3 lab_from_srgb(const glm::dvec3& encoded) {
  const double r = srgb_decode(encoded.r), g = srgb_decode(encoded.g), b = srgb_decode(encoded.b);
  // IEC 61966-2-1, divided by the white (the row sums), so that white is exactly (100, 0, 0)
  const double x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505;
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  const double z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0890;
  const double fx = lab_curve(x), fy = lab_curve(y), fz = lab_curve(z);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

double ciede2000(const glm::dvec3& p, const glm::dvec3& q) {
  const double mean_chroma = 0.5 * (std::hypot(p.y, p.z) + std::hypot(q.y, q.z));
  const double g = 0.5 * (1.0 - seventh_root_term(mean_chroma));
  const double a1 = (1.0 + g) * p.y, a2 = (1.0 + g) * q.y;
  const double c1 = std::hypot(a1, p.z), c2 = std::hypot(a2, q.z);
  const double h1 = hue(a1, p.z), h2 = hue(a2, q.z);
  const bool gray = c1 * c2 == 0.0;
  double turn = gray ? 0.0 : h2 - h1;
  if (turn > 180.0) turn -= 360.0;
  if (turn < -180.0) turn += 360.0;
  const double dl = q.x - p.x, dc = c2 - c1, dh = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * turn * degree);
  const double l = 0.5 * (p.x + q.x), c = 0.5 * (c1 + c2), h = mean_hue(h1, h2, gray);
  const double t = 1.0 - 0.17 * std::cos((h - 30.0) * degree) + 0.24 * std::cos(2.0 * h * degree) +
                   0.32 * std::cos((3.0 * h + 6.0) * degree) - 0.20 * std::cos((4.0 * h - 63.0) * degree);
  const double l50 = (l - 50.0) * (l - 50.0);
  const double sl = 1.0 + 0.015 * l50 / std::sqrt(20.0 + l50), sc = 1.0 + 0.045 * c, sh = 1.0 + 0.015 * c * t;
  const double bump = 30.0 * std::exp(-((h - 275.0) / 25.0) * ((h - 275.0) / 25.0));
  const double rotation = -2.0 * seventh_root_term(c) * std::sin(2.0 * bump * degree);
  const double x = dl / sl, y = dc / sc, z = dh / sh;
  return std::sqrt(std::max(0.0, x * x + y * y + z * z + rotation * y * z));
}

} // namespace mote::compare
