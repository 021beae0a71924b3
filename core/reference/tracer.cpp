// SPDX-License-Identifier: MIT
#include "core/reference/tracer.hpp"

#include <algorithm>
#include <cmath>

namespace mote::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-13; // of the coordinates involved: what double arithmetic may lose, generously

// The spacing of float32 numbers at |t|.
double ulp(double t) {
  const float f = static_cast<float>(std::abs(t));
  if (!std::isfinite(f)) return 0.0;
  return double(std::nextafter(f, std::numeric_limits<float>::infinity())) - double(f);
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
double largest(const Bounds& b) { return std::max(largest(b.min), largest(b.max)); }

} // namespace

// The sample's ray and, where ambiguity matters, its four neighbors: walked together, along the first one.
struct Tracer::Search {
  std::array<Ray, 5> rays{}; // world axes, relative to the eye
  std::size_t count{1};
  std::array<Ray, 5> local{}; // in the data space of the instance being visited
  double slack{};             // ... and how far its neighbors stray there
  std::array<Hit, 5> best{};
  double second{infinity}; // on the first ray: the nearest visible surface of any other particle
  bool near_doubt{}, far_doubt{};
  double limit{infinity}; // nothing beyond can matter
  double limit_start{infinity};

  void offer(std::size_t ray, const Hit& hit) {
    Hit& best_hit = best[ray];
    const bool better = hit.t < best_hit.t || (hit.t == best_hit.t && hit.id < best_hit.id);
    if (ray == 0) second = std::min(second, better ? best_hit.t : hit.t);
    if (!better) return;
    best_hit = hit;
    double reach = 0.0;
    for (std::size_t i = 0; i < count; ++i) reach = std::max(reach, best[i].t);
    limit = std::min(limit_start, reach * (1.0 + 1e-6)); // 4 ulp (float32) are less than 5e-7
  }
};

Tracer::Tracer(const World& world, const View& view) : world_(world), view_(view) {
  near_ = std::max(0.0, view.near_cut);
  far_ = view.far_cut > 0.0 ? view.far_cut : infinity;
  near_margin_ = 4.0 * ulp(near_);
  far_margin_ = far_ < infinity ? 4.0 * ulp(far_) : 0.0;
  t_min_ = near_ * (1.0 - 1e-6);
  seen_.resize(world.placed.size());
  const glm::dvec3 forward = glm::transpose(view.rotation) * glm::dvec3(0, 0, 1);
  const double step =
      ambiguous_shift / view.focal; // a neighbor's sideways distance; perspective: per unit of depth
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Placed& p = world.placed[i];
    seen_[i].eye = p.data_from_world * (view.eye - p.translation);
    double depth = 1.0; // orthographic
    if (view.projection == Projection::Perspective) {
      const glm::dvec3 half = (p.bounds.max - p.bounds.min) * 0.5;
      depth = glm::dot(p.bounds.center() - view.eye, forward) + glm::dot(half, glm::abs(forward));
    }
    const double world_slack = step * std::max(0.0, depth);
    const double coordinates = largest(seen_[i].eye) + largest(p.tree->bvh.bounds) +
                               p.stretch * (largest(view.eye) + largest(p.translation));
    seen_[i].slack = world_slack * p.stretch + rounding * coordinates;
    top_slack_ = std::max(top_slack_, world_slack + rounding * (largest(p.bounds) + largest(view.eye)));
  }
}

Ray Tracer::local(const Ray& ray, std::uint32_t placed) const {
  const glm::dmat3& m = world_.placed[placed].data_from_world;
  return {seen_[placed].eye + m * ray.origin, m * ray.direction};
}

void Tracer::leaf(Search& search, std::uint32_t placed, std::uint32_t record) const {
  const Placed& owner = world_.placed[placed];
  const ChunkSet& chunks = *owner.tree->chunks;
  const Particle p = particle(chunks, record);
  const Ray& first = search.local[0];
  const glm::dvec3 m = p.center - first.origin;
  const double s = glm::dot(m, first.direction) / glm::dot(first.direction, first.direction);
  const glm::dvec3 l = m - s * first.direction;
  const double reach = p.radius * (1.0 + 1e-6) + search.slack; // a float32 bounding radius may be rounded down
  if (glm::dot(l, l) > reach * reach * (1.0 + 1e-12)) return;
  Hit hit{0.0, owner.first_id + chunks.rows[record], placed, record, false};
  for (std::size_t i = 0; i < search.count; ++i) {
    const auto interval = owner.tree->shape->intersect(p, search.local[i]);
    if (!interval) continue;
    const double t_in = interval->t_in, t_out = interval->t_out;
    const auto visible = [&](double t) { return t > 0.0 && t >= near_ && t <= far_; };
    if (i == 0) {
      const double margin = near_ > 0.0 ? near_margin_ : 0x1p-21 * std::max(std::abs(t_in), std::abs(t_out));
      search.near_doubt |= std::abs(t_in - near_) <= margin || std::abs(t_out - near_) <= margin;
      search.far_doubt |= std::abs(t_in - far_) <= far_margin_ || std::abs(t_out - far_) <= far_margin_;
    }
    hit.exit = interval->inner_in || !visible(t_in);
    hit.t = hit.exit ? t_out : t_in;
    if (hit.exit && interval->inner_out) continue;
    if (visible(hit.t)) search.offer(i, hit);
  }
}

