// SPDX-License-Identifier: MIT
// The states of `opaque_impostors`: depth_test, depth_write, blend, cull. Every answer is known in closed
// form: flat colors, one pixel.
#include "graph_test.hpp"

#include "passes/states.hpp"

#include <fmt/format.h>

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using ::testing::HasSubstr;

const glm::dvec3 red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

std::string graph_with(const std::string& params, const std::string& draw = "") {
  return fmt::format("schema = 1\noutput = \"opaque.color\"\n[[pass]]\nname = \"opaque\"\nkind = \"opaque_impostors\"\n{}\n{}\n", draw,
                     params.empty() ? "" : "params = { " + params + " }");
}

void expect_color(const glm::vec4& found, const glm::dvec3& wanted) {
  EXPECT_NEAR(found.r, wanted.r, 1e-3);
  EXPECT_NEAR(found.g, wanted.g, 1e-3);
  EXPECT_NEAR(found.b, wanted.b, 1e-3);
}

class States : public GraphTest {
protected:
  static View view(const Scene& scene) { return look(scene, {0, 0, 10}, {0, 0, 0}, {65, 65}); }
  glm::vec4 center(const Scene& scene, const std::string& params) {
    return draw_graph(scene, view(scene), graph_with(params), "opaque.color").center();
  }
  // The nearest is red, the farthest blue.
  static Scene stack(double green_alpha = 1.0) {
    Scene scene = join({flat_sphere({0, 0, 0, 1}, green, green_alpha), flat_sphere({0, 0, -3, 1}, blue, 0.5), flat_sphere({0, 0, 3, 1}, red, 0.5)});
    scene.background = {0, 0, 0, 1};
    return scene;
  }
  static Scene two(bool near_first) {
    const Scene near = flat_sphere({0, 0, 3, 1}, red), far = flat_sphere({0, 0, 0, 1}, green);
    Scene scene = near_first ? join({near, far}) : join({far, near});
    scene.background = {0, 0, 1, 1};
    return scene;
  }
};

// Red of alpha 1/2 before green before blue of alpha 1/2, drawn green, blue, red.
TEST_F(States, TheStackWithDepthTestShowsRedOverGreen) {
  expect_color(center(stack(), "blend = \"over\", depth_test = \"less\""), {0.5, 0.5, 0});
}
TEST_F(States, TheStackWithoutDepthTestShowsTheFilesOrder) {
  expect_color(center(stack(), "blend = \"over\", depth_test = \"always\", depth_write = false"), {0.5, 0.25, 0.25});
}

TEST_F(States, EveryDepthTestMeansDistance) {
  struct Case {
    const char* word;
    glm::dvec3 near_first, far_first;
  };
  // `greater` starts from distance 0, all others from infinitely far: nothing is at an equal distance then.
  const Case cases[] = {{"never", blue, blue},       {"less", red, red},      {"less_equal", red, red}, {"equal", blue, blue},
                        {"greater", green, green},   {"greater_equal", green, green},
                        {"not_equal", green, red},   {"always", green, red}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.word);
    expect_color(center(two(true), fmt::format("depth_test = \"{}\"", c.word)), c.near_first);
    expect_color(center(two(false), fmt::format("depth_test = \"{}\"", c.word)), c.far_first);
  }
}

TEST_F(States, EqualDistancesPassLessEqualOnly) {
  Scene scene = join({flat_sphere({0, 0, 0, 1}, red), flat_sphere({0, 0, 0, 1}, green)});
  expect_color(center(scene, "depth_test = \"less\""), red);
  expect_color(center(scene, "depth_test = \"less_equal\""), green);
}

TEST_F(States, WithoutDepthWriteTheLastOneShows) {
  expect_color(center(two(true), "depth_write = false"), green);
  expect_color(center(two(true), "depth_write = true"), red);
}

