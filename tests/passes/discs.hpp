// SPDX-License-Identifier: MIT
// Unlit white discs on black, whose color is their coverage, and the error of coverage at their edges.
#pragma once

#include "harness.hpp"

#include "core/reference/reference.hpp"
#include "passes/particles/expansion_choice.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace mote::test {

class Discs : public GpuTest {
protected:
  // White unlit discs of 3 to 30 px on black: color is coverage.
  static Scene discs() {
    std::vector<glm::dvec4> spheres;
    double x = 0;
    for (int i = 0; i < 24; ++i) {
      const double r = 3.0 * std::pow(10.0, i / 23.0);
      x += r + 2.3;
      spheres.push_back({x, 40.0 * std::sin(1.7 * i), 0.1 * i, r});
      x += r;
    }
    Scene scene = scene_of(spheres, {0xFFFFFFFFu});
    scene.background = {0, 0, 0, 1};
    scene.ambient = {1, 1, 1};
    scene.lights.clear();
    return scene;
  }
  static View view(const Scene& scene) { // one unit a pixel
    const double width = scene.bounds.max.x - scene.bounds.min.x + 8;
    return look_orthographic(scene, {0.5 * (scene.bounds.min.x + scene.bounds.max.x) + 0.13, 0.29, 5000}, {0.5 * (scene.bounds.min.x + scene.bounds.max.x) + 0.13, 0.29, 0},
                             {static_cast<std::uint32_t>(width), 160}, 160);
  }
  // RMS of coverage over the pixels that an edge crosses.
  static double edge_error(const Picture& p, const std::vector<glm::dvec4>& area) {
    double sum = 0;
    std::size_t edges = 0;
    for (std::size_t i = 0; i < area.size(); ++i)
      if (area[i].g > 0.002 && area[i].g < 0.998) ++edges, sum += std::pow(p.color[i].g - area[i].g, 2);
    EXPECT_GT(edges, 1000u);
    return std::sqrt(sum / static_cast<double>(edges));
  }
};

// Several samples a pixel, by quads and by tiles.
class Samples : public Discs, public testing::WithParamInterface<passes::Expansion> {
protected:
  Picture draw(const Scene& scene, const View& view, passes::FrameOptions options = {}, const std::vector<std::string>& settings = {}) {
    options.expansion = GetParam();
    options.chosen = [this](const passes::ExpansionReport& report) { tiled_ = report.tiled > 0; };
    return GpuTest::draw(scene, view, options, settings);
  }
  bool tiled_{}; // whether the last picture had tiles
};

} // namespace mote::test
