// SPDX-License-Identifier: MIT
// Pictures of series: which frames, into which files, shared out over jobs, what a file says about itself, movies.
#include "core/image/exr.hpp"
#include "core/image/npy.hpp"
#include "core/image/png.hpp"
#include "run_mote.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace mote::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Batch : public CommandTest {
protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::string text;
    for (int k = 0; k < 6; ++k) text += fmt::format("2\nProperties=species:S:1:pos:R:3:s:R:1 Time={}\nO 0 0 0 {}\nH {} 0 0 {}\n", k, k, 2 + k, 10 * k);
    write("t.xyz", text);
    write("s.toml", "schema = 1\n[[data]]\nfile = \"t.xyz\"\ncolor = { attribute = \"s\" }\n");
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  bool there(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::vector<std::uint8_t> pixels(const std::string& name) const { return read_png(path(name)).rgba8; }
  std::string text_of(const std::string& file, const std::string& key) const {
    for (const auto& [k, value] : read_png(path(file)).text)
      if (k == key) return value;
    return "(none)";
  }
};

TEST_F(Batch, OneFrameOfASeries) {
  ASSERT_EQ(mote("render t.xyz --frame -1 -o last.png --aov id=id.npy --size 64x36").exit, 0);
  ASSERT_EQ(mote("render t.xyz --frame 5 -o five.png --size 64x36").exit, 0);
  ASSERT_EQ(mote("render t.xyz --frame 0 -o first.png --size 64x36").exit, 0);
  EXPECT_EQ(pixels("last.png"), pixels("five.png"));
  EXPECT_NE(pixels("first.png"), pixels("five.png"));
  const Ran beyond = mote("render t.xyz --frame 6 -o no.png");
  EXPECT_EQ(beyond.exit, 2) << beyond.err;
  EXPECT_THAT(beyond.err, HasSubstr("error D017: there is no frame 6: there are 6 frames (0 to 5"));
  EXPECT_THAT(mote("info t.xyz --frame 3").out, HasSubstr("frame 3"));
}

TEST_F(Batch, FramesIntoNumberedFiles) {
  const Ran ran = mote("render s.toml --frames 0:6:2 -o out_%03d.png --aov depth=d_%d.npy --size 64x36");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.err, ""); // no progress where there is no terminal
  for (const char* name : {"out_000.png", "out_002.png", "out_004.png", "d_0.npy", "d_4.npy"}) EXPECT_TRUE(there(name)) << name;
  EXPECT_FALSE(there("out_001.png"));
  EXPECT_EQ(text_of("out_002.png", "Frame"), "2");
  EXPECT_EQ(text_of("out_002.png", "Command"), "mote render s.toml --frame 2 --size 64x36");
  EXPECT_THAT(text_of("out_002.png", "Scene"), HasSubstr("color = { attribute = \"s\" }"));
  EXPECT_THAT(text_of("out_002.png", "Input"), HasSubstr("t.xyz"));
  ASSERT_EQ(shell("eval \"$(echo '" + text_of("out_002.png", "Command") + "' | sed \"s|^mote|$MOTE|\") -o again.png\"").exit, 0);
  EXPECT_EQ(read("again.png"), read("out_002.png")); // the same command, the same file
}

TEST_F(Batch, ShardsGiveTheSamePictures) {
  ASSERT_EQ(mote("render s.toml --frames : -o all_%d.png --size 64x36").exit, 0);
  for (int k = 1; k <= 3; ++k) ASSERT_EQ(mote(fmt::format("render s.toml --frames : --shard {}/3 -o part_%d.png --size 64x36", k)).exit, 0);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(read(fmt::format("all_{}.png", k)), read(fmt::format("part_{}.png", k))) << k;
  ASSERT_EQ(mote("render s.toml --frames : --shard 2/4 -o some_%d.png --size 64x36").exit, 0);
  EXPECT_TRUE(there("some_2.png"));
  EXPECT_FALSE(there("some_1.png"));
}

