// SPDX-License-Identifier: MIT
// Draws a scene with any graph, given as text, and reads one color source back as floats. For passes
// that the default graph lacks.
#pragma once

#include "harness.hpp"
#include "render_graph/compile.hpp"

#include <fmt/format.h>

namespace mote::test {

// Scene-linear RGBA of one source, and its size.
struct Colors {
  Size2d size{};
  std::vector<glm::vec4> texels{};
  std::vector<std::string> ran{}; // passes that were not idle
  Diagnostics report{};           // what the passes had to say after the frame
  [[nodiscard]] glm::vec4 at(std::uint32_t x, std::uint32_t y) const { return texels[std::size_t{y} * size.width + x]; }
  [[nodiscard]] glm::vec4 center() const { return at(size.width / 2, size.height / 2); }
};

// Opaque particles, then transparent ones with the parameters given; `draw`: a line of the transparent pass.
inline std::string glyphs_over_opaque(const std::string& params, const std::string& draw = "") {
  return fmt::format(R"(schema = 1
output = "glyphs.color"
[[pass]]
name = "opaque"
kind = "opaque_impostors"
[[pass]]
name = "glyphs"
kind = "sorted_glyphs"
inputs = {{ color = "opaque.color", depth = "opaque.depth" }}
{}
{}
)",
                     draw, params.empty() ? "" : "params = { " + params + " }");
}
inline const std::string exact_glyphs = glyphs_over_opaque("oit = \"exact\"");

class GraphTest : public GpuTest {
protected:
  // `source` must be a color texture of four floats or halves. A graph that does not compile fails the test.
  Colors draw_graph(const Scene& scene, const View& view, const std::string& graph, const std::string& source,
                    const passes::FrameOptions& options = {});
  // What compiling the graph has to say.
  static Diagnostics check_graph(const std::string& graph);
};

// Several scenes in one: the batches of all, numbered in order; lights, background, camera of the first.
Scene join(const std::vector<Scene>& scenes);
// One sphere of a color (linear) and an alpha, lit by ambient light of 1 alone: it shows its color everywhere.
Scene flat_sphere(glm::dvec4 center_radius, glm::dvec3 color, double alpha = 1.0);

} // namespace mote::test
