// SPDX-License-Identifier: MIT
// Derivations and worked numbers of the course documents, with their derivable answers; where mote's reference has the same
// thing (sphere, cylinder), the documents' formula must find it.
#include "core/reference/shapes.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mote {
namespace {

using glm::dmat2, glm::dmat3, glm::dmat4, glm::dvec2, glm::dvec3, glm::dvec4;

double random_in(std::mt19937& random, double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }
dvec3 random_point(std::mt19937& random, double half) { return {random_in(random, -half, half), random_in(random, -half, half), random_in(random, -half, half)}; }

void expect_near(const dvec3& a, const dvec3& b, double tolerance = 1e-12) { EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z; }

// ---- script: transformations ----

TEST(Derivations, ScaleThenTranslateAndTheOtherWay) {
  const dmat4 s = glm::scale(dmat4(1), dvec3(2, 2, 1)), t = glm::translate(dmat4(1), dvec3(3, 1, 0));
  const dmat4 ts = t * s, st = s * t;
  expect_near(dvec3(ts[3]), {3, 1, 0});
  expect_near(dvec3(st[3]), {6, 2, 0});
  EXPECT_EQ(ts[0][0], 2.0);
  EXPECT_EQ(st[0][0], 2.0);
}

// By 90 degrees about the z axis through (1, 0, 0): T(1, 0, 0) R T(-1, 0, 0).
TEST(Derivations, RotationAboutAPointOfTheXAxis) {
  const dmat4 m = glm::translate(dmat4(1), dvec3(1, 0, 0)) * glm::rotate(dmat4(1), std::numbers::pi / 2, dvec3(0, 0, 1)) * glm::translate(dmat4(1), dvec3(-1, 0, 0));
  expect_near(dvec3(m[3]), {1, -1, 0});
  expect_near(dvec3(m * dvec4(1, 0, 0, 1)), {1, 0, 0});
  expect_near(dvec3(m * dvec4(2, 0, 0, 1)), {1, 1, 0});
}

// q' = q - 2 n (q . n) + 2 n k, k = p . n: the mirror image at the plane through p.
TEST(Derivations, ReflectionAtAPlane) {
  const dvec3 n = glm::normalize(dvec3(1, 2, -2)), p(0.5, -1, 3);
  const double k = glm::dot(p, n);
  dmat4 m(1);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) m[c][r] -= 2 * n[r] * n[c];
  m[3] = dvec4(2 * k * n, 1);
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const dvec3 q = random_point(random, 5), image(m * dvec4(q, 1));
    EXPECT_NEAR(glm::dot(image - p, n), -glm::dot(q - p, n), 1e-12);
    expect_near(glm::cross(image - q, n), dvec3(0), 1e-12);
  }
}

// Q = (M^-1)^T keeps n . v = 0; M itself does not. The example: x doubled, tangent (1, -1), normal (1, 1).
TEST(Derivations, NormalsByTheInverseTranspose) {
  const dmat3 m(2, 0, 0, 0, 1, 0, 0, 0, 1);
  const dvec3 tangent(1, -1, 0), normal(1, 1, 0);
  const dvec3 right = glm::transpose(glm::inverse(m)) * normal;
  expect_near(right, {0.5, 1, 0});
  EXPECT_NEAR(glm::dot(right, m * tangent), 0.0, 1e-12);
  EXPECT_GT(std::abs(glm::dot(m * normal, m * tangent)), 1.0);
}

// ---- script: perspective ----

// Rows (n 0 0 0), (0 n 0 0), (0 0 n+f -nf), (0 0 1 0).
dmat4 projection(double n, double f) { return {n, 0, 0, 0, 0, n, 0, 0, 0, 0, n + f, 1, 0, 0, -n * f, 0}; }
dvec3 projected(const dmat4& m, const dvec3& p) {
  const dvec4 q = m * dvec4(p, 1);
  return dvec3(q) / q.w;
}
TEST(Derivations, PerspectiveKeepsBothPlanes) {
  const double n = 1, f = 2;
  const dmat4 m = projection(n, f);
  expect_near(projected(m, {0, 0, n}), {0, 0, n});
  expect_near(projected(m, {0, 0, f}), {0, 0, f});
  expect_near(projected(m, {4, 7, n}), {4, 7, n});
  expect_near(projected(m, {4, 7, f}), {4 * n / f, 7 * n / f, f});
  EXPECT_NEAR(projected(m, {0, 0, 1.5}).z, 5.0 / 3.0, 1e-12) << "between them: toward the far one";
}
TEST(Derivations, ToNormalizedDeviceCoordinates) {
  const double n = 1, f = 5, l = -2, r = 3, b = -1, t = 1.5;
  const dmat4 box(2 / (r - l), 0, 0, 0, 0, 2 / (t - b), 0, 0, 0, 0, 2 / (f - n), 0, -(r + l) / (r - l), -(t + b) / (t - b), -(f + n) / (f - n), 1);
  const dmat4 m = box * projection(n, f);
  expect_near(projected(m, {l, b, n}), {-1, -1, -1});
  expect_near(projected(m, {r * f / n, t * f / n, f}), {1, 1, 1});
}

