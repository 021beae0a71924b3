// SPDX-License-Identifier: MIT
// Drags of things in the world: what is dragged stays under the mouse, on the axes that are largest on the screen.
#include "app/window/handles.hpp"

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

TEST(Gizmo, MovesWithTheMouseAlongTwoAxes) {
  for (const bool flat : {false, true}) {
    const View view = view_from({0.0, -10, 0}, flat);
    const glm::dvec3 pivot{0.5, 0, 0.25};
    const glm::dvec3 after = moved(gizmo_change(GizmoMode::Move, view, pivot, 30, -20).matrix(), pivot);
    const glm::dvec2 by = pixel_of(view, after) - pixel_of(view, pivot);
    EXPECT_NEAR(by.x, 30.0, 0.01);
    EXPECT_NEAR(by.y, -20.0, 0.01);
    EXPECT_EQ(after.y, pivot.y) << "the axis to the eye is left alone";
  }
}

TEST(Gizmo, TurnsAndScalesAboutThePivot) {
  const View view = view_from({0, -10, 0});
  const glm::dvec3 pivot{1, 2, 3}, middle{0, 0, 0};
  for (const GizmoMode mode : {GizmoMode::Turn, GizmoMode::Scale}) {
    EXPECT_LT(glm::length(moved(gizmo_change(mode, view, pivot, 40, 25).matrix(), pivot) - pivot), 1e-12);
    EXPECT_LT(glm::length(moved(gizmo_change_along(mode, 2, view, pivot, 0.5, {400, 200}, 40, 25).matrix(), pivot) - pivot), 1e-12);
  }
  const glm::dmat4 turn = gizmo_change(GizmoMode::Turn, view, middle, 200, 0).matrix();
  EXPECT_LT(glm::length(moved(turn, {0, -1, 0}) - glm::dvec3(1, 0, 0)), 1e-12) << "the front goes to the right with the mouse";
  const glm::dmat4 tilt = gizmo_change(GizmoMode::Turn, view, middle, 0, 200).matrix();
  EXPECT_LT(glm::length(moved(tilt, {0, -1, 0}) - glm::dvec3(0, 0, -1)), 1e-12) << "and down";
  const glm::dmat4 twice = gizmo_change(GizmoMode::Scale, view, middle, 100, -200).matrix();
  EXPECT_LT(glm::length(moved(twice, {1, 1, 1}) - glm::dvec3(2, 1, 4)), 1e-12);
  EXPECT_LT(glm::length(moved(gizmo_change(GizmoMode::Scale, view, middle, -100, 7, true).matrix(), {1, 1, 1}) - glm::dvec3(0.5)), 1e-12);
}

TEST(Gizmo, HoldsOneAxis) {
  const View view = view_from({6, -8, 5});
  const glm::dvec3 pivot{0.5, -0.25, 1};
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec2 line = pixels_along(view, pivot, axis_unit(axis));
    const glm::dvec3 shift = gizmo_change_along(GizmoMode::Move, axis, view, pivot, 0.5, {0, 0}, 0.5 * line.x, 0.5 * line.y).shift;
    EXPECT_LT(glm::length(shift - 0.5 * axis_unit(axis)), 1e-3) << "half a unit along the axis as it is seen";
    const glm::dvec2 doubled = 100.0 * line / glm::length(line);
    EXPECT_NEAR(gizmo_change_along(GizmoMode::Scale, axis, view, pivot, 0.5, {0, 0}, doubled.x, doubled.y).factors[axis], 2.0, 1e-9);
    // What is grabbed on the ring goes with the mouse.
    const glm::dvec3 arm = axis_unit((axis + 1) % 3) * 0.5;
    const glm::dvec2 from = pixel_of(view, pivot) + pixels_along(view, pivot, arm), way = pixels_along(view, pivot, glm::cross(axis_unit(axis), arm));
    const glm::dvec2 by = way * glm::radians(10.0);
    const GizmoChange turn = gizmo_change_along(GizmoMode::Turn, axis, view, pivot, 0.5, from, by.x, by.y);
    EXPECT_EQ(turn.turns[0].axis, axis);
    EXPECT_NEAR(turn.turns[0].degrees, 10.0, 0.5);
  }
}

