// SPDX-License-Identifier: MIT
#include "core/reference/shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::reference {

double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

glm::dvec3 particle_color(const World& world, const Placed& placed, std::uint32_t record) {
  static const std::array<double, 256> linear = [] {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < 256; ++i) table[i] = srgb_to_linear(double(i) / 255.0);
    return table;
  }();
  const ChunkSet& chunks = *placed.tree->chunks;
  if (chunks.colors.empty()) return world.scene.batches[placed.batch].color;
  const std::uint32_t c = chunks.color_of(record);
  return {linear[c & 255u], linear[(c >> 8) & 255u], linear[(c >> 16) & 255u]};
}

namespace {

double smoothstep(double low, double high, double x) {
  if (x >= high) return 1.0;
  if (x <= low) return 0.0;
  const double t = (x - low) / (high - low);
  return t * t * (3.0 - 2.0 * t);
}

} // namespace

Arriving arriving(const Light& light, const glm::dvec3& position, const glm::dvec3& eye,
                  const glm::dvec3& forward) {
  Arriving a;
  a.strength = light.color * light.intensity;
  a.distance = std::numeric_limits<double>::infinity();
  if (light.kind == LightKind::Directional) a.to_light = -glm::normalize(light.direction);
  if (light.kind == LightKind::Headlight) a.to_light = -forward;
  if (light.kind == LightKind::Directional || light.kind == LightKind::Headlight) return a;
  const glm::dvec3 way = (light.position - eye) - position;
  a.distance = glm::length(way);
  a.to_light = a.distance > 0.0 ? way / a.distance : glm::dvec3(0); // in the light itself: n.l = 0
  const glm::dvec3& k = light.attenuation;
  a.strength /= k.x + a.distance * (k.y + k.z * a.distance);
  if (light.kind == LightKind::Spot) {
    const double cosine = -glm::dot(glm::normalize(light.direction), a.to_light);
    a.strength *= smoothstep(std::cos(light.outer_angle), std::cos(light.inner_angle), cosine);
  }
  return a;
}

double specular(const Material& material, const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v) {
  double cosine = 0.0;
  switch (material.model) {
  case ShadingModel::Lambert: return 0.0;
  case ShadingModel::Phong: cosine = glm::dot(2.0 * glm::dot(n, l) * n - l, v); break;
  case ShadingModel::BlinnPhong:
    cosine = glm::length(l + v) > 0.0 ? glm::dot(n, glm::normalize(l + v)) : 0.0;
    break;
  }
  return std::pow(std::max(0.0, cosine), material.exponent); // pow(0, 0) = 1
}

glm::dvec3 shade_surface(const Tracer& tracer, const SurfacePoint& at, bool shadows) {
  const World& world = tracer.world();
  const Material& m = world.scene.batches[at.placed.batch].material;
  const glm::dvec3& normal = at.normal;
  const glm::dvec3 position = at.ray.origin + at.t * at.ray.direction;
  const glm::dvec3 to_eye = -glm::normalize(at.ray.direction);
  const glm::dvec3 forward = glm::transpose(tracer.view().rotation) * glm::dvec3(0, 0, 1);
  glm::dvec3 diffuse(0), gloss(0);
  for (const Light& light : world.scene.lights) {
    const Arriving a = arriving(light, position, tracer.view().eye, forward);
    const double cosine = glm::dot(normal, a.to_light);
    if (!(cosine > 0.0)) continue;
    if (shadows && light.shadows && tracer.occluded({position, a.to_light}, a.distance, at.id))
      continue;
    diffuse += a.strength * cosine;
    if (m.specular > 0.0) gloss += a.strength * specular(m, normal, a.to_light, to_eye);
  }
  const glm::dvec3 color = particle_color(world, at.placed, at.record);
  return color * (m.ambient * world.scene.ambient + m.diffuse * diffuse) + m.specular * gloss;
}

glm::dvec4 shade(const Tracer& tracer, const Sample& sample, const glm::dvec3& normal, bool shadows) {
  if (!sample.hit) return tracer.world().scene.background;
  const Placed& placed = tracer.world().placed[sample.hit.placed];
  return {shade_surface(tracer, {placed, sample.hit.record, sample.hit.id, sample.ray, sample.hit.t, normal}, shadows), 1.0};
}

} // namespace mote::reference
