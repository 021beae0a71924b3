// SPDX-License-Identifier: MIT
// A particle type from a folder (app/types/torus), drawn by every expansion and in every phase, against its own double-precision
// twin: the same text, compiled with double. And what is said of types that are wrong.
#include "graph_test.hpp"

#include "core/gpu/shader_compiler.hpp"
#include "passes/particles/particle_type.hpp"
#include "passes/particles/user_type.hpp"

#include <gmock/gmock.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <random>

namespace mote::test {
namespace {

using passes::Expansion;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::shared_ptr<UserType> torus() {
  static const std::shared_ptr<UserType> type = [] {
    Diagnostics diagnostics;
    auto read = read_user_type(MOTE_SOURCE_DIR "/app/types/torus", {}, diagnostics);
    EXPECT_TRUE(read && passes::take_type(*read, {}, diagnostics)) << to_string(diagnostics);
    return read;
  }();
  return type;
}

Glyph ring(const glm::dvec3& center, const glm::vec4& q, float major, float minor) {
  return {center, std::hypot(std::hypot(major + minor, major + minor), minor) * 1.000001, double(minor), {q, glm::vec4(major, minor, 0, 0), glm::vec4(0)}};
}
std::vector<Glyph> rings(std::size_t count, double half, unsigned seed = 4) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Glyph> out;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec4 q = glm::normalize(glm::vec4(u(random), u(random), u(random), u(random)));
    out.push_back(ring(half * glm::dvec3(u(random), u(random), u(random)), q, static_cast<float>(0.9 + 0.4 * u(random)), static_cast<float>(0.25 + 0.15 * u(random))));
  }
  return out;
}

// Where one ray meets one particle, in world terms.
struct Met {
  std::uint32_t id{0xFFFFFFFFu};
  double t_in{infinity}, t_out{infinity};
  glm::dvec3 n_in{0}, n_out{0};
};

// Casts rays (view space: origin, direction) at all particles of the scene's batch in double.
std::vector<std::vector<Met>> cast(gpu::Device device, const Scene& scene, const View& view, const std::vector<std::pair<glm::dvec3, glm::dvec3>>& rays) {
  std::vector<passes::TwinRay> given;
  struct Owner {
    std::size_t ray{}, turn{};
    std::uint32_t id{};
    double moved{};
  };
  std::vector<Owner> owners;
  std::vector<glm::dmat3> turns;
  const Batch& batch = scene.batches[0];
  for (std::size_t k = 0; k < batch.instances.size(); ++k)
    for (std::uint64_t record = 0; record < batch.chunks->record_count(); ++record) {
      const std::uint32_t row = batch.chunks->rows[record];
      if (row == no_row) continue;
      const glm::vec4* r = &batch.chunks->records[record * 4];
      const glm::dmat4& m = batch.instances[k].world_from_data;
      const glm::dmat3 linear = view.rotation * glm::dmat3(m) * glm::mat3_cast(glm::normalize(glm::dquat(r[1].w, r[1].x, r[1].y, r[1].z)));
      const glm::dvec3 center = view.rotation * (glm::dvec3(m * glm::dvec4(batch.chunks->center(record), 1.0)) - view.eye);
      const glm::dmat3 own = glm::inverse(linear);
      turns.push_back(glm::transpose(own));
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 o = own * (rays[i].first - center), d = own * rays[i].second;
        const double shift = -glm::dot(o, d) / glm::dot(d, d);
        const glm::dvec3 l = o + shift * d;
        if (glm::length(l) > double(r[2].x) + double(r[2].y)) continue;
        given.push_back({l, d, glm::dvec3(r[2]), glm::dvec2(r[3])});
        owners.push_back({i, turns.size() - 1, static_cast<std::uint32_t>(row + k * batch.row_count), shift});
      }
    }
  const std::vector<passes::TwinHit> hits = passes::cast_in_double(device, *torus(), given);
  std::vector<std::vector<Met>> out(rays.size());
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].met) continue;
    const Owner& owner = owners[k];
    const auto world = [&](const glm::dvec3& n) { return glm::transpose(view.rotation) * glm::normalize(turns[owner.turn] * n); };
    out[owner.ray].push_back({owner.id, hits[k].t_in + owner.moved, hits[k].t_out + owner.moved, world(hits[k].n_in), world(hits[k].n_out)});
  }
  return out;
}