// ---- script: interpolation, reflection, blending ----

TEST(Derivations, BarycentricCoordinates) {
  const dvec2 a(0, 0), b(4, 0), c(0, 2), p(1, 0.5);
  const dmat2 edges(b - a, c - a);
  const dvec2 uv = glm::inverse(edges) * (p - a);
  EXPECT_NEAR(uv.x, 0.25, 1e-12);
  EXPECT_NEAR(uv.y, 0.25, 1e-12);
  const dvec2 e1 = b - a, e2 = c - a, v = p - a; // by the dot products of the script
  const dvec2 same = glm::inverse(dmat2(glm::dot(e1, e1), glm::dot(e1, e2), glm::dot(e1, e2), glm::dot(e2, e2))) * dvec2(glm::dot(v, e1), glm::dot(v, e2));
  EXPECT_LT(glm::length(same - uv), 1e-12);
}
TEST(Derivations, ReflectedLight) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    const dvec3 n = glm::normalize(random_point(random, 1)), l = glm::normalize(random_point(random, 1)), r = 2 * glm::dot(n, l) * n - l;
    EXPECT_NEAR(glm::length(r), 1, 1e-12);
    EXPECT_NEAR(glm::dot(r, n), glm::dot(l, n), 1e-12);
    expect_near(glm::cross(n, l + r), dvec3(0), 1e-12);
  }
}
// Layers of white, alpha 1/2 each: 0.5, 0.75, ... from the front; from the back the same sum.
TEST(Derivations, FrontToBackEqualsBackToFront) {
  double front = 0, alpha = 0, back = 0;
  for (int i = 0; i < 2; ++i) {
    const double color = i == 0 ? 1.0 : 0.5;
    front += (1 - alpha) * 0.5 * color;
    alpha += (1 - alpha) * 0.5;
  }
  for (int i = 1; i >= 0; --i) back = 0.5 * (i == 0 ? 1.0 : 0.5) + 0.5 * back;
  EXPECT_DOUBLE_EQ(front, 0.625);
  EXPECT_DOUBLE_EQ(back, 0.625);
  EXPECT_DOUBLE_EQ(alpha, 0.75);
}
// Assignment, statement a: the specular term does not follow the angle of light and normal, but that of reflection and eye.
TEST(Derivations, SpecularDoesNotFollowTheAngleOfIncidence) {
  const dvec3 n(0, 0, 1), eye = glm::normalize(dvec3(1, 0, 1));
  const auto specular = [&](double angle) {
    const dvec3 l(-std::sin(angle), 0, std::cos(angle));
    return std::max(0.0, glm::dot(2 * glm::dot(n, l) * n - l, eye));
  };
  EXPECT_NEAR(specular(std::numbers::pi / 4), 1, 1e-12);
  EXPECT_LT(specular(0.1), specular(std::numbers::pi / 4)) << "a smaller angle, and darker";
}
// Crofton: of the rays that meet a convex cell, a part equal to the ratio of surfaces meets a convex object in it. In the plane, of
// perimeters: a square cut in halves, 3 l / 4 l.
TEST(Derivations, CroftonsRatio) {
  std::mt19937 random(3);
  int meets_square = 0, meets_half = 0;
  const auto meets = [](double width, double angle, double offset) { // the line cos x + sin y = offset and the rectangle [0, width] x [0, 1]
    const double c = std::cos(angle), s = std::sin(angle);
    const double values[] = {0, c * width, s, c * width + s};
    return offset >= *std::min_element(values, values + 4) && offset <= *std::max_element(values, values + 4);
  };
  for (int i = 0; i < 200000; ++i) {
    const double angle = random_in(random, 0, std::numbers::pi), offset = random_in(random, -1.5, 1.5);
    meets_square += meets(1, angle, offset);
    meets_half += meets(0.5, angle, offset);
  }
  EXPECT_NEAR(static_cast<double>(meets_half) / meets_square, 0.75, 0.01);
}

