// SPDX-License-Identifier: MIT
// Radius, color and opacity of every row of a frame, by the rules of realize.hpp. Private to core/scene.
#pragma once

#include "core/data/dataset.hpp"
#include "core/scene/annotations.hpp"
#include "core/scene/scene_file.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mote {

// The series that a frame belongs to, for what must not change from frame to frame: ranges and the order of words.
class SeriesView {
public:
  virtual ~SeriesView() = default;
  // Values of an attribute over the frames of the series (some of them, when there are many).
  virtual RangeCollector values(const std::string& attribute, bool keep_values, bool positive) = 0;
  // The words of a text attribute in the order of their first appearance.
  virtual std::vector<std::string> words(const std::string& attribute) = 0;
};

// A frame and what belongs to it.
struct FrameContext {
  const data::Frame& frame;
  SourceLoc contents{};             // the particle file, for messages about its contents
  std::string name{};               // of the file
  std::filesystem::path folder{};   // that color map files are relative to
  std::vector<bool> rows{};         // those that are drawn; empty: all
  SeriesView* series{};             // null: the frame stands alone
  std::optional<double> usual_radius{}; // of particles without one, in a series: that of frame 0
};

// The attribute that a rule names; nothing when there is none (S021) or it is text and numbers are needed (S022).
std::optional<Attribute> wanted_attribute(const FrameContext& context, const Located<std::string>& name, bool numbers,
                                          Diagnostics& diagnostics);
// Ends of a mapping's range. S036 when no value can be mapped.
ValueScale value_scale(const FrameContext& context, const Mapping& mapping, const Attribute& attribute, Diagnostics& diagnostics);

// One radius per row as the rules give it: may be zero, negative or NaN, which the caller sorts out. Empty after an error.
std::vector<double> particle_radii(const FrameContext& context, const RadiusDesc& rule, Diagnostics& diagnostics);

// One color per row as ChunkSet holds it (sRGB-encoded RGBA, R lowest), or none when all rows share `constant`.
struct ParticleColors {
  std::vector<std::uint32_t> packed{};
  glm::dvec3 constant{0.8}; // working space
  std::optional<ColorKey> key{}; // of a mapped scalar
};
ParticleColors particle_colors(const FrameContext& context, const ColorDesc& rule, bool generated, Diagnostics& diagnostics);
// Opacities that are not one for all become part of the colors.
void apply_opacity(const FrameContext& context, const AlphaDesc& rule, ParticleColors& colors, Diagnostics& diagnostics);

} // namespace mote
