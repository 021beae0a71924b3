// SPDX-License-Identifier: MIT
#include "core/scene/glyphs.hpp"

#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote {
namespace {

struct GlyphType {
  std::string_view name;
  GlyphMaker make;
};
// One line a type.
constexpr std::array glyph_types{
    GlyphType{"capsule", make_axial},
    GlyphType{"ellipsoid", make_oriented},
    GlyphType{"box", make_oriented},
    GlyphType{"superquadric", make_oriented},
    GlyphType{"cylinder", make_axial},
    GlyphType{"cone", make_axial},
    GlyphType{"arrow", make_axial},
    GlyphType{"polyline", make_polyline},
};

} // namespace

GlyphMaker find_glyph_maker(std::string_view type) {
  for (const GlyphType& t : glyph_types)
    if (t.name == type) return t.make;
  return nullptr;
}

GlyphMaker maker_of(const DataDesc& desc) { return desc.user ? make_user : find_glyph_maker(desc.type); }

const std::vector<std::string>& scene_particle_types() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"sphere"};
    for (const GlyphType& t : glyph_types) all.emplace_back(t.name);
    return all;
  }();
  return names;
}

const data::Column* wanted_vector(const FrameContext& context, const Located<std::string>& name, Diagnostics& diagnostics) {
  const std::optional<Attribute> found = wanted_attribute(context, name, true, diagnostics);
  if (!found) return nullptr;
  if (!found->component && found->column->components == 3) return found->column;
  std::vector<std::string> vectors;
  for (const data::Column& column : context.frame.columns)
    if (column.components == 3 && column.type() != data::ColumnType::Text) vectors.push_back(column.name);
  diagnostics.error(code::not_a_vector, name.loc,
                    fmt::format("'{}' of {} is no vector: it has {}", name.value, context.name,
                                found->component || found->column->components == 1 ? "one number a particle" : fmt::format("{} numbers a particle", found->column->components)),
                    {fmt::format("Vectors: {}", list_of(vectors))});
  return nullptr;
}

} // namespace mote
