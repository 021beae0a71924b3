// SPDX-License-Identifier: MIT
// Private to core/color: a view transform as a chain of pieces, each either OCIO arithmetic or a
// CurveTable. display_transform.cpp makes and runs them, display_glsl.cpp writes them as GLSL.
#pragma once

#include "core/color/curve_table.hpp"
#include "core/color/display_transform.hpp"
#include "core/color/ocio_bridge.hpp"

#include <optional>

namespace mote {

struct DisplayPiece {
  OCIO::ConstProcessorRcPtr processor{};
  OCIO::ConstCPUProcessorRcPtr cpu{};
  std::optional<CurveTable> table{}; // stands for the processor when present
};

struct DisplayTransform::Inner {
  std::string display{}, view{}, source_space{};
  SourceLoc loc{};
  double gain{1.0};
  double baked_error{};
  OCIO::ConstProcessorRcPtr processor{};
  OCIO::ConstCPUProcessorRcPtr cpu{}; // of the whole
  std::vector<DisplayPiece> pieces{}; // of the GLSL function; one without a table when nothing is baked
};

// Largest finite half float: every input is cut to +-this before the transform.
inline constexpr float display_limit = 65504.0f;

} // namespace mote
