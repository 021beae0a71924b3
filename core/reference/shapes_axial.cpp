// SPDX-License-Identifier: MIT
// Solids of revolution about a segment: capsule, cylinder, cone, arrow; and the polyline's, a capsule cut by two planes.
//
// In the frame whose z is the axis, a ray l + t d meets the double cone |p.xy| = |r + k p.z| where
// a t^2 + 2 b t + c = 0. With the radius f + g t along the ray (f = r + k l.z, g = k d.z):
//   a = |d.xy|^2 - g^2,   b = l.xy . d.xy - f g,   c = |l.xy|^2 - f^2,
//   b^2 - a c = |f d.xy - g l.xy|^2 - (l.xy x d.xy)^2    (Lagrange's identity of the metric + + -),
// whose right side cancels nothing but near tangents.
#include "core/reference/shapes_local.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace mote::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A truncated cone about the frame's z axis, |z - at| <= half, of radius middle + slope (z - at).
struct Frustum {
  double at{}, middle{}, slope{}, half{};
};
Frustum frustum(double at, double r_low, double r_high, double half) {
  return {at, 0.5 * (r_low + r_high), half > 0.0 ? 0.5 * (r_high - r_low) / half : 0.0, half};
}

enum class Part : std::int8_t { Low, Side, High };
struct End {
  double t{};
  Part part{Part::Side};
  glm::dvec3 normal{0}; // outward, in the frame
  bool inner{};
};
struct Stretch { // of a ray within a solid
  End in{}, out{};
};

// p q - r s with one rounding each (Kahan).
double difference(double p, double q, double r, double s) {
  const double w = r * s;
  return std::fma(p, q, -w) + std::fma(-r, s, w);
}

// The part of the line inside the infinite cone's nappe of positive radius; nullopt: none.
std::optional<Interval> within_side(const Frustum& c, const glm::dvec3& l, const glm::dvec3& d) {
  const double f = std::fma(c.slope, l.z, c.middle), g = c.slope * d.z;
  const double across = std::hypot(d.x, d.y), away = std::hypot(l.x, l.y);
  if (across == 0.0 && g == 0.0) return away <= f ? std::optional<Interval>({-infinity, infinity}) : std::nullopt;
  const double root = std::hypot(difference(f, d.x, g, l.x), difference(f, d.y, g, l.y));
  const double cross = std::abs(difference(l.x, d.y, l.y, d.x));
  const double a = (across - std::abs(g)) * (across + std::abs(g));
  const double discriminant = (root - cross) * (root + cross);
  if (discriminant < 0.0 && a > 0.0) return std::nullopt;
  const double b = l.x * d.x + l.y * d.y - f * g, h = std::sqrt(std::max(0.0, discriminant));
  const double q = b >= 0.0 ? -(b + h) : h - b;
  // a = 0 is the limit of negative a: the other root lies at infinity on the other nappe.
  const double one = q != 0.0 ? (away - f) * (away + f) / q : 0.0;
  const double other = a != 0.0 ? q / a : (q >= 0.0 ? -infinity : infinity);
  const auto [low, high] = std::minmax(one, other);
  if (a > 0.0) return f + g * 0.5 * (low + high) < 0.0 ? std::nullopt : std::optional<Interval>({low, high});
  return g > 0.0 ? Interval{high, infinity} : Interval{-infinity, low};
}

glm::dvec3 side_normal(const Frustum& c, const glm::dvec3& p) {
  const double away = std::hypot(p.x, p.y);
  if (!(away > 0.0)) return {0, 0, c.slope > 0.0 ? -1 : 1}; // the apex
  return glm::normalize(glm::dvec3(p.x / away, p.y / away, -c.slope));
}

void set_normal(const Frustum& c, const glm::dvec3& l, const glm::dvec3& d, End& end) {
  end.normal = end.part == Part::Side ? side_normal(c, l + end.t * d) : glm::dvec3(0, 0, end.part == Part::Low ? -1 : 1);
}

// The solid with both end disks. `l`, `d` in the frame.
std::optional<Stretch> capped(const Frustum& c, glm::dvec3 l, const glm::dvec3& d) {
  if (!(c.half > 0.0)) return std::nullopt;
  l.z -= c.at;
  const auto side = within_side(c, l, d);
  if (!side) return std::nullopt;
  Stretch s{{side->t_in, Part::Side}, {side->t_out, Part::Side}};
  if (d.z == 0.0 && std::abs(l.z) > c.half) return std::nullopt;
  if (d.z != 0.0) {
    End low{(-c.half - l.z) / d.z, Part::Low}, high{(c.half - l.z) / d.z, Part::High};
    if (low.t > high.t) std::swap(low, high);
    if (low.t > s.in.t) s.in = low;
    if (high.t < s.out.t) s.out = high;
  }
  if (!(s.in.t <= s.out.t)) return std::nullopt;
  set_normal(c, l, d, s.in);
  set_normal(c, l, d, s.out);
  return s;
}

