// SPDX-License-Identifier: MIT
// Handles in a session: what drags of them do to the scene's file, to the scene, and to undo.
#include "tests/window/session_fixture.hpp"

namespace mote::window {
namespace {

using ::testing::HasSubstr;

// What the handles do to a scene file, seen in it and in the picture.
TEST_F(SessionTest, HandlesMoveDataSets) {
  write("scene.toml", std::string(scene) + "transform = [ { scale = 0.5 } ] # half\n");
  open({path("scene.toml")}, {300, 300});
  const auto before = draw();
  press('w');
  ASSERT_EQ(session->gizmo_mode(), GizmoMode::Move);
  session->handle(key_event(key::f1), now); // no message in the pictures
  session->handle(key_event(key::f1), now);
  const auto strokes = session->gizmo_strokes_now();
  ASSERT_EQ(strokes.size(), 4u);
  const auto half = [](const GizmoStroke& s) { return 0.5 * (s.points.front() + s.points.back()); };
  const glm::dvec2 at = half(strokes[0]); // the x axis goes to the right
  drag(Button::Left, at, at + glm::dvec2(30, 8));
  const double pixels = make_view(session->camera(), {300, 300}, 1).focal / 30.0;
  const glm::dmat4 moved = session->job().desc.data[0].transform;
  EXPECT_NEAR(moved[3].x, 30.0 / pixels, 0.01);
  EXPECT_EQ(moved[3].y, 0.0);
  EXPECT_EQ(moved[3].z, 0.0) << "one axis";
  EXPECT_EQ(session->job().scene.batches[0].instances[0].world_from_data, moved);
  EXPECT_THAT(session->document().text(), HasSubstr("transform = [ { scale = 0.5 }, { translate = ["));
  EXPECT_THAT(session->document().text(), HasSubstr("# half"));
  const glm::dvec2 middle = session->gizmo_strokes_now()[3].points[0];
  drag(Button::Left, middle, middle + glm::dvec2(-10, -40)); // both directions; goes on with the same step
  EXPECT_NEAR(session->job().desc.data[0].transform[3].x, 20.0 / pixels, 0.01);
  EXPECT_NEAR(session->job().desc.data[0].transform[3].z, 40.0 / pixels, 0.01);
  EXPECT_EQ(session->job().desc.data[0].transform[3].y, 0.0);
  const std::string text = session->document().text();
  EXPECT_EQ(text.find("translate"), text.rfind("translate"));
  EXPECT_EQ(session->camera().eye, glm::dvec3(0, -30, 0)) << "the camera stays";
  session->undo();
  EXPECT_EQ(session->job().desc.data[0].transform, moved) << "a drag is one step";
  session->undo();
  session->handle(key_event(key::escape), now);
  EXPECT_FALSE(session->gizmo_mode());
  EXPECT_EQ(draw(), before);
  session->redo();
  session->redo();
  session->handle(key_event(key::escape), now);
  const auto shown = draw();
  EXPECT_TRUE(session->save());
  session->handle(key_event(key::escape), now);
  open({path("scene.toml")}, {300, 300});
  EXPECT_EQ(draw(), shown) << "the saved scene shows what was seen";
}

TEST_F(SessionTest, HandlesTurnAndScale) {
  open({path("scene.toml")}, {300, 300});
  press('e');
  glm::dvec2 middle = session->gizmo_strokes_now()[3].points[0];
  drag(Button::Left, middle, middle + glm::dvec2(100, 0)); // 45 degrees about z
  EXPECT_THAT(session->document().text(), HasSubstr("transform = [ { rotate = { axis = [0.0, 0.0, 1.0], angle = 45.0, through = "));
  drag(Button::Left, middle, middle + glm::dvec2(50, 0));
  EXPECT_THAT(session->document().text(), HasSubstr("angle = 67.5, "));
  press('r', {.shift = true});
  ASSERT_EQ(session->gizmo_mode(), GizmoMode::Scale);
  middle = session->gizmo_strokes_now()[3].points[0];
  drag(Button::Left, middle, middle + glm::dvec2(100, 0), {.shift = true});
  EXPECT_NEAR(std::abs(glm::determinant(glm::dmat3(session->job().desc.data[0].transform))), 8.0, 1e-9) << "twice as large";
  // Escape in the middle of a drag takes it back.
  const std::string text = session->document().text();
  session->handle(button_event(Button::Left, middle.x, middle.y, true), now);
  session->handle(move_event(middle.x + 50, middle.y), now);
  EXPECT_NE(session->document().text(), text);
  press(key::escape);
  EXPECT_EQ(session->document().text(), text);
  session->handle(move_event(middle.x + 90, middle.y), now);
  session->handle(button_event(Button::Left, middle.x + 90, middle.y, false), now);
  EXPECT_EQ(session->document().text(), text);
}

// On a display of twice the density handles, search windows and clicks are twice as large in pixels.
TEST_F(SessionTest, HighDensityDisplays) {
  open({path("scene.toml")}, {300, 300});
  press('w');
  const auto length = [&] { const auto s = session->gizmo_strokes_now()[0]; return glm::length(s.points.back() - s.points.front()); };
  const double usual = length();
  session->handle(resize_event({600, 600}, 2.0), now);
  EXPECT_NEAR(length(), 2.0 * usual, 1e-9);
  press(key::escape);
  const double radius = make_view(session->camera(), {600, 600}, 1).focal / 30.0; // of the sphere in the middle, pixels
  EXPECT_TRUE(session->pick(300 - radius - 13, 300)) << "13 pixels beside it are 6.5 of a usual display's";
  drag(Button::Left, {300, 300}, {306, 300}, {.control = true}); // a click with a hand that shakes
  EXPECT_EQ(session->picked().size(), 1u);
  session->handle(resize_event({600, 600}, 1.0), now);
  EXPECT_FALSE(session->pick(300 - radius - 13, 300));
}

TEST_F(SessionTest, HandlesOfLights) {
  write("scene.toml", std::string(scene) + "[[light]]\nname = \"lamp\"\nkind = \"point\"\nposition = [0.0, 0.0, 2.0] # above\n");
  open({path("scene.toml")}, {300, 300});
  ASSERT_EQ(session->gizmo_targets().size(), 3u);
  press('w');
  press('n'); // the sun has no place, so it is turned
  EXPECT_EQ(session->gizmo_mode(), GizmoMode::Turn);
  const glm::dvec2 middle = session->gizmo_strokes_now()[3].points[0];
  drag(Button::Left, middle, middle + glm::dvec2(200, 0));
  EXPECT_NEAR(std::abs(session->job().scene.lights[0].direction.x), 1.0, 1e-6) << "from behind the camera to the side";
  EXPECT_THAT(session->document().text(), HasSubstr("direction = [-1.0, "));
  press('n');
  EXPECT_EQ(session->gizmo_mode(), GizmoMode::Move) << "the lamp has no direction";
  const glm::dvec2 up = session->gizmo_strokes_now()[2].points[1];
  drag(Button::Left, up, up + glm::dvec2(0, -20));
  EXPECT_GT(session->job().scene.lights[1].position.z, 2.1);
  EXPECT_THAT(session->document().text(), HasSubstr("# above"));
}

} // namespace
} // namespace mote::window
