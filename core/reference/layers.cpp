// SPDX-License-Identifier: MIT
#include "core/reference/layers.hpp"

#include "core/reference/shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-13; // of the coordinates involved

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
double largest(const Bounds& b) { return std::max(largest(b.min), largest(b.max)); }

bool nearer(const Layer& a, const Layer& b) {
  if (a.t != b.t) return a.t < b.t;
  return a.id != b.id ? a.id < b.id : !a.exit && b.exit;
}

// Within 4 units in the last place of a float32.
bool close(double a, double b) {
  const float f = static_cast<float>(std::max(std::abs(a), std::abs(b)));
  return std::isfinite(f) && std::abs(a - b) <= 4.0 * (double(std::nextafter(f, std::numeric_limits<float>::infinity())) - double(f));
}

} // namespace

LayerTracer::LayerTracer(const Tracer& tracer, bool two_surfaces)
    : tracer_(tracer), world_(tracer.world()), two_surfaces_(two_surfaces) {
  const View& view = tracer.view();
  near_ = std::max(0.0, view.near_cut);
  far_ = view.far_cut > 0.0 ? view.far_cut : infinity;
  for (const Placed& p : world_.transparent_placed) {
    eyes_.push_back(p.data_from_world * (view.eye - p.translation));
    slacks_.push_back(rounding * (largest(eyes_.back()) + largest(p.tree->bvh.bounds) +
                                  p.stretch * (largest(view.eye) + largest(p.translation))));
    top_slack_ = std::max(top_slack_, rounding * (largest(p.bounds) + largest(view.eye)));
  }
}

Ray LayerTracer::local(const Ray& ray, std::uint32_t placed) const {
  const glm::dmat3& m = world_.transparent_placed[placed].data_from_world;
  return {eyes_[placed] + m * ray.origin, m * ray.direction};
}

void LayerTracer::add(const Ray& ray, double limit, std::uint32_t placed, std::uint32_t record,
                      std::vector<Layer>& out) const {
  const Placed& owner = world_.transparent_placed[placed];
  const Shape& shape = *owner.tree->shape;
  const auto interval = (shape.united ? shape.united : shape.intersect)(particle(*owner.tree->chunks, record), ray);
  if (!interval) return;
  const std::uint64_t id = owner.first_id + owner.tree->chunks->rows[record];
  const auto uncut = [&](double t) { return t > 0.0 && t >= near_; };
  const Batch& batch = world_.scene.batches[owner.batch];
  const bool absorbs = batch.density > 0.0;
  const std::size_t before = out.size();
  const auto offer = [&](double t, bool exit) {
    const bool inner = exit ? interval->inner_out : interval->inner_in;
    if (uncut(t) && t <= far_ && t < limit && (absorbs || !inner)) out.push_back({t, id, placed, record, exit, inner});
  };
  const bool inside = !uncut(interval->t_in);
  if (two_surfaces_ || !inside) offer(interval->t_in, false);
  if (two_surfaces_ || inside) offer(interval->t_out, true);
  if (!absorbs) return;
  const double from = std::max({interval->t_in, near_, 0.0}), to = std::min({interval->t_out, far_, limit});
  const double own = owner.tree->chunks->alpha_of(record);
  const double depth = batch.density * own * std::max(0.0, to - from) * glm::length(owner.linear * ray.direction);
  for (std::size_t i = before; i < out.size(); ++i) out[i].blocks = 1.0 - std::exp(-depth / double(out.size() - before));
}

std::vector<Layer> LayerTracer::layers(const Ray& ray, double limit) const {
  std::vector<Layer> out;
  const double end = std::min(limit, far_) * (1.0 + 1e-6);
  const auto reach = [&] { return end; };
  walk(world_.transparent_top, tracer_.view().eye + ray.origin, ray.direction, top_slack_, 0.0, reach,
       [&](std::uint32_t first, std::uint32_t count) {
         for (std::uint32_t i = first; i < first + count; ++i) {
           const std::uint32_t placed = world_.transparent_top.order[i];
           const Bvh& bvh = world_.transparent_placed[placed].tree->bvh;
           const Ray r = local(ray, placed);
           walk(bvh, r.origin, r.direction, slacks_[placed], 0.0, reach,
                [&](std::uint32_t begin, std::uint32_t records) {
                  for (std::uint32_t k = begin; k < begin + records; ++k) add(r, limit, placed, bvh.order[k], out);
                });
         }
       });
  std::sort(out.begin(), out.end(), nearer);
  return out;
}

double LayerTracer::alpha_of(const Layer& layer) const {
  if (layer.blocks >= 0.0) return layer.blocks;
  const Placed& p = world_.transparent_placed[layer.placed];
  const double alpha = world_.scene.batches[p.batch].alpha * p.tree->chunks->alpha_of(layer.record);
  return two_surfaces_ ? 1.0 - std::sqrt(1.0 - alpha) : alpha;
}

glm::dvec3 LayerTracer::normal(const Layer& layer, const Ray& ray) const {
  if (layer.inner) return -glm::normalize(ray.direction);
  const Placed& p = world_.transparent_placed[layer.placed];
  const glm::dvec3 n =
      p.tree->shape->normal(particle(*p.tree->chunks, layer.record), local(ray, layer.placed), layer.exit);
  return glm::normalize(p.normal_to_world * (layer.exit ? -n : n));
}

glm::dvec4 LayerTracer::over(const std::vector<Layer>& layers, const Ray& ray, const glm::dvec4& behind,
                             bool shadows) const {
  if (layers.empty()) return behind;
  glm::dvec3 light = glm::dvec3(behind) * behind.a; // times its alpha
  double alpha = behind.a;
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const Placed& p = world_.transparent_placed[layer->placed];
    const glm::dvec3 color =
        shade_surface(tracer_, {p, layer->record, layer->id, ray, layer->t, normal(*layer, ray)}, shadows);
    const double a = alpha_of(*layer);
    light = a * color + (1.0 - a) * light;
    alpha = a + (1.0 - a) * alpha;
  }
  return alpha > 0.0 ? glm::dvec4(light / alpha, alpha) : behind;
}

bool LayerTracer::ambiguous(double x, double y, const Sample& sample, const std::vector<Layer>& layers_here) const {
  double before = near_;
  for (const Layer& layer : layers_here) {
    if (!layer.inner && close(layer.t, before)) return true;
    before = layer.t;
  }
  if (!layers_here.empty() && sample.hit && close(before, sample.hit.t)) return true;
  constexpr double d = ambiguous_shift;
  constexpr std::array<std::array<double, 2>, 4> shifts{{{-d, 0}, {d, 0}, {0, -d}, {0, d}}};
  return std::any_of(shifts.begin(), shifts.end(), [&](const auto& shift) {
    const Sample beside = tracer_.sample(x + shift[0], y + shift[1], false);
    const std::vector<Layer> there = layers(beside.ray, beside.hit.t);
    return !std::equal(there.begin(), there.end(), layers_here.begin(), layers_here.end(),
                       [](const Layer& a, const Layer& b) { return a.id == b.id && a.exit == b.exit; });
  });
}

} // namespace mote::reference
