// SPDX-License-Identifier: MIT
// Particles other than spheres in whole scenes: bounds, trees, affine instances, shadow rays, exact transparency.
#include "core/reference/shade.hpp"
#include "core/reference/tracer.hpp"
#include "quad_shapes.hpp"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace mote {
namespace {

using namespace mote::test;

struct Glyph {
  glm::dvec3 center{0};
  Record record{}; // [0].xyz is set from the center
};

std::shared_ptr<ChunkSet> chunks_of_glyphs(const std::vector<Glyph>& glyphs) {
  auto set = std::make_shared<ChunkSet>();
  set->vec4s_per_record = 4;
  const std::size_t chunks = (glyphs.size() + chunk_capacity - 1) / chunk_capacity;
  set->records.assign(chunks * chunk_capacity * 4, glm::vec4(0));
  set->rows.assign(chunks * chunk_capacity, no_row);
  for (std::size_t i = 0; i < glyphs.size(); ++i) {
    if (i % chunk_capacity == 0) set->chunks.push_back({glyphs[i].center});
    Chunk& chunk = set->chunks.back();
    ++chunk.count;
    for (std::size_t k = 0; k < 4; ++k) set->records[i * 4 + k] = glyphs[i].record[k];
    set->records[i * 4] = glm::vec4(glm::vec3(glyphs[i].center - chunk.origin), glyphs[i].record[0].w);
    set->rows[i] = static_cast<std::uint32_t>(i);
  }
  return set;
}

Scene scene_of_glyphs(std::string type, const std::vector<Glyph>& glyphs, const std::vector<glm::dmat4>& instances = {glm::dmat4(1)}) {
  Scene scene;
  Batch batch;
  batch.name = batch.type = std::move(type);
  batch.chunks = chunks_of_glyphs(glyphs);
  batch.row_count = glyphs.size();
  for (const glm::dmat4& m : instances) batch.instances.push_back({m});
  scene.batches.push_back(batch);
  scene.lights.push_back({});
  return scene;
}

const std::vector<std::string>& types() {
  static const std::vector<std::string> all{"capsule", "cylinder", "cone", "arrow", "ellipsoid", "box", "superquadric"};
  return all;
}

Record random_record(const std::string& type, std::mt19937_64& random) {
  std::uniform_real_distribution<float> unit(-1, 1), size(0.1f, 0.6f), exponent(0.2f, 2.0f);
  Record r{};
  const glm::vec3 h = 0.7f * glm::vec3(unit(random), unit(random), unit(random));
  if (type == "ellipsoid" || type == "box" || type == "superquadric") {
    r[1] = glm::normalize(glm::vec4(h, unit(random)));
    r[2] = glm::vec4(size(random), size(random), size(random), 0);
    r[3] = glm::vec4(exponent(random), exponent(random), 0, 0);
    r[0].w = 1.001f * glm::length(glm::vec3(r[2]));
  } else {
    r[1] = glm::vec4(h, 0.5f * size(random));
    r[2] = type == "arrow" ? glm::vec4(2.0f * r[1].w, glm::length(h) * 0.6f, 0, 0) : glm::vec4(0.5f * size(random), 0, 0, 0);
    r[0].w = 1.001f * (glm::length(h) + std::max(r[1].w, type == "capsule" ? 0.0f : r[2].x));
  }
  return r;
}

std::vector<Glyph> random_glyphs(const std::string& type, std::size_t n, double half) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-half, half);
  std::vector<Glyph> glyphs(n);
  for (Glyph& g : glyphs) g = {{place(random), place(random), place(random)}, random_record(type, random)};
  return glyphs;
}

