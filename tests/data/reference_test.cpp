// SPDX-License-Identifier: MIT
// Good files against readings by other programs (ASE, MDAnalysis), listed in reference_values.json.
// ASE sorts LAMMPS atoms by id; here rows stay as in the file, so such frames are sorted first.
#include "core/data/elements.hpp"
#include "core/data/source.hpp"
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numeric>

namespace mote::data {
namespace {

using nlohmann::json;

json reference(const std::string& file) {
  std::ifstream in(test::pack() / "reference_values.json");
  return json::parse(in).at(file);
}

std::vector<std::uint64_t> order_by_id(const Frame& frame, bool wanted) {
  std::vector<std::uint64_t> order(frame.count);
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  const Column* id = frame.find("id");
  if (wanted && id)
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return id->number(a) < id->number(b); });
  return order;
}

void check_positions(const Frame& frame, const json& want, bool sorted) {
  const Column& position = *frame.find("position");
  const auto order = order_by_id(frame, sorted);
  for (std::uint32_t k = 0; k < 3; ++k) {
    double low = INFINITY, high = -INFINITY, sum = 0;
    for (std::uint64_t i = 0; i < frame.count; ++i) {
      low = std::min(low, position.number(i, k));
      high = std::max(high, position.number(i, k));
      sum += position.number(i, k);
    }
    EXPECT_DOUBLE_EQ(position.number(order.front(), k), want["first"][k].get<double>());
    EXPECT_DOUBLE_EQ(position.number(order.back(), k), want["last"][k].get<double>());
    EXPECT_DOUBLE_EQ(low, want["min"][k].get<double>());
    EXPECT_DOUBLE_EQ(high, want["max"][k].get<double>());
    EXPECT_NEAR(sum / static_cast<double>(frame.count), want["mean"][k].get<double>(), 1e-9);
  }
}

void check_box(const Frame& frame, const json& want) {
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) size += std::abs(want["cell"][i][k].get<double>());
  ASSERT_EQ(frame.box.has_value(), size > 0);
  if (!frame.box) return;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(frame.box->edges[i][k], want["cell"][i][k].get<double>(), 1e-10);
    EXPECT_EQ(frame.box->periodic[i], want["pbc"][i].get<bool>());
  }
}

// The reference has the least and largest magnitude of each array.
void check_range(const Column& column, std::uint32_t first, std::uint32_t components, const json& range) {
  double low = INFINITY, high = -INFINITY;
  for (std::uint64_t i = 0; i < column.rows(); ++i) {
    double squared = 0;
    for (std::uint32_t k = 0; k < components; ++k)
      squared += column.number(i, first + k) * column.number(i, first + k);
    low = std::min(low, std::sqrt(squared));
    high = std::max(high, std::sqrt(squared));
  }
  EXPECT_NEAR(low, range[0].get<double>(), 1e-9 * std::abs(low)) << column.name;
  EXPECT_NEAR(high, range[1].get<double>(), 1e-9 * std::abs(high)) << column.name;
}

void check_arrays(const Frame& frame, const json& arrays) {
  for (const auto& [name, want] : arrays.items()) {
    if (name == "numbers" || want["range"].is_null()) continue;
    const std::string ours = name == "positions"            ? "position"
                             : name.starts_with("c_stress") ? "stress"
                                                            : name;
    const Column* column = frame.find(ours);
    ASSERT_TRUE(column) << name;
    const auto components = want["components"].get<std::uint32_t>();
    const std::uint32_t first = ours == "stress" ? static_cast<std::uint32_t>(name[9] - '1') : 0;
    if (ours != "stress") {
      EXPECT_EQ(column->components, components) << name;
    }
    check_range(*column, first, components, want["range"]);
  }
}

// ASE's atomic numbers: from symbols, or the type where there are none.
void check_numbers(const Frame& frame, const json& want) {
  double low = INFINITY, high = -INFINITY;
  const Column* symbols = frame.find("element");
  const Column* types = frame.find("type");
  ASSERT_TRUE(symbols || types);
  for (std::uint64_t i = 0; i < frame.count; ++i) {
    const double number =
        symbols ? find_element(std::get<TextColumn>(symbols->values).at(i))->number : types->number(i);
    low = std::min(low, number);
    high = std::max(high, number);
  }
  EXPECT_EQ(low, want["range"][0].get<double>());
  EXPECT_EQ(high, want["range"][1].get<double>());
}

class ReferenceFile : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceFile, AgreesWithAse) {
  MOTE_NEED_PACK();
  const std::string name = GetParam();
  const json want = reference(name);
  const auto source = open(test::pack() / name);
  const Frame frame = source->read(0);
  EXPECT_EQ(test::broken_promise(frame), "");
  EXPECT_EQ(frame.count, want["count"].get<std::uint64_t>());
  check_positions(frame, want, source->format() == "lammps-dump");
  check_box(frame, want);
  check_arrays(frame, want["arrays"]);
  check_numbers(frame, want["arrays"]["numbers"]);
  const std::uint64_t frames = source->frame_count();
  ASSERT_EQ(frames, want["frames"].get<std::uint64_t>());
  const json& counts = want["counts"];
  for (std::uint64_t k = 0; k < std::min<std::uint64_t>(3, frames) && k + 1 < counts.size(); ++k)
    EXPECT_EQ(source->read(k).count, counts[k].get<std::uint64_t>());
  EXPECT_EQ(source->read(frames - 1).count, counts.back().get<std::uint64_t>());
  EXPECT_TRUE(source->warnings().empty()) << to_string(source->warnings());
}

INSTANTIATE_TEST_SUITE_P(Pack, ReferenceFile,
                         testing::Values("md/extended.xyz", "md/Mo.xyz", "md/ges2.xyz", "md/trajectory.xyz",
                                         "md/water.xyz", "md/water_dft_forces_bec.xyz", "md/ISF.dump",
                                         "md/polymer.lammpstrj", "md/properties.lammpstrj"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                           return name;
                         });

TEST(Reference, ScaledCoordinatesOfNacl) {
  MOTE_NEED_PACK();
  const auto source = open(test::pack() / "md/nacl.lammpstrj");
  const Frame frame = source->read(0);
  EXPECT_EQ(frame.count, 512u);
  EXPECT_EQ(source->frame_count(), 6u);
  EXPECT_FALSE(frame.find("id"));
  for (std::uint32_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(frame.find("position")->number(0, k), 0.0, 1e-6);
    EXPECT_NEAR(frame.box->edges[static_cast<int>(k)][static_cast<int>(k)], 22.560801, 1e-9);
  }
  EXPECT_EQ(frame.find("velocity")->number(511, 2), source->read(0).find("velocity")->number(511, 2));
}

TEST(Reference, TheSameTrajectoryPackedAndPlain) {
  MOTE_NEED_PACK();
  const auto plain = open(test::pack() / "md/water.xyz");
  const auto packed = open(test::pack() / "md/water.6.xyz.gz");
  ASSERT_EQ(plain->frame_count(), 100u);
  ASSERT_EQ(packed->frame_count(), 100u);
  for (const std::uint64_t k : {99u, 0u, 41u}) // any order
    EXPECT_EQ(std::get<std::vector<double>>(plain->read(k).find("position")->values),
              std::get<std::vector<double>>(packed->read(k).find("position")->values));
  EXPECT_EQ(plain->read(99).find("position")->number(0, 1), 8.776042);
}

} // namespace
} // namespace mote::data
