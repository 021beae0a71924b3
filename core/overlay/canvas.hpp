// SPDX-License-Identifier: MIT
// A layer over a picture, and areas filled on it with exact coverage of pixels. Colors are scene-linear (working
// space), so that a layer can be laid over a linear picture as it is, or over a displayed one after the view
// transform. Pixel (0,0) is the top left one; coordinates are in pixels, y down.
#pragma once

#include "core/math/camera.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace mote::overlay {

using Path = std::vector<std::vector<glm::dvec2>>; // closed contours; inside: winding number not zero

struct Layer {
  Size2d size{};
  std::vector<glm::vec4> pixels{}; // working space times alpha, alpha
};

class Canvas {
public:
  explicit Canvas(Size2d size) : layer_{size, std::vector<glm::vec4>(std::size_t{size.width} * size.height)} {}
  // Contours must not overlap each other where they turn the same way.
  void fill(const Path& path, const glm::dvec3& color, double alpha = 1.0);
  void rectangle(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec3& color, double alpha = 1.0);
  // Over what is there, with `alpha` already times coverage.
  void blend(std::uint32_t x, std::uint32_t y, const glm::dvec3& color, double alpha);
  [[nodiscard]] Size2d size() const { return layer_.size; }
  Layer take() { return std::move(layer_); }

private:
  Layer layer_;
};

} // namespace mote::overlay
