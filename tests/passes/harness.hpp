// SPDX-License-Identifier: MIT
// Draws a scene with the shipped default graph on the test device and reads every AOV back. One
// device a process; any uncaptured error or message of the validation layer fails the test.
#pragma once

#include "core/gpu/gpu.hpp"
#include "core/scene/scene.hpp"
#include "passes/frame.hpp"
#include "passes/particles/particle_store.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mote::test {

struct Picture {
  Size2d size{};
  std::vector<float> depth{};         // +inf where nothing is
  std::vector<std::uint32_t> id{};    // 0xFFFFFFFF where nothing is
  std::vector<glm::vec4> normal{};    // world
  std::vector<glm::vec4> color{};     // scene-linear, from half floats
  std::vector<glm::u8vec4> display{}; // after the display transform
  [[nodiscard]] std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * size.width + x; }
};

struct Bars {
  double least_hits{};           // fraction of the pixels: the picture shows something
  double most_ambiguous{0.01};   // fraction of the pixels: most of them count
  double depth_factor{1.0};      // times the bars on depth: the eye near a surface, see docs/accuracy.md
  double normal_factor{1.0};     // times the bar on normals: of shapes longer than thick, whose bounding ball says how large they are
  double colors_off{0.0};        // fraction of the pixels whose color may be another: at edges between faces of one particle
};
class GpuTest : public ::testing::Test {
protected:
  void SetUp() override;
  void TearDown() override; // the validation layer has said nothing
  [[nodiscard]] static gpu::Device device();
  // `settings`: "pass.param=value" each.
  // `graph_` names the shipped graph.
  Picture draw(const Scene& scene, const View& view, const passes::FrameOptions& options = {},
               const std::vector<std::string>& settings = {});
  // Draws with both expansions, which must agree bit for bit, against the reference, and with the alarm of FC-29 on.
  Picture check(const Scene& scene, const View& view, const Bars& bars = {});
  std::string graph_{"default"};
};

// Spheres (x, y, z, r) as one batch of a scene with one head light of 0.8 and an ambient of 0.2 on white.
Scene scene_of(const std::vector<glm::dvec4>& spheres, const std::vector<std::uint32_t>& colors = {});
// n spheres in a cube of half edge `half`, radii log-uniform.
std::vector<glm::dvec4> cloud(std::size_t n, double half, double r_min, double r_max, unsigned seed = 3);
// One particle of any type: where it is, a ball around it, its least measure, and the vec4s of its record behind the first.
struct Glyph {
  glm::dvec3 center{0};
  double bound{}, finest{};
  std::vector<glm::vec4> rest{};
};
Scene glyph_scene(const std::string& type, const std::vector<Glyph>& glyphs, const std::vector<std::uint32_t>& colors = {});
// Another type's particles in the same scene, as a batch of their own.
Scene joined(Scene scene, const Scene& other);
// The scene with its one batch placed by `instances`; bounds follow.
Scene placed(Scene scene, const std::vector<glm::dmat4>& instances);
View look(const Scene& scene, glm::dvec3 eye, glm::dvec3 target, Size2d size, double fov_y = 30.0);
View look_orthographic(const Scene& scene, glm::dvec3 eye, glm::dvec3 target, Size2d size, double height);

// GPU picture against the reference, with the bars of the contracts: equal ids outside ambiguous pixels; depth
// median <= 6e-8 and 99th percentile <= 2.5e-7 relative; normals' 99th percentile <= 1e-6 + 1.5e-4 / R.
void expect_equals_reference(const Picture& picture, const Scene& scene, const View& view, const Bars& bars = {});

} // namespace mote::test
