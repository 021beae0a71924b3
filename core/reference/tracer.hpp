// SPDX-License-Identifier: MIT
// Rays of one view through a World, in double precision: the nearest surface, whether a sample is
// ambiguous, and whether anything lies between a point and a light. Called by the pixel loop
// (reference.hpp), by picking and by tests; const and safe to share between threads.
//
// A particle shows its entry point where that is visible (t > 0, not nearer than near_cut, not
// farther than far_cut), else its exit point, else nothing. Ties go to the lowest id.
// t is the depth along the view axis (camera.hpp).
//
// A sample is ambiguous where one of these holds; float32 rounding may decide there:
//   - at one of the four samples 1e-3 px to the left, right, top, bottom the id differs, or the same
//     particle shows its other side;
//   - another particle's visible surface lies within 4 ulp (float32) of the nearest depth, or the
//     record exists several times;
//   - an intersection lies within 4 ulp of near_cut or far_cut and decides what is seen; or the eye lies
//     on a particle's surface (entry or exit within 2^-21 of the other one's distance).
#pragma once

#include "core/math/camera.hpp"
#include "core/reference/world.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace mote::reference {

constexpr std::uint64_t no_id = ~std::uint64_t{0};
constexpr double ambiguous_shift = 1e-3; // px

struct Hit {
  double t{std::numeric_limits<double>::infinity()};
  std::uint64_t id{no_id};
  std::uint32_t placed{}, record{};
  bool exit{}; // the inside is seen
  explicit operator bool() const { return id != no_id; }
};

struct Sample {
  Hit hit{};
  Ray ray{}; // world axes, relative to the eye
  bool ambiguous{};
};

class Tracer {
public:
  Tracer(const World& world, const View& view);

  // The sample of pixel (x, y), view.sample_offset included; `ambiguity` false leaves that flag unset.
  [[nodiscard]] Sample sample(double x, double y, bool ambiguity) const;
  // Unit, world, turned to the eye. Only for a hit.
  [[nodiscard]] glm::dvec3 normal(const Sample& sample) const;
  // The hit particle's smallest radius of curvature (a sphere's: its radius) on the picture, in pixels: focal * radius
  // / distance of its center (orthographic: focal * radius). Placed by no similarity: an estimate.
  [[nodiscard]] double projected_radius(const Hit& hit) const;
  // Whether a surface of any particle but `skip_id` lies on origin + t direction with 0 < t < t_max.
  [[nodiscard]] bool occluded(const Ray& ray, double t_max, std::uint64_t skip_id) const;

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] const View& view() const { return view_; }

private:
  struct Search;
  struct Seen {        // an instance from this eye
    glm::dvec3 eye{0}; // in data space
    double slack{};    // grows its boxes: shifted samples and rounding
  };
  [[nodiscard]] Ray local(const Ray& ray, std::uint32_t placed) const;
  void instance(Search& search, std::uint32_t placed) const;
  void leaf(Search& search, std::uint32_t placed, std::uint32_t record) const;
  [[nodiscard]] bool ambiguous(const Search& search) const;

  const World& world_;
  View view_;
  std::vector<Seen> seen_{};
  double near_{}, far_{};               // 0 and infinity where not set
  double near_margin_{}, far_margin_{}; // 4 ulp (float32)
  double t_min_{};
  double top_slack_{};
};

} // namespace mote::reference
