// SPDX-License-Identifier: MIT
// Shadows of a picture against the reference's shadow rays. "Wrong" is a pixel that faces the light and shows light where the
// ray is blocked, or the reverse (method book, section 8.2).
#pragma once

#include "harness.hpp"

#include <algorithm>
#include <cstddef>

namespace mote::test {

struct ShadowErrors {
  std::size_t facing{}, shadowed{}, false_shadow{}, false_light{};
  [[nodiscard]] double wrong() const { return static_cast<double>(false_shadow + false_light) / static_cast<double>(std::max<std::size_t>(facing, 1)); }
};
// Of the lights of the scene that cast shadows: which of them each pixel shows, by the reference's picture with and without shadows.
ShadowErrors shadow_errors(const Picture& picture, const Scene& scene, const View& view);

} // namespace mote::test
