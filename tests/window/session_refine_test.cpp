// SPDX-License-Identifier: MIT
// Pictures that are drawn in pieces, and files that are read again.
#include "tests/window/session_fixture.hpp"

#include "core/image/png.hpp"

namespace mote::window {
namespace {

using ::testing::HasSubstr;

// A refinement in strips is the picture that is drawn at once, whatever the graph; and an input does not wait for all of it.
TEST_F(SessionTest, LongPicturesAreDrawnInPieces) {
  write("shadowed.toml", std::string(scene) + "[[light]]\nname = \"side\"\nkind = \"directional\"\ndirection = [1.0, 1.0, -0.5]\nshadows = true\n");
  const std::vector<std::vector<std::string>> cases{{path("scene.toml")},
                                                    {path("scene.toml"), "opaque.samples=16"},
                                                    {"spheres:2e5:fill"}, // too many for analytic edges
                                                    {"spheres:200:fit", "data[0].alpha=0.5"},
                                                    {path("shadowed.toml"), "graph=shadowed"}};
  for (const auto& words : cases) {
    open({words[0]}, {160, 200}, {words.begin() + 1, words.end()}, {.goal_ms = 0.01});
    const auto shown = draw();
    EXPECT_GT(session->painter().pieces(), 3u) << words[0];
    session->screenshot(path("a.png"));
    const PngPicture picture = read_png(path("a.png"));
    int most = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < shown.size(); i += 4)
      for (const auto& [own, other] : {std::pair(i + 2, i), std::pair(i + 1, i + 1), std::pair(i, i + 2)}) {
        most = std::max(most, std::abs(static_cast<int>(shown[own]) - picture.rgba8[other]));
        different += static_cast<int>(shown[own]) != picture.rgba8[other];
      }
    EXPECT_EQ(different, 0u) << words[0] << " " << words.back() << ", by " << most;
  }
  now += 10.0; // messages have gone
  (void)draw();
  press('f');
  now += 1.0;
  session->render(now);
  ASSERT_FALSE(session->shows_new()) << "a piece";
  EXPECT_TRUE(session->wants_frame(now));
  session->handle(button_event(Button::Left, 20, 20, true), now);
  session->handle(move_event(60, 30), now);
  session->render(now);
  EXPECT_TRUE(session->shows_new()) << "the input is answered before the pieces that were left";
  session->handle(button_event(Button::Left, 60, 30, false), now);
  (void)draw();
}

TEST_F(SessionTest, IncludedGraphFilesAreWatched) {
  std::filesystem::create_directories(folder / "parts");
  write("scene.toml", "graph = \"graph.toml\"\n" + std::string(scene));
  write("graph.toml", "schema = 1\ninclude = \"parts/base.toml\"\n");
  write("parts/base.toml", "schema = 1\ninclude = \"default\"\n[[pass]]\nname = \"display\"\nparams = { exposure = 0.0 }\n");
  open({path("scene.toml")});
  const auto watched = session->take_wishes().watch;
  ASSERT_TRUE(watched);
  EXPECT_THAT(*watched, ::testing::IsSupersetOf({path("scene.toml"), path("graph.toml"), path("parts/base.toml")}));
  const auto before = draw();
  const auto changed = [&] { session->handle({.kind = Event::Kind::Files, .files = {path("parts/base.toml")}}, now); };
  write("parts/base.toml", "schema = 1\ninclude = \"more.toml\"\n");
  changed();
  EXPECT_THAT(said(), HasSubstr("base.toml:2:"));
  session->handle(key_event(key::escape), now);
  press('f');
  press('r');
  EXPECT_EQ(draw(), before) << "the last good one";
  const auto missing = session->take_wishes().watch;
  ASSERT_TRUE(missing);
  EXPECT_THAT(*missing, ::testing::Contains(path("parts/more.toml"))) << "a file that is not there yet";
  write("parts/more.toml", "schema = 1\ninclude = \"default\"\n[[pass]]\nname = \"display\"\nparams = { exposure = -2.0 }\n");
  changed();
  session->handle(key_event(key::escape), now);
  EXPECT_NE(draw(), before);
}

} // namespace
} // namespace mote::window
