// SPDX-License-Identifier: MIT
// Chains of segments: by every expansion against the reference, without seams (against the capsules that they are made of), as one body
// where they are transparent; and absorption by density, of every type.
#include "graph_test.hpp"

#include "core/reference/reference.hpp"
#include "core/reference/shapes.hpp"
#include "core/scene/glyphs.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace mote::test {
namespace {

using passes::Expansion;

// Points and the chain of each, through the maker that scenes use.
Glyphs make(const std::vector<glm::dvec3>& points, const std::vector<std::int64_t>& chains, const std::vector<double>& radii) {
  data::Frame frame;
  frame.count = points.size();
  std::vector<double> positions;
  for (const glm::dvec3& p : points) positions.insert(positions.end(), {p.x, p.y, p.z});
  frame.columns.push_back({"position", 3, std::move(positions), ""});
  frame.columns.push_back({"chain", 1, chains, ""});
  DataDesc desc;
  desc.type = "polyline";
  Diagnostics diagnostics;
  Glyphs made = make_polyline({.frame = frame}, desc, radii, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  return made;
}
Glyphs make(const std::vector<glm::dvec3>& points, const std::vector<std::int64_t>& chains, double radius) {
  return make(points, chains, std::vector<double>(points.size(), radius));
}
std::vector<Glyph> drawn(const Glyphs& made) {
  std::vector<Glyph> out;
  for (std::size_t i = 0; i < made.centers.size(); ++i)
    if (made.verdicts[i] == Verdict::Draw) out.push_back({made.centers[i], made.bounds[i], made.finest[i], {made.rest[3 * i], made.rest[3 * i + 1], made.rest[3 * i + 2]}});
  return out;
}

// Random walks of steps longer than thick, with some that turn back on themselves or take steps too short for a cut.
std::vector<Glyph> walks(std::size_t count, double half, double radius, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<glm::dvec3> points;
  std::vector<std::int64_t> chains;
  for (std::size_t c = 0; c < count; ++c) {
    glm::dvec3 p = half * glm::dvec3(u(random), u(random), u(random)), way = glm::normalize(glm::dvec3(u(random), u(random), u(random)));
    for (int i = 0; i < 12; ++i) {
      points.push_back(p);
      chains.push_back(static_cast<std::int64_t>(c));
      way = glm::normalize(way + (i % 5 == 4 ? 2.0 : 0.7) * glm::dvec3(u(random), u(random), u(random)));
      p += way * radius * (i % 7 == 3 ? 0.7 : 3.0);
    }
  }
  return drawn(make(points, chains, radius));
}

class Polyline : public GraphTest {};

TEST_F(Polyline, CloudsEqualTheReference) {
  const Scene scene = glyph_scene("polyline", walks(60, 6, 0.3));
  check(scene, look(scene, {9, 12, 28}, {0, 0, 0}, {240, 160}), {.least_hits = 0.1, .most_ambiguous = 0.03});
  check(scene, look_orthographic(scene, {0, 0, 30}, {0, 0, 0}, {240, 160}, 16), {.least_hits = 0.1, .most_ambiguous = 0.03});
}

TEST_F(Polyline, InsideCutMirroredUnevenFar) {
  const std::vector<Glyph> thick = walks(12, 4, 1.2, 9);
  const Scene inside = glyph_scene("polyline", thick);
  check(inside, look(inside, thick[3].center, thick[3].center + glm::dvec3(1, 0.3, 0.2), {160, 120}, 70), {.least_hits = 0.8, .most_ambiguous = 0.05});
  View view = look(inside, {3, 5, 22}, {0, 0, 0}, {200, 140});
  view.near_cut = 21.0;
  check(inside, view, {.least_hits = 0.05, .most_ambiguous = 0.05});
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1)), uneven = glm::translate(glm::dmat4(1.0), glm::dvec3(7, 0, 0)) * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.4, 1, 0.5));
  const Scene placed_ = placed(glyph_scene("polyline", walks(15, 3, 0.3, 5)), {mirror, uneven});
  check(placed_, look(placed_, {4, 5, 28}, {3, 0, 0}, {200, 140}), {.least_hits = 0.03, .most_ambiguous = 0.03, .normal_factor = 2});
  std::vector<Glyph> far = walks(30, 5, 0.3);
  const glm::dvec3 o(1e6, -1e6, 1e6);
  for (Glyph& g : far) g.center += o;
  const Scene away = glyph_scene("polyline", far);
  check(away, look(away, o + glm::dvec3(5, 8, 22), o, {200, 140}), {.least_hits = 0.05, .most_ambiguous = 0.03});
}