TEST_F(States, BlendTakesSourceDestinationAndOperation) {
  const std::string off = ", depth_test = \"always\", depth_write = false";
  expect_color(center(two(true), "blend = { source = \"one\", destination = \"one\" }" + off), {1, 1, 1});
  expect_color(center(two(true), "blend = { source = \"one\", destination = \"one\", operation = \"max\" }" + off), {1, 1, 1});
  expect_color(center(two(true), "blend = { source = \"one\", destination = \"one\", operation = \"min\" }" + off), {0, 0, 0});
  expect_color(center(two(true), "blend = { source = \"one\", destination = \"one\", operation = \"reverse_subtract\" }" + off), {-1, -1, 1});
  expect_color(center(two(true), "blend = { source = \"zero\", destination = \"one_minus_src\" }" + off), {0, 0, 1});
}

// Without blending, what is not opaque is not this pass's: AOVs and depth show opaque surfaces only.
TEST_F(States, TransparentParticlesAreLeftOut) {
  expect_color(center(stack(), ""), green);
  expect_color(center(stack(0.5), ""), {0, 0, 0});
  Scene mixed = scene_of({{0, 0, 3, 1}, {0, 0, 0, 1}}, {0x800000FFu, 0xFF00FF00u}); // the near one has an alpha of its own
  mixed.lights.clear();
  mixed.ambient = glm::dvec3(1);
  for (const passes::Expansion expansion : {passes::Expansion::Vertex, passes::Expansion::Geometry})
    expect_color(draw_graph(mixed, view(mixed), graph_with(""), "opaque.color", {.expansion = expansion}).center(), green);
  expect_color(draw_graph(mixed, view(mixed), graph_with("", "draw = [\"all\"]"), "opaque.color").center(), red);
}

// Front surfaces are entries, back surfaces exits, wherever the eye stands.
TEST_F(States, CullLeavesOutEntriesOrExits) {
  const Scene scene = [] {
    Scene s = join({flat_sphere({0, 0, 0, 2}, green), flat_sphere({0, 0, -1.5, 0.1}, red)}); // the red one inside
    s.background = {0, 0, 1, 1};
    return s;
  }();
  expect_color(center(scene, ""), green);
  expect_color(center(scene, "cull = \"back\""), green);
  expect_color(center(scene, "cull = \"front\""), red); // nearer than the inner wall
  const View inside = look(scene, {0, 0, 1}, {0, 0.3, 0}, {65, 65});
  const auto seen = [&](const std::string& params) { return draw_graph(scene, inside, graph_with(params), "opaque.color").center(); };
  expect_color(seen(""), green);
  expect_color(seen("cull = \"front\""), green);
  expect_color(seen("cull = \"back\""), blue);
}

TEST_F(States, UnknownStatesAreLocatedAndSayWhatExists) {
  const auto expect_error = [](const std::string& params, const std::string& code, const std::vector<std::string>& words) {
    const Diagnostics diagnostics = check_graph(graph_with(params));
    ASSERT_TRUE(diagnostics.has_errors()) << params;
    const std::string text = to_string(diagnostics);
    EXPECT_THAT(text, HasSubstr("test.toml:7:"));
    EXPECT_THAT(text, HasSubstr("error " + code));
    for (const std::string& word : words) EXPECT_THAT(text, HasSubstr(word));
  };
  expect_error("depth_test = \"lesser\"", "G023", {"'lesser'", "less_equal", "not_equal", "Did you mean 'less'?"});
  expect_error("depth_test = 3", "G020", {"depth_test", "a string"});
  expect_error("depth_write = \"yes\"", "G020", {"depth_write", "true or false"});
  expect_error("cull = \"both\"", "G023", {"none, front, back"});
  expect_error("blend = \"multiply\"", "G023", {"none, over"});
  expect_error("blend = { source = \"alpha\" }", "G023", {"blend.source", "one_minus_src_alpha", "src_alpha"});
  expect_error("blend = { operation = \"times\" }", "G023", {"reverse_subtract"});
  expect_error("blend = { destinaton = \"one\" }", "G021", {"destinaton", "destination"});
}

TEST(BlendState, PacksIntoANumberAndBack) {
  using namespace passes;
  EXPECT_FALSE(unpack_blend(0));
  for (const gpu::BlendState& blend : {blend_over(), blend_over_premultiplied(), gpu::BlendState{}}) EXPECT_EQ(unpack_blend(pack(blend)), blend);
  EXPECT_NE(pack(blend_over()), pack(blend_over_premultiplied()));
}

} // namespace
} // namespace mote::test