TEST_F(Batch, CompleteFilesAreSkippedOthersAreNot) {
  const std::string command = "render t.xyz --frames 0:3 -o o_%d.png --size 64x36 --skip-existing";
  ASSERT_EQ(mote(command).exit, 0);
  const std::string whole = read("o_1.png");
  write("o_0.png", whole);                                  // complete, of another frame: stays
  write("o_1.png", whole.substr(0, whole.size() - 5));      // cut off: drawn again
  ASSERT_EQ(mote(command).exit, 0);
  EXPECT_EQ(read("o_0.png"), whole);
  EXPECT_EQ(read("o_1.png"), whole);
  ASSERT_EQ(mote("render t.xyz --frames 0:3 -o o_%d.png --size 32x18 --skip-existing").exit, 0);
  EXPECT_EQ(read_png(path("o_0.png")).width, 32u); // of another size: drawn again
}

TEST_F(Batch, ProvenanceInExr) {
  ASSERT_EQ(mote("render s.toml --frame 1 --set data[0].radius=0.25 -o a.exr --size 64x36").exit, 0);
  const ExrPicture exr = read_exr(path("a.exr"));
  std::string command;
  for (const auto& [key, value] : exr.attributes)
    if (key == "Command") command = value;
  EXPECT_EQ(command, "mote render s.toml --frame 1 --set 'data[0].radius=0.25' --size 64x36");
}

TEST_F(Batch, WordsThatDoNotGoTogether) {
  struct Case {
    const char *words, *message;
  };
  for (const Case& c : {Case{"--frames 0:3 -o a.png", "one place for the number"}, Case{"--frames 0:3 -o a_%d_%d.png", "one place for the number"},
                        Case{"--frames 9: -o a_%d.png", "names none of 6 frames"}, Case{"--frames 1:x -o a_%d.png", "is no list of frames"},
                        Case{"--frames : --frame 1 -o a_%d.png", "only one of them"}, Case{"--shard 1/2 -o a.png", "--frames, which is missing"},
                        Case{"--frames : --shard 3/2 -o a_%d.png", "is not K/N"}, Case{"--frames : --shard 1/0 -o a_%d.png", "is not K/N"},
                        Case{"-o a.mp4", "--frames says of what"}, Case{"--frames : --shard 1/2 -o a.mp4", "in one go"},
                        Case{"--frames : -o -", "standard output"}}) {
    const Ran ran = mote(std::string("render t.xyz ") + c.words);
    EXPECT_EQ(ran.exit, 2) << c.words << ran.err;
    EXPECT_THAT(ran.err, HasSubstr(c.message)) << c.words;
  }
}

TEST_F(Batch, MoviesGoThroughFfmpeg) {
  const Ran missing = mote("render t.xyz --frames : -o a.mp4 --size 64x36", "PATH=/nowhere");
  EXPECT_EQ(missing.exit, 1);
  EXPECT_THAT(missing.err, HasSubstr("error A023: movies are made by ffmpeg, which is not installed"));
  // a stand-in that keeps what it gets
  write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\n/bin/cat > \"$last\"\n");
  ASSERT_EQ(shell("chmod +x bin/ffmpeg").exit, 0);
  const Ran made = mote("render t.xyz --frames : -o a.mp4 --size 64x36", "PATH=\"$PWD/bin\"");
  EXPECT_EQ(made.exit, 0) << made.err;
  EXPECT_EQ(read("a.mp4").size(), std::size_t{6} * 64 * 36 * 4);
  write("bin/ffmpeg", "#!/bin/sh\nexit 3\n");
  const Ran failed = mote("render t.xyz --frames : -o b.mp4 --size 64x36", "PATH=\"$PWD/bin\"");
  EXPECT_EQ(failed.exit, 1);
  EXPECT_THAT(failed.err, HasSubstr("error A023"));
  EXPECT_FALSE(there("b.mp4"));
}

