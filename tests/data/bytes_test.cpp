// SPDX-License-Identifier: MIT
// Where bytes come from: files, gzip in its variants and with damage, pipes, bounded memory.
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <zlib.h>

#include <thread>

namespace mote::data {
namespace {

using test::failure_of;
using testing::HasSubstr;

std::string gzip(std::string_view content) {
  z_stream z{};
  EXPECT_EQ(deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&z, content.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  z.avail_in = static_cast<uInt>(content.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&z, Z_FINISH), Z_STREAM_END);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

const std::string one = "1\n\nO 1 2 3\n";
const std::string two = "1\n\nH 4 5 6\n";

TEST(Bytes, GzipIsLookedThroughWhateverTheName) {
  const test::Folder folder;
  for (const char* name : {"a.xyz.gz", "a.xyz", "a"}) {
    const auto source = open(folder.write(name, gzip(one)));
    EXPECT_EQ(source->format(), "xyz");
    EXPECT_EQ(source->read(0).find("position")->number(0, 2), 3);
  }
}

TEST(Bytes, GzipMembersFollowEachOther) {
  EXPECT_EQ(test::open_text(gzip(one) + gzip(two))->frame_count(), 2u);
  const auto padded = test::open_text(gzip(one) + std::string(512, '\0'));
  EXPECT_EQ(padded->frame_count(), 1u);
  EXPECT_TRUE(padded->warnings().empty());
  const auto trailing = test::open_text(gzip(one) + "garbage");
  EXPECT_EQ(trailing->frame_count(), 1u);
  EXPECT_TRUE(trailing->warnings().has("D023"));
}

TEST(Bytes, GzipCutAnywhereIsRefused) {
  const std::string packed = gzip(one + two);
  for (std::size_t length = 2; length < packed.size(); ++length) {
    const Diagnostic d = failure_of([&] { (void)test::open_text(packed.substr(0, length)); });
    ASSERT_EQ(d.code, "D003") << length;
    EXPECT_THAT(d.text, HasSubstr("is cut off"));
    EXPECT_EQ(d.loc.byte, static_cast<std::int64_t>(length));
  }
}

TEST(Bytes, GzipDamagedIsRefused) {
  std::string packed = gzip(one);
  packed[packed.size() - 6] ^= 1; // the check sum
  const Diagnostic d = failure_of([&] { (void)test::open_text(packed); });
  EXPECT_EQ(d.code, "D003");
  EXPECT_THAT(d.text, HasSubstr("damaged"));
}

TEST(Bytes, GzipOfNothingIsEmpty) {
  EXPECT_EQ(failure_of([] { (void)test::open_text(gzip("")); }).code, "D002");
}

TEST(Bytes, MemoryIsBoundedAndTheNeedIsStated) {
  const std::string packed = gzip(std::string(8 << 20, ' '));
  const Diagnostic d = failure_of([&] { (void)Bytes::from_memory("big.gz", packed, 1 << 20); });
  EXPECT_EQ(d.code, "D004");
  EXPECT_THAT(d.text, HasSubstr("needs about 8 MiB of memory, but 1 MiB may be used"));
  std::string liar = packed; // states 16 bytes
  liar.replace(liar.size() - 4, 4, std::string("\x10\0\0\0", 4));
  EXPECT_THAT(failure_of([&] { (void)Bytes::from_memory("big.gz", liar, 1 << 20); }).text,
              HasSubstr("more than"));
}

TEST(Bytes, PipesAreRead) {
  const test::Folder folder;
  for (const std::string& content : {one + two, gzip(one + two)}) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << content; });
    const auto source = open(pipe);
    writer.join();
    EXPECT_EQ(source->frame_count(), 2u);
    EXPECT_EQ(source->read(1).find("position")->number(0, 0), 4);
    std::filesystem::remove(pipe);
  }
}

TEST(Bytes, StandardInputIsAMinus) {
  const test::Folder folder;
  const int kept = ::dup(0);
  const int file = ::open(folder.write("in", one).c_str(), O_RDONLY);
  ::dup2(file, 0);
  const auto source = open("-");
  ::dup2(kept, 0);
  ::close(kept);
  ::close(file);
  EXPECT_EQ(source->read(0).count, 1u);
  EXPECT_EQ(failure_of([&] { (void)source->read(3); }).loc.file, "(standard input)");
}

TEST(Bytes, AnEndlessDeviceIsBounded) {
  EXPECT_EQ(failure_of([] { (void)Bytes::load("/dev/zero", 4 << 20); }).code, "D004");
}

TEST(Registry, FormatsAreListedAndContentBeatsTheName) {
  for (const char* name : {"xyz", "lammps-dump", "npy", "csv"})
    EXPECT_EQ(
        std::count_if(formats().begin(), formats().end(), [&](const Format& f) { return f.name == name; }), 1)
        << name;
  EXPECT_EQ(test::open_text(one, "csv")->format(), "xyz");
  EXPECT_EQ(test::open_text("x,y,z\n1,2,3\n", "xyz")->format(), "csv");
  EXPECT_EQ(test::open_text("ITEM: TIMESTEP\n0\n", "xyz")->format(), "lammps-dump");
  EXPECT_EQ(test::failure_of_text("nonsense\n", "xyz").code,
            "D008"); // by name, and then it says what is wrong
}

} // namespace
} // namespace mote::data