// The nearest visible surface by brute force in quadruple precision. A superquadric's from the twin itself.
Plain plain_at(const Scene& scene, const View& view, double x, double y) {
  const Batch& batch = scene.batches[0];
  const reference::Shape& shape = *reference::find_shape(batch.type);
  const glm::dmat3 to_world = glm::transpose(view.rotation);
  Plain best;
  for (std::size_t k = 0; k < batch.instances.size(); ++k) {
    const glm::dmat4& m = batch.instances[k].world_from_data;
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(m));
    const glm::dvec3 eye = inverse * (view.eye + to_world * view.ray_origin(x, y) - glm::dvec3(m[3]));
    const glm::dvec3 d = inverse * (to_world * view.ray_direction(x, y));
    for (std::size_t i = 0; i < batch.row_count; ++i) {
      const reference::Particle p = reference::particle(*batch.chunks, i);
      Record r{};
      std::copy(p.record.begin(), p.record.end(), r.begin());
      double t_in = 0.0, t_out = -1.0;
      if (batch.type == "superquadric") {
        if (const auto found = shape.intersect(p, {eye, d})) t_in = found->t_in, t_out = found->t_out;
      } else if (const QuadHits hits = quad_hits(batch.type, r, q3(eye) - q3(p.center), q3(d), 0.0); hits.hit) {
        t_in = static_cast<double>(hits.t_in), t_out = static_cast<double>(hits.t_out);
      }
      const double t = t_in > 0.0 ? t_in : t_out;
      if (t_in > t_out || !(t > 0.0) || t >= best.t) continue;
      best.t = t;
      best.id = static_cast<std::uint32_t>(k * batch.row_count + i);
    }
  }
  return best;
}

std::size_t expect_same(const Scene& scene, const View& view) {
  const ReferencePicture picture = render_reference(scene, view);
  std::size_t hit = 0, wrong = 0;
  for (std::uint32_t y = 0; y < view.size.height; ++y)
    for (std::uint32_t x = 0; x < view.size.width; ++x) {
      const std::size_t i = std::size_t{y} * view.size.width + x;
      const Plain p = plain_at(scene, view, x + view.sample_offset.x - 0.5, y + view.sample_offset.y - 0.5);
      hit += p.id != reference_no_id;
      const bool same = picture.id[i] == p.id && (p.id == reference_no_id || std::abs(picture.depth[i] - p.t) <= 1e-11 * p.t);
      wrong += !same && !picture.ambiguous[i];
    }
  EXPECT_EQ(wrong, 0u) << scene.batches[0].type;
  return hit;
}

constexpr Size2d small{32, 24};

glm::dmat4 skewed() {
  glm::dmat4 m(1);
  m[0] = {1.5, 0.2, -0.3, 0};
  m[1] = {0.1, -0.6, 0.2, 0};
  m[2] = {0.0, 0.4, 1.1, 0};
  m[3] = {2.0, 1.0, -1.0, 1};
  return m;
}

TEST(ReferenceGlyphs, PicturesEqualBruteForceInAffineInstances) {
  for (const std::string& type : types()) {
    const Scene scene = scene_of_glyphs(type, random_glyphs(type, 40, 1.5), {glm::dmat4(1), skewed()});
    EXPECT_GT(expect_same(scene, look({9, -7, 5}, {0.5, 0.5, 0}, small, 30.0)), 200u) << type;
    EXPECT_GT(expect_same(scene, look({0.2, 0.1, 0}, {3, 1, 1}, small, 80.0)), 200u) << type;
    EXPECT_GT(expect_same(scene, look_parallel({9, -7, 5}, {0, 0, 0}, small, 5.0)), 200u) << type;
  }
}

TEST(ReferenceGlyphs, BoundsHoldTheSolidTightly) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const std::string& type : types())
    for (int i = 0; i < 8; ++i) {
      const Record r = random_record(type, random);
      const reference::Particle p{glm::dvec3(10, -20, 30), double(r[0].w), r};
      const reference::Shape& shape = *reference::find_shape(type);
      const Bounds box = shape.bounds(p);
      Bounds seen;
      for (int k = 0; k < 20000; ++k) {
        const glm::dvec3 d = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        const glm::dvec3 o = p.center + p.radius * glm::dvec3(unit(random), unit(random), unit(random));
        const auto hit = shape.intersect(p, {o, d});
        if (!hit) continue;
        seen.add(o + hit->t_in * d);
        seen.add(o + hit->t_out * d);
      }
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(seen.min[k], box.min[k] - 1e-12) << type;
        EXPECT_LE(seen.max[k], box.max[k] + 1e-12) << type;
        EXPECT_GT(seen.max[k] - seen.min[k], 0.85 * (box.max[k] - box.min[k])) << type << " axis " << k;
      }
    }
}

