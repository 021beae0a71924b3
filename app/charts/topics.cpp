// SPDX-License-Identifier: MIT
#include "app/charts/topic.hpp"

#include <array>

namespace mote::app {

std::span<const Topic> topics() {
  static constexpr std::array list{
      Topic{"sphere", "formulas for a ray and a sphere, over distance / radius", "", "", chart_sphere},
      Topic{"proxy", "expansions, and outlines that stand for a sphere", "spheres:1e4:fit", "640x360", chart_proxy},
      Topic{"mesh", "exact spheres against triangles", "spheres:1e3:fit", "640x360", chart_mesh},
      Topic{"placement", "centers far from the origin", "", "", chart_placement},
      Topic{"depth", "encodings and formats of depth", "", "", chart_depth},
      Topic{"sampling", "samples a pixel, analytic edges", "spheres:1e3:fit", "320x180", chart_sampling},
      Topic{"shadow", "shadow maps and their sizes", "spheres:1e4:fit", "640x360", chart_shadow},
      Topic{"transparency", "orders, sums and lists", "spheres:1e3:fit", "320x180", chart_transparency},
      Topic{"color_models", "color models, tables of hues, subsampled chroma", "", "", chart_color_models},
      Topic{"ocio", "display transforms: arithmetic, baked curves, tables", "", "", chart_ocio},
  };
  return list;
}

} // namespace mote::app
