// SPDX-License-Identifier: MIT
// A window's session on a device, without a window: pictures as `mote render` makes them, edits, picks, files that change,
// and ten thousand random events. The validation layer runs and must be silent.
#include "tests/window/session_fixture.hpp"

#include "core/image/png.hpp"

#include <random>

namespace mote::window {
namespace {

using ::testing::HasSubstr;

TEST_F(SessionTest, ShowsThePictureThatRenderMakes) {
  open({path("scene.toml")});
  const std::vector<std::byte> shown = draw();
  session->screenshot(path("a.png"));
  const PngPicture picture = read_png(path("a.png"));
  ASSERT_EQ(picture.rgba8.size(), shown.size());
  for (std::size_t i = 0; i < shown.size(); i += 4) ASSERT_EQ(static_cast<int>(shown[i + 2]), picture.rgba8[i]) << i / 4;
  EXPECT_LT(static_cast<int>(shown[(24 * 64 + 32) * 4 + 1]), 50) << "the sphere in the middle is red";
  EXPECT_EQ(static_cast<int>(shown[0]), 255) << "white around it";
}

TEST_F(SessionTest, DrawsOnlyWhenSomethingChanged) {
  open({path("scene.toml")});
  EXPECT_FALSE(session->wants_frame(now + 100));
  EXPECT_FALSE(session->due());
  session->handle(move_event(10, 10), now);
  EXPECT_FALSE(session->wants_frame(now)) << "a mouse that passes by changes nothing";
  press('f');
  EXPECT_TRUE(session->wants_frame(now));
}

TEST_F(SessionTest, SizesOfNothingAndOnePixel) {
  open({path("scene.toml")});
  for (const Size2d size : {Size2d{0, 0}, Size2d{1, 1}, Size2d{0, 5}, Size2d{300, 2}, Size2d{64, 48}}) {
    session->handle(resize_event(size), now);
    drag(Button::Left, {1, 1}, {20, 9});
    EXPECT_EQ(session->wants_frame(now), size.width > 0 && size.height > 0);
    (void)draw();
  }
}

TEST_F(SessionTest, EditsUndoAndSave) {
  open({path("scene.toml")});
  const auto before = draw();
  EXPECT_TRUE(session->set("data[0].color", "\"#00ff00\""));
  const auto green = draw();
  EXPECT_NE(green, before);
  EXPECT_TRUE(session->set("light.sun.intensity", "0.1"));
  const auto dark = draw();
  EXPECT_NE(dark, green);
  press('z', {.control = true});
  session->handle(key_event(key::escape), now);
  EXPECT_EQ(draw(), green);
  press('y', {.control = true});
  session->handle(key_event(key::escape), now);
  EXPECT_EQ(draw(), dark);
  drag(Button::Left, {10, 10}, {30, 20});
  press('s', {.control = true});
  session->handle(key_event(key::escape), now);
  const auto saved = draw();
  EXPECT_THAT(read("scene.toml"), HasSubstr("schema = 1 # kept"));
  EXPECT_THAT(read("scene.toml"), HasSubstr("#00ff00"));
  open({path("scene.toml")});
  EXPECT_EQ(draw(), saved) << "the saved scene shows what was saved";
}

TEST_F(SessionTest, StepsByKeys) {
  open({path("scene.toml")});
  const std::vector<std::byte> whole = draw();
  press('1', {.shift = true});
  EXPECT_THAT(said(), HasSubstr("step: proxy"));
  const std::vector<std::byte> proxy = draw();
  EXPECT_NE(proxy, whole);
  press('6', {.shift = true});
  EXPECT_NE(draw(), proxy);
  press('4', {.shift = true});
  press(key::escape);
  EXPECT_EQ(draw(), whole);
}

TEST_F(SessionTest, BadEditsLeaveAllAsItWas) {
  open({path("scene.toml")});
  const auto before = draw();
  EXPECT_FALSE(session->set("data[0].color", "{ attribute = \"nothing\", map = \"viridis\" }"));
  EXPECT_THAT(said(), HasSubstr("S021"));
  EXPECT_FALSE(session->set("opaque.samples", "0"));
  EXPECT_FALSE(session->set("nonsense.samples", "1"));
  EXPECT_FALSE(session->document().changed());
  session->handle(key_event(key::escape), now);
  press('f');
  press('r');
  EXPECT_EQ(draw(), before);
}

TEST_F(SessionTest, PicksParticlesDistancesAndAngles) {
  open({path("scene.toml")}, {200, 150});
  const auto here = session->pick(100, 75);
  ASSERT_TRUE(here);
  EXPECT_EQ(here->id, 0u);
  EXPECT_THAT(here->rows[0][1], HasSubstr("row 0"));
  bool speed = false;
  for (const auto& row : here->rows) speed |= row[0] == "speed" && row[1] == "5";
  EXPECT_TRUE(speed);
  EXPECT_FALSE(session->pick(5, 5));
  const double pixels = make_view(session->camera(), {200, 150}, 1).focal / 30.0;
  const Modifiers control{.control = true};
  drag(Button::Left, {100 + 3 * pixels, 75}, {100 + 3 * pixels, 75}, control);
  now += 1;
  drag(Button::Left, {100, 75}, {100, 75}, control);
  now += 1;
  drag(Button::Left, {100, 75 - 4 * pixels}, {100, 75 - 4 * pixels}, control);
  ASSERT_EQ(session->picked().size(), 3u);
  EXPECT_NEAR(glm::length(session->picked()[1].center - session->picked()[0].center), 3.0, 1e-6);
  EXPECT_NEAR(*angle_at(session->picked()[0].center, session->picked()[1].center, session->picked()[2].center), 90.0, 1e-5);
  session->handle(move_event(100 + 3 * pixels, 75), now);
  press('o');
  EXPECT_NEAR(session->camera().target.x, 3.0, 1e-6);
}

TEST_F(SessionTest, BrokenFilesKeepTheLastGoodPicture) {
  open({path("scene.toml")});
  const auto before = draw();
  const auto changed = [&] { session->handle({.kind = Event::Kind::Files, .files = {path("scene.toml")}}, now); };
  write("scene.toml", "schema = 1\n[[data]\n");
  changed();
  EXPECT_THAT(said(), HasSubstr("scene.toml:2:"));
  session->handle(key_event(key::escape), now);
  press('f');
  press('r');
  EXPECT_EQ(draw(), before);
  write("scene.toml", std::string(scene) + "alpha = 1.0\nmaterial = { ambient = 0.0 }\n");
  changed();
  session->handle(key_event(key::escape), now);
  EXPECT_NE(draw(), before);
}

TEST_F(SessionTest, DroppedFiles) {
  open({path("scene.toml")});
  const auto before = draw();
  write("broken.xyz", "three\n");
  for (const char* name : {"broken.xyz", "missing.xyz"}) {
    session->handle({.kind = Event::Kind::Drop, .files = {path(name)}}, now);
    EXPECT_THAT(said(), HasSubstr(name));
    EXPECT_THAT(said(), HasSubstr("the picture before stays"));
  }
  session->handle(key_event(key::escape), now);
  EXPECT_EQ(draw(), before);
  write("two.csv", "x,y,z\n0,0,0\n1,1,1\n");
  session->handle({.kind = Event::Kind::Drop, .files = {path("two.csv")}}, now);
  EXPECT_EQ(session->job().scene.particle_count(), 2u);
  (void)draw();
}

// Nothing that a user can do in any order ends it.
TEST_F(SessionTest, TenThousandRandomEvents) {
  open({"spheres:300:fill"});
  std::mt19937 random(11);
  const auto pixel = [&] { return static_cast<double>(random() % 120) - 20.0; };
  const std::string_view keys = "frxyzptohlc351 wegn[]";
  int frames = 0;
  for (int i = 0; i < 10000; ++i) {
    const Modifiers modifiers{.shift = random() % 5 == 0, .control = random() % 7 == 0};
    switch (random() % 10) {
    case 0: case 1: case 2: session->handle(move_event(pixel(), pixel(), modifiers), now); break;
    case 3: case 4: session->handle(button_event(static_cast<Button>(random() % 3), pixel(), pixel(), random() % 2, modifiers), now); break;
    case 5: session->handle(wheel_event(static_cast<double>(random() % 9) - 4.0, pixel(), pixel(), modifiers), now); break;
    case 6: case 7: {
      const Key key = random() % 12 ? Key{keys[random() % keys.size()]} : key::tab; // panels come and go
      if (key != 'r' || !modifiers.control) press(key, {.shift = modifiers.shift});
      break;
    }
    case 8: {
      constexpr Size2d sizes[] = {{0, 0}, {1, 1}, {64, 48}, {33, 7}, {100, 80}, {1, 40}, {0, 9}};
      session->handle(resize_event(sizes[random() % 7], 1.0 + static_cast<double>(random() % 3)), now);
      break;
    }
    default: session->handle({.kind = Event::Kind::Redraw}, now); break;
    }
    now += 0.01 * static_cast<double>(random() % 10);
    if (i % 8 == 0 && session->wants_frame(now)) {
      frame();
      ++frames;
    }
    ASSERT_THAT(check(session->camera()), "") << i;
  }
  EXPECT_GT(frames, 300);
  device().check(); // errors of the device, words of the validation layer
}

} // namespace
} // namespace mote::window
