// SPDX-License-Identifier: MIT
// The typical distance between particles: exact for lattices, against all pairs for random ones, in
// any unit, and for data that break simple methods.
#include "core/data/neighbors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace mote::data {
namespace {

struct Random {
  std::uint64_t state{88172645463325252u};
  double operator()() { // 0..1
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<double>(state >> 11) * 0x1p-53;
  }
};

std::vector<double> lattice(int n, int layers, double spacing) {
  std::vector<double> out;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) out.insert(out.end(), {x * spacing, y * spacing, z * spacing});
  return out;
}

double by_all_pairs(const std::vector<double>& p) {
  std::vector<double> nearest;
  for (std::size_t i = 0; i < p.size(); i += 3) {
    double best = INFINITY;
    for (std::size_t j = 0; j < p.size(); j += 3) {
      const double d = std::hypot(p[i] - p[j], p[i + 1] - p[j + 1], p[i + 2] - p[j + 2]);
      if (d > 0) best = std::min(best, d);
    }
    nearest.push_back(best);
  }
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2),
                   nearest.end());
  return nearest[nearest.size() / 2];
}

TEST(Neighbors, ExactAgainstAllPairs) {
  Random random;
  std::vector<double> points;
  for (int i = 0; i < 3 * 1500; ++i) points.push_back(random() * random() * 10);
  EXPECT_NEAR(*median_neighbor_distance(points), by_all_pairs(points), 1e-12);
}

TEST(Neighbors, LatticesOfEverySizeAndUnit) {
  for (const double spacing : {1.0, 3.61, 1e-9, 1e12})
    for (const auto& [n, layers] :
         {std::pair{10, 10}, {20, 1}, {60, 60}, {400, 1}}) // up to 216 000, planar ones too
      EXPECT_NEAR(*median_neighbor_distance(lattice(n, layers, spacing)), spacing, 1e-6 * spacing)
          << n << " " << layers;
}

TEST(Neighbors, LargeRandomDataWithinTwoPercentPoints) {
  Random random;
  std::vector<double> points(3 * 300000);
  for (double& value : points) value = random();
  // Poisson process: median = (3 ln 2 / (4 pi density))^(1/3)
  const double expected = std::cbrt(3 * std::log(2.0) / (4 * M_PI * 300000));
  EXPECT_NEAR(*median_neighbor_distance(points) / expected, 1.0, 0.04);
}

TEST(Neighbors, DenseClustersWithFarOutliers) {
  Random random;
  std::vector<double> points;
  for (int i = 0; i < 100000; ++i)
    for (int k = 0; k < 3; ++k) points.push_back(i % 1000 == 0 ? random() * 1e9 : random());
  const double expected = std::cbrt(3 * std::log(2.0) / (4 * M_PI * 100000));
  EXPECT_NEAR(*median_neighbor_distance(points) / expected, 1.0, 0.06);
}

TEST(Neighbors, CoincidentAndBadPointsDoNotCount) {
  std::vector<double> points = lattice(10, 10, 2.0);
  const std::vector<double> once = points;
  points.insert(points.end(), once.begin(), once.end());
  points.insert(points.end(), {NAN, 0, 0, INFINITY, 1, 1});
  EXPECT_DOUBLE_EQ(*median_neighbor_distance(points), 2.0);
  std::vector<double> piled(3 * 200000, 5.0); // all in one place but one
  piled[0] = 8.0;
  EXPECT_DOUBLE_EQ(*median_neighbor_distance(piled), 3.0);
}

TEST(Neighbors, NothingWithoutTwoPlaces) {
  EXPECT_FALSE(median_neighbor_distance({}));
  EXPECT_FALSE(median_neighbor_distance(std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(median_neighbor_distance(std::vector<double>(300000, 1.0)));
  EXPECT_FALSE(median_neighbor_distance(std::vector<double>{NAN, 2, 3, 1, 2, 3}));
  EXPECT_FALSE(
      median_neighbor_distance(std::vector<double>{1e300, 2, 3, -1e300, 2, 3})); // beyond double when squared
}

} // namespace
} // namespace mote::data
