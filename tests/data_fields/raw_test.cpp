// SPDX-License-Identifier: MIT
// Raw files and their descriptions, and what is wrong with some of them.
#include "tests/data_fields/support.hpp"

#include <unistd.h>

namespace mote::data::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Raw : public ::testing::Test {
protected:
  Raw() : folder_(std::filesystem::temp_directory_path() / ("mote-raw-test-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Raw() override { std::filesystem::remove_all(folder_); }
  void save(const std::string& name, std::string_view content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }
  Frame read(const std::string& text, Diagnostics* warnings = nullptr) const {
    save("a.moteraw", text);
    const auto source = open(folder_ / "a.moteraw");
    EXPECT_EQ(source->format(), "raw");
    Frame frame = source->read(0);
    if (warnings) *warnings = source->warnings();
    return frame;
  }
  void refused(const std::string& text, std::string_view code, std::string_view words) const {
    try {
      (void)read(text);
      ADD_FAILURE() << "was read: " << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.diagnostic().code, code) << failure.what();
      EXPECT_THAT(failure.what(), HasSubstr(words));
      EXPECT_EQ(failure.exit(), Exit::BadInput);
    }
  }
  std::filesystem::path folder_;
};

const std::string bytes_of_two = std::string("\1\2\3\4\5\6\7\x08", 8);
const std::string good = "mote_raw = 1\n[[file]]\npath = 'p.bin'\nlayout = ['position u1 3', 'charge i1']\n";

TEST_F(Raw, BinaryToTheEndOfTheFile) {
  save("p.bin", bytes_of_two);
  const Frame frame = read(good);
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(1, 2, 3, 5, 6, 7));
  EXPECT_THAT(numbers_of(frame, "charge"), ElementsAre(4, 8));
}

TEST_F(Raw, CountHeaderAndTrailingBytes) {
  save("p.bin", "H" + bytes_of_two + "tail");
  Diagnostics warnings;
  const Frame frame = read(good + "header = 1\ncount = 2\n", &warnings);
  EXPECT_EQ(frame.count, 2u);
  EXPECT_TRUE(warnings.has("D023"));
}

TEST_F(Raw, TextWithComments) {
  save("p.txt", "heading\n# comment\n1 0.5 1.5 2.5 extra\n\n2 3 4 5\n");
  const Frame frame = read("mote_raw = 1\n[[file]]\npath = 'p.txt'\nkind = 'text'\nheader = 1\nlayout = ['id "
                           "integer', 'position real 3 nm']\n");
  EXPECT_THAT(numbers_of(frame, "position"), ElementsAre(0.5, 1.5, 2.5, 3, 4, 5));
  EXPECT_EQ(frame.find("position")->unit, "nm");
}

TEST_F(Raw, BadDescriptionsAreRefused) {
  save("p.bin", bytes_of_two);
  refused("mote_raw = 1\n[[file]\n", "D067", "a.moteraw:2");
  refused(good + "endain = 'big'\n", "D068", "Did you mean 'endian'");
  refused(changed(good, "layout", "layuot"), "D068", "layout is missing");
  refused(changed(good, "path = 'p.bin'\n", ""), "D068", "path");
  refused("mote_raw = 1\n", "D068", "file");
  refused(changed(good, "mote_raw = 1", "mote_raw = 2"), "D069", "'2'");
  refused(good + "endian = 'middle'\n", "D069", "middle");
  refused(good + "count = -1\n", "D069", "'-1'");
  refused(good + "header = 'x'\n", "D069", "header");
  refused(changed(good, "i1", "i3"), "D070", "'i3'");
  refused(changed(good, "u1 3", "u1 0"), "D070", "'0'");
  refused(changed(good, "u1 3", "u1 3 m more"), "D070", "more than name");
  refused(changed(good, "['position u1 3', 'charge i1']", "[1]"), "D070", "not 1");
  refused(changed(good, "position", "place"), "D013", "position");
}

TEST_F(Raw, BadFilesAreRefused) {
  refused(good, "D001", "p.bin");
  save("p.bin", bytes_of_two + "x");
  refused(good, "D064", "p.bin:@8");
  refused(good + "count = 3\n", "D006", "3 records of 4 bytes needs 12 bytes, but 9 are left");
  refused(good + "count = 9000000000000000000\n", "D006", "ends early");
  refused(good + "header = 10\n", "D006", "header");
  save("p.txt", "1 2 3\n4 5\n");
  refused("mote_raw = 1\n[[file]]\npath = 'p.txt'\nkind = 'text'\nlayout = ['position real 3']\n", "D010",
          "p.txt:2");
  refused("mote_raw = 1\n[[file]]\npath = 'p.txt'\nkind = 'text'\ncount = 3\nlayout = ['position real 2']\n",
          "D006", "3 rows are wanted, 2 are there");
}

TEST_F(Raw, FilesMustHoldTheSameParticles) {
  save("p.bin", bytes_of_two);
  save("q.bin", "ab");
  const std::string second = "[[file]]\npath = 'q.bin'\n";
  EXPECT_THAT(numbers_of(read(good + second + "layout = ['k u1']\n"), "k"), ElementsAre('a', 'b'));
  refused(good + second + "layout = ['k u1']\ncount = 1\n", "D071", "1 rows");
  refused(changed(good, "charge i1", "id i1") + second + "layout = ['id u1']\n", "D071", "row 1 has id 97");
}

} // namespace
} // namespace mote::data::testing
