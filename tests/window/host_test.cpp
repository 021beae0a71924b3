// SPDX-License-Identifier: MIT
// The real window on a virtual display (Xvfb): scripts, real X events (xdotool), and displays that are not there or cannot
// show Vulkan pictures. Without Xvfb or xdotool the tests are skipped, loudly.
#include "app/run_mote.hpp"

#include "core/image/npy.hpp"
#include "core/image/png.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

namespace mote::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

bool has(const char* program) { return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0; }

class HostTest : public CommandTest {
protected:
  void SetUp() override {
    CommandTest::SetUp();
    write("points.csv", "x,y,z,radius,speed\n0,0,0,1,5\n3,0,0,1,6\n0,0,4,1,7\n");
    write("scene.toml", "schema = 1 # kept\n[camera]\neye = [0.0, -30.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\nfov_y = 20.0\n"
                        "[[light]]\nname = \"sun\"\nkind = \"directional\"\ndirection = [0.0, 1.0, 0.0]\nintensity = 0.8 # bright\n[[data]]\nfile = \"points.csv\"\n");
  }
  // A display of its own around `command`, which sees it as $DISPLAY.
  [[nodiscard]] Ran displayed(const std::string& command, const std::string& screen = "800x600x24") const {
    return shell("Xvfb -displayfd 3 -screen 0 " + screen + " -nolisten tcp 3>number 2>/dev/null &\nxvfb=$!\n"
                 "for i in $(seq 200); do [ -s number ] && break; sleep 0.05; done\nexport DISPLAY=:$(cat number)\n" +
                 command + "\nstatus=$?\nkill $xvfb\nwait $xvfb 2>/dev/null\nexit $status");
  }
};
#define NEEDS(program) \
  if (!has(program)) GTEST_SKIP() << program << " is not installed: the window is NOT tested. apt-get install " << program

TEST_F(HostTest, NoDisplaySaysWhatWorksInstead) {
  const Ran ran = mote("view scene.toml");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_THAT(ran.err, HasSubstr("A010"));
  EXPECT_THAT(ran.err, HasSubstr("mote render scene.toml -o picture.png"));
}

TEST_F(HostTest, ADisplayWithoutTrueColorCannotPresent) {
  NEEDS("Xvfb");
  const Ran ran = displayed("\"$MOTE\" view scene.toml --size 64x48", "800x600x8");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_THAT(ran.err, HasSubstr("A0"));
  EXPECT_THAT(ran.err, HasSubstr("mote render scene.toml -o picture.png"));
}

TEST_F(HostTest, BadScriptsOpenNothing) {
  write("s.txt", "key r\njump\n");
  const Ran ran = mote("view scene.toml --script s.txt");
  EXPECT_EQ(ran.exit, 3);
  EXPECT_THAT(ran.err, HasSubstr("s.txt:2:1: error A051: there is no step 'jump'"));
  EXPECT_EQ(mote("view scene.toml --script none.txt").exit, 3);
}

// Open, turn, pick, map a color, change a light, save, draw headless: the same picture.
TEST_F(HostTest, TheWalk) {
  NEEDS("Xvfb");
  write("s.txt", "key tab\nwait refined\ndrag left 200 150 260 170\nclick left 200 150 ctrl\nset data[0].color={ attribute = \"speed\", map = \"viridis\" }\n"
                 "set light.sun.intensity=0.5\nkey escape\nkey l\nkey l\nwait refined\nsave\nscreenshot shown.png\nsize 300x200\nwait refined\nsize 400x300\nminimize\nwait 0.1\nrestore\nwait refined\nquit\n");
  const Ran ran = displayed("\"$MOTE\" view scene.toml --size 400x300 --script s.txt --report");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("frames "));
  EXPECT_THAT(read("scene.toml"), HasSubstr("schema = 1 # kept"));
  EXPECT_THAT(read("scene.toml"), HasSubstr("intensity = 0.5 # bright"));
  ASSERT_EQ(mote("render scene.toml --size 400x300 -o drawn.png --aov id=drawn.npy").exit, 0);
  const PngPicture shown = read_png((folder / "shown.png").string()), drawn = read_png((folder / "drawn.png").string());
  EXPECT_EQ(shown.rgba8, drawn.rgba8);
  // The command in the screenshot draws it again, ids and all.
  std::string command;
  for (const auto& [key, value] : shown.text)
    if (value.starts_with("mote render")) command = value.substr(5);
  ASSERT_FALSE(command.empty());
  ASSERT_EQ(mote(command + " -o again.png --aov id=again.npy").exit, 0) << command;
  EXPECT_EQ(read("again.npy"), read("drawn.npy"));
}