TEST(Gizmo, RandomViewsGiveFiniteMatrices) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-5, 5);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 eye{any(random), any(random), i % 5 ? any(random) : 0.0}, pivot{any(random), any(random), any(random)};
    if (glm::length(glm::dvec2(eye)) < 1e-3) continue;
    const View view = view_from(eye, i % 2);
    const ScreenAxes axes = screen_axes(view, pivot);
    EXPECT_NE(axes.x, axes.y);
    for (const GizmoMode mode : {GizmoMode::Move, GizmoMode::Turn, GizmoMode::Scale})
      for (const glm::dmat4& m : {gizmo_change(mode, view, pivot, any(random) * 50, any(random) * 50).matrix(),
                                  gizmo_change_along(mode, i % 3, view, pivot, gizmo_length(view, pivot, 80), {any(random) * 99, any(random) * 99}, any(random) * 50, any(random) * 50).matrix()})
        for (int k = 0; k < 16; ++k) ASSERT_TRUE(std::isfinite(m[k / 4][k % 4]));
  }
}

TEST(Gizmo, HandlesAreTakenWhereTheyAreSeen) {
  for (const double scale : {1.0, 2.0}) {
    const View view = view_from({6, -8, 5});
    const glm::dvec3 pivot{0.5, -0.25, 1};
    const glm::dvec2 middle = pixel_of(view, pivot);
    const auto arrows = gizmo_strokes(GizmoMode::Move, view, pivot, scale);
    EXPECT_EQ(gizmo_part_at(arrows, middle.x + 3, middle.y - 3, scale), GizmoPart::Both);
    for (int axis = 0; axis < 3; ++axis) {
      const glm::dvec2 tip = arrows[static_cast<std::size_t>(axis)].points.back(), at = middle + 0.7 * (tip - middle);
      EXPECT_LE(glm::length(tip - middle), 80.0 * scale + 1e-9);
      EXPECT_EQ(gizmo_part_at(arrows, at.x, at.y, scale), static_cast<GizmoPart>(axis));
      const auto rings = gizmo_strokes(GizmoMode::Turn, view, pivot, scale);
      const glm::dvec2 on = rings[static_cast<std::size_t>(axis)].points[5];
      EXPECT_EQ(gizmo_part_at(rings, on.x, on.y, scale), static_cast<GizmoPart>(axis));
    }
    EXPECT_FALSE(gizmo_part_at(arrows, middle.x + 200, middle.y, scale));
    EXPECT_TRUE(gizmo_strokes(GizmoMode::Move, view, {60, -80, 50}, scale).empty()) << "behind the eye";
    const FlatPicture picture = gizmo_picture(arrows, GizmoPart::X, scale);
    const auto pixel = [&](const glm::dvec2& p) { return &picture.rgba[((static_cast<std::size_t>(p.y) - static_cast<std::size_t>(picture.y)) * picture.size.width + static_cast<std::size_t>(p.x) - static_cast<std::size_t>(picture.x)) * 4]; };
    const glm::dvec2 green = middle + 0.6 * (arrows[1].points.back() - middle);
    EXPECT_GT(pixel(green)[1], 150);
    EXPECT_LT(pixel(green)[0], 120);
    EXPECT_EQ(pixel(green)[3], 255);
  }
}

TEST(Gizmo, StepsReadBack) {
  const View view = view_from({3, -10, 2});
  for (const GizmoMode mode : {GizmoMode::Move, GizmoMode::Turn, GizmoMode::Scale}) {
    const GizmoChange change = gizmo_change(mode, view, {1, 2, 3}, 17, 31);
    Diagnostics diagnostics;
    const SceneDesc scene = parse_scene("schema = 1\n[[data]]\nfile = \"a.npy\"\ntransform = [" + change.steps() + "]\n", "s", {}, {}, diagnostics);
    ASSERT_FALSE(diagnostics.has_errors()) << to_string(diagnostics);
    for (int k = 0; k < 12; ++k) EXPECT_NEAR(scene.data[0].transform[k / 3][k % 3], change.matrix()[k / 3][k % 3], 1e-12) << change.steps();
  }
  EXPECT_EQ(gizmo_change(GizmoMode::Move, view, {1, 2, 3}, 0, 0).steps(), "");
}

} // namespace
} // namespace mote::window