// The cuts take nothing away: the same segments as whole capsules show the same surface at every pixel.
TEST_F(Polyline, ChainsHaveNoSeams) {
  for (const unsigned seed : {3u, 4u}) {
    std::vector<Glyph> chain = walks(25, 5, 0.45, seed), capsules = chain;
    for (Glyph& g : capsules) g.rest.resize(1);
    const Scene a = glyph_scene("polyline", chain), b = glyph_scene("capsule", capsules);
    const View view = look(a, {4, 6, 20}, {0, 0, 0}, {320, 240}, 35);
    for (const Expansion e : {Expansion::Vertex, Expansion::Compute}) {
      const Picture p = draw(a, view, {.expansion = e}), q = draw(b, view, {.expansion = e});
      std::size_t differs = 0, hits = 0;
      for (std::size_t i = 0; i < p.id.size(); ++i) {
        const bool met = q.id[i] != 0xFFFFFFFFu;
        hits += met;
        differs += met != (p.id[i] != 0xFFFFFFFFu) || (met && std::abs(p.depth[i] - q.depth[i]) > 2e-6f * q.depth[i]);
      }
      EXPECT_GT(hits, 8000u);
      EXPECT_EQ(differs, 0u);
    }
  }
}

// A straight chain from the left to the right: whatever lies behind it, each ray passes one entry and one exit.
TEST_F(Polyline, TransparentChainsAreOneBody) {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 7; ++i) points.emplace_back(i - 3.0, 0.3 * (i % 2), 0);
  Scene scene = glyph_scene("polyline", drawn(make(points, std::vector<std::int64_t>(7, 0), 0.4)));
  scene.batches[0].alpha = 0.5;
  scene.batches[0].color = glm::dvec3(1, 0, 0);
  scene.lights.clear();
  scene.ambient = glm::dvec3(1);
  scene.background = {0, 0, 0, 1};
  const std::string graph = R"(schema = 1
output = "glyphs.color"
[[pass]]
name = "glyphs"
kind = "sorted_glyphs"
params = { oit = "exact" }
)";
  const View straight = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {200, 60}, 2.4);
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry}) {
    const Colors colors = draw_graph(scene, straight, graph, "glyphs.color", {.expansion = e});
    for (std::uint32_t x = 25; x < 175; ++x) EXPECT_NEAR(colors.at(x, 26).r, 0.5, 2e-3) << "column " << x;
  }
  const View along = look(scene, {12, 0.4, 0.3}, {0, 0.15, 0}, {60, 60}, 8); // through many segments, entry and exit far apart
  const Colors colors = draw_graph(scene, along, graph, "glyphs.color");
  const ReferencePicture reference = render_reference(scene, along);
  std::size_t off = 0, covered = 0;
  for (std::size_t i = 0; i < reference.color.size(); ++i) {
    covered += reference.color[i].r > 0.4;
    off += !reference.layers_ambiguous[i] && std::abs(reference.color[i].r - double(colors.texels[i].r)) > 1.0 / 255.0;
  }
  EXPECT_GT(covered, 100u);
  EXPECT_EQ(off, 0u);
}

// How many stretches of a ray lie within the union of the segments, as whole capsules, and how long they are together.
struct Within {
  std::size_t parts{};
  double length{};
};
Within within_all(const std::vector<Glyph>& segments, const reference::Ray& ray) {
  std::vector<std::pair<double, double>> stretches;
  for (const Glyph& g : segments) {
    const std::array<glm::vec4, 2> record{glm::vec4(0), g.rest[0]};
    if (const auto s = reference::find_shape("capsule")->intersect({g.center, g.bound, record}, ray)) stretches.emplace_back(s->t_in, s->t_out);
  }
  std::sort(stretches.begin(), stretches.end());
  Within out;
  double end = -1e30;
  for (const auto& [from, to] : stretches) {
    out.parts += from > end;
    out.length += std::max(0.0, to - std::max(from, end)) * glm::length(ray.direction);
    end = std::max(end, to);
  }
  return out;
}

