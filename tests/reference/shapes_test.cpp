// SPDX-License-Identifier: MIT
// Every particle type's double-precision twin against 113-bit arithmetic: random, degenerate and grazing rays, from
// inside to a million sizes away, ordinary shapes and needles. MOTE_MEASURE=1 prints the worst errors
// (the table of docs/accuracy.md).
#include "core/reference/shapes.hpp"
#include "quad_shapes.hpp"
#include "random_shapes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace mote {
namespace {

using namespace mote::test;
using reference::Shape;

double angle(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Worst {
  std::size_t hits{}, borderline{};
  double t{};        // of ordinary rays (|n.d| > 0.1): error of the hit over the ray's length
  double normal{};   // of ordinary rays: radians
  double backward{}; // of grazing rays: the change of the solid's size that explains the result
};

class Checker {
public:
  Checker(std::string_view type, bool open, bool needle, double distance)
      : type_(type), open_(open), needle_(needle), distance_(distance), shape_(*reference::find_shape(type)) {}

  Worst run(std::size_t cases, std::uint64_t seed) {
    dice_.random.seed(seed);
    for (std::size_t i = 0; i < cases; ++i) {
      Case c = random_case(type_, dice_, i % 4 == 2, needle_);
      if (open_) c.record[2].y = 1.0f;
      const glm::dvec3 center = distance_ > 1.0 ? glm::dvec3(0) : dice_.direction();
      particle_ = {center, double(c.record[0].w), c.record};
      check(c, ray(c, center, i % 4), i % 4 == 3);
      if (::testing::Test::HasFailure()) break;
    }
    return worst_;
  }

private:
  reference::Ray ray(const Case& c, const glm::dvec3& center, std::size_t kind) {
    const auto within = [&] { return c.extents * glm::dvec3(dice_.between(-1, 1), dice_.between(-1, 1), dice_.between(-1, 1)); };
    const glm::dvec3 target = center + c.axes * within();
    glm::dvec3 direction = dice_.direction();
    if (kind == 2) direction = c.axes[static_cast<int>(dice_.between(0, 2.999))] * (dice_.between(0, 1) < 0.5 ? -1.0 : 1.0);
    const glm::dvec3 origin = distance_ > 1.0 ? target - direction * (distance_ * c.size()) : center + c.axes * (0.5 * within());
    const double stretch = dice_.log_between(0.1, 10.0);
    if (kind != 3) return {origin, direction * stretch};
    // toward the silhouette as the twin sees it, then off it by 1e-15 to 1e-2 of what was searched
    glm::dvec3 hit = center - origin;
    if (distance_ <= 1.0) hit = c.axes * within();
    glm::dvec3 miss = hit + glm::normalize(glm::cross(hit, dice_.direction())) * (3.0 * c.size());
    const glm::dvec3 span = miss - hit;
    for (int k = 0; k < 50; ++k) {
      const glm::dvec3 middle = 0.5 * (hit + miss);
      (shape_.intersect(particle_, {origin, middle}) ? hit : miss) = middle;
    }
    return {origin, hit + span * (c.thin / c.size() * dice_.log_between(1e-15, 1e-2) * (dice_.between(0, 1) < 0.3 ? 1.0 : -1.0))};
  }

  [[nodiscard]] QuadHits exact(const Case& c, const reference::Ray& ray, double grow) const {
    return quad_hits(type_, c.record, q3(ray.origin) - q3(particle_.center), q3(ray.direction), grow);
  }

  // Rounding in units of the particle's size: of the eye's distance and, for thin ones, of the ratio.
  [[nodiscard]] double unit(const Case& c) const { return 1e-16 * std::max(1.0, distance_) * c.size() / c.thin; }

  void check(const Case& c, const reference::Ray& ray, bool grazing) {
    const auto found = shape_.intersect(particle_, ray);
    if (type_ == "superquadric") return check_superquadric(c, ray, found);
    const double most = 64.0 * unit(c);
    const QuadHits now = exact(c, ray, 0.0);
    if (found.has_value() != now.hit) {
      ++worst_.borderline;
      EXPECT_NE(exact(c, ray, most).hit, exact(c, ray, -most).hit) << describe(c, ray) << (now.hit ? "missed" : "hit");
    }
    if (!found || !now.hit) return;
    ++worst_.hits;
    compare(c, ray, found->t_in, static_cast<double>(now.t_in), to_double(now.n_in), false, most);
    compare(c, ray, found->t_out, static_cast<double>(now.t_out), to_double(now.n_out), true, most);
    if (grazing && !open_) bracket(c, ray, *found, most);
  }

  void compare(const Case& c, const reference::Ray& ray, double t, double exact_t, glm::dvec3 exact_n, bool exit, double most) {
    const double length = glm::length(ray.direction), way = std::max(distance_, 1.0) * c.size();
    const double cosine = std::abs(glm::dot(glm::normalize(exact_n), ray.direction)) / length;
    if (cosine < 0.1) return;
    const glm::dvec3 n = shape_.normal(particle_, ray, exit);
    EXPECT_NEAR(glm::length(n), 1.0, 1e-14);
    if (open_ && (glm::dot(exact_n, ray.direction) > 0.0) != exit) exact_n = -exact_n; // against the ray where met first
    double off = angle(n, exact_n), dt = std::abs(t - exact_t) * length / way;
    if (off > 1e-3 || dt > most)
      for (const double grow : {most, -most}) { // across an edge: another face, for a solid as good as equal
        const QuadHits other = exact(c, ray, grow);
        if (!other.hit) continue;
        glm::dvec3 m = to_double(exit ? other.n_out : other.n_in);
        if (open_ && (glm::dot(m, ray.direction) > 0.0) != exit) m = -m;
        off = std::min(off, angle(n, m));
        dt = std::min(dt, std::abs(t - static_cast<double>(exit ? other.t_out : other.t_in)) * length / way);
      }
    worst_.t = std::max(worst_.t, dt);
    worst_.normal = std::max(worst_.normal, off);
    EXPECT_LT(dt, 0.5 * most) << describe(c, ray) << " t " << t << " exactly " << exact_t;
    EXPECT_LT(off, most) << describe(c, ray) << " exit " << exit;
  }

  // The least growth between whose ends the interval lies.
  void bracket(const Case& c, const reference::Ray& ray, const reference::Interval& found, double most) {
    const double tiny = 1e-15 * std::max(1.0, distance_) * c.size() / glm::length(ray.direction);
    for (double grow = 1e-6 * most; grow <= most; grow *= 2.0) {
      const QuadHits outer = exact(c, ray, grow), inner = exact(c, ray, -grow);
      const bool in = outer.hit && found.t_in >= static_cast<double>(outer.t_in) - tiny &&
                      found.t_out <= static_cast<double>(outer.t_out) + tiny;
      const bool out = !inner.hit || (found.t_in <= static_cast<double>(inner.t_in) + tiny &&
                                      found.t_out >= static_cast<double>(inner.t_out) - tiny);
      if (!in || !out) continue;
      worst_.backward = std::max(worst_.backward, grow);
      return;
    }
    ADD_FAILURE() << describe(c, ray) << "no growth up to " << most << " explains the interval";
  }

  // g is homogeneous, so |g - 1| at the hit is the growth; convex, so the slope tells entry from exit.
  void check_superquadric(const Case& c, const reference::Ray& ray, const std::optional<reference::Interval>& found) {
    const Q3 o = q3(ray.origin) - q3(particle_.center), d = q3(ray.direction);
    const double most = 64.0 * unit(c), length = glm::length(ray.direction);
    if (!found) {
      quad low = -dot(o, d) / dot(d, d) - quad(2 * c.size() / length), high = low + quad(4 * c.size() / length);
      for (int k = 0; k < 60; ++k) {
        const quad middle = (low + high) / quad(2);
        (dot(quad_gauge(c.record, o + middle * d).gradient, d) > quad(0) ? high : low) = middle;
      }
      EXPECT_GT(static_cast<double>(quad_gauge(c.record, o + low * d).value), 1.0 - most) << describe(c, ray);
      return;
    }
    ++worst_.hits;
    for (const bool exit : {false, true}) {
      const quad t = quad(exit ? found->t_out : found->t_in);
      const QuadGauge at = quad_gauge(c.record, o + t * d);
      const double residual = static_cast<double>(at.value - quad(1)), slope = static_cast<double>(dot(at.gradient, d));
      const glm::dvec3 gradient = to_double(at.gradient);
      // the parameter itself is rounded; along a steep normal of a needle that alone moves g
      const double rounded = 1e-16 * std::max(1.0, distance_) * c.size() / length * std::abs(slope);
      worst_.backward = std::max(worst_.backward, std::abs(residual));
      EXPECT_LT(std::abs(residual), most + 4.0 * rounded) << describe(c, ray);
      const double cosine = slope / (length * glm::length(gradient));
      const bool edge = (found->t_out - found->t_in) * length < 1e-6 * c.thin + 1e-14 * distance_ * c.size(); // across a crease: two normals in one place
      if (std::abs(cosine) < 0.1 || edge) continue;
      EXPECT_EQ(slope > 0.0, exit) << describe(c, ray);
      worst_.t = std::max(worst_.t, std::abs(residual / slope) * length / (std::max(1.0, distance_) * c.size()));
      const double off = angle(shape_.normal(particle_, ray, exit), to_double(quad_gauge(c.record, o + (t - quad(residual / slope)) * d).gradient));
      if (off < 1e-2) worst_.normal = std::max(worst_.normal, off); // beyond: a crease
      else ++worst_.borderline;
    }
  }

  [[nodiscard]] std::string describe(const Case& c, const reference::Ray& ray) const {
    std::string text(type_);
    for (const glm::vec4& v : c.record) text += fmt::format(" ({:.9g} {:.9g} {:.9g} {:.9g})", v.x, v.y, v.z, v.w);
    return text + fmt::format(" from {} {} {} along {} {} {} distance {} ", ray.origin.x, ray.origin.y, ray.origin.z,
                              ray.direction.x, ray.direction.y, ray.direction.z, distance_);
  }

  std::string_view type_;
  bool open_, needle_;
  double distance_;
  const Shape& shape_;
  Dice dice_{};
  reference::Particle particle_{};
  Worst worst_{};
};

void check_type(std::string_view type, bool open = false) {
  for (const bool needle : {false, true})
    for (const double distance : {0.0, 2.0, 1e2, 1e4, 1e6}) {
      const std::size_t cases = type == "superquadric" ? 1000 : 4000;
      const Worst w = Checker(type, open, needle, distance).run(cases, 11);
      EXPECT_GT(w.hits, cases / 8);
      EXPECT_LT(w.borderline, cases / 20);
      if (std::getenv("MOTE_MEASURE"))
        fmt::print("| {}{}{} | {:g} | {} | {} | {:.1e} | {:.1e} | {:.1e} |\n", type, open ? ", open" : "", needle ? ", needles" : "",
                   distance, w.hits, w.borderline, w.t, w.normal, w.backward);
      if (::testing::Test::HasFailure()) return;
    }
}

TEST(ReferenceShapes, Capsule) { check_type("capsule"); }
TEST(ReferenceShapes, Polyline) { check_type("polyline"); }
TEST(ReferenceShapes, Cylinder) { check_type("cylinder"); }
TEST(ReferenceShapes, OpenCylinder) { check_type("cylinder", true); }
TEST(ReferenceShapes, Cone) { check_type("cone"); }
TEST(ReferenceShapes, Arrow) { check_type("arrow"); }
TEST(ReferenceShapes, Ellipsoid) { check_type("ellipsoid"); }
TEST(ReferenceShapes, Box) { check_type("box"); }
TEST(ReferenceShapes, Superquadric) { check_type("superquadric"); }

} // namespace
} // namespace mote
