// SPDX-License-Identifier: MIT
#include "core/base/atomic_file.hpp"
#include "tests/image/scratch.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

namespace {
using namespace mote;
using mote::test::failure_of;
using mote::test::FileSizeLimit;
using testing::HasSubstr;
using AtomicFileTest = mote::test::Scratch;
namespace fs = std::filesystem;

TEST_F(AtomicFileTest, AppearsOnCommitOnly) {
  {
    AtomicFile file(at("a.txt"));
    file.write(std::string_view("hello "));
    EXPECT_FALSE(fs::exists(at("a.txt")));
    EXPECT_TRUE(fs::exists(at("a.txt.tmp." + std::to_string(getpid()))));
    file.write(std::string_view("world"));
    file.commit(true);
    EXPECT_EQ(content("a.txt"), "hello world");
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesTheOldFileWithoutCommit) {
  put("a.txt", "old");
  { AtomicFile(at("a.txt")).write(std::string_view("new")); }
  EXPECT_EQ(content("a.txt"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, WritesMoreThanItsBuffer) {
  std::string big(5'000'000, 'x');
  for (std::size_t i = 0; i < big.size(); i += 977) big[i] = static_cast<char>(i);
  write_file(at("big"), big);
  EXPECT_EQ(content("big"), big);
}

TEST_F(AtomicFileTest, KeepsPermissionsAndFollowsLinks) {
  put("real", "old");
  chmod(at("real").c_str(), 0640);
  fs::create_symlink("real", at("link"));
  write_file(at("link"), "new");
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(content("real"), "new");
  EXPECT_EQ(static_cast<int>(fs::status(at("real")).permissions()), 0640);
}

TEST_F(AtomicFileTest, NamesWhyAFileCannotBeCreated) {
  const Diagnostic d = failure_of(Exit::Failed, [&] { write_file(at("none/a.txt"), "x"); });
  EXPECT_EQ(d.code, "I001");
  EXPECT_EQ(d.loc.file, at("none/a.txt"));
  EXPECT_THAT(d.text, HasSubstr("none/a.txt' cannot be written: No such file or directory"));
  EXPECT_THAT(d.text, HasSubstr("there is no folder '" + at("none") + "'"));
  EXPECT_THAT(failure_of(Exit::Failed, [&] { write_file(folder.string(), "x"); }).text,
              HasSubstr("Is a directory"));
  put("file", "");
  EXPECT_THAT(failure_of(Exit::Failed, [&] { write_file(at("file/a.txt"), "x"); }).text,
              HasSubstr("Not a directory"));
  EXPECT_EQ(failure_of(Exit::Failed, [&] { write_file("", "x"); }).code, "I001");
  // refused whoever runs this: nothing may be created in /proc
  EXPECT_EQ(failure_of(Exit::Failed, [&] { write_file("/proc/a.txt", "x"); }).code, "I001");
}

TEST_F(AtomicFileTest, WritesPipesAndDevicesInPlace) {
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  const int reader = open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  write_file(at("pipe"), "through");
  char text[16]{};
  EXPECT_EQ(read(reader, text, sizeof text), 7);
  EXPECT_STREQ(text, "through");
  close(reader);
  ASSERT_TRUE(fs::is_fifo(at("pipe"))) << "nothing may be renamed over it";
  EXPECT_EQ(files(), 1u);
  // Only now a real device: were the above broken, root would lose it.
  const Diagnostic d = failure_of(Exit::Failed, [&] { write_file("/dev/full", "x"); });
  EXPECT_EQ(d.code, "I002");
  EXPECT_THAT(d.text, HasSubstr("'/dev/full' cannot be written: No space left on device"));
}

TEST_F(AtomicFileTest, RemovesWhatItCouldNotFinish) {
  put("a.txt", "old");
  const std::string big(3'000'000, 'x');
  Diagnostic d;
  {
    const FileSizeLimit limit(1'500'000);
    d = failure_of(Exit::Failed, [&] { write_file(at("a.txt"), big); });
  }
  EXPECT_EQ(d.code, "I002");
  EXPECT_THAT(d.text, HasSubstr("File too large"));
  EXPECT_EQ(content("a.txt"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, NamesWhyAFileCannotBeRenamed) {
  Diagnostic d;
  {
    AtomicFile file(at("a.txt"));
    file.write(std::string_view("x"));
    fs::create_directories(at("a.txt/inside")); // something else took the name meanwhile
    d = failure_of(Exit::Failed, [&] { file.commit(); });
  }
  EXPECT_EQ(d.code, "I003");
  EXPECT_THAT(d.text, HasSubstr("cannot be put in its place: Is a directory"));
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, MinusIsStandardOutput) {
  testing::internal::CaptureStdout();
  write_file("-", "to the pipe");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "to the pipe");
}
} // namespace