void Tracer::instance(Search& search, std::uint32_t placed) const {
  const Tree& tree = *world_.placed[placed].tree;
  for (std::size_t i = 0; i < search.count; ++i) search.local[i] = local(search.rays[i], placed);
  search.slack = seen_[placed].slack;
  walk(
      tree.bvh, search.local[0].origin, search.local[0].direction, search.slack, t_min_,
      [&] { return search.limit; },
      [&](std::uint32_t begin, std::uint32_t count) {
        for (std::uint32_t i = begin; i < begin + count; ++i) leaf(search, placed, tree.bvh.order[i]);
      });
}

bool Tracer::ambiguous(const Search& s) const {
  const Hit& hit = s.best[0];
  if (s.near_doubt || (s.far_doubt && hit.t >= far_ - far_margin_)) return true;
  for (std::size_t i = 1; i < s.count; ++i)
    if (s.best[i].id != hit.id || s.best[i].exit != hit.exit) return true;
  if (!hit) return false;
  return s.second - hit.t <= 4.0 * ulp(hit.t) || world_.placed[hit.placed].tree->is_repeated(hit.record);
}

Sample Tracer::sample(double x, double y, bool ambiguity) const {
  const glm::dmat3 world_from_view = glm::transpose(view_.rotation);
  const auto ray = [&](double dx, double dy) {
    return Ray{world_from_view * view_.ray_origin(x + dx, y + dy),
               world_from_view * view_.ray_direction(x + dx, y + dy)};
  };
  Search search;
  search.rays[0] = ray(0, 0);
  if (ambiguity) {
    constexpr double d = ambiguous_shift;
    search.count = 5;
    search.rays[1] = ray(-d, 0);
    search.rays[2] = ray(d, 0);
    search.rays[3] = ray(0, -d);
    search.rays[4] = ray(0, d);
  }
  search.limit = search.limit_start = far_ * (1.0 + 1e-6);
  walk(
      world_.top, view_.eye + search.rays[0].origin, search.rays[0].direction, top_slack_, t_min_,
      [&] { return search.limit; },
      [&](std::uint32_t begin, std::uint32_t count) {
        for (std::uint32_t i = begin; i < begin + count; ++i) instance(search, world_.top.order[i]);
      });
  return {search.best[0], search.rays[0], ambiguity && ambiguous(search)};
}

glm::dvec3 Tracer::normal(const Sample& sample) const {
  const Placed& p = world_.placed[sample.hit.placed];
  const glm::dvec3 n = p.tree->shape->normal(particle(*p.tree->chunks, sample.hit.record),
                                             local(sample.ray, sample.hit.placed), sample.hit.exit);
  return glm::normalize(p.normal_to_world * (sample.hit.exit ? -n : n));
}

double Tracer::projected_radius(const Hit& hit) const {
  const Placed& p = world_.placed[hit.placed];
  const Particle of = particle(*p.tree->chunks, hit.record);
  const double radius = view_.focal * p.tree->shape->curvature(of) * p.curvature;
  if (view_.projection == Projection::Orthographic) return radius;
  return radius / glm::length(p.linear * (of.center - seen_[hit.placed].eye));
}

bool Tracer::occluded(const Ray& ray, double t_max, std::uint64_t skip_id) const {
  double limit = t_max;
  const auto open = [&] { return limit; };
  const auto visit = [&](std::uint32_t placed) {
    const Placed& owner = world_.placed[placed];
    const Ray r = local(ray, placed);
    walk(owner.tree->bvh, r.origin, r.direction, seen_[placed].slack, 0.0, open,
         [&](std::uint32_t begin, std::uint32_t count) {
           for (std::uint32_t i = begin; i < begin + count; ++i) {
             const std::uint32_t record = owner.tree->bvh.order[i];
             if (owner.first_id + owner.tree->chunks->rows[record] == skip_id) continue;
             const auto interval = owner.tree->shape->intersect(particle(*owner.tree->chunks, record), r);
             if (!interval) continue;
             const auto between = [&](double t) { return t > 0.0 && t < t_max; };
             if ((!interval->inner_in && between(interval->t_in)) || (!interval->inner_out && between(interval->t_out))) limit = -1.0;
           }
         });
  };
  walk(world_.top, view_.eye + ray.origin, ray.direction, top_slack_, 0.0, open,
       [&](std::uint32_t begin, std::uint32_t count) {
         for (std::uint32_t i = begin; i < begin + count && limit > 0.0; ++i) visit(world_.top.order[i]);
       });
  return limit < 0.0;
}

} // namespace mote::reference
