// SPDX-License-Identifier: MIT
// Placement and culling without a device: what the CPU does for every frame.
#include "passes/particles/frame_uniform.hpp"
#include "passes/particles/placement.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>

using namespace mote;
using namespace mote::passes;

namespace {

View view_from(glm::dvec3 eye, glm::dvec3 target, Projection projection = Projection::Perspective) {
  Camera camera;
  camera.projection = projection;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0, 1, 0};
  camera.height = 10;
  return make_view(camera, {640, 360}, 100.0);
}

ChunkSet one_chunk(glm::dvec3 origin, float half) {
  ChunkSet set;
  set.chunks.push_back({.origin = origin, .box_min = glm::vec3(-half), .box_max = glm::vec3(half), .count = 1});
  set.records.resize(chunk_capacity);
  set.records[0] = {0, 0, 0, half};
  return set;
}

glm::vec3 origin_of(const PlacedChunk& p) {
  return {std::bit_cast<float>(p.bits.x), std::bit_cast<float>(p.bits.y), std::bit_cast<float>(p.bits.z)};
}

std::vector<PlacedChunk> place(const ChunkSet& set, const View& view, const glm::dmat4& m = glm::dmat4(1)) {
  PlacedChunks out;
  place_chunks(set, 0, set.chunks.size(), {m}, view, ViewCuller(view), out);
  out.far.insert(out.far.end(), out.near.begin(), out.near.end());
  return out.far;
}

// A million units from the origin the origin of a chunk is as exact as at the origin.
TEST(Placement, IsExactFarFromTheOrigin) {
  for (const double offset : {0.0, 1e3, 1e6, 1e9}) {
    const glm::dvec3 shift(offset, -offset, offset);
    const View view = view_from(shift + glm::dvec3(0, 0, 100), shift);
    const auto placed = place(one_chunk(shift + glm::dvec3(1.25, -2.5, 3.0), 1.0f), view);
    ASSERT_EQ(placed.size(), 1u);
    EXPECT_NEAR(origin_of(placed[0]).x, 1.25, 1e-6);
    EXPECT_NEAR(origin_of(placed[0]).y, 2.5, 1e-6); // y points down
    EXPECT_NEAR(origin_of(placed[0]).z, 97.0, 1e-5);
  }
}

TEST(Placement, InstancesMoveChunks) {
  const View view = view_from({0, 0, 100}, {0, 0, 0});
  glm::dmat4 m(2.0); // scale 2, then move
  m[3] = glm::dvec4(5, 0, 0, 1);
  const auto placed = place(one_chunk({1, 0, 0}, 1.0f), view, m);
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_NEAR(origin_of(placed[0]).x, 7.0, 1e-6);
}

// Never culls what a pixel could see: a point of the box inside the image keeps the chunk.
TEST(Placement, CullingIsConservative) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  int culled = 0;
  for (int i = 0; i < 20000; ++i) {
    const Projection projection = i % 3 ? Projection::Perspective : Projection::Orthographic;
    const View view = view_from(glm::dvec3(u(random), u(random), u(random)) * 20.0, glm::dvec3(u(random), u(random), u(random)), projection);
    const float half = std::pow(10.0f, static_cast<float>(u(random)));
    const ChunkSet set = one_chunk(glm::dvec3(u(random), u(random), u(random)) * 30.0, half);
    bool seen = false;
    for (int k = 0; k < 64 && !seen; ++k) {
      const glm::dvec3 p = view.to_view(set.chunks[0].origin + glm::dvec3(u(random), u(random), u(random)) * double(half));
      if (p.z <= 0) continue;
      const double w = projection == Projection::Perspective ? p.z : 1.0;
      seen = std::abs(p.x / w * view.focal) <= 320 && std::abs(p.y / w * view.focal) <= 180;
    }
    const bool kept = !place(set, view).empty();
    culled += !kept;
    if (seen) {
      ASSERT_TRUE(kept) << "case " << i;
    }
  }
  EXPECT_GT(culled, 2000); // and it does cull
}

// The eye a millionth of the radius above a sphere: its power keeps all digits, a float center alone would keep none.
TEST(Placement, ParticlesNearTheEyeArePlacedInDouble) {
  const View view = view_from({0, 0, 1000.001}, {0, 0, 0});
  PlacedChunks out;
  const ChunkSet set = one_chunk({0, 0, 0}, 1000.0f);
  place_chunks(set, 0, 1, {}, view, ViewCuller(view), out);
  ASSERT_EQ(out.near.size(), 1u);
  ASSERT_EQ(out.payloads.size(), chunk_capacity);
  const double exact = 1000.001 * 1000.001 - 1e6;
  EXPECT_NEAR(double(out.payloads[0].rest_power.w) + double(out.payloads[0].power_rest.x), exact, 1e-9 * exact);
  // A float32 center forgets half a ulp, 3e-5 at this distance; the rest holds it.
  const View aside = view_from({0.1, 0.3, 1000.7}, {0, 0, 0});
  PlacedChunks beside;
  place_chunks(set, 0, 1, {}, aside, ViewCuller(aside), beside);
  ASSERT_EQ(beside.payloads.size(), chunk_capacity);
  const glm::dvec3 center = aside.to_view({0, 0, 0});
  const NearPayload& p = beside.payloads[0];
  EXPECT_LT(glm::length(glm::dvec3(p.center_radius) + glm::dvec3(p.rest_power) - center), 1e-11);
  EXPECT_GT(glm::length(glm::dvec3(p.center_radius) - center), 1e-8);
  const View away = view_from({0, 0, 1e6}, {0, 0, 0});
  place_chunks(set, 0, 1, {}, away, ViewCuller(away), out);
  EXPECT_EQ(out.near.size(), 1u) << "from far away the chunk is not near";
  EXPECT_EQ(out.far.size(), 1u);
}