struct Chain {
  std::string name{};
  std::vector<glm::dvec3> points{};
  std::vector<double> radii{}; // of each segment
};
std::vector<Chain> chains_of_every_kind() {
  std::vector<Chain> out;
  Chain unlike{"unlike radii", {}, {0.5, 0.3, 0.45, 0.2, 0.35, 0.5, 0.1, 0.4}};
  for (int i = 0; i < 8; ++i) unlike.points.emplace_back(1.1 * i - 3.8, 0.5 * (i % 2), 0.4 * (i % 3));
  out.push_back(unlike);
  out.push_back({"sharp turns", {{-3, -1.8, 0}, {2.5, -1.2, 0.3}, {-2.5, -0.2, 0}, {2.5, 0.6, -0.2}, {-2.5, 1.4, 0.4}}, std::vector<double>(5, 0.3)});
  out.push_back({"a hairpin", {{-2.5, 0, 0}, {1.5, 0.1, 0}, {-1.8, 0.5, 0.3}}, {0.5, 0.5, 0.5}});
  out.push_back({"back the same way", {{-3, 0, 0}, {2, 0, 0}, {-1, 0, 0}}, {0.4, 0.4, 0.4}});
  out.push_back({"back the same way, thinner", {{-3, 0.1, 0}, {2, 0, 0.5}, {-1, 0.1, 0}}, {0.5, 0.3, 0.3}});
  Chain dense{"short steps", {}, std::vector<double>(40, 0.5)};
  for (int i = 0; i < 40; ++i) dense.points.emplace_back(0.18 * i - 3.5, std::sin(0.14 * i), 0.6 * std::cos(0.1 * i));
  out.push_back(dense);
  Chain tapering{"short steps, tapering", {}, {}};
  for (int i = 0; i < 30; ++i) {
    tapering.points.emplace_back(0.24 * i - 3.5, std::sin(0.2 * i), 0);
    tapering.radii.push_back(0.6 - 0.015 * i);
  }
  out.push_back(tapering);
  return out;
}

// Of pixels beside which rays meet as many stretches: those, those that meet any, and those where `red`, of a red chain of alpha or density 0.5
// on black, is not what the union says.
struct Counts {
  std::size_t sure{}, seen{}, off{};
};
template <class Red> Counts against_union(const std::vector<Glyph>& segments, const View& view, bool absorbs, const Red& red) {
  Counts out;
  const glm::dmat3 back = glm::transpose(view.rotation);
  for (std::uint32_t i = 0; i < view.size.width * view.size.height; ++i) {
    const auto here = [&](double dx, double dy) {
      const double x = i % view.size.width + dx, y = i / view.size.width + dy;
      return within_all(segments, {view.eye + back * view.ray_origin(x, y), back * view.ray_direction(x, y)});
    };
    const Within w = here(0, 0);
    bool alike = true;
    for (const glm::dvec2& d : {glm::dvec2(2e-3, 0), {-2e-3, 0}, {0, 2e-3}, {0, -2e-3}}) alike = alike && here(d.x, d.y).parts == w.parts;
    if (!alike) continue;
    ++out.sure;
    out.seen += w.parts > 0;
    out.off += std::abs(1.0 - (absorbs ? std::exp(-0.5 * w.length) : std::pow(0.5, double(w.parts))) - red(i)) > 1.0 / 255.0;
  }
  return out;
}
Scene red_chain(const std::vector<Glyph>& segments, bool absorbs) {
  Scene scene = glyph_scene("polyline", segments);
  scene.batches[0].color = glm::dvec3(1, 0, 0);
  scene.batches[0].alpha = 0.5;
  scene.batches[0].density = absorbs ? 0.5 : 0.0;
  scene.lights.clear();
  scene.ambient = glm::dvec3(1);
  scene.background = {0, 0, 0, 1};
  return scene;
}

