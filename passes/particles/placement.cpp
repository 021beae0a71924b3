// SPDX-License-Identifier: MIT
#include "passes/particles/placement.hpp"

#include "passes/particles/sprites.hpp"

#include <algorithm>
#include <bit>

namespace mote::passes {

ViewCuller::ViewCuller(const View& view) {
  // One pixel of slack: sample offsets, proxy margins and rounding never matter. From the axis to the sides, per unit of z:
  const glm::dvec2 low = (view.center() + 1.0) / view.focal, high = (glm::dvec2(view.size.width, view.size.height) - view.center() + 1.0) / view.focal;
  auto add = [&](glm::dvec3 normal, double offset) {
    const double length = glm::length(normal);
    planes_[count_] = normal / length;
    offsets_[count_++] = offset / length;
  };
  const bool perspective = view.projection == Projection::Perspective;
  for (const double side : {-1.0, 1.0}) {
    const double hx = side > 0 ? low.x : high.x, hy = side > 0 ? low.y : high.y;
    add(perspective ? glm::dvec3(side, 0, hx) : glm::dvec3(side, 0, 0), perspective ? 0.0 : hx);
    add(perspective ? glm::dvec3(0, side, hy) : glm::dvec3(0, side, 0), perspective ? 0.0 : hy);
  }
  add({0, 0, 1}, -view.near_cut);
  if (view.far_cut > 0) add({0, 0, -1}, view.far_cut);
}

ViewCuller::Reaches ViewCuller::reaches(const glm::dmat3& view_from_data) const {
  Reaches out;
  for (std::size_t i = 0; i < count_; ++i) out[i] = glm::abs(planes_[i] * view_from_data) * (1.0 + 1e-6);
  return out;
}

bool ViewCuller::may_see(const glm::dvec3& center, const Reaches& reaches, const glm::dvec3& half) const {
  const double slack = 1e-6 * glm::length(center);
  for (std::size_t i = 0; i < count_; ++i)
    if (glm::dot(planes_[i], center) + offsets_[i] < -glm::dot(reaches[i], half) - slack) return false;
  return true;
}

namespace {

// Distance from the eye to a box, in data space.
double distance_to_box(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& half) {
  return glm::length(glm::max(glm::abs(eye - center) - half, glm::dvec3(0)));
}

// Radius of a ball around the image of a box.
double reach(const glm::dmat3& linear, const glm::dvec3& half) {
  return glm::length(linear[0]) * half.x + glm::length(linear[1]) * half.y + glm::length(linear[2]) * half.z;
}

// A double as the sum of two floats. Volatile, because g++ 12 at -O2 forgets the rounding where it makes two such
// conversions at once, and then nothing is left over.
struct TwoFloats {
  float high, rest;
  explicit TwoFloats(double value) {
    volatile float rounded = static_cast<float>(value);
    high = rounded;
    rest = static_cast<float>(value - double{high});
  }
};

} // namespace

void ChunkPlacer::add_near(const ChunkSet& set, std::uint64_t chunk, const glm::dvec3& origin, std::vector<NearPayload>& out) const {
  for (std::uint64_t record = chunk * chunk_capacity; record < (chunk + 1) * chunk_capacity; ++record) {
    const glm::vec4 stored = set.records[record * set.vec4s_per_record];
    const glm::dvec3 center = origin + linear_ * glm::dvec3(stored);
    double radius = scale_ * double(stored.w), distance = glm::length(center), power = (distance - radius) * (distance + radius);
    if (!similar_) {
      distance = glm::length(center * axes_.axes / (axes_.lengths * radius));
      power = radius > 0.0 ? (distance - 1.0) * (distance + 1.0) : 0.0;
    }
    const TwoFloats x(center.x), y(center.y), z(center.z), p(power);
    const glm::vec4 second = set.vec4s_per_record > 1 ? set.records[record * set.vec4s_per_record + 1] : glm::vec4(0);
    const glm::dvec3 vector = own_from_data_ * glm::dvec3(second);
    const TwoFloats u(vector.x), v(vector.y), w(vector.z);
    out.push_back({glm::vec4(x.high, y.high, z.high, static_cast<float>(radius)), glm::vec4(x.rest, y.rest, z.rest, p.high),
                   glm::vec4(p.rest, u.rest, v.rest, w.rest), glm::vec4(u.high, v.high, w.high, static_cast<float>(scale_ * double(second.w)))});
  }
}

ChunkPlacer::ChunkPlacer(const Instance& instance, const View& view, const ViewCuller& culler)
    : culler_(culler), instance_linear_(instance.world_from_data), linear_(view.rotation * instance_linear_),
      rotation_(view.rotation), translation_(glm::dvec3(instance.world_from_data[3]) - view.eye),
      eye_(glm::inverse(instance_linear_) * -translation_) {
  const auto scale = similarity_scale(instance.world_from_data);
  similar_ = scale.has_value();
  scale_ = scale.value_or(1.0);
  if (!similar_) axes_ = principal_axes(linear_);
  own_from_data_ = linear_;
  if (!similar_) // V^T of linear = U S V^T; S is negative where it mirrors
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) own_from_data_[i][k] = glm::dot(axes_.axes[k], linear_[i]) / (glm::determinant(linear_) < 0.0 ? -axes_.lengths[k] : axes_.lengths[k]);
  for (int i = 0; i < 3; ++i) reach_[i] = glm::abs(linear_[i]);
  plane_reaches_ = culler.reaches(linear_);
}

