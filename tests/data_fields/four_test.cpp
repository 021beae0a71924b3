// SPDX-License-Identifier: MIT
// The same four particles in every format and packing (files/, written by make_files.py): they read the
// same; cut at every byte they are refused; changed at random they are read or refused, never worse.
#include "tests/data_fields/support.hpp"

#include <random>

namespace mote::data::testing {
namespace {

const std::vector<std::string> names{
    "four_ascii.vtk",    "four_binary.vtk",      "four_binary_5.1.vtk",  "four_ascii.vtu",
    "four_ascii.vtp",    "four_inline.vtu",      "four_inline_zlib.vtu", "four_base64.vtu",
    "four_raw.vtu",      "four_base64_zlib.vtp", "four_raw_big.vtu",     "four_raw_zlib.vtu",
    "four_raw_lz4.vtp",  "four_raw_lzma.vtu",    "four_pieces.vtu",      "four.bgeo",
    "four_gz.bgeo",      "four_ascii.ply",       "four_little.ply",      "four_big.ply",
    "four.npz",          "four_deflated.npz",    "four_ascii.ply.xz",    "four_ascii.ply.gz",
    "four_ascii.ply.zst"};

class Four : public ::testing::TestWithParam<std::string> {};

void expect_four(const Frame& frame) {
  EXPECT_EQ(frame.count, 4u);
  EXPECT_THAT(numbers_of(frame, "position"), ::testing::ElementsAre(0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3.25));
  EXPECT_THAT(numbers_of(frame, "velocity"),
              ::testing::ElementsAre(0, 0, 0, 1, 10, -0.5, 2, 20, -1, 3, 30, -1.5));
  const std::vector<double> density = numbers_of(frame, "density");
  ASSERT_EQ(density.size(), 4u);
  EXPECT_EQ(density[1], 2.5);
  EXPECT_NEAR(density[3], 1e-3, 1e-9); // bgeo has 32 bits
  EXPECT_THAT(numbers_of(frame, "id"), ::testing::ElementsAre(7, 8, 9, 10));
  ASSERT_NE(frame.find("id"), nullptr);
  EXPECT_EQ(frame.find("id")->type(), ColumnType::Int);
  EXPECT_EQ(frame.columns.size(), 4u);
}

TEST_P(Four, ReadsTheSame) {
  const auto source = open(small_file(GetParam()));
  EXPECT_EQ(source->frame_count(), 1u);
  const Frame frame = source->read(0);
  expect_four(frame);
  const std::string extension = extension_of_name(GetParam());
  if (extension.starts_with("vt") || extension == "npz") {
    EXPECT_EQ(frame.time, 0.25);
    EXPECT_EQ(frame.step, 12);
  }
  try {
    (void)source->read(1);
    ADD_FAILURE() << "there is no frame 1";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "D017");
  }
}

// A cut may be unseen only where the file could not tell: in blanks at the end, and in legacy VTK between two
// sections, which all are optional. Where the data read may have lost digits or the end mark, D073 warns.
TEST_P(Four, CutAtEveryByteIsRefused) {
  const std::string whole = content_of(small_file(GetParam()));
  for (std::size_t size = 1; size < whole.size(); ++size) {
    Diagnostics warnings;
    try {
      const Frame frame = read_memory(GetParam(), std::string_view(whole).substr(0, size), &warnings);
      EXPECT_EQ(frame.count, 4u);
      const bool only_blanks = whole.find_last_not_of("\n") < size;
      const bool between = GetParam().ends_with(".vtk") && whole[size - 1] == '\n';
      if (only_blanks) expect_four(frame);
      EXPECT_TRUE(only_blanks || between || warnings.has("D073"))
          << "cut at " << size << " of " << whole.size();
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit(), Exit::BadInput);
      EXPECT_TRUE(failure.diagnostic().code.starts_with('D')) << failure.what();
      EXPECT_FALSE(failure.diagnostic().loc.file.empty());
    }
  }
}

TEST_P(Four, RandomChangesAreReadOrRefused) {
  const std::string whole = content_of(small_file(GetParam()));
  std::minstd_rand random(4711);
  for (int round = 0; round < 600; ++round) {
    std::string changed = whole;
    for (std::uint32_t n = random() % 4 + 1; n > 0; --n) {
      const std::size_t at = random() % changed.size();
      switch (random() % 4) {
      case 0: changed[at] = static_cast<char>(random()); break;
      case 1: changed[at] = static_cast<char>(changed[at] ^ (1 << random() % 8)); break;
      case 2: changed.erase(at, random() % 9 + 1); break;
      default: changed.insert(at, random() % 5 + 1, "0-9\xff\0 <"[random() % 8]); break;
      }
      if (changed.empty()) changed.push_back('x');
    }
    const Outcome outcome = outcome_of(GetParam(), changed);
    EXPECT_TRUE(outcome.code.empty() || (outcome.code.starts_with('D') && outcome.exit == Exit::BadInput))
        << outcome.text;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Four, ::testing::ValuesIn(names), [](const auto& test) {
  std::string name = test.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST(FourRaw, ReadsTheSame) {
  const auto source = open(small_file("four_raw.toml"));
  const Frame frame = source->read(0);
  expect_four(frame);
  EXPECT_EQ(frame.time, 0.25);
  EXPECT_EQ(frame.find("position")->unit, "m");
}

} // namespace
} // namespace mote::data::testing
