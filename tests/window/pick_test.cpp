// SPDX-License-Identifier: MIT
// Picking by ids around the mouse, and what slots of a graph show: pure parts.
#include "app/window/pick.hpp"
#include "app/window/slot.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

namespace mote::window {
namespace {

View test_view() {
  Camera c;
  c.eye = {0, -10, 0};
  c.target = {0, 0, 0};
  return make_view(c, {64, 48}, 1.0);
}
PickArea area_of(const View& part, std::vector<std::uint32_t> ids) {
  PickArea a{part.panel_origin, part.size, std::move(ids), {}};
  for (const std::uint32_t id : a.ids) a.depths.push_back(id == no_particle ? INFINITY : 10.0f);
  return a;
}

TEST(Pick, AreaIsCutAtThePicture) {
  const View view = test_view();
  const View middle = pick_view(view, 30.5, 20.5, 3);
  EXPECT_EQ(middle.size, (Size2d{7, 7}));
  EXPECT_EQ(middle.panel_origin, glm::uvec2(27, 17));
  const View corner = pick_view(view, 0.0, 47.9, 3);
  EXPECT_EQ(corner.panel_origin, glm::uvec2(0, 44));
  EXPECT_EQ(corner.size, (Size2d{4, 4}));
  const View outside = pick_view(view, -50, 1e6, 2);
  EXPECT_GT(outside.size.width * outside.size.height, 0u);
}

TEST(Pick, NearestWinsAndAHitWinsAtOnce) {
  const View view = test_view(), part = pick_view(view, 30.5, 20.5, 1);
  constexpr std::uint32_t n = no_particle;
  EXPECT_FALSE(nearest_particle(area_of(part, {n, n, n, n, n, n, n, n, n}), 30.5, 20.5, view));
  EXPECT_EQ(nearest_particle(area_of(part, {7, n, n, n, n, n, n, n, n}), 30.5, 20.5, view)->id, 7u);
  EXPECT_EQ(nearest_particle(area_of(part, {7, n, n, n, 3, n, n, n, n}), 30.5, 20.5, view)->id, 3u);
  EXPECT_EQ(nearest_particle(area_of(part, {7, 5, n, n, n, n, n, n, n}), 30.5, 20.5, view)->id, 5u) << "beside, not across";
  PickArea tie = area_of(part, {n, 5, n, n, n, n, n, 6, n});
  tie.depths[7] = 9.0f;
  EXPECT_EQ(nearest_particle(tie, 30.5, 20.5, view)->id, 6u) << "the one before";
}

TEST(Pick, SurfacePointLiesOnTheRay) {
  const View view = test_view(), part = pick_view(view, 32, 24, 0);
  const auto pick = nearest_particle(area_of(part, {1}), 32, 24, view);
  ASSERT_TRUE(pick);
  const glm::dvec3 in_view = view.to_view(pick->surface);
  EXPECT_NEAR(in_view.z, 10.0, 1e-9);
  EXPECT_NEAR(in_view.x / in_view.z * view.focal + view.center().x, 32.5, 1e-9);
}

TEST(Pick, Angles) {
  EXPECT_NEAR(*angle_at({1, 0, 0}, {0, 0, 0}, {0, 3, 0}), 90.0, 1e-12);
  EXPECT_NEAR(*angle_at({1, 0, 0}, {0, 0, 0}, {-2, 0, 0}), 180.0, 1e-12);
  EXPECT_NEAR(*angle_at({1, 0, 0}, {0, 0, 0}, {1, 1e-9, 0}), std::atan(1e-9) * 180 / 3.14159265358979, 1e-15);
  EXPECT_FALSE(angle_at({1, 0, 0}, {1, 0, 0}, {0, 3, 0}));
}

template <class T> SlotPixels slot_of(Size2d size, gpu::TextureFormat format, const std::vector<T>& values) {
  SlotPixels s{size, format, std::vector<std::byte>(values.size() * sizeof(T))};
  std::memcpy(s.bytes.data(), values.data(), s.bytes.size());
  return s;
}

TEST(Slot, ValuesAndRanges) {
  const SlotPixels ids = slot_of<std::uint32_t>({2, 2}, gpu::TextureFormat::R32Uint, {7, 0xFFFFFFFFu, 16777217, 9});
  EXPECT_EQ(ids.text(0, 1), "16777217") << "exactly, beyond what a float holds";
  EXPECT_EQ(ids.text(1, 0), "nothing");
  EXPECT_EQ(ids.range(0), (std::pair{7.0, 16777217.0}));
  const SlotPixels depth = slot_of<float>({3, 1}, gpu::TextureFormat::R32Float, {INFINITY, 2.5f, -1.0f});
  EXPECT_EQ(depth.range(0), (std::pair{-1.0, 2.5}));
  const auto gray = depth.picture({-1.0, 2.5});
  EXPECT_EQ(gray[0], 255);
  EXPECT_EQ(gray[4], 255);
  EXPECT_EQ(gray[8], 0);
  const SlotPixels color = slot_of<std::uint8_t>({1, 1}, gpu::TextureFormat::BGRA8Unorm, {0, 51, 255, 255});
  EXPECT_EQ(color.text(0, 0), "1, 0.2, 0, 1");
  EXPECT_EQ(color.picture({0, 1})[0], 255);
  const SlotPixels broken = slot_of<float>({1, 1}, gpu::TextureFormat::R32Float, {NAN});
  EXPECT_EQ(broken.range(0), (std::pair{0.0, 0.0}));
  EXPECT_EQ(broken.picture({0, 1})[1], 0) << "magenta";
}

} // namespace
} // namespace mote::window