// Where ffmpeg is installed, every ending becomes a movie of all frames; odd sizes as well.
TEST_F(Batch, MoviesOfARealFfmpeg) {
  if (shell("command -v ffmpeg && command -v ffprobe").exit != 0) GTEST_SKIP() << "NOT TESTED: ffmpeg is not installed";
  for (const char* ending : {"mp4", "mkv", "mov", "webm", "avi", "gif"}) {
    const std::string file = std::string("movie.") + ending;
    const Ran made = mote("render t.xyz --frames : -o " + file + " --size 97x55 --rate 10");
    ASSERT_EQ(made.exit, 0) << made.err;
    const Ran probe = shell("ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 " + file);
    EXPECT_THAT(probe.out, HasSubstr("6")) << ending;
  }
}

TEST_F(Batch, LegendsAreOnPicturesAndNotInAovs) {
  const std::string size = " --size 320x180";
  ASSERT_EQ(mote("render s.toml --frame 1 -o on.png --aov depth=on.npy --aov id=on_id.npy" + size).exit, 0);
  ASSERT_EQ(mote("render s.toml --frame 1 -o off.png --aov depth=off.npy --aov id=off_id.npy --set legend=false" + size).exit, 0);
  EXPECT_NE(pixels("on.png"), pixels("off.png"));
  EXPECT_EQ(read("on.npy"), read("off.npy"));
  EXPECT_EQ(read("on_id.npy"), read("off_id.npy"));
  ASSERT_EQ(mote("render s.toml --frame 1 -o on.exr" + size).exit, 0);
  const Ran equal = mote("compare on.exr --reference s.toml --set frame=1 --limits id=0");
  EXPECT_EQ(equal.exit, 0) << equal.out << equal.err;
}

// What users' files and shells do: names that are no UTF-8, pipes, frames that differ, another locale.
TEST_F(Batch, OddInputIsReadOrRefusedWithWords) {
  write("b\xe4r_1.csv", "x,y,z,gr\xf6\xdf" "e\n0,0,0,1\n1,0,0,2\n");
  EXPECT_EQ(mote("render b*_1.csv -o name.png --size 32x18").exit, 0);
  const Ran info = mote("info b*_1.csv --json", "LC_ALL=de_DE.UTF-8");
  EXPECT_EQ(info.exit, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("\"max\": 2.0"));
  EXPECT_EQ(shell("cat t.xyz | \"$MOTE\" render - --frame 2 -o pipe.png --size 32x18").exit, 0);
  ASSERT_EQ(mote("render t.xyz --frame 2 -o file.png --size 32x18").exit, 0);
  EXPECT_EQ(pixels("pipe.png"), pixels("file.png"));
  write("grow.xyz", "1\n\nO 0 0 0\n3\n\nO 0 0 0\nO 1 0 0\nO 2 0 0\n");
  EXPECT_EQ(mote("render grow.xyz --frames : -o grow_%d.png --size 32x18").exit, 0);
  EXPECT_NE(pixels("grow_0.png"), pixels("grow_1.png"));
  write("lie.xyz", "9223372036854775808\n\nO 0 0 0\n");
  EXPECT_EQ(mote("render lie.xyz -o no.png").exit, 3);
}

TEST_F(Batch, TopologyAndTrajectory) {
  if (!std::filesystem::exists(std::filesystem::path(MOTE_SOURCE_DIR).parent_path() / "shared/data/md/md.xtc")) GTEST_SKIP() << "NOT TESTED: the reference pack is missing";
  const std::string pack = (std::filesystem::path(MOTE_SOURCE_DIR).parent_path() / "shared/data/md/").string();
  const Ran info = mote("info " + pack + "md.gro " + pack + "md.xtc");
  EXPECT_THAT(info.out, HasSubstr("gro + xtc, 17411 particles, 51 frames"));
  const Ran ran = mote("render " + pack + "md.gro " + pack + "md.xtc --frame 50 -o a.png --size 160x90");
  EXPECT_EQ(ran.exit, 0) << ran.err;
}

} // namespace
} // namespace mote::test
