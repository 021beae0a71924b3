// SPDX-License-Identifier: MIT
// Cylinders and cones by the faces of their boxes: the same picture as by rectangles, bit for bit, from everywhere.
#include "harness.hpp"

#include "core/color/color_config.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace mote::test {
namespace {

using passes::Expansion;

Scene sticks(const std::string& type, std::size_t count, double half, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> out;
  for (std::size_t i = 0; i < count; ++i) {
    const float r = static_cast<float>(0.05 + 0.2 * std::abs(u(random)));
    const glm::vec3 h = i % 9 == 0 ? glm::vec3(0, 0, 1) : glm::vec3(1.5 * u(random), 1.5 * u(random), 1.5 * u(random));
    const float end = type == "cone" ? 0.3f * r : i % 3 == 0 ? 0.5f * r : r;
    out.push_back({half * glm::dvec3(u(random), u(random), u(random)), (glm::length(h) + r) * 1.00001, double{end}, {glm::vec4(h, r), glm::vec4(end, type == "cylinder" && i % 4 == 0 ? 1 : 0, 0, 0)}});
  }
  return glyph_scene(type, out);
}

class Boxes : public GpuTest, public ::testing::WithParamInterface<std::string> {
protected:
  void expect_same(const Scene& scene, const View& view) {
    const Picture tight = draw(scene, view, {.expansion = Expansion::Geometry});
    const Picture box = draw(scene, view, {.expansion = Expansion::Vertex, .show_depth_violation = true}, {"opaque.proxy=box"});
    EXPECT_GT(std::count_if(tight.id.begin(), tight.id.end(), [](std::uint32_t id) { return id != 0xFFFFFFFFu; }), 500);
    std::size_t other = 0, first = 0;
    for (std::size_t i = 0; i < tight.id.size(); ++i) {
      const bool same = tight.id[i] == box.id[i] && tight.depth[i] == box.depth[i] && tight.normal[i] == box.normal[i] && tight.display[i] == box.display[i];
      if (!same && other++ == 0) first = i;
    }
    EXPECT_EQ(other, 0u) << "first at " << first % view.size.width << "," << first / view.size.width << ": id " << tight.id[first] << " by a rectangle, " << box.id[first]
                         << " by a box (or a depth beyond the box's bound)";
  }
};
INSTANTIATE_TEST_SUITE_P(Types, Boxes, ::testing::Values("cylinder", "cone"), [](const auto& type) { return type.param; });

TEST_P(Boxes, ShowWhatRectanglesShow) {
  const Scene scene = sticks(GetParam(), 600, 5);
  expect_same(scene, look(scene, {6, 9, 22}, {0, 0, 0}, {240, 160}));
  expect_same(scene, look(scene, {0, 0, 9}, {0, 0, 0}, {240, 160}, 90));
  expect_same(scene, look_orthographic(scene, {6, 9, 22}, {0, 0, 0}, {240, 160}, 13));
  expect_same(scene, look_orthographic(scene, {0, 0, 22}, {0, 0, 0}, {240, 160}, 13));
  expect_same(scene, look(scene, {0, 0, 0}, {1, 0.2, 0.1}, {240, 160}, 70)); // some hold the eye or are cut
  View cut = look(scene, {6, 9, 22}, {0, 0, 0}, {240, 160});
  cut.near_cut = 23.0;
  expect_same(scene, cut);
}

TEST_P(Boxes, MirroredAndUneven) {
  const glm::dmat4 uneven = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3))) * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.4, 1, 0.5));
  const Scene scene = placed(sticks(GetParam(), 150, 3), {glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1)), glm::translate(glm::dmat4(1.0), glm::dvec3(7, 0, 0)) * uneven});
  expect_same(scene, look(scene, {4, 5, 28}, {3, 0, 0}, {240, 160}));
  expect_same(scene, look_orthographic(scene, {4, 5, 28}, {3, 0, 0}, {240, 160}, 13));
}

} // namespace
} // namespace mote::test