// Transparent chains with joints that no plane parts: as many surfaces, and as much absorbed, as the union of their capsules says.
TEST_F(Polyline, TransparentJointsOfEveryKindAreOneBody) {
  for (const Chain& chain : chains_of_every_kind()) {
    const std::vector<Glyph> segments = drawn(make(chain.points, std::vector<std::int64_t>(chain.points.size(), 0), chain.radii));
    for (const bool absorbs : {false, true}) {
      SCOPED_TRACE(chain.name + (absorbs ? ", absorbing" : ""));
      const Scene scene = red_chain(segments, absorbs);
      for (const View& view : {look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {120, 66}, 5), look(scene, {9, 2, 3}, {0, 0, 0}, {80, 66}, 35), look(scene, {-2, 3, 12}, {0, 0, 0}, {106, 60}, 30)}) {
        const Colors colors = draw_graph(scene, view, exact_glyphs, "glyphs.color", {.expansion = absorbs ? Expansion::Geometry : Expansion::Vertex});
        const Counts counts = against_union(segments, view, absorbs, [&](std::uint32_t i) { return double(colors.texels[i].r); });
        EXPECT_GT(counts.sure, colors.texels.size() * 97 / 100);
        EXPECT_GT(counts.seen, counts.sure / 30);
        EXPECT_EQ(counts.off, 0u);
        const ReferencePicture reference = render_reference(scene, view);
        EXPECT_EQ(against_union(segments, view, absorbs, [&](std::uint32_t i) { return reference.color[i].r; }).off, 0u);
      }
    }
  }
  // Without their neighbors in their records they overlap.
  std::vector<Glyph> segments = drawn(make(chains_of_every_kind()[0].points, std::vector<std::int64_t>(8, 0), chains_of_every_kind()[0].radii));
  for (Glyph& g : segments) g.rest[1] = g.rest[2] = glm::vec4(0);
  const Scene apart = red_chain(segments, false);
  const View view = look_orthographic(apart, {0, 0, 10}, {0, 0, 0}, {180, 100}, 5);
  const Colors colors = draw_graph(apart, view, exact_glyphs, "glyphs.color");
  EXPECT_GT(against_union(segments, view, false, [&](std::uint32_t i) { return double(colors.texels[i].r); }).off, 300u);
}

TEST(PolylineMaker, JoinsRowsOfAChainInTheOrderOfTheFile) {
  const Glyphs made = make({{0, 0, 0}, {9, 0, 0}, {2, 0, 0}, {9, 2, 0}, {4, 0, 0}, {5, 5, 5}, {4.1, 0, 0}}, {1, 2, 1, 2, 1, 3, 1}, 0.25);
  EXPECT_EQ(made.centers[0], glm::dvec3(1, 0, 0)) << "to row 2";
  EXPECT_EQ(made.centers[1], glm::dvec3(9, 1, 0)) << "to row 3";
  EXPECT_EQ(made.verdicts[3], Verdict::Told) << "the end of chain 2";
  EXPECT_EQ(made.verdicts[5], Verdict::Draw) << "a chain of one row is a ball";
  EXPECT_EQ(glm::vec3(made.rest[3 * 5]), glm::vec3(0));
  EXPECT_EQ(made.rest[3 * 0 + 2], glm::vec4(1, 0, 0, 0)) << "cut where it goes on";
  EXPECT_EQ(made.rest[3 * 2 + 1], glm::vec4(1, 0, 0, 0));
  EXPECT_EQ(made.rest[3 * 2 + 2], glm::vec4(glm::vec3(0.5 * (4.1 - 4.0), 0, 0), 0.25f)) << "the next one is shorter than thick: they overlap, and it is known";
  EXPECT_EQ(made.rest[3 * 0 + 1], glm::vec4(0)) << "nothing before";
}

// --- absorption

Scene absorbing(Scene scene, double density) {
  scene.batches[0].density = density;
  scene.batches[0].alpha = 0.5;
  scene.batches[0].color = glm::dvec3(0);
  scene.lights.clear();
  scene.background = {1, 1, 1, 1};
  return scene;
}
std::string glyphs_graph(const std::string& params) {
  return "schema = 1\noutput = \"glyphs.color\"\n[[pass]]\nname = \"opaque\"\nkind = \"opaque_impostors\"\n[[pass]]\nname = \"glyphs\"\nkind = \"sorted_glyphs\"\n"
         "inputs = { color = \"opaque.color\", depth = \"opaque.depth\" }\nparams = { " + params + " }\n";
}

std::string type_name(const ::testing::TestParamInfo<std::string>& type) { return type.param; }
std::string mode_name(const ::testing::TestParamInfo<std::string>& mode) {
  return std::vector<std::string>{"exact", "back_to_front", "front_to_back", "front"}.at(mode.index);
}

class Density : public GraphTest, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Modes, Density, ::testing::Values("oit = \"exact\"", "order = \"back_to_front\"", "order = \"front_to_back\"", "oit = \"exact\", surfaces = \"front\""),
                         mode_name);