// The axis of a particle near the eye comes turned in double, as what own_space.glsl says its own space is.
TEST(Placement, VectorsNearTheEyeAreTurnedInDouble) {
  ChunkSet set = one_chunk({0, 0, 0}, 2.0f);
  set.vec4s_per_record = 2;
  set.records.assign(2 * chunk_capacity, glm::vec4(0));
  set.records[0] = {0, 0, 0, 2.0f};
  set.records[1] = {0.3f, 0.7f, -0.9f, 0.1f};
  const View view = view_from({1, 2, 2.5}, {0, 0, 0});
  const auto placed = [&](const glm::dmat4& m) {
    PlacedChunks out;
    place_chunks(set, 0, 1, {m}, view, ViewCuller(view), out);
    return out.payloads.at(0);
  };
  const auto vector = [](const NearPayload& p) { return glm::dvec3(p.vector_size) + glm::dvec3(p.power_rest.y, p.power_rest.z, p.power_rest.w); };
  const glm::dvec3 h(set.records[1]);
  const NearPayload doubled = placed(glm::dmat4(glm::dmat3(2.0)));
  EXPECT_LT(glm::length(vector(doubled) - view.rotation * (2.0 * h)), 1e-14);
  EXPECT_FLOAT_EQ(doubled.vector_size.w, 0.2f);
  const glm::dmat4 uneven(glm::dmat3(-1.5, 0.2, 0, 0.1, 1, 0.3, 0, 0, 0.5)); // mirrors, too
  const glm::dmat3 linear = view.rotation * glm::dmat3(uneven);
  const PrincipalAxes shape = principal_axes(linear);
  const NearPayload stretched = placed(uneven);
  EXPECT_LT(glm::length(shape.axes * (-shape.lengths * vector(stretched)) - linear * h), 1e-13);
  EXPECT_NEAR(glm::length(vector(stretched)), glm::length(h), 1e-13) << "turned, not stretched";
  EXPECT_FLOAT_EQ(stretched.vector_size.w, 0.1f);
}

TEST(Placement, NearAndFarCut) {
  View view = view_from({0, 0, 100}, {0, 0, 0});
  EXPECT_EQ(place(one_chunk({0, 0, 110}, 1.0f), view).size(), 0u) << "behind the eye";
  EXPECT_EQ(place(one_chunk({0, 0, 100.5}, 1.0f), view).size(), 1u) << "around the eye";
  view.near_cut = 50;
  EXPECT_EQ(place(one_chunk({0, 0, 60}, 1.0f), view).size(), 0u);
  EXPECT_EQ(place(one_chunk({0, 0, 50.5}, 1.0f), view).size(), 1u);
  view.far_cut = 60;
  EXPECT_EQ(place(one_chunk({0, 0, 0}, 1.0f), view).size(), 0u);
}

// Lights arrive in view space: x right, y down, z forward.
TEST(FrameBlock, PutsLightsIntoViewSpace) {
  Scene scene;
  scene.lights.resize(3);
  scene.lights[0].kind = LightKind::Headlight;
  scene.lights[1].kind = LightKind::Directional;
  scene.lights[1].direction = {0, -2, 0}; // travels down the world's y
  scene.lights[1].intensity = 0.5;
  scene.lights[2].kind = LightKind::Point;
  scene.lights[2].position = {3, 0, 90};
  scene.lights[2].attenuation = {1, 0, 2};
  const FrameBlock block = frame_block(scene, view_from({0, 0, 100}, {0, 0, 0}));
  EXPECT_EQ(block.lights[0].position, glm::vec4(0, 0, -1, 0));
  EXPECT_NEAR(block.lights[1].position.y, -1.0, 1e-6) << "to the light is up, which is -y";
  EXPECT_EQ(block.lights[1].position.w, 0.0f);
  EXPECT_FLOAT_EQ(block.lights[1].strength.r, 0.5f);
  EXPECT_NEAR(block.lights[2].position.x, 3.0, 1e-6);
  EXPECT_NEAR(block.lights[2].position.z, 10.0, 1e-5);
  EXPECT_EQ(block.lights[2].position.w, 1.0f);
  EXPECT_EQ(block.lights[2].attenuation.z, 2.0f);
  EXPECT_NEAR(view_from({0, 0, 100}, {0, 0, 0}).focal * (double(block.viewport.w) + double(block.depth_near.y)), 1.0, 1e-10);
}

} // namespace
