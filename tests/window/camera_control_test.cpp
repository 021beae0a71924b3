// SPDX-License-Identifier: MIT
// The camera under the mouse, against geometry: what turns keep, what stays under the mouse, and that it always sees.
#include "app/window/camera_control.hpp"

#include "core/scene/scene_file.hpp"
#include "core/scene/realize.hpp"

#include <gmock/gmock.h>

#include <random>

namespace mote::window {
namespace {

constexpr Size2d size{640, 480};
constexpr double tiny = 1e-9;

Camera front() {
  Camera c;
  c.eye = {0, -10, 0};
  c.target = {0, 0, 0};
  c.up = {0, 0, 1};
  c.fov_y = 40;
  return c;
}
Bounds cube() {
  Bounds b;
  b.add(glm::dvec3(-1));
  b.add(glm::dvec3(1));
  return b;
}
glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& world) {
  const View view = make_view(camera, size, 1.0);
  const glm::dvec3 p = view.to_view(world);
  const double depth = view.projection == Projection::Perspective ? p.z : 1.0;
  return glm::dvec2(p) * view.focal / depth + view.center();
}
void expect_near(const glm::dvec3& a, const glm::dvec3& b, double error = tiny) { EXPECT_LT(glm::length(a - b), error) << "distance " << glm::length(a - b); }

TEST(CameraControl, TurntableKeepsDistanceAndUp) {
  CameraControl control(front(), cube());
  control.orbit(240, 0, size); // half the height: a quarter turn
  expect_near(control.camera().eye, {-10, 0, 0}, 1e-8);
  control.orbit(0, 80, size);
  EXPECT_NEAR(glm::length(control.camera().eye), 10.0, 1e-8);
  expect_near(control.camera().up, {0, 0, 1});
  EXPECT_GT(control.camera().eye.z, 0.0) << "dragging down lifts the eye";
}

TEST(CameraControl, ThePictureFollowsTheMouse) {
  for (const bool trackball : {false, true}) {
    CameraControl control(front(), cube());
    control.set_trackball(trackball);
    const glm::dvec3 near_point{0, -1, 0};
    const glm::dvec2 before = pixel_of(control.camera(), near_point);
    control.orbit(10, 6, size);
    const glm::dvec2 after = pixel_of(control.camera(), near_point);
    EXPECT_GT(after.x, before.x);
    EXPECT_GT(after.y, before.y);
  }
}

TEST(CameraControl, TurntableStopsBeforeThePole) {
  CameraControl control(front(), cube());
  for (int i = 0; i < 100; ++i) control.orbit(3, 50, size);
  EXPECT_THAT(check(control.camera()), "");
  EXPECT_GT(control.camera().eye.z, 9.99);
  for (int i = 0; i < 200; ++i) control.orbit(3, -50, size);
  EXPECT_LT(control.camera().eye.z, -9.99);
}

TEST(CameraControl, TrackballGoesOverThePole) {
  CameraControl control(front(), cube());
  control.set_trackball(true);
  control.orbit(0, 480 * 0.75, size); // 135 degrees
  EXPECT_GT(control.camera().eye.y, 0.0);
  EXPECT_NEAR(glm::length(control.camera().eye), 10.0, 1e-8);
  EXPECT_LT(control.camera().up.z, 0.0) << "upside down";
}

TEST(CameraControl, RollTurnsThePictureWithTheMouse) {
  CameraControl control(front(), cube());
  const glm::dvec3 point{1, 0, 0}; // right of the middle
  const glm::dvec2 middle(320, 240), before = pixel_of(control.camera(), point) - middle;
  control.roll({400, 240}, {320, 320}, size); // from the right to below: a quarter, clockwise
  const glm::dvec2 after = pixel_of(control.camera(), point) - middle;
  EXPECT_NEAR(after.x, -before.y, 1e-9);
  EXPECT_NEAR(after.y, before.x, 1e-9);
  expect_near(control.camera().eye, front().eye);
  expect_near(control.camera().target, front().target);
  // A turntable then turns about what is up in the picture.
  const glm::dvec3 up = control.camera().up;
  control.orbit(100, 0, size);
  expect_near(control.camera().up, up);
  EXPECT_NEAR(glm::dot(glm::normalize(control.camera().eye), up), 0.0, 1e-9);
  control.look_along(0, false);
  expect_near(control.camera().up, {0, 0, 1});
  control.roll(0.3);
  control.reset();
  expect_near(control.camera().up, front().up);
  control.roll({320, 240}, {320, 240}, size); // no direction at the middle
  EXPECT_EQ(check(control.camera()), "");
}

TEST(CameraControl, PanMovesTheTargetPlaneWithTheMouse) {
  for (const bool flat : {false, true}) {
    CameraControl control(front(), cube());
    if (flat) control.toggle_projection();
    const glm::dvec2 before = pixel_of(control.camera(), {0, 0, 0});
    control.pan(31, -17, size);
    const glm::dvec2 moved = pixel_of(control.camera(), {0, 0, 0}) - before;
    EXPECT_NEAR(moved.x, 31.0, 1e-7);
    EXPECT_NEAR(moved.y, -17.0, 1e-7);
  }
}

TEST(CameraControl, ZoomKeepsWhatIsUnderTheMouse) {
  for (const bool flat : {false, true}) {
    CameraControl control(front(), cube());
    if (flat) control.toggle_projection();
    const double pixel = control.pixel_length(size);
    const glm::dvec3 under{(500 - 320.0) * pixel, 0, -(100 - 240.0) * pixel}; // of the plane through the target
    control.zoom(0.5, 500, 100, size);
    const glm::dvec2 after = pixel_of(control.camera(), under);
    EXPECT_NEAR(after.x, 500.0, 1e-7);
    EXPECT_NEAR(after.y, 100.0, 1e-7);
    EXPECT_NEAR(control.pixel_length(size), 0.5 * pixel, 1e-12);
  }
}

TEST(CameraControl, ZoomHasEnds) {
  CameraControl control(front(), cube());
  for (int i = 0; i < 2000; ++i) control.zoom(0.5, 10, 10, size);
  EXPECT_THAT(check(control.camera()), "");
  EXPECT_GT(control.pixel_length(size), 0.0);
  for (int i = 0; i < 4000; ++i) control.zoom(2.0, 600, 400, size);
  EXPECT_THAT(check(control.camera()), "");
  EXPECT_TRUE(std::isfinite(control.pixel_length(size)));
  control.zoom(NAN, 1, 1, size);
  control.zoom(-1, 1, 1, size);
  control.zoom(INFINITY, 1, 1, size);
  EXPECT_THAT(check(control.camera()), "");
}

TEST(CameraControl, AxisViews) {
  CameraControl control(front(), cube());
  for (int axis = 0; axis < 3; ++axis)
    for (const bool back : {false, true}) {
      control.look_along(axis, back);
      glm::dvec3 wanted(0);
      wanted[axis] = back ? -10 : 10;
      expect_near(control.camera().eye, wanted, 1e-8);
      EXPECT_THAT(check(control.camera()), "");
    }
  expect_near(control.camera().up, {0, 1, 0}); // along z, y is up
}

TEST(CameraControl, ProjectionsShowTheTargetAlike) {
  CameraControl control(front(), cube());
  const glm::dvec2 before = pixel_of(control.camera(), {1, 0, 1});
  control.toggle_projection();
  const glm::dvec2 flat = pixel_of(control.camera(), {1, 0, 1});
  EXPECT_NEAR(before.x, flat.x, 1e-7);
  EXPECT_NEAR(before.y, flat.y, 1e-7);
  control.toggle_projection();
  const glm::dvec2 back = pixel_of(control.camera(), {1, 0, 1});
  EXPECT_NEAR(before.x, back.x, 1e-7);
  EXPECT_NEAR(before.y, back.y, 1e-7);
}

TEST(CameraControl, FrameAllShowsEveryCorner) {
  Bounds b;
  b.add({100, 200, 300});
  b.add({130, 205, 302});
  for (const bool flat : {false, true}) {
    CameraControl control(front(), b);
    if (flat) control.toggle_projection();
    control.orbit(70, 33, size);
    control.frame_all(size);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(i & 1 ? 130 : 100, i & 2 ? 205 : 200, i & 4 ? 302 : 300);
      const glm::dvec2 p = pixel_of(control.camera(), corner);
      EXPECT_TRUE(p.x >= 0 && p.x <= 640 && p.y >= 0 && p.y <= 480) << p.x << " " << p.y;
      EXPECT_GT(make_view(control.camera(), size, 1.0).to_view(corner).z, 0.0);
    }
  }
}

