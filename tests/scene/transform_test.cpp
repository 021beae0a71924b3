// SPDX-License-Identifier: MIT
#include "core/scene/scene_file.hpp"

#include <gmock/gmock.h>

namespace mote {
namespace {

// The image of a point under the transform list of a scene.
glm::dvec3 moved(const std::string& list, const glm::dvec3& p, Diagnostics* out = nullptr) {
  Diagnostics diagnostics;
  const SceneDesc scene = parse_scene("schema = 1\n[[data]]\nfile = \"a.xyz\"\ntransform = " + list, "s.toml", "", {}, diagnostics);
  for (const Diagnostic& d : diagnostics.list()) {
    if (out) out->add(d);
    else ADD_FAILURE() << to_string(d);
  }
  return glm::dvec3(scene.data.at(0).transform * glm::dvec4(p, 1.0));
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

TEST(Transform, EachStep) {
  expect_near(moved("[{ translate = [1, 2, 3] }]", {1, 1, 1}), {2, 3, 4});
  expect_near(moved("[{ scale = 2 }]", {1, 2, 3}), {2, 4, 6});
  expect_near(moved("[{ scale = [1, 2, 3] }]", {1, 1, 1}), {1, 2, 3});
  expect_near(moved("[{ rotate = { axis = [0, 0, 5], angle = 90 } }]", {1, 0, 0}), {0, 1, 0});
  expect_near(moved("[{ rotate = { axis = [1, 0, 0], angle = 90 } }]", {0, 1, 0}), {0, 0, 1});
  expect_near(moved("[{ rotate = { axis = [0, 0, 1], angle = 180, through = [1, 0, 0] } }]", {3, 0, 0}), {-1, 0, 0});
  expect_near(moved("[{ shear = { xy = 0.5 } }]", {1, 2, 3}), {2, 2, 3});
  expect_near(moved("[{ shear = { zx = 2 } }]", {1, 2, 3}), {1, 2, 5});
  expect_near(moved("[{ reflect = [1, 0, 0] }]", {1, 2, 3}), {-1, 2, 3});
  expect_near(moved("[{ reflect = { normal = [0, 2, 0], through = [0, 1, 0] } }]", {1, 3, 3}), {1, -1, 3});
  expect_near(moved("[{ matrix = [[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 1, 7]] }]", {1, 0, 0}), {5, 7, 7});
  expect_near(moved("[{ matrix = [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }]", {1, 0, 0}), {2, 0, 0});
}

TEST(Transform, StepsApplyInOrder) {
  expect_near(moved("[{ translate = [1, 0, 0] }, { rotate = { axis = [0, 0, 1], angle = 90 } }]", {0, 0, 0}), {0, 1, 0});
  expect_near(moved("[{ rotate = { axis = [0, 0, 1], angle = 90 } }, { translate = [1, 0, 0] }]", {0, 0, 0}), {1, 0, 0});
}

TEST(Transform, ManySmallTurnsComeBack) {
  std::string list = "[";
  for (int i = 0; i < 360; ++i) list += "{ rotate = { axis = [1, 2, 3], angle = 1 } },";
  expect_near(moved(list + "]", {4, 5, 6}), {4, 5, 6});
}

TEST(Transform, MalformedStepsAreReported) {
  auto code = [](const std::string& list) {
    Diagnostics diagnostics;
    moved(list, {0, 0, 0}, &diagnostics);
    return diagnostics.empty() ? std::string() : diagnostics.list()[0].code;
  };
  EXPECT_EQ(code("[{ translate = [1, 2] }]"), "S004");
  EXPECT_EQ(code("[{ translate = [1, 2, 3], scale = 2 }]"), "S012");
  EXPECT_EQ(code("[5]"), "S012");
  EXPECT_EQ(code("{ scale = 2 }"), "S004");
  EXPECT_EQ(code("[{ rotate = 90 }]"), "S004");
  EXPECT_EQ(code("[{ rotate = { axis = [0, 0, 1] } }]"), "S007");
  EXPECT_EQ(code("[{ reflect = [0, 0, 0] }]"), "S012");
  EXPECT_EQ(code("[{ matrix = [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]] }]"), "S012");
  EXPECT_EQ(code("[{ matrix = [[1, 0, 0, 0], [2, 0, 0, 0], [0, 0, 1, 0]] }]"), "S013");
  EXPECT_EQ(code("[{ shear = { xx = 2 } }]"), "S003");
  EXPECT_EQ(code("[{ scale = 1e-30 }]"), ""); // small, not flat
  EXPECT_EQ(code("[{ scale = [1, 1, 1e-5] }]"), "");
  EXPECT_EQ(code("[{ scale = [1, 1, 1e-5] }, { scale = [1, 1, 1e-5] }]"), "S013"); // flat together
  EXPECT_EQ(code("[{ reflect = [1, 2, 3] }]"), "");
}

} // namespace
} // namespace mote
