// SPDX-License-Identifier: MIT
// Keys, scripts, the pace of frames: what is pure about the window's input.
#include "app/window/actions.hpp"
#include "app/window/hud.hpp"
#include "app/window/pace.hpp"
#include "app/window/script.hpp"

#include <gmock/gmock.h>

#include <set>

namespace mote::window {
namespace {

using ::testing::HasSubstr;

TEST(Keys, NamesReadBack) {
  EXPECT_EQ(key_from_name("R"), 'r');
  EXPECT_EQ(key_from_name("f11"), key::f1 + 10);
  EXPECT_EQ(key_from_name("f"), 'f');
  EXPECT_EQ(key_from_name("f13"), key::none);
  EXPECT_EQ(key_from_name("nonsense"), key::none);
  EXPECT_EQ(key_from_name(""), key::none);
  EXPECT_EQ(key_name(key::page_up), "Page up");
  EXPECT_EQ(key_name('x'), "X");
}

TEST(Keys, NoCombinationHasTwoMeanings) {
  std::set<std::tuple<Key, bool, bool, bool>> seen;
  for (const Shortcut& s : shortcuts())
    EXPECT_TRUE(seen.insert({s.key, s.modifiers.shift, s.modifiers.control, s.modifiers.alt}).second) << key_name(s.key);
}

TEST(Keys, HelpNamesEveryAction) {
  std::set<Action> explained;
  for (const Shortcut& s : shortcuts()) explained.insert(s.action);
  EXPECT_EQ(explained.size(), static_cast<std::size_t>(Action::Quit) + 1);
  std::string all;
  for (const auto& row : help_rows()) all += row[0] + ": " + row[1] + "\n";
  EXPECT_THAT(all, HasSubstr("F11: full screen"));
  EXPECT_THAT(all, HasSubstr("Ctrl Z, Ctrl Shift Z, Ctrl Y: undo, redo"));
}

TEST(Keys, ModifiersMatter) {
  EXPECT_EQ(action_of('s', {}), Action::Screenshot);
  EXPECT_EQ(action_of('s', {.control = true}), Action::Save);
  EXPECT_EQ(action_of('s', {.alt = true}), std::nullopt);
}

// A display of twice the density: 400 x 300 units of the window system are 800 x 600 pixels, and all texts are twice as large.
TEST(HighDensity, PlacesArePixelsAndTextsGrow) {
  EXPECT_EQ(to_pixels(100, 50, {400, 300}, {800, 600}), glm::dvec2(200, 100));
  EXPECT_EQ(to_pixels(100, 50, {400, 300}, {400, 300}), glm::dvec2(100, 50));
  EXPECT_EQ(to_pixels(100, 50, {0, 0}, {0, 0}), glm::dvec2(100, 50)) << "a window that is minimized";
  const std::vector<std::array<std::string, 2>> rows{{"particle 7", "row 7 of a.xyz"}, {"mass", "12.011"}};
  const FlatPicture usual = text_box(rows, HudPlace::BottomLeft, {400, 300}, 1.0), dense = text_box(rows, HudPlace::BottomLeft, {800, 600}, 2.0);
  EXPECT_NEAR(dense.size.width, 2.0 * usual.size.width, 2.0);
  EXPECT_NEAR(dense.size.height, 2.0 * usual.size.height, 2.0);
  EXPECT_NEAR(dense.x, 2.0 * usual.x, 2.0);
  EXPECT_NEAR(dense.y, 2.0 * usual.y, 2.0);
}

std::vector<Step> good(const std::string& text) {
  Diagnostics diagnostics;
  std::vector<Step> steps = parse_script(text, "s.txt", diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  return steps;
}

TEST(Script, EveryStepIsRead) {
  const std::vector<Step> steps = good("# a comment\nsize 640x480\n  key ctrl+shift+z\nmove 1.5 2\nclick left 3 4 ctrl\nwheel -2 5 6\n"
                                       "drag middle 0 0 10 20 shift steps 5\ndrop a file.xyz\nset light.sun.intensity=2\nsave\nsave out.toml\nwait refined\nwait 0.5\n"
                                       "screenshot a b.png\nwindow w.png\nprint hello there\n@1.5 minimize\nrestore\nquit\n");
  EXPECT_EQ(steps[0].size, (Size2d{640, 480}));
  EXPECT_EQ(steps[1].event.key, 'z');
  EXPECT_TRUE(steps[1].event.modifiers.control && steps[1].event.modifiers.shift);
  EXPECT_FALSE(steps[2].event.pressed); // let go
  EXPECT_EQ(steps[3].event.x, 1.5);
  EXPECT_TRUE(steps[5].event.modifiers.control);
  std::size_t drops = 0, moves = 0;
  for (const Step& s : steps) {
    if (s.kind == Step::Kind::Event && s.event.kind == Event::Kind::Drop) {
      ++drops;
      EXPECT_EQ(s.event.files, std::vector<std::string>{"a file.xyz"});
    }
    if (s.kind == Step::Kind::Event && s.event.kind == Event::Kind::Move && s.event.modifiers.shift) ++moves;
    if (s.kind == Step::Kind::Screenshot) {
      EXPECT_EQ(s.text, "a b.png");
    }
    if (s.kind == Step::Kind::Print) {
      EXPECT_EQ(s.text, "hello there");
    }
    if (s.kind == Step::Kind::Minimize) {
      EXPECT_EQ(s.at, 1.5);
    }
  }
  EXPECT_EQ(drops, 1u);
  EXPECT_EQ(moves, 6u);
  EXPECT_EQ(steps.back().kind, Step::Kind::Quit);
}

// One thing wrong each time: place, code and words.
TEST(Script, MistakesAreNamed) {
  const std::pair<const char*, const char*> bad[] = {
      {"jump 3", "there is no step 'jump'"},       {"key nothing", "there is no key 'nothing'"},  {"key", "a key is missing"},
      {"size 0x5", "'0x5' is not a size"},         {"move 1", "y is missing"},                    {"move 1 two", "'two' is not y"},
      {"click top 1 2", "there is no button 'top'"}, {"wait -1", "'-1' is no time to wait"},      {"wait soon", "'soon' is not refined"},
      {"quit now", "'now' is too much behind 'quit'"}, {"drag left 0 0 1 1 steps 0", "'0' is no number of steps"},
      {"@x quit", "'x' is not a time"},            {"key hyper+a", "'hyper' is not ctrl"},        {"drag left 0 0 1 1 over 0", "'0' is no time for a drag"}};
  for (const auto& [line, says] : bad) {
    Diagnostics diagnostics;
    (void)parse_script(std::string("key r\n") + line + "\n", "s.txt", diagnostics);
    ASSERT_TRUE(diagnostics.has("A051")) << line;
    EXPECT_THAT(to_string(diagnostics), HasSubstr(says));
    EXPECT_THAT(to_string(diagnostics), HasSubstr("s.txt:2:1: error"));
  }
}

TEST(Script, PlayerWaits) {
  ScriptPlayer player(good("key a\nwait refined\nkey b\nwait 0.5\n@3 key c\n"));
  EXPECT_EQ(player.next({0, false})->event.key, 'a');
  EXPECT_EQ(player.next({0, false})->event.pressed, false);
  EXPECT_FALSE(player.next({0.1, false}));
  EXPECT_FALSE(player.due({0.1, false})) << "nothing but a frame helps";
  EXPECT_EQ(player.next({0.2, true})->event.key, 'b');
  EXPECT_TRUE(player.next({0.2, true}));
  EXPECT_FALSE(player.next({0.3, true}));
  EXPECT_NEAR(*player.due({0.4, true}), 0.4, 1e-12);
  EXPECT_FALSE(player.next({0.79, true}));
  EXPECT_FALSE(player.next({0.81, true}));
  EXPECT_NEAR(*player.due({1.0, true}), 2.0, 1e-12);
  EXPECT_EQ(player.next({3.0, true})->event.key, 'c');
  EXPECT_TRUE(player.next({3.0, true}));
  EXPECT_TRUE(player.ended());
  EXPECT_FALSE(player.next({9.0, true}));
}

TEST(Script, TimedDragsComeAtTheirTimes) {
  ScriptPlayer player(good("drag left 0 0 100 0 steps 10 over 1\n"));
  ASSERT_TRUE(player.next({5.0, true}));
  ASSERT_TRUE(player.next({5.0, true})); // pressed
  EXPECT_FALSE(player.next({5.05, true}));
  int due = 0;
  while (player.next({5.45, true})) ++due;
  EXPECT_EQ(due, 4);
  EXPECT_NEAR(player.scheduled(), 5.4, 1e-12);
}

// A renderer whose frames cost `full_ms` at full size, by the number of pixels.
struct Simulated {
  Pace pace{};
  double now{}, full_ms{};
  double frame() {
    const bool draft = pace.draft(now);
    const double ms = full_ms * (draft ? pace.scale() * pace.scale() : 1.0);
    now += ms / 1000.0;
    pace.drew(draft, ms);
    return ms;
  }
};

TEST(Pace, HoldsTheRateWhileSomethingMoves) {
  for (const double full : {1.0, 40.0, 200.0, 900.0}) {
    Simulated s{.full_ms = full};
    s.pace.changed(0, true);
    (void)s.frame();
    for (int i = 0; i < 50; ++i) {
      s.pace.changed(s.now, true);
      const double ms = s.frame();
      if (i > 2) {
        EXPECT_LE(ms, 1000.0 / 15.0) << full << " ms, frame " << i;
      }
    }
    if (full < 10) {
      EXPECT_EQ(s.pace.scale(), 1.0);
    }
  }
}

TEST(Pace, RefinesAfterTheLastChange) {
  Simulated s{.full_ms = 200.0};
  s.pace.changed(0, true);
  for (int i = 0; i < 5; ++i) {
    s.pace.changed(s.now, true);
    (void)s.frame();
  }
  EXPECT_FALSE(s.pace.refined());
  EXPECT_FALSE(s.pace.wants_frame(s.now + 10)) << "the button is still down";
  s.pace.changed(s.now, false);
  (void)s.frame();
  EXPECT_FALSE(s.pace.refined());
  ASSERT_TRUE(s.pace.due());
  const double waits = *s.pace.due() - s.now;
  EXPECT_LE(waits + 0.2, 0.5) << "refined half a second after, for a frame of 200 ms";
  s.now = *s.pace.due() + 1e-6;
  EXPECT_TRUE(s.pace.wants_frame(s.now));
  EXPECT_FALSE(s.pace.draft(s.now));
  (void)s.frame();
  EXPECT_TRUE(s.pace.refined());
  EXPECT_FALSE(s.pace.wants_frame(s.now + 100)) << "idle";
  EXPECT_FALSE(s.pace.due());
}

TEST(Pace, FastPicturesAreNeverDrafts) {
  Simulated s{.full_ms = 5.0};
  s.pace.changed(0, false);
  (void)s.frame();
  EXPECT_TRUE(s.pace.refined());
  s.pace.set_draft_differs(true); // several samples a pixel
  s.pace.changed(s.now, true);
  EXPECT_TRUE(s.pace.draft(s.now));
  (void)s.frame();
  EXPECT_FALSE(s.pace.refined());
}

TEST(Keys, GizmosAndRoll) {
  EXPECT_EQ(action_of('w', {}), Action::GizmoMove);
  EXPECT_EQ(action_of('g', {}), Action::GizmoMove);
  EXPECT_EQ(action_of('e', {}), Action::GizmoTurn);
  EXPECT_EQ(action_of('r', {.shift = true}), Action::GizmoScale);
  EXPECT_EQ(action_of('r', {}), Action::ResetView);
  EXPECT_EQ(gesture_of(Button::Left, {.control = true}), Gesture::Roll);
  EXPECT_EQ(gesture_of(Button::Left, {}), Gesture::Orbit);
}

// What a frame costs besides its picture takes from the picture's share.
TEST(Pace, WhatComesOnTopMakesPicturesSmaller) {
  const auto scale_with = [](double fixed) {
    Pace pace;
    for (int i = 0; i < 30; ++i) {
      pace.changed(0.01 * i, true);
      const bool draft = pace.draft(0.01 * i);
      pace.drew(draft, 60.0 * (draft ? pace.scale() * pace.scale() : 1.0), fixed);
    }
    return pace.scale();
  };
  const double without = scale_with(0.0), with = scale_with(12.0);
  EXPECT_LT(with, without);
  EXPECT_LE(60.0 * with * with, 12.0);
  EXPECT_GE(scale_with(500.0), 0.25) << "there smaller pictures help no more";
}

TEST(Pace, RecoversWhenFramesGetCheap) {
  Simulated s{.full_ms = 500.0};
  for (int i = 0; i < 10; ++i) {
    s.pace.changed(s.now, true);
    (void)s.frame();
  }
  EXPECT_LT(s.pace.scale(), 0.5);
  s.full_ms = 8.0;
  for (int i = 0; i < 60; ++i) {
    s.pace.changed(s.now, true);
    (void)s.frame();
  }
  EXPECT_EQ(s.pace.scale(), 1.0);
}

} // namespace
} // namespace mote::window