TEST(ReferenceGlyphs, ShadowRaysMeetEveryType) {
  for (const std::string& type : types()) {
    Record r{};
    r[0].w = 3.0f;
    const bool turned = type == "ellipsoid" || type == "box" || type == "superquadric";
    r[1] = turned ? glm::vec4(0, 0, 0, 1) : glm::vec4(0, 0, 1, 0.5);
    r[2] = turned ? glm::vec4(0.5, 0.5, 1, 0) : glm::vec4(0.5, 0, 0, 0);
    if (type == "arrow") r[2] = glm::vec4(0.8, 0.5, 0, 0);
    r[3] = glm::vec4(0.5, 1.5, 0, 0);
    const Scene scene = scene_of_glyphs(type, {{{0, 0, 5}, r}});
    const reference::World world = reference::build_world(scene);
    const reference::Tracer tracer(world, look({0, -8, 0}, {0, 0, 0}, small));
    const auto blocked = [&](const glm::dvec3& from, double reach, std::uint64_t skip) {
      return tracer.occluded({from - glm::dvec3(0, -8, 0), {0, 0, 1}}, reach, skip);
    };
    EXPECT_TRUE(blocked({0.1, 0.1, 0}, 100.0, reference::no_id)) << type;
    EXPECT_FALSE(blocked({0.1, 0.1, 0}, 100.0, 0)) << type << ": no particle shades itself";
    EXPECT_FALSE(blocked({0.1, 0.1, 0}, 3.0, reference::no_id)) << type << ": the light lies before it";
    EXPECT_FALSE(blocked({0.1, 0.1, 7}, 100.0, reference::no_id)) << type << ": it lies behind";
    EXPECT_FALSE(blocked({0.9, 0.0, 0}, 100.0, reference::no_id)) << type << ": beside it";
  }
}

// Two surfaces of 1 - sqrt(1 - alpha) each: together alpha, whatever the type.
TEST(ReferenceGlyphs, TransparentOnesBlockTheirAlpha) {
  for (const std::string& type : types()) {
    Record r{};
    r[0].w = 3.0f;
    const bool turned = type == "ellipsoid" || type == "box" || type == "superquadric";
    r[1] = turned ? glm::vec4(0.1, 0.2, 0.3, 0.9) : glm::vec4(0.3, 0.1, 1, 0.5);
    r[2] = turned ? glm::vec4(0.5, 0.6, 1, 0) : glm::vec4(0.5, 0, 0, 0);
    if (type == "arrow") r[2] = glm::vec4(0.8, 0.5, 0, 0);
    r[3] = glm::vec4(0.5, 1.5, 0, 0);
    Scene scene = scene_of_glyphs(type, {{{0, 0, 0}, r}});
    scene.batches[0].alpha = 0.75;
    scene.batches[0].color = glm::dvec3(0);
    scene.background = glm::dvec4(1);
    const ReferencePicture picture = render_reference(scene, look({0, -8, 0}, {0, 0, 0}, {33, 33}));
    EXPECT_NEAR(picture.color[16 * 33 + 16].r, 0.25, 1e-12) << type;
    EXPECT_NEAR(picture.color[16 * 33 + 16].a, 1.0, 1e-12) << type;
    EXPECT_EQ(picture.id[16 * 33 + 16], reference_no_id) << type;
  }
}

// An open tube shows its inner wall through its end, and both walls from the side; a closed one its disk.
TEST(ReferenceGlyphs, OpenTubesAreSeenInto) {
  Record r{};
  r[0].w = 3.0f;
  r[1] = glm::vec4(0, 0, 1, 0.5);
  r[2] = glm::vec4(0.5, 1, 0, 0);
  const reference::Shape& shape = *reference::find_shape("cylinder");
  const reference::Ray into{{0, 0, 4}, {0.125, 0, -1}}; // meets the wall at z = 0
  const reference::Particle open{glm::dvec3(0), 3.0, r};
  const auto hit = shape.intersect(open, into);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t_in, 4.0, 1e-14);
  EXPECT_NEAR(hit->t_out, 4.0, 1e-14);
  EXPECT_NEAR(shape.normal(open, into, false).x, -1.0, 1e-14) << "against the ray";
  EXPECT_NEAR(shape.normal(open, into, true).x, 1.0, 1e-14) << "along it: the tracer turns exits";
  EXPECT_FALSE(shape.intersect(open, {{0, 0, 4}, {0.0625, 0, -1}})) << "through both openings";
  r[2].y = 0.0f;
  const reference::Particle closed{glm::dvec3(0), 3.0, r};
  ASSERT_TRUE(shape.intersect(closed, into));
  EXPECT_NEAR(shape.intersect(closed, into)->t_in, 3.0, 1e-14);
  EXPECT_NEAR(shape.normal(closed, into, false).z, 1.0, 1e-14);
}