struct Nearest {
  std::uint32_t id{0xFFFFFFFFu};
  double t{infinity};
  glm::dvec3 normal{0};
};
Nearest nearest(const std::vector<Met>& all) {
  Nearest best;
  for (const Met& m : all) {
    const bool inside = !(m.t_in > 0.0);
    const double t = inside ? m.t_out : m.t_in;
    if (t > 0.0 && t < best.t) best = {m.id, t, inside ? -m.n_out : m.n_in};
  }
  return best;
}

std::pair<glm::dvec3, glm::dvec3> ray_at(const View& view, double x, double y) { return {view.ray_origin(x, y), view.ray_direction(x, y)}; }

class UserTypes : public GraphTest {
protected:
  void compare(const Picture& p, const Scene& scene, const View& view, double least_hits, double bar = 1.0) {
    const std::size_t pixels = p.id.size();
    std::vector<std::pair<glm::dvec3, glm::dvec3>> rays;
    const std::array<glm::dvec2, 5> shifts{{{0, 0}, {-1e-3, 0}, {1e-3, 0}, {0, -1e-3}, {0, 1e-3}}};
    for (std::size_t i = 0; i < pixels; ++i)
      for (const glm::dvec2& s : shifts) rays.push_back(ray_at(view, double(i % view.size.width) + s.x, double(i / view.size.width) + s.y));
    const auto met = cast(device(), scene, view, rays);
    std::size_t hits = 0, wrong = 0, unsure = 0, depth_off = 0, normal_off = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const Nearest best = nearest(met[5 * i]);
      bool sure = true;
      for (std::size_t k = 1; k < 5; ++k) sure = sure && nearest(met[5 * i + k]).id == best.id && (best.id == 0xFFFFFFFFu || std::abs(nearest(met[5 * i + k]).t - best.t) < 0.02 * best.t);
      unsure += !sure;
      if (!sure) continue;
      wrong += p.id[i] != best.id;
      if (p.id[i] != best.id || best.id == 0xFFFFFFFFu) continue;
      ++hits;
      depth_off += std::abs(double(p.depth[i]) - best.t) > bar * 2.5e-7 * best.t;
      const glm::dvec3 n(p.normal[i]);
      normal_off += std::atan2(glm::length(glm::cross(n, best.normal)), glm::dot(n, best.normal)) > bar * 1e-4;
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GE(static_cast<double>(hits), least_hits * static_cast<double>(pixels));
    EXPECT_LT(unsure, pixels / 50);
    EXPECT_LE(depth_off, hits / 50);
    EXPECT_LE(normal_off, hits / 50);
  }
};

TEST_F(UserTypes, EveryExpansionEqualsTheTwin) {
  const Scene scene = glyph_scene(torus()->key, rings(12, 2.5));
  for (const View& view : {look(scene, {2, 3, 11}, {0, 0, 0}, {120, 90}, 35), look_orthographic(scene, {0, 0, 11}, {0, 0, 0}, {120, 90}, 7)}) {
    const Picture vertex = draw(scene, view, {.expansion = Expansion::Vertex}), geometry = draw(scene, view, {.expansion = Expansion::Geometry});
    EXPECT_EQ(vertex.id, geometry.id);
    EXPECT_EQ(vertex.depth, geometry.depth);
    compare(vertex, scene, view, 0.2);
    compare(draw(scene, view, {.expansion = Expansion::Compute}), scene, view, 0.2);
    EXPECT_EQ(draw(scene, view, {.expansion = Expansion::Vertex, .show_depth_violation = true}).display, vertex.display) << "a depth beyond its proxy's bound, or NaN";
  }
}