// The side alone: a surface with two faces. Its normals are against the ray where it is met first, along the ray
// where last, so that both face the eye once the tracer has turned the latter.
std::optional<Stretch> open_ended(const Frustum& c, const glm::dvec3& l, const glm::dvec3& d) {
  const auto side = c.half > 0.0 ? within_side(c, l, d) : std::nullopt;
  if (!side) return std::nullopt;
  const auto on_it = [&](double t) { return std::isfinite(t) && std::abs(std::fma(t, d.z, l.z)) <= c.half; };
  const bool first = on_it(side->t_in), last = on_it(side->t_out);
  if (!first && !last) return std::nullopt;
  Stretch s{{first ? side->t_in : side->t_out}, {last ? side->t_out : side->t_in}};
  set_normal(c, l, d, s.in);
  set_normal(c, l, d, s.out);
  if (glm::dot(s.in.normal, d) > 0.0) s.in.normal = -s.in.normal;
  if (glm::dot(s.out.normal, d) < 0.0) s.out.normal = -s.out.normal;
  return s;
}

std::optional<Stretch> either(const std::optional<Stretch>& a, const std::optional<Stretch>& b) {
  if (!a || !b) return a ? a : b;
  return Stretch{a->in.t <= b->in.t ? a->in : b->in, a->out.t >= b->out.t ? a->out : b->out};
}

// A particle and a ray in its frame.
struct Local {
  AxisFrame frame{};
  double t{}; // parameter of l
  glm::dvec3 l{0}, d{0};
};
Local local(const Particle& p, const Ray& ray) {
  Local at;
  at.frame = axis_frame(xyz(p, 1));
  const Nearest n = nearest(ray.origin - p.center, ray.direction);
  at.t = n.t;
  at.l = into(at.frame.axes, n.l);
  at.d = into(at.frame.axes, ray.direction);
  return at;
}

std::optional<Stretch> cylinder(const Particle& p, const Local& at) {
  const double low = double(p.record[1].w), high = double(p.record[2].x);
  if (!(std::max(low, high) > 0.0)) return std::nullopt;
  const Frustum c = frustum(0.0, low, high, at.frame.half);
  return p.record[2].y == 0.0f ? capped(c, at.l, at.d) : open_ended(c, at.l, at.d);
}

std::optional<Stretch> cone(const Particle& p, const Local& at) {
  const double low = double(p.record[1].w), high = double(p.record[2].x);
  if (!(std::max(low, high) > 0.0)) return std::nullopt;
  return capped(frustum(0.0, low, high, at.frame.half), at.l, at.d);
}

// The head's base lies `head` below the tip; a head longer than the arrow is cut to it.
std::optional<Stretch> arrow(const Particle& p, const Local& at) {
  const double half = at.frame.half, head = std::clamp(double(p.record[2].y), 0.0, 2.0 * half);
  const double shaft_radius = double(p.record[1].w), head_radius = double(p.record[2].x);
  std::optional<Stretch> shaft, tip;
  if (shaft_radius > 0.0) shaft = capped({-0.5 * head, shaft_radius, 0.0, half - 0.5 * head}, at.l, at.d);
  if (head_radius > 0.0) tip = capped(frustum(half - 0.5 * head, head_radius, 0.0, 0.5 * head), at.l, at.d);
  return either(shaft, tip);
}

std::optional<Stretch> ball(const glm::dvec3& l, const glm::dvec3& d, double z, double radius) {
  const Nearest n = nearest(l - glm::dvec3(0, 0, z), d);
  const double distance = glm::length(n.l), squared = (radius - distance) * (radius + distance) / glm::dot(d, d);
  if (!(squared >= 0.0)) return std::nullopt;
  return Stretch{{n.t - std::sqrt(squared)}, {n.t + std::sqrt(squared)}};
}

// The union of a cylinder and two balls. Its normal points away from the nearest point of the segment, which is
// continuous where they join.
std::optional<Stretch> capsule(const Particle& p, const Local& at) {
  const double half = at.frame.half, radius = double(p.record[1].w);
  if (!(radius > 0.0)) return std::nullopt;
  auto s = either(either(ball(at.l, at.d, -half, radius), ball(at.l, at.d, half, radius)),
                  capped({0.0, radius, 0.0, half}, at.l, at.d));
  if (!s) return s;
  for (End* end : {&s->in, &s->out}) {
    glm::dvec3 q = at.l + end->t * at.d;
    q.z -= std::clamp(q.z, -half, half);
    end->normal = glm::normalize(q);
  }
  return s;
}

// Keeps what of the capsule lies before the plane through `at`; a zero normal keeps all.
bool cut(Stretch& s, const Local& at, const glm::dvec3& through, const glm::dvec3& normal) {
  if (normal == glm::dvec3(0)) return true;
  const glm::dvec3 n = glm::normalize(normal);
  const double height = glm::dot(at.l - through, n), slope = glm::dot(at.d, n);
  const bool first = height + s.in.t * slope > 0.0, last = height + s.out.t * slope > 0.0;
  if (first && last) return false;
  if (first) s.in = {-height / slope, Part::Side, n, true};
  if (last) s.out = {-height / slope, Part::Side, n, true};
  return true;
}

