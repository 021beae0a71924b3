// SPDX-License-Identifier: MIT
// The trees: same answers as brute force, the same tree for any number of threads, hard inputs.
#include "core/reference/bvh.hpp"
#include "core/reference/tracer.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace mote {
namespace {

using namespace mote::test;

void expect_same_as_brute_force(const Scene& scene, const View& view) {
  const ReferencePicture picture = render_reference(scene, view);
  const PlainSpheres<long double> plain(scene, view);
  std::size_t wrong = 0;
  for (std::uint32_t y = 0; y < view.size.height; ++y)
    for (std::uint32_t x = 0; x < view.size.width; ++x) {
      const std::size_t i = std::size_t{y} * view.size.width + x;
      wrong += plain.at(view, x, y).id != picture.id[i] && !picture.ambiguous[i];
    }
  EXPECT_EQ(wrong, 0u);
}

TEST(ReferenceTree, ManySpheresEqualBruteForce) {
  expect_same_as_brute_force(scene_of(random_balls(30000, 50.0, 0.5, 2.0)),
                             look({150, -20, 30}, {0, 0, 0}, {40, 30}, 30));
}

TEST(ReferenceTree, SizesFromTinyToHuge) {
  std::vector<Ball> balls = random_balls(5000, 50.0, 0.5, 1.0);
  for (std::size_t i = 0; i < balls.size(); ++i)
    balls[i].radius *= std::pow(10.0, -3.0 + 4.0 * double(i % 100) / 100.0);
  expect_same_as_brute_force(scene_of(balls), look({100, -20, 30}, {0, 0, 0}, {40, 30}, 30));
}

TEST(ReferenceTree, FlatAndOnALine) {
  std::vector<Ball> balls = random_balls(3000, 50.0, 0.5, 1.0);
  for (Ball& b : balls) b.center.z = 0.0;
  expect_same_as_brute_force(scene_of(balls), look({100, -20, 30}, {0, 0, 0}, {40, 30}, 30));
  for (Ball& b : balls) b.center.y = 0.0;
  expect_same_as_brute_force(scene_of(balls), look({0, -80, 10}, {0, 0, 0}, {40, 30}, 30));
}

// Places halve towards the origin on three axes at once: each split by area peels off a few items only, over
// 200 levels if nothing stopped it.
TEST(ReferenceTree, HalvingPlacesStayShallow) {
  std::vector<reference::BvhItem> items;
  for (std::uint32_t i = 0; i < 720; ++i) {
    Bounds b;
    glm::dvec3 place(0);
    place[static_cast<int>(i % 3)] = std::ldexp(1.0, 120 - static_cast<int>(i / 3));
    b.add(place, 1e-3 * glm::length(place));
    items.push_back(reference::make_item(b, glm::dvec3(0), i));
  }
  const reference::Bvh bvh = reference::build_bvh(items, glm::dvec3(0), {}, 2);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> todo{{0, 1}};
  std::uint32_t deepest = 0;
  while (!todo.empty()) {
    const auto [node, depth] = todo.back();
    todo.pop_back();
    deepest = std::max(deepest, depth);
    for (std::size_t side = 0; side < 2; ++side)
      if (!bvh.nodes[node].count[side] && bvh.nodes[node].box[side][0] <= bvh.nodes[node].box[side][3])
        todo.emplace_back(bvh.nodes[node].first[side], depth + 1);
  }
  EXPECT_GT(deepest, 48u);
  EXPECT_LE(deepest, reference::bvh_max_depth);
}

TEST(ReferenceTree, EveryItemInExactlyOneLeafAndInItsBoxes) {
  const std::vector<Ball> balls = random_balls(20000, 50.0, 0.5, 2.0);
  std::vector<reference::BvhItem> items;
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    Bounds b;
    b.add(balls[i].center, balls[i].radius);
    items.push_back(reference::make_item(b, glm::dvec3(1, 2, 3), i));
  }
  const reference::Bvh bvh = reference::build_bvh(items, glm::dvec3(1, 2, 3), {}, 2);
  std::vector<std::uint32_t> order = bvh.order, all(items.size());
  std::sort(order.begin(), order.end());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(order, all);
  for (const reference::BvhNode& node : bvh.nodes)
    for (std::size_t side = 0; side < 2; ++side)
      for (std::uint32_t i = node.first[side]; i < node.first[side] + node.count[side]; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          const reference::BvhItem& item = items[bvh.order[i]];
          ASSERT_LE(node.box[side][k], item.lo[k]);
          ASSERT_GE(node.box[side][k + 3], item.hi[k]);
          ASSERT_LE(node.count[side], reference::bvh_leaf);
        }
}