TEST_F(UserTypes, InsideMirroredUnevenFarAndNear) {
  std::vector<Glyph> glyphs = rings(5, 1.5);
  const glm::dmat4 mirror = glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, 1));
  const glm::dmat4 uneven = glm::translate(glm::dmat4(1.0), glm::dvec3(3.5, 0, 0)) * glm::scale(glm::dmat4(1.0), glm::dvec3(-1.3, 1.0, 0.6));
  const Scene scene = placed(glyph_scene(torus()->key, glyphs), {mirror, uneven});
  for (const View& view : {look(scene, {1, 2, 10}, {1, 0, 0}, {120, 90}, 40), look(scene, {0.2, 0.1, 1.2}, {1, 0.2, 0}, {120, 90}, 70)})
    for (const Expansion expansion : {Expansion::Vertex, Expansion::Compute}) compare(draw(scene, view, {.expansion = expansion}), scene, view, 0.1, 3.0);
  for (Glyph& g : glyphs) g.center += glm::dvec3(1e6, -1e6, 1e6);
  const Scene far = glyph_scene(torus()->key, glyphs);
  const View view = look(far, glm::dvec3(1e6, -1e6, 1e6) + glm::dvec3(1, 2, 8), {1e6, -1e6, 1e6}, {120, 90});
  compare(draw(far, view, {.expansion = Expansion::Vertex}), far, view, 0.1);
}

// The eye in the tube, and rays through the hole from the side: entry of the near tube, exit of the far one.
TEST_F(UserTypes, KnownDepths) {
  const Scene scene = glyph_scene(torus()->key, {ring({0, 0, 0}, {0, 0, 0, 1}, 2, 0.5f)});
  const View side = look_orthographic(scene, {0, -10, 0}, {0, 0, 0}, {101, 101}, 5.05);
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry, Expansion::Compute}) {
    const Picture p = draw(scene, side, {.expansion = e});
    EXPECT_NEAR(p.depth[p.at(50, 50)], 7.5f, 2e-6);
    EXPECT_LT(glm::length(glm::dvec3(p.normal[p.at(50, 50)]) - glm::dvec3(0, -1, 0)), 1e-5);
    const View top = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {101, 101}, 5.05);
    const Picture q = draw(scene, top, {.expansion = e});
    EXPECT_EQ(q.id[q.at(50, 50)], 0xFFFFFFFFu) << "the hole";
    EXPECT_NEAR(q.depth[q.at(90, 50)], 9.5f, 2e-6);
    EXPECT_EQ(q.id[q.at(79, 50)], 0xFFFFFFFFu); // 1.45 from the axis
    EXPECT_EQ(q.id[q.at(81, 50)], 0u);
  }
  const Picture in = draw(scene, look(scene, {2, 0, 0}, {2, 1, 0}, {64, 64}, 60), {.expansion = Expansion::Vertex});
  EXPECT_EQ(std::count(in.id.begin(), in.id.end(), 0u), 64 * 64);
}

TEST_F(UserTypes, ExactTransparencyEqualsTheTwin) {
  Scene scene = glyph_scene(torus()->key, rings(10, 1.5), {0x80FF6040u, 0xC040FF60u, 0x604060FFu});
  scene.background = {0.2, 0.3, 0.4, 1};
  scene.lights.clear(); // every surface has its ambient color
  const View view = look(scene, {1, 2, 9}, {0, 0, 0}, {80, 60});
  std::vector<std::pair<glm::dvec3, glm::dvec3>> rays;
  for (std::uint32_t i = 0; i < 80 * 60; ++i) rays.push_back(ray_at(view, i % 80, i / 80));
  const auto met = cast(device(), scene, view, rays);
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry}) {
    const Colors colors = draw_graph(scene, view, exact_glyphs, "glyphs.color", {.expansion = e});
    std::size_t off = 0, layered = 0;
    const Batch& batch = scene.batches[0];
    for (std::size_t i = 0; i < met.size(); ++i) {
      std::vector<std::pair<double, std::uint32_t>> surfaces;
      for (const Met& m : met[i]) surfaces.insert(surfaces.end(), {{m.t_in, m.id}, {m.t_out, m.id}});
      std::sort(surfaces.rbegin(), surfaces.rend());
      glm::dvec3 c(scene.background);
      for (const auto& [t, id] : surfaces) {
        const auto record = static_cast<std::size_t>(std::find(batch.chunks->rows.begin(), batch.chunks->rows.end(), id) - batch.chunks->rows.begin());
        const std::uint32_t rgba = batch.chunks->color_of(record);
        const auto linear = [](std::uint32_t v) { const double s = v / 255.0; return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
        const double a = 1.0 - std::sqrt(1.0 - (rgba >> 24) / 255.0);
        c = (1.0 - a) * c + a * 0.2 * glm::dvec3(linear(rgba & 255u), linear(rgba >> 8 & 255u), linear(rgba >> 16 & 255u));
      }
      layered += surfaces.size() > 2;
      const glm::dvec3 d = glm::abs(c - glm::dvec3(colors.at(static_cast<std::uint32_t>(i % 80), static_cast<std::uint32_t>(i / 80))));
      off += std::max({d.r, d.g, d.b}) > 1.0 / 255.0;
    }
    EXPECT_GT(layered, 300u);
    EXPECT_LE(off, 5u) << "outlines within a rounding";
  }
}

