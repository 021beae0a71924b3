// SPDX-License-Identifier: MIT
// Types other than spheres in the phases beside the opaque one: exact transparency and shadow maps, against the reference.
#include "graph_test.hpp"

#include "core/reference/reference.hpp"

#include <glm/gtc/quaternion.hpp>

#include <random>

namespace mote::test {
namespace {

std::vector<Glyph> overlapping(const std::string& type, std::size_t count) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> out;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 center = 2.5 * glm::dvec3(u(random), u(random), u(random));
    const glm::vec4 q = glm::normalize(glm::vec4(u(random), u(random), u(random), u(random)));
    const glm::vec3 a = glm::vec3(0.6, 0.4, 0.3) + 0.25f * glm::vec3(u(random), u(random), u(random));
    Glyph g{center, glm::length(glm::dvec3(a)) * 1.001, 0.2, {q, glm::vec4(a, 0)}};
    if (type == "superquadric") g.rest.push_back(glm::vec4(1.0 + 0.5 * u(random), 1.0 + 0.5 * u(random), 0, 0));
    if (type == "capsule") g = {center, 1.2, 0.2, {glm::vec4(0.6f * glm::vec3(q), 0.2f + 0.3f * a.z)}};
    if (type == "cylinder" || type == "cone" || type == "arrow") {
      const glm::vec3 h = 0.7f * glm::normalize(glm::vec3(q));
      const float r = 0.2f + 0.3f * a.z;
      g = {center, 1.2, 0.15, {glm::vec4(h, type == "arrow" ? 0.5f * r : r), type == "arrow" ? glm::vec4(r, 0.6f, 0, 0) : glm::vec4(type == "cone" ? 0.1f : 0.8f * r, 0, 0, 0)}};
    }
    if (type == "polyline") { // cut at one end
      const glm::vec3 h = 0.6f * glm::normalize(glm::vec3(q));
      g = {center, 1.2, 0.2, {glm::vec4(h, 0.2f + 0.3f * a.z), glm::vec4(0), glm::vec4(glm::normalize(h + 0.2f * a), 0)}};
    }
    out.push_back(std::move(g));
  }
  return out;
}

const auto type_names = [](const auto& type) { return type.param; };

class GlyphTransparency : public GraphTest, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Types, GlyphTransparency, ::testing::Values("capsule", "cylinder", "cone", "arrow", "ellipsoid", "box", "superquadric", "polyline"), type_names);

TEST_P(GlyphTransparency, ExactOrderEqualsTheReference) {
  Scene scene = glyph_scene(GetParam(), overlapping(GetParam(), 150), {0x80FF6040u, 0xC040FF60u, 0x604060FFu});
  scene.background = {0.2, 0.3, 0.4, 1};
  const View view = look(scene, {1, 2, 10}, {0, 0, 0}, {120, 100});
  const ReferencePicture reference = render_reference(scene, view);
  for (const passes::Expansion expansion : {passes::Expansion::Vertex, passes::Expansion::Geometry}) {
    const Colors colors = draw_graph(scene, view, exact_glyphs, "glyphs.color", {.expansion = expansion});
    std::size_t sure = 0, wrong = 0, layered = 0;
    for (std::size_t i = 0; i < reference.color.size(); ++i) {
      if (reference.layers_ambiguous[i]) continue;
      ++sure;
      const glm::dvec3 c(reference.color[i]);
      layered += glm::length(c - glm::dvec3(scene.background)) > 0.05;
      const glm::dvec3 off = glm::abs(c - glm::dvec3(colors.at(static_cast<std::uint32_t>(i % view.size.width), static_cast<std::uint32_t>(i / view.size.width))));
      wrong += std::max({off.r, off.g, off.b}) > 1.0 / 255.0;
    }
    EXPECT_GT(sure, reference.color.size() * 9 / 10);
    EXPECT_GT(layered, reference.color.size() / 10);
    EXPECT_LE(wrong, GetParam() == "ellipsoid" || GetParam() == "capsule" || GetParam() == "polyline" ? 0u : sure / 1000) << "edges between faces of one particle excepted";
  }
}

class GlyphShadows : public GpuTest, public ::testing::WithParamInterface<std::string> {
protected:
  GlyphShadows() { graph_ = "shadowed"; }
};
INSTANTIATE_TEST_SUITE_P(Types, GlyphShadows, ::testing::Values("capsule", "cylinder", "cone", "arrow", "ellipsoid", "box", "superquadric", "polyline"), type_names);

TEST_P(GlyphShadows, MapsOfCastersEqualShadowRays) {
  Scene scene = glyph_scene(GetParam(), overlapping(GetParam(), 60));
  scene.lights = {{.name = "sun", .kind = LightKind::Directional, .direction = glm::normalize(glm::dvec3(1, -0.6, -0.5)), .intensity = 0.8, .shadows = true}};
  const View view = look(scene, {1, 2, 12}, {0, 0, 0}, {200, 160});
  const ReferencePicture with = render_reference(scene, view);
  ReferenceOptions unshadowed;
  unshadowed.shadows = false;
  const ReferencePicture without = render_reference(scene, view, unshadowed);
  for (const passes::Expansion expansion : {passes::Expansion::Vertex, passes::Expansion::Geometry}) {
    const Picture p = draw(scene, view, {.expansion = expansion});
    std::size_t facing = 0, dark = 0, wrong = 0;
    for (std::size_t i = 0; i < with.id.size(); ++i) {
      if (with.id[i] == reference_no_id || with.ambiguous[i]) continue;
      const double unlit = 0.2 * scene.batches[0].color.g, lit = without.color[i].g;
      if (lit - unlit < 0.02) continue;
      ++facing;
      const bool truth = with.color[i].g < 0.5 * (lit + unlit), drawn = double(p.color[i].g) < 0.5 * (lit + unlit);
      dark += truth;
      wrong += truth != drawn;
    }
    EXPECT_GT(facing, 2000u);
    EXPECT_GT(dark, 100u);
    EXPECT_LE(static_cast<double>(wrong), 5e-3 * static_cast<double>(facing)) << dark << " in shadow";
  }
}

} // namespace
} // namespace mote::test
