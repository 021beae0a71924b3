// SPDX-License-Identifier: MIT
#include "app/library/panels.hpp"

#include <algorithm>

namespace mote::app {
namespace {

std::uint32_t side_of(const FrameRenderer& renderer, std::uint32_t panel) {
  return std::min(panel ? panel : default_panel, renderer.limits().max_texture_dimension_2d);
}

// Copies a panel's rows to its place in the picture; `channels` values a pixel.
template <class T> void paste(const std::vector<T>& from, std::vector<T>& to, const View& panel, std::size_t channels) {
  if (from.empty()) return;
  const Size2d whole = panel.whole();
  to.resize(std::size_t{whole.width} * whole.height * channels);
  for (std::size_t y = 0; y < panel.size.height; ++y) {
    const auto row = from.begin() + static_cast<std::ptrdiff_t>(y * panel.size.width * channels);
    const std::size_t place = (panel.panel_origin.y + y) * whole.width + panel.panel_origin.x;
    std::copy_n(row, panel.size.width * channels, to.begin() + static_cast<std::ptrdiff_t>(place * channels));
  }
}

} // namespace

std::size_t panel_count(const FrameRenderer& renderer, const View& view, std::uint32_t panel) {
  return panels(view, side_of(renderer, panel)).size();
}

DrawnPicture draw_picture(FrameRenderer& renderer, const View& view, std::uint32_t panel) {
  const std::vector<View> parts = panels(view, side_of(renderer, panel));
  DrawnPicture whole;
  for (const View& part : parts) {
    renderer.wait(renderer.draw(part));
    DrawnPicture drawn = renderer.read();
    if (parts.size() == 1) return drawn;
    paste(drawn.rgba8, whole.rgba8, part, 4);
    paste(drawn.display, whole.display, part, 4);
    paste(drawn.linear, whole.linear, part, 4);
    paste(drawn.depth, whole.depth, part, 1);
    paste(drawn.id, whole.id, part, 1);
    paste(drawn.normal, whole.normal, part, 3);
  }
  whole.size = view.size;
  return whole;
}

} // namespace mote::app