class UserTypeShadows : public GpuTest {
protected:
  UserTypeShadows() { graph_ = "shadowed"; }
};
// A ring over a plate: the light comes straight down, so the shadow is the ring's own picture from above.
TEST_F(UserTypeShadows, ARingsShadowHasAHole) {
  Scene scene = joined(glyph_scene(torus()->key, {ring({0, 0, 2}, {0, 0, 0, 1}, 2, 0.5f)}), glyph_scene("box", {{{0, 0, -1}, 8, 0.5, {{0, 0, 0, 1}, {5, 5, 0.5f, 0}}}}));
  scene.lights = {{.name = "sun", .kind = LightKind::Directional, .direction = {0, 0, -1}, .intensity = 0.8, .shadows = true}};
  const View view = look_orthographic(scene, {6, 0, 20}, {0, 0, 0}, {160, 160}, 9);
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry}) {
    const Picture p = draw(scene, view, {.expansion = e});
    std::size_t dark = 0, wrong = 0;
    for (std::uint32_t i = 0; i < p.id.size(); ++i) {
      if (p.id[i] != 1u) continue;
      const auto [o, d] = ray_at(view, i % 160, i / 160);
      const glm::dvec3 at = glm::transpose(view.rotation) * (o + double(p.depth[i]) * d) + view.eye;
      if (at.z < -0.51) continue; // a side
      const double away = std::abs(glm::length(glm::dvec2(at)) - 2.0);
      if (std::abs(away - 0.5) < 0.03) continue;
      const bool shadowed = double(p.color[i].g) < 0.5 * scene.batches[1].color.g;
      dark += shadowed;
      wrong += shadowed != (away < 0.5);
    }
    EXPECT_GT(dark, 300u);
    EXPECT_LE(wrong, 3u);
  }
}

TEST(UserTypeMatrix, SaysWhatATypeFromFilesCan) {
  (void)torus();
  EXPECT_THAT(passes::support_matrix(), testing::HasSubstr("torus       compute     yes         yes         no          yes"));
}

