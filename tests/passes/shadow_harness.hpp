// SPDX-License-Identifier: MIT
// What tests of shadows share: lights, pictures by each way of drawing maps and surfaces, and those against the reference's shadow rays. "Wrong" is a pixel that faces the light and shows light where the
// ray is blocked, or the reverse (method book, section 8.2).
#pragma once

#include "harness.hpp"

#include "core/base/diagnostic.hpp"
#include "passes/particles/expansion_choice.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace mote::test {

struct ShadowErrors {
  std::size_t facing{}, shadowed{}, false_shadow{}, false_light{};
  [[nodiscard]] double wrong() const { return static_cast<double>(false_shadow + false_light) / static_cast<double>(std::max<std::size_t>(facing, 1)); }
};
// Of the lights of the scene that cast shadows: which of them each pixel shows, by the reference's picture with and without shadows.
ShadowErrors shadow_errors(const Picture& picture, const Scene& scene, const View& view);

Light sun(glm::dvec3 direction);

class ShadowTest : public GpuTest, public testing::WithParamInterface<passes::Expansion> {
protected:
  ShadowTest() { graph_ = "shadowed"; }
  Picture draw(const Scene& scene, const View& view, passes::FrameOptions options = {}, const std::vector<std::string>& settings = {}) {
    options.expansion = GetParam();
    options.chosen = [this](const passes::ExpansionReport& report) { tiled_ = report.tiled > 0; };
    return GpuTest::draw(scene, view, options, settings);
  }
  bool tiled_{}; // whether the last picture had tiles
};

// What `draw` is refused with.
template <class Draw> std::string failure_of(Draw draw) {
  try {
    draw();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "it was drawn";
}

} // namespace mote::test
