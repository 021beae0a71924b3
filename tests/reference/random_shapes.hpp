// SPDX-License-Identifier: MIT
// Random particles of every type, for tests that cast rays at them: the reference's against quadruple precision, the shaders'
// against the reference.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string_view>
#include <utility>

namespace mote::test {

using Record = std::array<glm::vec4, 4>; // core/reference/shapes.hpp

// A random particle and what the rays need to know of it.
struct Case {
  Record record{};
  glm::dmat3 axes{1};     // of a box around it
  glm::dvec3 extents{1};
  double thin{1};         // its least length
  [[nodiscard]] double size() const { return glm::length(extents); }
};

struct Dice {
  std::mt19937_64 random{};
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }
  double log_between(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  glm::dvec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  }
};

// `aligned`: along the axes of space; `needle`: 1e5 times longer than thick; others: 1 to 1 / thinnest times.
inline Case random_case(std::string_view type, Dice& dice, bool aligned, bool needle, double thinnest = 0.05) {
  Case c;
  if (type == "sphere") {
    c.record[0].w = 1.0f;
    return c;
  }
  const auto axes = [&] {
    const glm::vec4 q = aligned ? glm::vec4(0, 0, 0, 1) : glm::vec4(glm::normalize(glm::dvec4(dice.direction(), dice.between(-1, 1))));
    return std::pair(q, glm::mat3_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z))));
  };
  const auto thickness = [&] { return static_cast<float>(needle ? 1e-5 : dice.log_between(thinnest, 1.0)); };
  if (type == "ellipsoid" || type == "box" || type == "superquadric") {
    const auto [q, m] = axes();
    c.record[1] = q;
    c.record[2] = glm::vec4(thickness(), thickness(), 1.0f, 0.0f);
    const auto exponent = [&] { return static_cast<float>(dice.between(0, 1) < 0.2 ? 2.0 : dice.between(0.1, 2.0)); };
    c.record[3] = glm::vec4(exponent(), exponent(), 0, 0);
    c.axes = m;
    c.extents = glm::dvec3(c.record[2]);
    c.thin = std::min({c.extents.x, c.extents.y, c.extents.z});
  } else {
    const glm::dvec3 h = aligned ? glm::dvec3(0, 0, dice.between(0, 1) < 0.5 ? -1.0 : 1.0) : dice.direction();
    const double r0 = thickness(), r1 = type == "cylinder" && dice.between(0, 1) < 0.5 ? r0 : double(thickness());
    c.record[1] = glm::vec4(glm::vec3(h), static_cast<float>(r0));
    c.record[2] = glm::vec4(static_cast<float>(r1), 0, 0, 0);
    if (type == "cone" && dice.between(0, 1) < 0.5) c.record[2].x = 0.0f;
    if (type == "arrow") c.record[2] = glm::vec4(static_cast<float>(2.5 * r0), static_cast<float>(dice.between(0.1, 2.0)), 0, 0);
    if (type == "polyline") {
      c.record[1].w = static_cast<float>(0.8 * r0);
      const auto plane = [&] { return glm::vec4(dice.between(0, 1) < 0.2 ? glm::vec3(0) : glm::vec3(glm::normalize(h + dice.between(0, 1) * dice.direction())), 0); };
      c.record[2] = plane();
      c.record[3] = plane();
    }
    const glm::dvec3 x = glm::normalize(glm::cross(h, aligned ? glm::dvec3(0, 1, 0) : dice.direction()));
    c.axes = glm::dmat3(x, glm::cross(h, x), h);
    const bool round = type == "capsule" || type == "polyline";
    const double wide = round ? r0 : std::max(r0, double(c.record[2].x));
    c.extents = {wide, wide, 1.0 + (round ? r0 : 0.0)};
    c.thin = std::min(r0, c.record[2].x > 0.0f && !round ? double(c.record[2].x) : r0);
  }
  c.record[0] = glm::vec4(0, 0, 0, static_cast<float>(c.size() * 1.001));
  return c;
}

} // namespace mote::test