TEST(ReferenceTree, BoxesRoundOutward) {
  Bounds b;
  b.add(glm::dvec3(0.1, 1.0 / 3.0, -1e6 - 0.01), 1e-9);
  const reference::BvhItem item = reference::make_item(b, glm::dvec3(0.7), 0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(double(item.lo[std::size_t(k)]), b.min[k] - 0.7);
    EXPECT_GE(double(item.hi[std::size_t(k)]), b.max[k] - 0.7);
  }
}

TEST(ReferenceTree, SameForAnyNumberOfThreads) {
  const Scene scene = scene_of(random_balls(20000, 50.0, 0.5, 2.0));
  const reference::World one = reference::build_world(scene, 1), three = reference::build_world(scene, 3);
  EXPECT_EQ(one.trees[0]->bvh.order, three.trees[0]->bvh.order);
  const View view = look({150, -20, 30}, {0, 0, 0}, {80, 60}, 30);
  ReferenceOptions options;
  options.threads = 1;
  const ReferencePicture a = render_reference(one, view, options);
  options.threads = 3;
  const ReferencePicture b = render_reference(three, view, options);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.ambiguous, b.ambiguous);
}

TEST(ReferenceTree, HundredThousandSpheresInOnePlace) {
  std::vector<Ball> balls(100000, Ball{{0, 0, 0}, 1.0});
  balls[0] = {{3, 0, 0}, 0.5}; // the lowest row of the pile is 1
  Scene scene = scene_of(balls);
  const reference::World world = reference::build_world(scene);
  EXPECT_EQ(world.trees[0]->bvh.order.size(), 2u) << "kept once, not 1e5 times";
  const ReferencePicture picture = render_reference(world, look({0, -5, 0}, {0, 0, 0}, {160, 120}));
  const std::size_t middle = 60 * 160 + 80;
  EXPECT_EQ(picture.id[middle], 1u);
  EXPECT_EQ(picture.ambiguous[middle], 1);
}

TEST(ReferenceTree, ConcentricSpheresShowTheOutermost) {
  std::vector<Ball> balls;
  for (int i = 1; i <= 3000; ++i) balls.push_back({{0, 0, 0}, 1e-3 * i});
  const ReferencePicture picture = render_reference(scene_of(balls), look({0, -8, 0}, {0, 0, 0}, {33, 33}));
  EXPECT_EQ(picture.id[16 * 33 + 16], 2999u);
  EXPECT_EQ(picture.ambiguous[16 * 33 + 16], 0);
  const ReferencePicture inside =
      render_reference(scene_of(balls), look({0, -1.5005, 0}, {0, 10, 0}, {33, 33}));
  EXPECT_EQ(inside.id[16 * 33 + 16], 1499u) << "the nearest in front, of 1500 around the eye";
}

TEST(ReferenceTree, ManyInstancesShareOneTree) {
  std::vector<glm::dmat4> instances;
  for (int i = 0; i < 1000; ++i)
    instances.push_back(
        glm::translate(glm::dmat4(1), glm::dvec3(3 * (i % 10), 3 * (i / 10 % 10), 3 * (i / 100))));
  const Scene scene = scene_of(random_balls(50, 1.0, 0.1, 0.4), instances);
  const reference::World world = reference::build_world(scene);
  EXPECT_EQ(world.trees.size(), 1u);
  EXPECT_EQ(world.placed.size(), 1000u);
  expect_same_as_brute_force(scene, look({-30, -20, 40}, {13, 13, 13}, {40, 30}, 40));
}

} // namespace
} // namespace mote