// ---- lecture and particle exercise: rays ----

reference::Particle solid(const std::vector<glm::vec4>& record) { return {glm::dvec3(record[0]), double{record[0].w}, record}; }

TEST(Derivations, TheLecturesSphere) {
  const std::vector<glm::vec4> record{{0.5f, -1, 2, 1.5f}};
  std::mt19937 random(4);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const dvec3 p0 = dvec3(0, 0, -6) + random_point(random, 1), d = glm::normalize(dvec3(0.5, -1, 2) + random_point(random, 2) - p0);
    const dvec3 dp = p0 - dvec3(record[0]);
    const double b = glm::dot(d, dp), root = b * b - glm::dot(dp, dp) + 1.5 * 1.5;
    const auto found = reference::find_shape("sphere")->intersect(solid(record), {p0, d});
    ASSERT_EQ(found.has_value(), root >= 0);
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(found->t_in, -b - std::sqrt(root), 1e-9);
    EXPECT_NEAR(found->t_out, -b + std::sqrt(root), 1e-9);
  }
  EXPECT_GT(hits, 100);
}

// The lecture's endless cylinder from p1 to p2 (with the axis the right way round) and the exercise's unit cylinder.
TEST(Derivations, TheCylinderOfLectureAndExercise) {
  const dvec3 p1(-1, 0, 0.5), p2(2, 1, 0.5);
  const double r = 0.75;
  const dvec3 middle = 0.5 * (p1 + p2), h = 0.5 * (p2 - p1);
  const std::vector<glm::vec4> record{glm::vec4(glm::vec3(middle), 3), glm::vec4(glm::vec3(h), r), glm::vec4(r, 0, 0, 0)};
  const dvec3 u = glm::normalize(glm::cross(glm::normalize(h), dvec3(0, 0, 1))), v = glm::cross(glm::normalize(h), u);
  const dmat3 to_unit = glm::inverse(dmat3(r * u, r * v, h)); // half length 1 along t
  std::mt19937 random(5);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const dvec3 p0 = dvec3(0, -6, 3) + random_point(random, 1), d = middle + random_point(random, 1.5) - p0, axis = p2 - p1;
    const dvec3 a = (p0 - p1) - axis * (glm::dot(p0 - p1, axis) / glm::dot(axis, axis)), b = d - axis * (glm::dot(d, axis) / glm::dot(axis, axis));
    const double root = glm::dot(a, b) * glm::dot(a, b) - glm::dot(b, b) * (glm::dot(a, a) - r * r);
    if (root < 1e-6) continue;
    const double mu = (-glm::dot(a, b) - std::sqrt(root)) / glm::dot(b, b), alpha = glm::dot(p0 + mu * d - p1, axis) / glm::dot(axis, axis);
    const dvec3 e = to_unit * (p0 - middle), w = to_unit * d; // e^2 - 1 + 2 (e . v) l + v^2 l^2 = 0 across the axis
    const dvec2 ep(e), wp(w);
    const double lambda = (-glm::dot(ep, wp) - std::sqrt(glm::dot(ep, wp) * glm::dot(ep, wp) - glm::dot(wp, wp) * (glm::dot(ep, ep) - 1))) / glm::dot(wp, wp);
    EXPECT_NEAR(lambda, mu, 1e-6) << "the same in unit space";
    const auto found = reference::find_shape("cylinder")->intersect(solid(record), {p0, d});
    if (alpha < 1e-3 || alpha > 1 - 1e-3 || mu < 0) continue;
    ++hits;
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->t_in, mu, 2e-6) << "records are float32";
  }
  EXPECT_GT(hits, 100);
}