// Through the center of a ball lie two radii; half of the solid when an opaque wall stands in its middle; a chain along the view is as long as it is.
TEST_P(Density, KnownLengths) {
  const auto through = [&](const Scene& scene) {
    const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {65, 65}, 4);
    return double(draw_graph(scene, view, glyphs_graph(GetParam()), "glyphs.color").center().r);
  };
  const Scene ball = absorbing(scene_of({{0, 0, 0, 1.5}}), 0.4);
  EXPECT_NEAR(through(ball), std::exp(-0.4 * 3.0), 2e-3);
  Scene scaled = ball;
  scaled.batches[0].instances[0].world_from_data = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
  EXPECT_NEAR(through(scaled), std::exp(-0.4 * 6.0), 2e-3) << "lengths are the world's";
  Scene wall = joined(ball, glyph_scene("box", {{{0, 0, -0.5}, 3, 0.5, {{0, 0, 0, 1}, {1.8f, 1.8f, 0.5f, 0}}}}));
  wall.batches[1].color = glm::dvec3(5.0); // by ambient light of 0.2: 1
  wall.lights.clear();
  EXPECT_NEAR(through(wall), std::exp(-0.4 * 1.5), 2e-3) << "what lies behind the wall does not absorb";
  Scene chain = absorbing(glyph_scene("polyline", drawn(make({{0, 0, -2}, {0, 0, -0.5}, {0, 0, 1}, {0, 0, 2}}, {0, 0, 0, 0}, 0.3))), 0.4);
  if (GetParam().find("front\"") == std::string::npos || GetParam().find("order") == 0) {
    EXPECT_NEAR(through(chain), std::exp(-0.4 * 4.6), 2e-3);
  }
}

class DensityOfTypes : public GraphTest, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Types, DensityOfTypes, ::testing::Values("sphere", "capsule", "cylinder", "cone", "arrow", "ellipsoid", "box", "superquadric", "polyline"),
                         type_name);

TEST_P(DensityOfTypes, EqualsTheReference) {
  const std::string& type = GetParam();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> glyphs;
  for (int i = 0; i < 30 && type != "polyline" && type != "sphere"; ++i) {
    const glm::dvec3 center = 2.0 * glm::dvec3(u(random), u(random), u(random));
    const glm::vec4 q = glm::normalize(glm::vec4(u(random), u(random), u(random), u(random)));
    const glm::vec3 h = 0.8f * glm::normalize(glm::vec3(q));
    if (type == "ellipsoid" || type == "box" || type == "superquadric") glyphs.push_back({center, 1.3, 0.3, {q, glm::vec4(0.8, 0.5, 0.4, 0)}});
    else glyphs.push_back({center, 1.4, 0.2, {glm::vec4(h, 0.4f)}});
    if (type == "superquadric") glyphs.back().rest.push_back({0.8f, 1.3f, 0, 0});
    if (type == "cylinder") glyphs.back().rest.push_back({0.4f, 0, 0, 0});
    if (type == "cone") glyphs.back().rest.push_back({0.1f, 0, 0, 0});
    if (type == "arrow") glyphs.back().rest.push_back({0.6f, 0.7f, 0, 0});
  }
  if (type == "polyline") glyphs = walks(6, 1.5, 0.3, 2);
  Scene scene = type == "sphere" ? scene_of(cloud(30, 2, 0.3, 0.8)) : glyph_scene(type, glyphs);
  scene.batches[0].density = 0.7;
  scene.batches[0].alpha = 0.5;
  scene.batches[0].color = {0.8, 0.4, 0.2};
  scene.background = {0.3, 0.5, 0.9, 1};
  const View view = look(scene, {1, 2, 10}, {0, 0, 0}, {100, 80});
  const ReferencePicture reference = render_reference(scene, view);
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry}) {
    const Colors colors = draw_graph(scene, view, glyphs_graph("oit = \"exact\""), "glyphs.color", {.expansion = e});
    std::size_t sure = 0, wrong = 0, seen = 0;
    for (std::size_t i = 0; i < reference.color.size(); ++i) {
      if (reference.layers_ambiguous[i]) continue;
      ++sure;
      seen += glm::length(glm::dvec3(reference.color[i]) - glm::dvec3(scene.background)) > 0.05;
      const glm::dvec3 off = glm::abs(glm::dvec3(reference.color[i]) - glm::dvec3(colors.texels[i]));
      wrong += std::max({off.r, off.g, off.b}) > 1.0 / 255.0;
    }
    EXPECT_GT(sure, reference.color.size() * 8 / 10);
    EXPECT_GT(seen, reference.color.size() / 10);
    EXPECT_LE(wrong, sure / 500) << "edges between faces of one particle excepted";
  }
}

} // namespace
} // namespace mote::test
