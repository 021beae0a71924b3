// SPDX-License-Identifier: MIT
// Drags of things in the world: what is dragged stays under the mouse, on the axes that are largest on the screen.
#include "app/window/gizmo.hpp"

#include "core/scene/scene_file.hpp"

#include <gmock/gmock.h>

#include <random>

namespace mote::window {
namespace {

View view_from(const glm::dvec3& eye, bool flat = false) {
  Camera c;
  c.eye = eye;
  c.target = {0, 0, 0};
  c.height = 8;
  c.projection = flat ? Projection::Orthographic : Projection::Perspective;
  return make_view(c, {640, 480}, 1.0);
}
glm::dvec2 pixel_of(const View& view, const glm::dvec3& p) {
  const glm::dvec3 v = view.to_view(p);
  return glm::dvec2(v) * view.focal / (view.projection == Projection::Perspective ? v.z : 1.0) + view.center();
}
glm::dvec3 moved(const glm::dmat4& m, const glm::dvec3& p) { return glm::dvec3(m * glm::dvec4(p, 1.0)); }

TEST(Gizmo, TakesTheAxesThatAreLargestOnTheScreen) {
  const ScreenAxes front = screen_axes(view_from({0, -10, 0.5}), {0, 0, 0});
  EXPECT_EQ(front.x, 0);
  EXPECT_EQ(front.y, 2);
  const ScreenAxes side = screen_axes(view_from({10, 0.5, 0.5}), {0, 0, 0});
  EXPECT_EQ(side.x, 1);
  EXPECT_EQ(side.y, 2);
  const ScreenAxes above = screen_axes(view_from({0, -0.1, 10}), {0, 0, 0});
  EXPECT_EQ(above.x, 0);
  EXPECT_EQ(above.y, 1);
}

TEST(Gizmo, MovesWithTheMouseAlongAnAxis) {
  for (const bool flat : {false, true}) {
    const View view = view_from({0.0, -10, 0}, flat);
    const glm::dvec3 pivot{0.5, 0, 0.25};
    const ScreenAxes axes = screen_axes(view, pivot);
    const glm::dvec3 after = moved(gizmo_drag(GizmoMode::Move, axes, pivot, 30, -20), pivot);
    const glm::dvec2 by = pixel_of(view, after) - pixel_of(view, pivot);
    EXPECT_NEAR(by.x, 30.0, 1e-6);
    EXPECT_NEAR(by.y, -20.0, 1e-6);
    EXPECT_EQ(after.y, pivot.y) << "the axis to the eye is left alone";
  }
}

TEST(Gizmo, TurnsAndScalesAboutThePivot) {
  const View view = view_from({0, -10, 0});
  const glm::dvec3 pivot{1, 2, 3};
  const ScreenAxes axes = screen_axes(view, pivot);
  for (const GizmoMode mode : {GizmoMode::Turn, GizmoMode::Scale}) {
    const glm::dmat4 m = gizmo_drag(mode, axes, pivot, 40, 25);
    EXPECT_LT(glm::length(moved(m, pivot) - pivot), 1e-12);
  }
  const glm::dmat4 turn = gizmo_drag(GizmoMode::Turn, axes, {0, 0, 0}, 200, 0);
  EXPECT_LT(glm::length(moved(turn, {0, -1, 0}) - glm::dvec3(1, 0, 0)), 1e-12) << "the front goes to the right with the mouse";
  const glm::dmat4 tilt = gizmo_drag(GizmoMode::Turn, axes, {0, 0, 0}, 0, 200);
  EXPECT_LT(glm::length(moved(tilt, {0, -1, 0}) - glm::dvec3(0, 0, -1)), 1e-12) << "and down";
  const glm::dmat4 twice = gizmo_drag(GizmoMode::Scale, axes, {0, 0, 0}, 100, -200);
  EXPECT_LT(glm::length(moved(twice, {1, 1, 1}) - glm::dvec3(2, 1, 4)), 1e-12);
  EXPECT_LT(glm::length(moved(gizmo_drag(GizmoMode::Scale, axes, {0, 0, 0}, -100, 7, true), {1, 1, 1}) - glm::dvec3(0.5)), 1e-12);
}

TEST(Gizmo, RandomViewsGiveFiniteMatrices) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-5, 5);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 eye{any(random), any(random), i % 5 ? any(random) : 0.0}, pivot{any(random), any(random), any(random)};
    if (glm::length(glm::dvec2(eye)) < 1e-3) continue;
    const ScreenAxes axes = screen_axes(view_from(eye, i % 2), pivot);
    EXPECT_NE(axes.x, axes.y);
    for (const GizmoMode mode : {GizmoMode::Move, GizmoMode::Turn, GizmoMode::Scale}) {
      const glm::dmat4 m = gizmo_drag(mode, axes, pivot, any(random) * 50, any(random) * 50);
      for (int k = 0; k < 16; ++k) ASSERT_TRUE(std::isfinite(m[k / 4][k % 4]));
    }
  }
}

TEST(Gizmo, StepsReadBack) {
  glm::dmat4 m = gizmo_drag(GizmoMode::Turn, screen_axes(view_from({3, -10, 2}), {0, 0, 0}), {1, 2, 3}, 17, 31);
  Diagnostics diagnostics;
  const SceneDesc scene = parse_scene("schema = 1\n[[data]]\nfile = \"a.npy\"\ntransform = [" + transform_step(m) + "]\n", "s", {}, {}, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << to_string(diagnostics);
  for (int k = 0; k < 12; ++k) EXPECT_EQ(scene.data[0].transform[k / 3][k % 3], m[k / 3][k % 3]);
}

} // namespace
} // namespace mote::window
