// SPDX-License-Identifier: MIT
// Every file of the reference pack, so that none is forgotten: particle files open without being told how and agree
// with reference_values.json, everything under bad/ is refused, and what holds no particles is named here.
//
// The reference is sorted by id and wrapped into the box where a file has ids and a box, so that those compare by
// their counts here; reference_test.cpp sorts them and compares positions. ASE gives .gro, MDAnalysis .xtc and .trr in
// Angstrom: ten times the file's nm.
#include "core/data/source.hpp"
#include "tests/data/files.hpp"
#include "tests/data/support.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

namespace fs = std::filesystem;

// Numbers without a heading: a TOML file describes them (PackRaw in tests/data_fields reads all of these).
constexpr std::array<std::string_view, 9> described{
    "dem/packing_equilibrated.xyzd", "dem/packing_initial.xyzd",    "nbody/galaxy_20K.bin",       "nbody/smoke_pos_float4.bin",
    "nbody/smoke_vel_float4.bin",    "porenetwork/Berea_node1.dat", "porenetwork/Berea_node2.dat", "porenetwork/Berea_link1.dat",
    "porenetwork/Berea_link2.dat"};

bool is_no_particle_file(const std::string& name) {
  const fs::path path(name);
  const std::string folder = path.begin()->string(), extension = path.extension().string();
  return folder == "LICENSES" || folder == "colormaps" || folder == "elements" || folder == "maps" || folder == "wind" ||
         extension == ".md" || extension == ".json" || extension == ".nfo";
}

std::string mismatch(const Frame& frame, const nlohmann::json& want) {
  // Without point data the particles are the centers of the cells (D072); the reference lists the grid's points.
  if (want.contains("cells") && want["cells"].is_number() && frame.count == want["cells"].get<std::uint64_t>() &&
      frame.count != want.value("count", frame.count)) {
    const Column& centers = *frame.find("position");
    for (std::uint64_t i = 0; i < frame.count; ++i)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (!(centers.number(i, k) > want["min"][k].get<double>() && centers.number(i, k) < want["max"][k].get<double>()))
          return fmt::format("cell {} lies outside the grid", i);
    return {};
  }
  if (want.contains("count") && frame.count != want["count"].get<std::uint64_t>()) return "count";
  if (!want.contains("min") || frame.find("id")) return {};
  const Column& position = *frame.find("position");
  const double scale = position.unit == "nm" ? 10.0 : 1.0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    double low = INFINITY, high = -INFINITY;
    for (std::uint64_t i = 0; i < frame.count; ++i) {
      low = std::min(low, scale * position.number(i, k));
      high = std::max(high, scale * position.number(i, k));
    }
    const double size = 1e-6 * (1e-3 + std::abs(low) + std::abs(high));
    if (std::abs(low - want["min"][k].get<double>()) > size || std::abs(high - want["max"][k].get<double>()) > size)
      return fmt::format("axis {}: {} to {}", k, low, high);
  }
  return {};
}

TEST(PackFiles, EveryOneIsReadAsTheReferenceSaysOrRefused) {
  MOTE_NEED_PACK();
  std::ifstream in(test::pack() / "reference_values.json");
  const nlohmann::json reference = nlohmann::json::parse(in);
  int read = 0, refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test::pack())) {
    if (!entry.is_regular_file()) continue;
    const std::string name = fs::relative(entry.path(), test::pack()).generic_string();
    if (is_no_particle_file(name) || std::find(described.begin(), described.end(), name) != described.end()) continue;
    if (name.starts_with("bad/")) {
      const Diagnostic d = test::failure_of([&] { // whatever frame is bad
        const auto source = open(entry.path());
        for (std::uint64_t k = 0; k < source->frame_count(); ++k) (void)source->read(k);
      });
      EXPECT_NE(d.code, "none") << name;
      EXPECT_GT(d.text.size(), 10u) << name;
      ++refused;
      continue;
    }
    try {
      const auto source = open(entry.path());
      const Frame frame = source->read(0);
      EXPECT_EQ(test::broken_promise(frame), "") << name;
      EXPECT_GT(frame.count, 0u) << name;
      if (!reference.contains(name)) {
        ++read;
        continue;
      }
      const nlohmann::json& want = reference.at(name);
      EXPECT_EQ(mismatch(frame, want), "") << name;
      if (want.contains("frames") && want["frames"].is_number()) {
        EXPECT_EQ(source->frame_count(), want["frames"].get<std::uint64_t>()) << name;
      }
      ++read;
    } catch (const Failure& failure) {
      ADD_FAILURE() << name << ": " << failure.what();
    }
  }
  EXPECT_EQ(read, 71);
  EXPECT_EQ(refused, 15);
}

} // namespace
} // namespace mote::data
