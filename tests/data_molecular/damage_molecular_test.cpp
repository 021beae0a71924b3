// SPDX-License-Identifier: MIT
// Files cut off at every byte and files with changed bytes. A cut file is an error or a shorter valid
// series: what is read equals what the whole file gives, or a warning says that the end may be missing.
#include "tests/data_molecular/samples.hpp"
#include "tests/data_molecular/support.hpp"

#include <chrono>
#include <random>

namespace mote::data::test {
namespace {

struct Sample {
  std::string name, extension, content;
};
std::ostream& operator<<(std::ostream& out, const Sample& sample) { return out << sample.name; }

std::vector<Sample> samples() {
  return {{"pdb", "pdb", molecule_file("two_models.pdb")},
          {"cif", "cif", molecule_file("two_models.cif")},
          {"gro", "gro", molecule_file("two_frames.gro")},
          {"data", "data", molecule_file("full.data")},
          {"xtc", "xtc", make_xtc(3, 17)},
          {"xtc2023", "xtc", make_xtc(2, 12, true)},
          {"xtc_plain", "xtc", make_xtc(3, 5)},
          {"trr", "trr", make_trr(3, 5, false)},
          {"trr_double", "trr", make_trr(3, 3, true, 2)},
          {"dcd", "dcd", make_dcd(3, 5, {})},
          {"dcd_fixed", "dcd", make_dcd(3, 5, {Order::Big, 4, true, {1, 4}})},
          {"gsd", "gsd", make_gsd(3, 5, 0x20000)},
          {"gsd1", "gsd", make_gsd(2, 5, 0x10000)},
          {"netcdf", "nc", make_netcdf(3, 5, 2)},
          {"netcdf5", "nc", make_netcdf(3, 5, 5)}};
}

class Damage : public testing::TestWithParam<Sample> {};

const std::vector<double>& positions_of(const Frame& frame) {
  return std::get<std::vector<double>>(frame.find("position")->values);
}

// Empty when `cut` fails as it should or gives a part of what `whole` gives.
std::string flaw_of_cut(Source& whole, std::string_view cut, std::string_view extension) {
  try {
    const auto source = open_text(cut, extension);
    const std::uint64_t count = source->frame_count();
    if (count == 0 || count > whole.frame_count()) return fmt::format("{} frames", count);
    for (std::uint64_t f = 0; f < count; ++f) {
      const Frame part = source->read(f), all = whole.read(f);
      if (const std::string flaw = broken_promise(part); !flaw.empty()) return flaw;
      if (source->warnings().has("D051")) continue; // "may be cut off"
      const auto& mine = positions_of(part);
      const auto& theirs = positions_of(all);
      if (mine.size() > theirs.size() || !std::equal(mine.begin(), mine.end(), theirs.begin()))
        return fmt::format("garbage in frame {}", f);
      if (part.bonds.rows.size() > all.bonds.rows.size()) return "more bonds";
    }
  } catch (const Failure& failure) {
    if (failure.exit() != Exit::BadInput || failure.diagnostic().code.empty())
      return "not a failure of input";
  }
  return {};
}

TEST_P(Damage, CutAtEveryByte) {
  const auto& [name, extension, content] = GetParam();
  const auto whole = open_text(content, extension);
  ASSERT_EQ(flaw_of_cut(*whole, content, extension), "");
  for (std::size_t length = 0; length < content.size(); ++length)
    ASSERT_EQ(flaw_of_cut(*whole, std::string_view(content).substr(0, length), extension), "")
        << "cut at " << length << " of " << content.size();
}

// Bytes changed at random, always the same ones; bounded in time.
TEST_P(Damage, ChangedBytesAreReadOrRefused) {
  const auto& [name, extension, content] = GetParam();
  std::mt19937 random(7);
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(400);
  int rounds = 0;
  for (; rounds < 4000 && std::chrono::steady_clock::now() < end; ++rounds) {
    std::string damaged = content;
    for (unsigned k = 0, n = 1 + random() % 4; k < n; ++k) {
      constexpr unsigned char favorites[]{0x00, 0xff, 0x7f, 0x80, 0x01, ' ', '-', '9', '\n', '.'};
      const auto byte =
          random() % 2 ? favorites[random() % sizeof favorites] : static_cast<unsigned char>(random());
      damaged[random() % damaged.size()] = static_cast<char>(byte);
    }
    ASSERT_EQ(survives(damaged, extension), "") << "round " << rounds;
  }
  EXPECT_GT(rounds, 20);
}

TEST_P(Damage, PiecesRemovedOrRepeatedAreReadOrRefused) {
  const auto& [name, extension, content] = GetParam();
  std::mt19937 random(11);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = content;
    const std::size_t at = random() % damaged.size(),
                      length = std::min<std::size_t>(1 + random() % 80, damaged.size() - at);
    if (round % 2)
      damaged.erase(at, length);
    else
      damaged.insert(random() % damaged.size(), content, at, length);
    ASSERT_EQ(survives(damaged, extension), "") << "round " << round;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Damage, testing::ValuesIn(samples()),
                         [](const auto& param) { return param.param.name; });

TEST(CutSeries, LeavesOutTheLastFrameWithAWarning) {
  for (const std::string& whole : {make_xtc(3, 17), make_trr(3, 17, false), make_dcd(3, 17, {})}) {
    const auto source = open_text(std::string_view(whole).substr(0, whole.size() - 1));
    EXPECT_EQ(source->frame_count(), 2u);
    EXPECT_TRUE(source->warnings().has("D022")) << source->format();
  }
  const std::string nc = make_netcdf(3, 4, 2);
  const auto source = open_text(std::string_view(nc).substr(0, nc.size() - 1));
  EXPECT_EQ(source->frame_count(), 2u);
  EXPECT_TRUE(source->warnings().has("D050"));
}

} // namespace
} // namespace mote::data::test