TEST(ReferenceGlyphs, DegenerateOnesAreWhatTheyAre) {
  const auto meets = [](const std::string& type, const glm::vec4& one, const glm::vec4& two, const glm::vec4& three = glm::vec4(1, 1, 0, 0)) {
    const Record r{glm::vec4(0, 0, 0, 2), one, two, three};
    const reference::Particle p{glm::dvec3(0), 2.0, r};
    return reference::find_shape(type)->intersect(p, {{0.01, -5, 0.02}, {0, 1, 0}});
  };
  const auto sphere = meets("capsule", {0, 0, 0, 0.5}, {0, 0, 0, 0});
  ASSERT_TRUE(sphere) << "a capsule without length is a sphere";
  EXPECT_NEAR(sphere->t_in, 5.0 - std::sqrt(0.25 - 0.0005), 1e-14);
  EXPECT_FALSE(meets("capsule", {0, 0, 1, 0}, {0, 0, 0, 0}));
  EXPECT_FALSE(meets("cylinder", {0, 0, 0, 0.5}, {0.5, 0, 0, 0}));
  EXPECT_FALSE(meets("cylinder", {0, 0, 1, 0}, {0, 0, 0, 0}));
  EXPECT_TRUE(meets("cone", {0, 0, 1, 0.5}, {0, 0, 0, 0}));
  EXPECT_TRUE(meets("arrow", {0, 0, 0.5, 0.2}, {0.5, 9, 0, 0})) << "a head longer than the arrow is cut to it";
  EXPECT_FALSE(meets("ellipsoid", {0, 0, 0, 1}, {1, 0, 1, 0}));
  EXPECT_TRUE(meets("box", {0, 0, 0, 1}, {1, 0, 1, 0})) << "a plate";
  EXPECT_FALSE(meets("superquadric", {0, 0, 0, 1}, {1, 1, 1, 0}, {0, 1, 0, 0}));
  EXPECT_FALSE(meets("superquadric", {0, 0, 0, 1}, {1, 1, 1, 0}, {1, 2.5, 0, 0}));
  const auto twice = meets("ellipsoid", {0.2f, 0.4f, 0.6f, 1.0f}, {1, 0.5, 1, 0}), once = meets("ellipsoid", {0.1f, 0.2f, 0.3f, 0.5f}, {1, 0.5, 1, 0});
  ASSERT_TRUE(twice && once);
  EXPECT_NEAR(twice->t_in, once->t_in, 1e-14) << "a quaternion's length does not matter";
}

// A ray along a generator of a cone: the quadratic loses its square.
TEST(ReferenceGlyphs, RaysAlongAConesGenerator) {
  const Record r{glm::vec4(0, 0, 0, 2), glm::vec4(0, 0, 1, 2), glm::vec4(0), glm::vec4(0)}; // radius 1 - z
  const reference::Particle p{glm::dvec3(0), 2.0, r};
  const reference::Shape& cone = *reference::find_shape("cone");
  const auto up = cone.intersect(p, {{-4, 0, -2}, {1, 0, 1}}); // x = z - 2
  EXPECT_FALSE(up) << "it runs outside of the near side, x = z - 1";
  const auto low = cone.intersect(p, {{-2, 0, -2}, {1, 0, 1}});
  ASSERT_TRUE(low) << "x = z: enters by the disk, leaves by the far side at z = 1/2";
  EXPECT_NEAR(low->t_in, 1.0, 1e-14);
  EXPECT_NEAR(low->t_out, 2.5, 1e-14);
}

} // namespace
} // namespace mote