TEST(CameraControl, CenterKeepsTheEye) {
  CameraControl control(front(), cube());
  control.center_at({1, 0.5, 0.25});
  expect_near(control.camera().eye, {0, -10, 0});
  expect_near(control.camera().target, {1, 0.5, 0.25});
  control.center_at(control.camera().eye); // cannot be looked at
  expect_near(control.camera().target, {1, 0.5, 0.25});
}

// Whatever comes, it sees.
TEST(CameraControl, RandomUseAlwaysSees) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> far(-1e4, 1e4), part(-1.0, 1.0);
  CameraControl control(front(), cube());
  for (int i = 0; i < 20000; ++i) {
    const Size2d s{static_cast<std::uint32_t>(random() % 3 ? 640 : random() % 2), static_cast<std::uint32_t>(random() % 3 ? 480 : random() % 2)};
    switch (random() % 9) {
    case 0: control.orbit(far(random), far(random), s); break;
    case 1: control.pan(far(random), far(random), s); break;
    case 2: control.zoom(std::exp(5 * part(random)), far(random), far(random), s); break;
    case 3: control.look_along(static_cast<int>(random() % 3), random() % 2); break;
    case 4: control.toggle_projection(); break;
    case 5: control.set_trackball(random() % 2); break;
    case 6: control.frame_all(s); break;
    case 7: control.center_at({part(random), part(random), part(random)}); break;
    default: control.orbit(part(random), part(random), s); break;
    }
    ASSERT_THAT(check(control.camera()), "") << "step " << i;
  }
}

TEST(CameraToml, ReadsBackAsItIs) {
  Camera c = front();
  c.eye = {0.1, -1e-7, 1e9};
  c.target = {1.0 / 3.0, 2, 3};
  c.near = 0.5;
  for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
    c.projection = projection;
    c.height = 1.0 / 7.0;
    Diagnostics diagnostics;
    const SceneDesc scene = parse_scene("schema = 1\n" + camera_toml(c) + "[[data]]\nfile = \"a.npy\"\n", "s.toml", {}, {}, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << to_string(diagnostics);
    EXPECT_EQ(scene.camera.projection, projection);
    EXPECT_EQ(*scene.camera.eye, c.eye);
    EXPECT_EQ(*scene.camera.target, c.target);
    EXPECT_EQ(*scene.camera.up, c.up);
    EXPECT_EQ(scene.camera.near, c.near);
    EXPECT_EQ(scene.camera.fov_y.value_or(c.fov_y), c.fov_y);
    EXPECT_EQ(scene.camera.height.value_or(c.height), c.height);
    EXPECT_EQ(scene.camera.fov_y.has_value(), projection == Projection::Perspective);
  }
}

} // namespace
} // namespace mote::window
