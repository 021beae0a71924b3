// SPDX-License-Identifier: MIT
// Periodic cells and bonds by distance: known answers, and brute force over many images as the second opinion.
#include "core/data/bonds.hpp"
#include "core/data/cell.hpp"
#include "core/data/source.hpp"
#include "tests/data/files.hpp"

#include <gmock/gmock.h>

#include <random>

namespace mote::data {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Box box_of(const glm::dmat3& edges, bool x = true, bool y = true, bool z = true) { return {glm::dvec3(0.0), edges, glm::bvec3(x, y, z)}; }

Frame frame_at(const std::vector<double>& positions, const Box& box) {
  Frame frame;
  frame.count = positions.size() / 3;
  frame.columns.push_back({"position", 3, positions, {}});
  frame.box = box;
  return frame;
}
glm::dvec3 place(const Frame& frame, std::uint64_t row) {
  const Column& p = *frame.find("position");
  return {p.number(row, 0), p.number(row, 1), p.number(row, 2)};
}

double shortest_by_force(const glm::dmat3& e, const glm::dvec3& d, int reach) {
  double best = 1e300;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) best = std::min(best, glm::length(d + e * glm::dvec3(x, y, z)));
  return best;
}

TEST(MinimumImage, EqualsBruteForceInSkewedCells) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const glm::dmat3& edges : {glm::dmat3(4, 0, 0, 0, 5, 0, 0, 0, 6), glm::dmat3(4, 0, 0, 1.9, 5, 0, -1.9, 2.4, 6),
                                  glm::dmat3(10, 0, 0, 9.5, 1, 0, 0, 0, 3)}) { // the last one needs its edges reduced
    const MinimumImage shortest(box_of(edges));
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 d = edges * (1.7 * glm::dvec3(part(random), part(random), part(random)));
      EXPECT_NEAR(glm::length(shortest(d)), shortest_by_force(edges, d, 14), 1e-12);
    }
  }
}

TEST(MinimumImage, OnlyAlongPeriodicEdges) {
  const glm::dmat3 cube(10.0);
  EXPECT_EQ(MinimumImage(box_of(cube, true, false, true))({9, 9, -9}), glm::dvec3(-1, 9, 1));
  EXPECT_EQ(MinimumImage(box_of(cube, false, false, false))({9, 9, 9}), glm::dvec3(9, 9, 9));
  EXPECT_EQ(MinimumImage(box_of(glm::dmat3(0.0)))({9, 9, 9}), glm::dvec3(9, 9, 9)); // a cell without volume
}

TEST(Wrapping, ThereAndBack) {
  const glm::dmat3 edges(10, 0, 0, 3, 8, 0, -2, 1, 6);
  const std::vector<double> start{1, 1, 1, 25, -7, 13, -40.5, 3, -0.25};
  Frame frame = frame_at(start, box_of(edges, true, true, true));
  frame.box->origin = {-1, -1, -1};
  EXPECT_EQ(wrap(frame), "");
  const glm::dmat3 inverse = glm::inverse(edges);
  for (std::uint64_t row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k) {
      const double f = (inverse * (place(frame, row) - frame.box->origin))[k];
      EXPECT_GE(f, -1e-12);
      EXPECT_LT(f, 1.0 + 1e-12);
    }
  EXPECT_EQ(unwrap(frame), "");
  EXPECT_FALSE(frame.find("image"));
  for (std::uint64_t row = 0; row < 3; ++row)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(place(frame, row)[k], start[3 * row + static_cast<std::uint64_t>(k)], 1e-12);
}

TEST(Wrapping, WhatHindersIt) {
  Frame frame = frame_at({1, 2, 3}, box_of(glm::dmat3(1.0)));
  EXPECT_EQ(unwrap(frame), "there are no image flags");
  frame.box->periodic = glm::bvec3(false);
  EXPECT_EQ(wrap(frame), "the cell is not periodic");
  frame.box->edges[2] = glm::dvec3(0.0);
  EXPECT_EQ(wrap(frame), "the cell has no volume");
  frame.box.reset();
  EXPECT_EQ(wrap(frame), "there is no cell");
}

// polymer.lammpstrj has wrapped coordinates and image flags: unwrapped, bonded neighbors are near each other in every
// chain; wrapped again, all is as in the file.
TEST(Wrapping, PolymerChainsBecomeWhole) {
  MOTE_NEED_PACK();
  const Frame wrapped = open(test::pack() / "md/polymer.lammpstrj")->read(5);
  Frame whole = wrapped;
  ASSERT_EQ(unwrap(whole), "");
  Frame again = whole;
  ASSERT_EQ(wrap(again), "");
  double moved = 0.0, back = 0.0;
  for (std::uint64_t row = 0; row < wrapped.count; ++row) {
    moved = std::max(moved, glm::length(place(whole, row) - place(wrapped, row)));
    const glm::dvec3 d = place(again, row) - place(wrapped, row);
    back = std::max(back, glm::length(MinimumImage(*wrapped.box)(d)));
  }
  EXPECT_GT(moved, 1.0);
  EXPECT_LT(back, 1e-9);
}

Frame atoms(const std::vector<std::string>& symbols, const std::vector<double>& positions) {
  Frame frame = frame_at(positions, {});
  frame.box.reset();
  TextColumn text;
  for (const std::string& symbol : symbols) {
    text.codes.push_back(static_cast<std::uint32_t>(text.dictionary.size()));
    text.dictionary.push_back(symbol);
  }
  frame.columns.push_back({"element", 1, text, {}});
  return frame;
}

TEST(BondsByDistance, Water) {
  Frame water = atoms({"O", "H", "H"}, {0, 0, 0, 0.957, 0, 0, -0.24, 0.927, 0});
  EXPECT_THAT(bonds_by_distance(water).rows, ElementsAre(std::array{0u, 1u}, std::array{0u, 2u}));
  water.columns[0].unit = "nm"; // ten times as far apart
  EXPECT_TRUE(bonds_by_distance(water).rows.empty());
  for (double& x : std::get<std::vector<double>>(water.columns[0].values)) x *= 0.1;
  EXPECT_EQ(bonds_by_distance(water).rows.size(), 2u);
}

TEST(BondsByDistance, AcrossTheCellAndNotTooNear) {
  Frame frame = atoms({"C", "C", "C", "C"}, {0.2, 5, 5, 9.0, 5, 5, 5, 1, 1, 5, 1, 1.1});
  EXPECT_TRUE(bonds_by_distance(frame).rows.empty()); // the last two lie on each other
  frame.box = box_of(glm::dmat3(10.0));
  EXPECT_THAT(bonds_by_distance(frame).rows, ElementsAre(std::array{0u, 1u}));
}

TEST(BondsByDistance, EqualsAllPairsOfAProtein) {
  MOTE_NEED_PACK();
  const Frame frame = open(test::pack() / "protein/1crn.pdb")->read(0);
  const Bonds bonds = bonds_by_distance(frame);
  EXPECT_EQ(bonds.rows.size(), 337u); // 327 atoms of one chain, 7 rings of side chains, 3 bridges
  for (const auto& [a, b] : bonds.rows) EXPECT_LT(glm::length(place(frame, a) - place(frame, b)), 2.6);
}

} // namespace
} // namespace mote::data
