// SPDX-License-Identifier: MIT
#include "core/color/srgb.hpp"
#include "core/scene/scene_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace mote {
namespace {

using testing::HasSubstr;

// Every key of schema 1.
constexpr std::string_view full = R"(schema = 1
graph  = "default"
background = "#ff8000"
tolerance = "0.25px"
[camera]
projection = "perspective"
eye = [0.0, 0.0, 250.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y = 25.0
near = 1.0
far = 1000.0
[ambient]
color = "#ffffff"
intensity = 0.3
[[light]]
name = "sun"
kind = "directional"
direction = [0, 0, -2]
color = "#ff0000"
intensity = 0.8
shadows = true
[[light]]
kind = "spot"
position = [1, 2, 3]
direction = [0, 0, -1]
attenuation = [1, 0.5, 0.25]
inner_angle = 10
outer_angle = 20
[[data]]
file = "spheres.npy"
type = "sphere"
radius = { attribute = "mass", map = "linear", range = [0, 1], to = [0.2, 0.6] }
color = { attribute = "speed", map = "viridis", range = "auto" }
alpha = 0.5
material = { model = "blinn_phong", ambient = 0.9, diffuse = 0.8, specular = 0.7, exponent = 60.0 }
transform = [ { translate = [1, 0, 0] }, { scale = 2 } ]
assembly = "none"
)";

SceneDesc parse(std::string_view text, Diagnostics& diagnostics, std::vector<std::string> overrides = {}) {
  return parse_scene(text, "s.toml", "folder", overrides, diagnostics);
}

SceneDesc parse_good(std::string_view text, std::vector<std::string> overrides = {}) {
  Diagnostics diagnostics;
  SceneDesc scene = parse(text, diagnostics, std::move(overrides));
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  return scene;
}

std::string replaced(std::string_view from, std::string_view to) {
  std::string text(full);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SceneFile, EveryKeyIsRead) {
  const SceneDesc s = parse_good(full);
  EXPECT_EQ(s.graph->value, "default");
  EXPECT_NEAR(s.background.g, srgb_decode(128.0 / 255.0), 1e-12);
  EXPECT_EQ(s.background.a, 1.0);
  EXPECT_EQ(s.tolerance->value, 0.25);
  EXPECT_EQ(*s.camera.eye, glm::dvec3(0, 0, 250));
  EXPECT_EQ(*s.camera.fov_y, 25.0);
  EXPECT_EQ(*s.camera.near, 1.0);
  EXPECT_EQ(*s.camera.far, 1000.0);
  EXPECT_EQ(s.ambient, glm::dvec3(0.3));
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_EQ(s.lights[0].direction, glm::dvec3(0, 0, -1));
  EXPECT_EQ(s.lights[0].color, glm::dvec3(1, 0, 0));
  EXPECT_TRUE(s.lights[0].shadows);
  EXPECT_EQ(s.lights[1].name, "light 1");
  EXPECT_EQ(s.lights[1].attenuation, glm::dvec3(1, 0.5, 0.25));
  EXPECT_NEAR(s.lights[1].outer_angle, glm::radians(20.0), 1e-15);
  const DataDesc& d = s.data.at(0);
  EXPECT_EQ(d.file.value, "folder/spheres.npy");
  EXPECT_EQ(d.radius.rule, RadiusRule::Mapped);
  EXPECT_EQ(d.radius.mapping.to.second, 0.6);
  EXPECT_EQ(d.color.mapping.attribute.value, "speed");
  EXPECT_EQ(d.color.mapping.attribute.loc.line, 34u);
  EXPECT_FALSE(d.color.mapping.range);
  EXPECT_EQ(d.alpha, 0.5);
  EXPECT_EQ(d.material, (Material{ShadingModel::BlinnPhong, 0.9, 0.8, 0.7, 60.0}));
  EXPECT_EQ(d.transform[3][0], 2.0); // first moved, then scaled
}

TEST(SceneFile, DefaultsAreAHeadlightOnWhite) {
  const SceneDesc s = parse_good("schema = 1\n[[data]]\nfile = \"a.xyz\"\n");
  EXPECT_EQ(s.background, glm::dvec4(1));
  EXPECT_EQ(s.ambient, glm::dvec3(0.2));
  ASSERT_EQ(s.lights.size(), 1u);
  EXPECT_EQ(s.lights[0].kind, LightKind::Headlight);
  EXPECT_EQ(s.lights[0].intensity, 0.8);
  EXPECT_EQ(parse_good("schema = 1\n[[data]]\nfile = \"a.xyz\"\n", {"light.headlight.intensity=0.5"}).lights.at(0).intensity, 0.5);
  EXPECT_TRUE(parse_good("schema = 1\nlight = []\n[[data]]\nfile = \"a.xyz\"\n").lights.empty());
  EXPECT_EQ(s.data[0].color.rule, ColorRule::Auto);
  EXPECT_EQ(s.data[0].radius.rule, RadiusRule::Auto);
}

TEST(SceneFile, ColorsAreEncodedUnlessSaidOtherwise) {
  const std::string data = "[[data]]\nfile = \"a.xyz\"\n";
  EXPECT_NEAR(parse_good("schema = 1\nbackground = [0.5, 0.5, 0.5]\n" + data).background.r, srgb_decode(0.5), 1e-12);
  EXPECT_EQ(parse_good("schema = 1\ncolor_space = \"linear\"\nbackground = [0.5, 0.5, 0.5]\n" + data).background.r, 0.5);
  EXPECT_NEAR(parse_good("schema = 1\nbackground = \"#00000080\"\n" + data).background.a, 128.0 / 255, 1e-12);
}

TEST(SceneFile, OverridesMeetTheSameChecks) {
  const SceneDesc s = parse_good(full, {"camera.fov_y=40", "light.sun.intensity=2", "data[0].radius=0.3", "background=#000"});
  EXPECT_EQ(*s.camera.fov_y, 40.0);
  EXPECT_EQ(s.lights[0].intensity, 2.0);
  EXPECT_EQ(s.data[0].radius.constant, 0.3);
  EXPECT_EQ(s.background, glm::dvec4(0, 0, 0, 1));
  Diagnostics diagnostics;
  parse(full, diagnostics, {"camera.fov_y=400"});
  ASSERT_EQ(diagnostics.list().size(), 1u);
  EXPECT_THAT(to_string(diagnostics), HasSubstr("--set: error S005: camera.fov_y is '400'"));
}

TEST(SceneFile, AllProblemsAreReportedAtOnce) {
  Diagnostics diagnostics;
  parse("schema = 1\nbackgroundd = 1\ntolerance = 3\n[camera]\nfov_y = -1\n[[data]]\n", diagnostics);
  EXPECT_TRUE(diagnostics.has("S003"));
  EXPECT_TRUE(diagnostics.has("S004"));
  EXPECT_TRUE(diagnostics.has("S005"));
  EXPECT_TRUE(diagnostics.has("S007"));
}

struct Broken {
  std::string_view from, to, code, words;
};
class BrokenScene : public testing::TestWithParam<Broken> {};

TEST_P(BrokenScene, IsRefusedWithCodeAndWords) {
  const Broken& b = GetParam();
  Diagnostics diagnostics;
  std::string printed;
  try {
    parse(replaced(b.from, b.to), diagnostics);
    printed = to_string(diagnostics);
    EXPECT_EQ(diagnostics.list().size(), 1u) << printed;
  } catch (const Failure& failure) {
    printed = failure.what();
    EXPECT_EQ(failure.exit(), Exit::BadInput);
  }
  EXPECT_THAT(printed, HasSubstr(fmt::format("error {}: ", b.code)));
  EXPECT_THAT(printed, HasSubstr(std::string(b.words)));
  EXPECT_THAT(printed, HasSubstr("s.toml"));
}

INSTANTIATE_TEST_SUITE_P(
    Case, BrokenScene,
    testing::Values(
        Broken{"schema = 1", "schema = 2", "S008", "schema 2; this version reads schema 1"},
        Broken{"schema = 1", "", "S008", "Write schema = 1"}, Broken{"[[data]]", "[[pass]]", "S009", "render graph"},
        Broken{"graph  = \"default\"", "grap = \"default\"", "S003", "Did you mean 'graph'?"},
        Broken{"near = 1.0", "nearr = 1.0", "S003", "Did you mean 'near'?"},
        Broken{"alpha = 0.5", "alpha = 1.5", "S005", "data[0].alpha is '1.5'; it must be from 0 to 1"},
        Broken{"alpha = 0.5", "alpha = true", "S004", "data[0].alpha takes a number, not a truth value ('true')"},
        Broken{"alpha = 0.5", "alpha = nan", "S005", "'nan'"}, Broken{"#ff8000", "#ff80", "C008", "#ff80"},
        Broken{"background = \"#ff8000\"", "background = 5", "S004", "takes a color"},
        Broken{"\"0.25px\"", "\"0.25\"", "S005", "number of pixels above 0 like \"0.25px\""},
        Broken{"\"0.25px\"", "\"-1px\"", "S005", "'-1px'"},
        Broken{"\"perspective\"", "\"fisheye\"", "S006", "camera.projection takes: perspective, orthographic"},
        Broken{"fov_y = 25.0", "height = 25.0", "S015", "camera.height belongs to orthographic cameras"},
        Broken{"fov_y = 25.0", "fov_y = 180", "S005", "between 0 and 180"},
        Broken{"eye = [0.0, 0.0, 250.0]", "eye = [0.0, 0.0, 0.0]", "S011", "eye and target are the same point"},
        Broken{"up = [0.0, 1.0, 0.0]", "up = [0.0, 0.0, 1.0]", "S011", "up lies along the view"},
        Broken{"near = 1.0", "near = 2000.0", "S011", "near (2000) must be less than far (1000)"},
        Broken{"near = 1.0", "near = 0.0", "S005", "camera.near is '0'; it must be above 0"},
        Broken{"target = [0.0, 0.0, 0.0]", "target = [0.0, 0.0]", "S004", "array of 3 numbers, not an array of 2"},
        Broken{"kind = \"directional\"", "kind = \"sunny\"", "S006", "takes: directional, point, spot, headlight"},
        Broken{"kind = \"directional\"", "kind = \"headlight\"", "S015", "light[0].direction belongs to directional and spot"},
        Broken{"direction = [0, 0, -2]", "direction = [0, 0, 0]", "S010", "light[0].direction is zero"},
        Broken{"direction = [0, 0, -2]", "", "S007", "light[0].direction is missing"},
        Broken{"inner_angle = 10", "inner_angle = 30", "S010", "above the outer angle (20)"},
        Broken{"attenuation = [1, 0.5, 0.25]", "attenuation = [0, 0, 0]", "S010", "needs one number above 0"},
        Broken{"kind = \"spot\"", "name = \"sun\"\nkind = \"spot\"", "S025", "two lights named 'sun'"},
        Broken{"shadows = true", "shadows = 1", "S004", "takes true or false"},
        Broken{"intensity = 0.8", "intensity = -0.8", "S005", "at least 0"},
        Broken{"file = \"spheres.npy\"", "", "S007", "data[0].file is missing"},
        Broken{"type = \"sphere\"", "type = \"cube\"", "S006", "data[0].type takes: sphere"},
        Broken{"map = \"linear\"", "map = \"cubic\"", "S006", "data[0].radius.map takes: linear, log"},
        Broken{", to = [0.2, 0.6]", "", "S007", "data[0].radius.to is missing"},
        Broken{"to = [0.2, 0.6]", "to = [-0.2, 0.6]", "S005", "data[0].radius.to[0] is '-0.2'"},
        Broken{"range = [0, 1]", "range = [1, 1]", "S005", "its ends must differ"},
        Broken{"\"viridis\"", "\"virids\"", "S006", "Did you mean 'viridis'?"},
        Broken{"range = \"auto\"", "range = \"wide\"", "S004", "\"auto\" or [low, high]"},
        Broken{"model = \"blinn_phong\"", "model = \"toon\"", "S006", "lambert, phong, blinn_phong"},
        Broken{"assembly = \"none\"", "assembly = 1", "S004", "data[0].assembly takes a text"},
        Broken{"{ scale = 2 }", "{ scale = [1, 2, 1e-7] }", "S013", "thinner than a millionth"},
        Broken{"{ scale = 2 }", "{ scale = 0 }", "S013", "flattens space"},
        Broken{"{ scale = 2 }", "{ scal = 2 }", "S012", "Did you mean 'scale'?"},
        Broken{"{ scale = 2 }", "{ rotate = { axis = [0, 0, 0], angle = 3 } }", "S012", "axis of a rotation is zero"},
        Broken{"[[light]]\nname", "[light]\nname", "S002", ""}));

TEST(SceneFile, WordsOnTheCommandLine) {
  Diagnostics diagnostics;
  const std::vector<std::string> generated{"spheres:1000:inside"};
  const SceneDesc s = describe(generated, {}, diagnostics);
  EXPECT_TRUE(s.data.at(0).generated);
  EXPECT_EQ(*s.camera.near, 1.0);
  const std::vector<std::string> files{"a.xyz", "b.npy"};
  EXPECT_EQ(describe(files, {}, diagnostics).data.size(), 2u);
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  const std::vector<std::string> mixed{"a.xyz", "s.toml"};
  EXPECT_THROW(describe(mixed, {}, diagnostics), Failure);
  const std::vector<std::string> missing{"no_such.toml"};
  EXPECT_THROW(describe(missing, {}, diagnostics), Failure);
}

} // namespace
} // namespace mote