TEST_F(HostTest, RealKeysAndMouse) {
  NEEDS("Xvfb");
  NEEDS("xdotool");
  const Ran ran = displayed("\"$MOTE\" view scene.toml --size 400x300 &\nview=$!\n"
                            "window=$(timeout 60 xdotool search --sync --onlyvisible --class mote | head -1)\nsleep 1\nxdotool windowfocus $window\n"
                            "xdotool mousemove --window $window 350 100 click 4 mousedown 3 mousemove --window $window 370 120 mouseup 3 key s\n"
                            "for i in $(seq 100); do [ -s mote-1.png ] && break; sleep 0.1; done\nxdotool key ctrl+s key ctrl+q\n"
                            "for i in $(seq 100); do kill -0 $view 2>/dev/null || break; sleep 0.1; done\nwait $view");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("mote-1.png"));
  EXPECT_THAT(read("scene.toml"), Not(HasSubstr("eye = [0.0, -30.0, 0.0]"))) << "the wheel and the drag moved the camera, which was saved";
}

// A data set moved by its handles, a camera rolled: by real events, saved, and drawn headless as the window showed it.
TEST_F(HostTest, RealHandles) {
  NEEDS("Xvfb");
  NEEDS("xdotool");
  write("scene.toml", read("scene.toml") + "transform = [ { scale = 1.0 } ] # as measured\n");
  const Ran ran = displayed("\"$MOTE\" view scene.toml --size 800x600 &\nview=$!\n"
                            "window=$(timeout 60 xdotool search --sync --onlyvisible --class mote | head -1)\nsleep 1\nxdotool windowfocus $window\n"
                            "at() { xdotool mousemove --window $window $1 $2; }\nxdotool key w\nsleep 0.5\n"
                            "at 485 187\nxdotool mousedown 1\nat 500 187\nat 525 190\nxdotool mouseup 1\nxdotool key Escape\nsleep 0.5\n"
                            "at 600 300\nxdotool keydown ctrl mousedown 1\nat 590 350\nxdotool mouseup 1 keyup ctrl\nsleep 1\n"
                            "xdotool key s\nfor i in $(seq 100); do [ -s mote-1.png ] && break; sleep 0.1; done\nsleep 0.5\nxdotool key ctrl+s\nsleep 0.5\nxdotool key ctrl+q\n"
                            "for i in $(seq 100); do kill -0 $view 2>/dev/null || break; sleep 0.1; done\nwait $view");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(read("scene.toml"), HasSubstr("transform = [ { scale = 1.0 }, { translate = [0.7"));
  EXPECT_THAT(read("scene.toml"), HasSubstr("# as measured"));
  EXPECT_THAT(read("scene.toml"), Not(HasSubstr("up = [0.0, 0.0, 1.0]")));
  ASSERT_TRUE(exists("mote-1.png"));
  ASSERT_EQ(mote("render scene.toml --size 800x600 -o drawn.png").exit, 0);
  EXPECT_EQ(read_png((folder / "mote-1.png").string()).rgba8, read_png((folder / "drawn.png").string()).rgba8);
}

// While nothing happens, nothing is done: processor time between two looks at a window that is left alone.
TEST_F(HostTest, IdleUsesNoProcessor) {
  NEEDS("Xvfb");
  write("s.txt", "wait refined\nprint ready\n");
  const Ran ran = displayed("\"$MOTE\" view scene.toml --size 400x300 --script s.txt >said 2>&1 &\nview=$!\n"
                            "for i in $(seq 600); do grep -q ready said && break; sleep 0.1; done\nsleep 1\n"
                            "awk '{print $14 + $15}' /proc/$view/stat\nsleep 3\nawk '{print $14 + $15}' /proc/$view/stat\nkill $view\nwait $view\ntrue");
  int before = 0, after = 0;
  ASSERT_EQ(std::sscanf(ran.out.c_str(), "%d\n%d", &before, &after), 2) << ran.out << ran.err;
  EXPECT_LE(after - before, 1) << "hundredths of a second in three seconds";
}

} // namespace
} // namespace mote::test
