// SPDX-License-Identifier: MIT
// From the columns of a file to the records of particle types that are more than a center and a radius: one maker a
// type, in a table (glyphs.cpp). realize() calls the maker of a data set's type; makers read the frame and what the scene says
// (DataDesc), and never look at other data sets.
//
// The records themselves are laid out as the shaders read them (shaders/particles/<type>/type.glsl); the first vec4 (center and
// radius of a bounding ball) is made by build_chunks().
#pragma once

#include "core/scene/particle_values.hpp"

#include <glm/fwd.hpp>
#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mote {

enum class Verdict : std::uint8_t { Draw, NoPosition, NoRadius, ZeroRadius, NegativeRadius, NoShape, Told };

// One of each per row of the frame; lengths in data units.
struct Glyphs { // Verdict::Told: left out, and the maker has said why
  std::string type{"sphere"};          // of the batch
  std::uint32_t vec4s_per_record{1};
  std::vector<glm::dvec3> centers{};
  std::vector<double> bounds{};        // radii of balls around the centers that hold the particles as their records say them
  std::vector<double> finest{};        // the least measure of each
  std::vector<glm::dvec3> half{};      // half extents of boxes around the centers
  std::vector<glm::vec4> rest{};       // vec4s_per_record - 1 each
  std::vector<Verdict> verdicts{};     // what is to be left out, and why

  Glyphs(std::string name, std::uint32_t vec4s, std::uint64_t count)
      : type(std::move(name)), vec4s_per_record(vec4s), centers(count), bounds(count), finest(count), half(count), rest(count * (vec4s - 1)), verdicts(count) {}
  [[nodiscard]] glm::vec4* record(std::uint64_t row) { return &rest[row * (vec4s_per_record - 1)]; } // behind the first vec4
};

// `radii`: what the scene's rule gives each row, empty where the scene and the file say nothing and the type has a default.
// With errors in `diagnostics` the result is not used.
using GlyphMaker = Glyphs (*)(const FrameContext&, const DataDesc&, const std::vector<double>& radii, Diagnostics&);
GlyphMaker find_glyph_maker(std::string_view type); // null: spheres, or not known
GlyphMaker maker_of(const DataDesc& desc);          // the same for types from files, too
const std::vector<std::string>& scene_particle_types(); // shipped ones that a scene's `type` may name

Glyphs make_axial(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics);
Glyphs make_oriented(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics);
Glyphs make_polyline(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics);
Glyphs make_user(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics);

// Unit quaternions of each row, as the scene or the file says; what has none gets Verdict::Told and is reported (S062).
std::vector<glm::dquat> orientations(const FrameContext& context, const OrientedDesc& desc, std::vector<Verdict>& verdicts, Diagnostics& diagnostics);

// A vector column by name (three numbers a row): S021 when there is none, S022 for text, S041 for other numbers of components.
const data::Column* wanted_vector(const FrameContext& context, const Located<std::string>& name, Diagnostics& diagnostics);

// Float rounding of a record never leads out of what it is padded with.
constexpr double glyph_padding = 1.0 + 1e-6;

} // namespace mote
