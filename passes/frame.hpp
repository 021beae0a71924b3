// SPDX-License-Identifier: MIT
// What the built-in pass kinds expect in a FrameInput, besides mote::Scene and mote::View:
//
//   FrameOptions       how to draw this frame
//   ParticleStore      the particles on the device (particles/particle_store.hpp)
//   DisplaySettings    the display transform in force (ocio_tonemap only)
//   PassReports        optional: where problems go that do not stop the frame (passes from files)
#pragma once

#include "core/base/diagnostic.hpp"
#include "core/color/color_config.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace mote::passes {

// How a particle becomes fragments. Auto takes the cheapest that the device and the pass support.
enum class Expansion : std::uint8_t { Auto, Vertex, Geometry, Compute, Point };
std::string_view to_string(Expansion expansion);
std::span<const std::string_view> expansion_names(); // "auto", "vertex", "geometry", "compute", "point"
// False when `name` is none of them.
bool parse_expansion(std::string_view name, Expansion& out);

struct DeviceCosts;     // passes/particles/expansion_cost.hpp
struct ExpansionReport; // passes/particles/expansion_choice.hpp

struct FrameOptions {
  Expansion expansion{Expansion::Auto};
  bool show_depth_violation{}; // magenta: fragments whose depth breaks the conservative bound (FC-29), NaN of types from files
  double frames{1};            // that are expected to be drawn like this one: one-time costs count by their share
  const DeviceCosts* costs{};  // what `auto` reckons with; null: the numbers shipped for a processor
  std::function<void(const ExpansionReport&)> chosen{}; // told by each pass that draws particles, each frame
};

// Optional in a FrameInput: who hears what goes wrong without stopping a frame (a shader file that was changed and is broken).
struct PassReports {
  std::function<void(const Diagnostic&)> report{};
};

// The display transform in force. Display and view named by the graph's pass win over these; exposures add.
struct DisplaySettings {
  const ColorConfig* config{};
  std::string display{}, view{}; // empty: the config's defaults
  double exposure{};             // stops
  bool exact{};                  // arithmetic instead of baked curves
  std::string cache_directory{}; // of SPIR-V; empty: none
  std::function<void(const std::string&)> describe{}; // told once which transform was made and how exact it is
};

} // namespace mote::passes