// A type of the test's own, from text.
std::shared_ptr<UserType> made(const std::string& name, const std::string& glsl) {
  auto type = std::make_shared<UserType>();
  type->name = type->key = name;
  type->folder = "made/" + name;
  type->attributes = {{"size", true, 1.0}, {"turns", false, 1.0}};
  type->glsl = glsl;
  return type;
}
const std::string ball = R"(real3 bound(Shape s) { return real3(s.size); }
real inside(Shape s, real3 p) { return length(p) - s.size; }
real3 surface(Shape s, real3 p) { return p; }
bool hit(Shape s, real3 o, real3 d, out real t_in, out real t_out) {
  real h2 = (s.size * s.size - dot(o, o)) / dot(d, d);
  t_out = sqrt(max(h2, real(0.0)));
  t_in = -t_out;
  return h2 > real(0.0);
}
)";
std::string with(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(UserTypes, MeasuresFindWhatDoesNotFit) {
  const std::vector<glm::vec4> records{{0, 0, 0, 1}, {2, 0, 0, 0}, {1, 0, 0, 0}};
  const auto measured = [&](const std::string& name, const std::string& glsl) {
    const auto type = made(name, glsl);
    Diagnostics diagnostics;
    EXPECT_TRUE(passes::take_type(*type, {}, diagnostics)) << to_string(diagnostics);
    return passes::measure(device(), *type, records).at(0);
  };
  const MeasuredParticle good = measured("good_ball", ball);
  EXPECT_EQ(good.half, glm::vec3(2));
  EXPECT_GT(good.rays, 0u);
  EXPECT_EQ(good.nan + good.disagree + good.outside, 0u);
  const MeasuredParticle nan = measured("nan_ball", with(ball, "max(h2, real(0.0))", "h2 - real(0.5)"));
  EXPECT_GT(nan.nan, 0u);
  EXPECT_GT(measured("small_bound", with(ball, "return real3(s.size)", "return real3(s.size * real(0.5))")).outside, 0u);
  EXPECT_GT(measured("shifted_hit", with(ball, "t_in = -t_out", "t_in = real(-0.8) * t_out")).disagree, 10u);
  const auto whole = passes::measure(device(), *torus(), std::vector<glm::vec4>{{0, 0, 0, 1}, {2, 0.5f, 0, 0}, {}, {0, 0, 0, 1}, {1, 0.01f, 0, 0}, {}});
  EXPECT_EQ(whole[0].half, glm::vec3(2.5, 2.5, 0.5));
  for (const MeasuredParticle& m : whole) EXPECT_EQ(m.nan + m.disagree + m.outside, 0u) << m.nan << " " << m.disagree << " " << m.outside;
}

// What is NaN is left out, and magenta in debug.
TEST_F(UserTypes, NaNIsLeftOutOrMagenta) {
  const auto type = made("nan_disc", with(ball, "max(h2, real(0.0))", "h2 - real(0.5)"));
  Diagnostics diagnostics;
  ASSERT_TRUE(passes::take_type(*type, {}, diagnostics));
  const Scene scene = glyph_scene(type->key, {{{0, 0, 0}, 1.8, 1.0, {{0, 0, 0, 1}, {1, 0, 0, 0}, {1, 0, 0, 0}}}});
  const View view = look_orthographic(scene, {0, 0, 10}, {0, 0, 0}, {61, 61}, 3.05); // 20 pixels a unit; NaN from sqrt(0.5) on
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry, Expansion::Compute}) {
    const Picture p = draw(scene, view, {.expansion = e});
    EXPECT_EQ(p.id[p.at(30, 30)], 0u);
    EXPECT_EQ(p.id[p.at(47, 30)], 0xFFFFFFFFu) << "NaN there";
  }
  for (const Expansion e : {Expansion::Vertex, Expansion::Geometry, Expansion::Compute}) {
    const Picture debug = draw(scene, view, {.expansion = e, .show_depth_violation = true});
    EXPECT_EQ(debug.display[debug.at(47, 30)], glm::u8vec4(255, 0, 255, 255));
    EXPECT_EQ(debug.id[debug.at(47, 30)], 0u);
    EXPECT_FLOAT_EQ(debug.depth[debug.at(47, 30)], 10.0f) << "where the ray is nearest to the center";
    EXPECT_NE(debug.display[debug.at(30, 30)], glm::u8vec4(255, 0, 255, 255));
    EXPECT_EQ(debug.id[debug.at(52, 30)], 0xFFFFFFFFu);
  }
}

TEST_F(UserTypes, BrokenTextsNameTheirLine) {
  const auto said = [](const std::string& name, const std::string& glsl) {
    Diagnostics diagnostics;
    EXPECT_FALSE(passes::take_type(*made(name, glsl), {}, diagnostics));
    return to_string(diagnostics);
  };
  EXPECT_THAT(said("broken_a", with(ball, "return p;", "return q;")), testing::AllOf(testing::HasSubstr("made/broken_a/type.glsl:3"), testing::HasSubstr("P022"), testing::HasSubstr("'q' : undeclared identifier")));
  EXPECT_THAT(said("broken_b", with(ball, "real inside(Shape s, real3 p) { return length(p) - s.size; }", "")), testing::AllOf(testing::HasSubstr("made/broken_b/type.glsl"), testing::HasSubstr("inside")));
}

TEST(UserTypeTexts, AChangedTextIsATypeOfItsOwn) {
  Diagnostics diagnostics;
  const auto first = made("changing", ball), again = made("changing", ball), second = made("changing", ball + "// changed\n");
  for (const auto& type : {first, again, second}) EXPECT_TRUE(passes::take_type(*type, {}, diagnostics));
  EXPECT_EQ(first->key, "changing");
  EXPECT_EQ(again->key, "changing");
  EXPECT_EQ(second->key, "changing#2");
}

} // namespace
} // namespace mote::test