bool ChunkPlacer::place(const Chunk& chunk, PlacedBox& out) const {
  // Subtract the eye before anything is rotated or rounded.
  out.origin = rotation_ * (instance_linear_ * chunk.origin + translation_);
  const glm::dvec3 lo(chunk.box_min), hi(chunk.box_max), center = (lo + hi) * 0.5, half = (hi - lo) * 0.5;
  out.center = out.origin + linear_ * center;
  if (!culler_.may_see(out.center, plane_reaches_, half)) return false;
  out.extent = reach_ * half;
  if (similar_) {
    const double distance = distance_to_box(eye_, chunk.origin + center, half);
    out.near = distance < 2.0 * glm::length(half);
    out.distance = scale_ * distance;
  } else {
    const double radius = reach(linear_, half);
    out.distance = std::max(0.0, glm::length(out.center) - radius);
    out.near = out.distance < 2.0 * radius;
  }
  return true;
}

glm::vec4 ChunkPlacer::in_view(const ChunkSet& set, std::uint64_t record, const PlacedBox& box) const {
  const glm::vec4 stored = set.records[record * set.vec4s_per_record];
  return {glm::vec3(box.origin + linear_ * glm::dvec3(stored)), static_cast<float>(scale_ * double{stored.w})};
}

void ChunkPlacer::add(const ChunkSet& set, std::uint64_t chunk, std::uint64_t in_slice, const PlacedBox& box, PlacedChunks& out) const {
  const glm::vec3 o(box.origin);
  const PlacedChunk placed{glm::uvec4(std::bit_cast<std::uint32_t>(o.x), std::bit_cast<std::uint32_t>(o.y),
                                      std::bit_cast<std::uint32_t>(o.z), static_cast<std::uint32_t>(in_slice))};
  (box.near ? out.near : out.far).push_back(placed);
  if (box.near) add_near(set, chunk, box.origin, out.payloads);
}

void place_chunks(const ChunkSet& set, std::uint64_t first, std::uint64_t count, const Instance& instance,
                  const View& view, const ViewCuller& culler, PlacedChunks& out, const SpriteRule* sprites) {
  const ChunkPlacer placer(instance, view, culler);
  PlacedBox box;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!placer.place(set.chunks[first + i], box)) continue;
    placer.add(set, first + i, i, box, out);
    if (!sprites || box.near || !placer.similar() || !sprites->fits(box, placer.scale() * double{set.chunks[first + i].max_radius})) continue;
    out.sprites.push_back(out.far.back());
    out.far.pop_back();
  }
}

} // namespace mote::passes
