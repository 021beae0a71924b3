// SPDX-License-Identifier: MIT
// The binary trajectories on files made in memory: values, cells, steps, variants of each format.
#include "tests/data/support.hpp"
#include "tests/data_molecular/samples.hpp"

#include <gmock/gmock.h>

namespace mote::data::test {
namespace {

using testing::HasSubstr;

void expect_positions(const Frame& frame, std::uint64_t index, std::uint64_t atoms, double tolerance = 0) {
  EXPECT_EQ(broken_promise(frame), "");
  ASSERT_EQ(frame.count, atoms);
  const Column& column = *frame.find("position");
  for (std::uint64_t a = 0; a < atoms; ++a)
    for (int k = 0; k < 3; ++k)
      ASSERT_NEAR(column.number(a, static_cast<std::uint32_t>(k)), position(index, a, k), tolerance)
          << "atom " << a << " axis " << k;
}

struct Named {
  const char* name;
  std::string bytes;
  const char* format;
};
std::ostream& operator<<(std::ostream& out, const Named& named) { return out << named.name; }

class Trajectory : public testing::TestWithParam<Named> {};

// Five frames of 17 atoms, read backwards: random access needs no earlier frame.
TEST_P(Trajectory, GivesEveryFrameInAnyOrder) {
  const auto source = open_text(GetParam().bytes);
  EXPECT_EQ(source->format(), GetParam().format);
  for (const std::uint64_t f : {4u, 0u, 2u, 3u, 1u}) expect_positions(source->read(f), f, 17, 1e-12);
  EXPECT_EQ(source->frame_count(), 5u);
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
  const Diagnostic none = failure_of([&] { (void)source->read(5); });
  EXPECT_EQ(none.code, "D017");
  EXPECT_THAT(none.text, HasSubstr("5 frames (0 to 4)"));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, Trajectory,
    testing::Values(
        Named{"xtc", make_xtc(5, 17), "xtc"}, Named{"xtc2023", make_xtc(5, 17, true), "xtc"},
        Named{"trr", make_trr(5, 17, false), "trr"}, Named{"trr_double", make_trr(5, 17, true), "trr"},
        Named{"dcd", make_dcd(5, 17, {}), "dcd"}, Named{"dcd_big", make_dcd(5, 17, {Order::Big}), "dcd"},
        Named{"dcd_wide", make_dcd(5, 17, {Order::Little, 8}), "dcd"},
        Named{"dcd_wide_big", make_dcd(5, 17, {Order::Big, 8, false}), "dcd"},
        Named{"gsd1", make_gsd(5, 17, 0x10000), "gsd"}, Named{"gsd2", make_gsd(5, 17, 0x20000), "gsd"},
        Named{"cdf1", make_netcdf(5, 17, 1), "netcdf"}, Named{"cdf2", make_netcdf(5, 17, 2), "netcdf"},
        Named{"cdf5", make_netcdf(5, 17, 5), "netcdf"}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(Xtc, PlainPositionsOfNineAtomsAndFewer) {
  for (const std::uint64_t atoms : {1u, 9u})
    expect_positions(open_text(make_xtc(2, atoms))->read(1), 1, atoms);
}

TEST(Xtc, StepTimeBoxAndUnits) {
  const Frame frame = open_text(make_xtc(3, 12))->read(2);
  EXPECT_EQ(frame.step, 20);
  EXPECT_EQ(frame.time, 1.0);
  EXPECT_EQ(frame.find("position")->unit, "nm");
  ASSERT_TRUE(frame.box);
  EXPECT_EQ(frame.box->edges[2], glm::dvec3(2, 3, 66)); // the third vector of the file
}

TEST(Trr, FramesWithoutPositionsAreLeftOut) {
  const auto source = open_text(make_trr(4, 11, false, 0b0101)); // frames 0 and 2
  expect_positions(source->read(1), 3, 11);
  EXPECT_EQ(source->frame_count(), 2u);
  EXPECT_TRUE(source->warnings().has("D049"));
  const Frame frame = source->read(0);
  EXPECT_EQ(frame.step, 10);
  EXPECT_EQ(frame.find("velocity")->number(3, 1), -position(1, 3, 1));
  EXPECT_EQ(frame.find("velocity")->unit, "nm/ps");
}

TEST(Trr, OnlyFramesWithoutPositionsIsAnError) {
  EXPECT_EQ(failure_of([] { (void)open_text(make_trr(2, 11, false, 0b11))->frame_count(); }).code, "D017");
}

TEST(Dcd, FixedAtomsKeepTheirFirstPlace) {
  const auto source = open_text(make_dcd(3, 6, {Order::Little, 4, true, {2, 5}}));
  const Frame frame = source->read(2); // before frame 0 was asked for
  const Column& column = *frame.find("position");
  for (const std::uint64_t atom : {0u, 2u, 3u, 5u}) EXPECT_EQ(column.number(atom, 1), position(0, atom, 1));
  for (const std::uint64_t atom : {1u, 4u}) EXPECT_EQ(column.number(atom, 1), position(2, atom, 1));
  EXPECT_EQ(source->frame_count(), 3u);
}

TEST(Dcd, CellOfCosinesAndSteps) {
  const Frame frame = open_text(make_dcd(2, 3, {}))->read(1);
  EXPECT_EQ(frame.step, 110);
  ASSERT_TRUE(frame.box);
  EXPECT_NEAR(frame.box->edges[0].x, 10, 1e-12);
  EXPECT_NEAR(frame.box->edges[1].x, 10, 1e-12); // 20 cos 60
  EXPECT_NEAR(frame.box->edges[1].y, 20 * std::sqrt(0.75), 1e-12);
  EXPECT_EQ(frame.box->edges[2], glm::dvec3(0, 0, 30));
}

TEST(Dcd, CellOfDegreesAndOfAMatrix) {
  std::string bytes = make_dcd(1, 3, {});
  const std::size_t cell = bytes.size() - 3 * (12 + 8) - 4 - 48;
  Maker degrees(Order::Little), matrix(Order::Little);
  for (const double v : {10.0, 60.0, 20.0, 90.0, 90.0, 30.0}) degrees.put(v);
  bytes.replace(cell, 48, degrees.bytes);
  EXPECT_NEAR(open_text(bytes)->read(0).box->edges[1].x, 10, 1e-12);
  for (const double v : {10.0, -2.0, 20.0, -3.0, -4.0, 30.0}) matrix.put(v);
  bytes.replace(cell, 48, matrix.bytes);
  const Frame frame = open_text(bytes)->read(0);
  EXPECT_EQ(frame.box->edges[1], glm::dvec3(-2, 20, -4));
}

TEST(Dcd, AWrongFrameCountInTheHeaderIsAWarning) {
  std::string bytes = make_dcd(3, 3, {});
  bytes[8] = 7;
  const auto source = open_text(bytes);
  EXPECT_EQ(source->frame_count(), 3u);
  EXPECT_TRUE(source->warnings().has("D050"));
}

TEST(Gsd, TypesBondsBoxAndLog) {
  for (const std::uint32_t version : {0x10000u, 0x20000u}) {
    const Frame frame = open_text(make_gsd(3, 4, version))->read(2);
    EXPECT_EQ(frame.step, 20);
    EXPECT_EQ(std::get<TextColumn>(frame.find("type")->values).at(1), "Bb"); // inherited from frame 0
    EXPECT_EQ(frame.find("radius")->number(3), 2.0);                         // half of the diameter
    EXPECT_EQ(frame.bonds.rows, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
    ASSERT_TRUE(frame.box);
    EXPECT_EQ(frame.box->edges[1], glm::dvec3(10, 20, 0));  // xy Ly
    EXPECT_EQ(frame.box->edges[2], glm::dvec3(0, 7.5, 30)); // yz Lz
    EXPECT_EQ(frame.box->origin, glm::dvec3(-10, -13.75, -15));
    EXPECT_EQ(frame.find("particles/heat")->number(3), 5.0);
    EXPECT_THAT(frame.properties, testing::Contains(std::pair<std::string, std::string>("energy", "3")));
  }
}

TEST(Netcdf, ScaleUnitsPaddingAndBox) {
  for (const std::uint8_t version : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{5}}) {
    const Frame frame = open_text(make_netcdf(3, 5, version))->read(2); // five shorts: two bytes of padding
    expect_positions(frame, 2, 5);
    EXPECT_EQ(frame.time, 1.0);
    EXPECT_EQ(frame.find("position")->unit, "A");
    EXPECT_EQ(frame.find("molecule")->type(), ColumnType::Int);
    EXPECT_EQ(frame.find("molecule")->number(4), 5.0);
    ASSERT_TRUE(frame.box);
    EXPECT_EQ(frame.box->edges[2].z, 30);
  }
}

TEST(Netcdf, TheNumberOfFramesMayBeUnknown) {
  std::string bytes = make_netcdf(3, 4, 2);
  bytes.replace(4, 4, "\xff\xff\xff\xff");
  const auto source = open_text(bytes);
  EXPECT_EQ(source->frame_count(), 3u);
  EXPECT_TRUE(source->warnings().empty());
}

} // namespace
} // namespace mote::data::test