std::optional<Stretch> polyline(const Particle& p, const Local& at) {
  auto s = capsule(p, at);
  const glm::dvec3 end(0, 0, at.frame.half);
  const auto plane = [&](std::size_t k) { return p.record[k].w > 0.0f ? glm::dvec3(0) : into(at.frame.axes, xyz(p, k)); };
  if (!s || !cut(*s, at, end, plane(3)) || !cut(*s, at, -end, -plane(2))) return std::nullopt;
  return s;
}

// The polyline's segment where it is transparent. Ends of two segments that are nearer to each other than 1e-5 of their size are one, the
// earlier segment's: two of one radius share the ball at their joint.
std::optional<Interval> united_polyline(const Particle& p, const Ray& ray) {
  const Local at = local(p, ray);
  const auto whole = capsule(p, at), part = polyline(p, at);
  if (!part) return std::nullopt;
  Interval own{part->in.t, part->out.t, part->in.inner, part->out.inner};
  for (const std::size_t k : {std::size_t{2}, std::size_t{3}}) {
    if (!(p.record[k].w > 0.0f)) continue;
    const std::array<glm::vec4, 2> record{glm::vec4(0), p.record[k]};
    const Particle other{p.center + (k == 2 ? -1.0 : 1.0) * (xyz(p, 1) + xyz(p, k)), 0.0, record};
    const Local there = local(other, ray);
    const auto s = capsule(other, there);
    if (!s) continue;
    const double in = there.t - at.t + s->in.t, out = there.t - at.t + s->out.t;
    if (in >= whole->out.t || out <= whole->in.t) continue;
    const double sizes = glm::length(xyz(p, 1)) + double(p.record[1].w) + glm::length(xyz(p, k)) + double(p.record[k].w);
    const double tie = (k == 2 ? -1e-5 : 1e-5) * sizes / glm::length(ray.direction);
    const bool enters_there = in < whole->in.t - tie, leaves_there = out > whole->out.t + tie;
    if (enters_there && leaves_there) return std::nullopt;
    if (leaves_there) own.inner_out = true;
    if (!enters_there || out <= own.t_in) continue;
    own.t_in = std::min(out, own.t_out);
    own.inner_in = true;
  }
  return Interval{at.t + own.t_in, at.t + own.t_out, own.inner_in, own.inner_out};
}

using Solve = std::optional<Stretch> (*)(const Particle&, const Local&);

template <Solve solve> std::optional<Interval> intersect(const Particle& p, const Ray& ray) {
  const Local at = local(p, ray);
  const auto s = solve(p, at);
  if (!s) return std::nullopt;
  return Interval{at.t + s->in.t, at.t + s->out.t, s->in.inner, s->out.inner};
}

template <Solve solve> glm::dvec3 normal(const Particle& p, const Ray& ray, bool exit) {
  const Local at = local(p, ray);
  const auto s = solve(p, at);
  return s ? at.frame.axes * (exit ? s->out.normal : s->in.normal) : glm::dvec3(0);
}

void add_disk(Bounds& b, const glm::dvec3& center, const glm::dvec3& axis, double radius) {
  const glm::dvec3 half = radius * glm::sqrt(glm::max((1.0 - axis) * (1.0 + axis), 0.0));
  b.add(center - half);
  b.add(center + half);
}

Bounds capsule_bounds(const Particle& p) {
  return box_around(p.center, glm::abs(xyz(p, 1)) + double(p.record[1].w));
}

Bounds frustum_bounds(const Particle& p) {
  const glm::dvec3 h = xyz(p, 1), axis = axis_frame(h).axes[2];
  Bounds b;
  add_disk(b, p.center - h, axis, double(p.record[1].w));
  add_disk(b, p.center + h, axis, double(p.record[2].x));
  return b;
}

Bounds arrow_bounds(const Particle& p) {
  const glm::dvec3 h = xyz(p, 1);
  const AxisFrame frame = axis_frame(h);
  const glm::dvec3 axis = frame.axes[2];
  const double head = std::clamp(double(p.record[2].y), 0.0, 2.0 * frame.half);
  Bounds b;
  add_disk(b, p.center - h, axis, double(p.record[1].w));
  add_disk(b, p.center + (frame.half - head) * axis, axis, std::max(double(p.record[1].w), double(p.record[2].x)));
  b.add(p.center + h);
  return b;
}

double radius_of(const Particle& p) { return double(p.record[1].w); }
double mean_radius(const Particle& p) { return 0.5 * (double(p.record[1].w) + double(p.record[2].x)); }

} // namespace

constexpr Shape capsule_shape{"capsule", capsule_bounds, intersect<capsule>, normal<capsule>, radius_of};
constexpr Shape polyline_shape{"polyline", capsule_bounds, intersect<polyline>, normal<polyline>, radius_of, united_polyline};
constexpr Shape cylinder_shape{"cylinder", frustum_bounds, intersect<cylinder>, normal<cylinder>, mean_radius};
constexpr Shape cone_shape{"cone", frustum_bounds, intersect<cone>, normal<cone>, mean_radius};
constexpr Shape arrow_shape{"arrow", arrow_bounds, intersect<arrow>, normal<arrow>, radius_of};

} // namespace mote::reference
