// SPDX-License-Identifier: MIT
// The golden numbers were printed by the benchmark generator (NumPy): first and last record, and the
// CRC-32 of all float32 records x y z r.
#include "core/scene/generated.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <cmath>

namespace mote {
namespace {

using testing::HasSubstr;

unsigned long checksum(std::uint64_t count, std::uint64_t seed) {
  const GeneratedParticles g = generate_spheres(count, seed);
  std::vector<float> records;
  for (std::uint64_t i = 0; i < count; ++i) {
    for (std::uint64_t k = 0; k < 3; ++k) records.push_back(static_cast<float>(g.positions[3 * i + k]));
    records.push_back(static_cast<float>(g.radii[i]));
  }
  return crc32(0, reinterpret_cast<const Bytef*>(records.data()), static_cast<uInt>(records.size() * sizeof(float)));
}

TEST(Generated, RecordsAreThoseOfTheGenerator) {
  const GeneratedParticles g = generate_spheres(1000, 1);
  EXPECT_EQ(g.positions[0], -0x1.2b2cdap+5);
  EXPECT_EQ(g.positions[1], 0x1.417d6ap+4);
  EXPECT_EQ(g.positions[2], 0x1.a93432p+3);
  EXPECT_EQ(g.radii[0], 4.0);
  EXPECT_EQ(checksum(1000, 1), 0x8b30462du);
  EXPECT_EQ(checksum(1000, 7), 0xd8da7071u);
  EXPECT_EQ(checksum(100000, 1), 0x1b9a1c19u);
  EXPECT_EQ(checksum(1000000, 3), 0x36a265d4u);
}

void expect_eye(std::string_view name, const glm::dvec3& eye) {
  const Camera camera = generated_camera(parse_generated_name(name));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(camera.eye[k], eye[k], 1e-12 * 400) << name;
  EXPECT_EQ(camera.target, glm::dvec3(0));
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(camera.fov_y, 30.0);
  EXPECT_FALSE(camera.far);
}

TEST(Generated, CamerasAreThoseOfTheGenerator) {
  expect_eye("spheres:1e5:fit", {69.99813924559646, 41.99888354735787, 279.99255698238585});
  expect_eye("spheres:1e5:fit:frame=46", {173.8354346665362, 41.99888354735787, 230.38405569326392});
  expect_eye("spheres:1e5:fill", {32.401036849769056, 19.440622109861433, 129.60414739907623});
  expect_eye("spheres:1e5:fill:seed=7:frame=46", {80.46568644723502, 19.440622109861433, 106.64115301588232});
  expect_eye("spheres:1e5:inside:frame=46", {11.92084243662741, 2.8800921644239157, 15.798689335686271});
  EXPECT_EQ(generated_camera(parse_generated_name("spheres:1000:inside")).near, 1.0);
  EXPECT_FALSE(generated_camera(parse_generated_name("spheres:1000:fill")).near);
}

TEST(Generated, NamesAreUnderstood) {
  const GeneratedName name = parse_generated_name("spheres:2.5e6:inside:seed=7:frame=-3");
  EXPECT_EQ(name.count, 2500000u);
  EXPECT_EQ(name.camera, GeneratedCamera::Inside);
  EXPECT_EQ(name.seed, 7u);
  EXPECT_EQ(name.frame, -3);
  EXPECT_EQ(parse_generated_name("spheres:10").camera, GeneratedCamera::Fit);
  EXPECT_TRUE(is_generated_name("spheres:10"));
  EXPECT_TRUE(is_generated_name("sticks:10:fit"));
  EXPECT_FALSE(is_generated_name("spheres.npy"));
  EXPECT_FALSE(is_generated_name("C:spheres"));
}

// The last of a thousand sticks, as the benchmark's own generator (another program) makes it.
TEST(Generated, SticksAndArrows) {
  const GeneratedParticles sticks = generate(parse_generated_name("sticks:1e3")), arrows = generate(parse_generated_name("arrows:1e3"));
  const std::array<double, 6> last{-20.2458439, -12.8300934, -4.62780714, -29.1260548, -11.4453526, -0.243251324};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_FLOAT_EQ(static_cast<float>(sticks.positions[3 * 999 + k]), static_cast<float>(last[k]));
    EXPECT_FLOAT_EQ(static_cast<float>(sticks.ends[3 * 999 + k]), static_cast<float>(last[3 + k]));
  }
  EXPECT_FLOAT_EQ(static_cast<float>(sticks.radii[0]), 1.0f);
  EXPECT_FLOAT_EQ(static_cast<float>(arrows.radii[0]), 0.5f);
  EXPECT_EQ(arrows.ends, sticks.ends);
  EXPECT_EQ(particle_type_of(GeneratedKind::Sticks), "cylinder");
}

TEST(Generated, CrystalsSlabsAndDust) {
  auto make = [](std::string_view name) { return generate(parse_generated_name(name)); };
  const GeneratedParticles crystal = make("crystal:1000");
  ASSERT_EQ(crystal.positions.size(), 3000u);
  EXPECT_EQ(crystal.radii[7], 5.0);
  EXPECT_EQ(crystal.positions[0], -45.0);
  EXPECT_EQ(crystal.positions[3 * 999 + 2], 45.0);
  EXPECT_EQ(crystal.positions[3] - crystal.positions[0], 10.0) << "they touch";
  const GeneratedParticles slab = make("slab:40000:fill");
  EXPECT_EQ(slab.radii[0], 0.5);
  EXPECT_EQ(slab.positions[2], -1.5);
  EXPECT_EQ(slab.positions[3 * 39999 + 2], 1.5) << "four layers";
  const GeneratedParticles dust = make("dust:1e4:seed=3"), spheres = generate_spheres(10000, 3);
  EXPECT_EQ(dust.positions, spheres.positions);
  EXPECT_NEAR(1e4 * 3.14159265 * dust.radii[0] * dust.radii[0] / 1e4, 0.65, 1e-5);
  EXPECT_EQ(make("spheres:500:seed=2").positions, generate_spheres(500, 2).positions);
  EXPECT_EQ(make("crystal:1001").positions.size(), 3003u) << "a number that fills no cube";
}

void expect_refused(std::string_view name, std::string_view code, std::string_view words) {
  try {
    parse_generated_name(name);
    FAIL() << name << " was accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, code) << name;
    EXPECT_THAT(failure.what(), HasSubstr(std::string(words)));
    EXPECT_EQ(failure.exit(), Exit::Usage);
  }
}

TEST(Generated, BadNamesAreRefused) {
  expect_refused("spheres:", "S019", "'' is not a number");
  expect_refused("spheres:many:fit", "S019", "'many' is not a number");
  expect_refused("spheres:0:fit", "S019", "'0' particles");
  expect_refused("spheres:1.5:fit", "S019", "'1.5' is not a number");
  expect_refused("spheres:1e9:fit", "S019", "1 to 1e8");
  expect_refused("spheres:nan:fit", "S019", "'nan' is not a number");
  expect_refused("spheres:1e3:filll", "S019", "Did you mean 'fill'?");
  expect_refused("spheres:1e3:fit:speed=3", "S019", "option 'speed=3'");
  expect_refused("spheres:1e3:fit:seed=x", "S019", "'x' is not a whole number for seed");
}

} // namespace
} // namespace mote