// Particle exercise 1: rho^2 = 1 - r^2 / e^2, ||q|| <= 1 is the hit, lambda = 1 / (1 +- beta) both surfaces; depth by the pair (z, w).
TEST(Derivations, TheSilhouetteFormIsTheSphere) {
  const double r = 1.5;
  const dvec3 eye(1, 2, 9), center(0.5, -1, 2), m = eye - center;
  const double e = glm::length(m) / r, rho = std::sqrt(1 - 1 / (e * e));
  const dvec3 x = glm::normalize(glm::cross(m, dvec3(0, 1, 0))), y = glm::cross(glm::normalize(m), x);
  const std::vector<glm::vec4> record{glm::vec4(glm::vec3(center), static_cast<float>(r))};
  std::mt19937 random(6);
  for (int i = 0; i < 300; ++i) {
    const dvec2 q(random_in(random, -1.2, 1.2), random_in(random, -1.2, 1.2));
    const double qq = glm::dot(q, q);
    if (std::abs(qq - 1) < 1e-3) continue;
    const dvec3 point = center + r * (m / (r * e * e) + rho * (q.x * x + q.y * y)); // of the quad, in the silhouette's plane
    const auto found = reference::find_shape("sphere")->intersect(solid(record), {eye, point - eye});
    ASSERT_EQ(found.has_value(), qq < 1) << qq;
    if (!found) continue;
    const double beta = r * std::sqrt(1 - qq) / glm::length(m);
    EXPECT_NEAR(found->t_in, 1 / (1 + beta), 1e-6);
    EXPECT_NEAR(found->t_out, 1 / (1 - beta), 1e-6);
    const double n = 0.5, f = 100; // clip z and w are linear: the hit's depth from those of eye and point
    const auto zw = [&](const dvec3& p) { const double z = glm::dot(eye - p, glm::normalize(m)); return dvec2((f + n) / (f - n) * z - 2 * f * n / (f - n), z); };
    const dvec2 mixed = zw(eye) + (zw(point) - zw(eye)) / (1 + beta), direct = zw(eye + (point - eye) / (1 + beta));
    EXPECT_NEAR(mixed.x / mixed.y, direct.x / direct.y, 1e-12);
  }
}

// Exercise 2: b = base (one of the ends) +- R u +- R v holds the cylinder.
TEST(Derivations, TheBoxAroundACylinder) {
  const dvec3 p0(1, 2, 3), p1(-2, 0.5, 4), t = glm::normalize(p1 - p0);
  const double r = 0.8;
  const dvec3 u = glm::normalize(glm::cross(t, t.x * t.x + t.y * t.y > 1e-6 ? dvec3(0, 0, 1) : dvec3(0, 1, 0))), v = glm::cross(t, u);
  const dmat3 from_box(p1 - p0, r * u, r * v), to_box = glm::inverse(from_box);
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const double angle = random_in(random, 0, 6.3);
    const dvec3 surface = p0 + random_in(random, 0, 1) * (p1 - p0) + r * (std::cos(angle) * u + std::sin(angle) * v), inside = to_box * (surface - p0);
    EXPECT_TRUE(inside.x >= -1e-12 && inside.x <= 1 + 1e-12 && std::abs(inside.y) <= 1 + 1e-12 && std::abs(inside.z) <= 1 + 1e-12);
  }
  EXPECT_NEAR(glm::dot(u, t), 0, 1e-12);
  EXPECT_NEAR(glm::length(v), 1, 1e-12);
}

// Lecture: mu = -(p0 - p1) . n / (d . n); a triangle holds the point when both of its parameters and their sum lie in [0, 1].
TEST(Derivations, PlaneAndTriangle) {
  const dvec3 a(0, 0, 5), ab(2, 0, 1), ac(0, 3, 0), n = glm::cross(ab, ac), p0(0.1, 0.2, -1), target = a + 0.3 * ab + 0.4 * ac, d = target - p0;
  const double mu = -glm::dot(p0 - a, n) / glm::dot(d, n);
  EXPECT_NEAR(mu, 1, 1e-12);
  const dvec3 q = p0 + mu * d - a;
  const double aa = glm::dot(ab, ab), bb = glm::dot(ac, ac), cross = glm::dot(ab, ac);
  const double alpha = (bb * glm::dot(q, ab) - cross * glm::dot(q, ac)) / (aa * bb - cross * cross), beta = (glm::dot(q, ac) - alpha * cross) / bb;
  EXPECT_NEAR(alpha, 0.3, 1e-12);
  EXPECT_NEAR(beta, 0.4, 1e-12);
}

} // namespace
} // namespace mote
