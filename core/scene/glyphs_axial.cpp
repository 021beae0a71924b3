// SPDX-License-Identifier: MIT
// Makers of the types with an axis: capsule, cylinder, cone, arrow. The axis is a vector column, the way to an end point, or one
// vector for all; its length is the vector's, or a measure of its own.
#include "core/scene/codes.hpp"
#include "core/scene/glyphs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mote {
namespace {

constexpr double thickness = 0.1; // radius over length where nothing says it

double norm(const glm::dvec3& v) { // also of what a square would overflow or underflow
  const double most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return most > 0.0 && std::isfinite(most) ? most * glm::length(v / most) : most;
}

// The vector of each row.
struct Vectors {
  const data::Column* column{};
  const data::Column* position{};
  bool to_end{};
  glm::dvec3 constant{0};
  [[nodiscard]] glm::dvec3 at(std::uint64_t row) const {
    if (!column) return constant;
    const glm::dvec3 v(column->number(row, 0), column->number(row, 1), column->number(row, 2));
    return to_end ? v - glm::dvec3(position->number(row, 0), position->number(row, 1), position->number(row, 2)) : v;
  }
};

std::optional<Vectors> vectors_of(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics) {
  const AxialDesc& axial = desc.axial;
  Vectors out;
  out.position = context.frame.find("position");
  if (axial.constant) {
    out.constant = *axial.constant;
    return out;
  }
  out.to_end = axial.end.has_value();
  Located<std::string> name{"direction", context.contents};
  if (axial.end) name = *axial.end;
  else if (axial.direction) name = *axial.direction;
  else if (!context.frame.find("direction")) {
    std::vector<std::string> columns;
    for (const data::Column& column : context.frame.columns)
      if (column.components == 3 && column.name != "position" && column.type() != data::ColumnType::Text) columns.push_back(column.name);
    diagnostics.error(code::attribute_missing, desc.loc, fmt::format("particles of type '{}' need a direction, and {} has no column of that name", desc.type, context.name),
                      {fmt::format("direction = \"...\" names a vector, end = \"...\" the other end, direction = [x, y, z] is one for all; vectors there: {}",
                                   columns.empty() ? "none" : list_of(columns))});
    return std::nullopt;
  }
  out.column = wanted_vector(context, name, diagnostics);
  return out.column ? std::optional(out) : std::nullopt;
}

// A measure of each row: by its rule, or nothing.
std::vector<double> measure(const FrameContext& context, const RadiusDesc& rule, Diagnostics& diagnostics) {
  return rule.rule == RadiusRule::Auto ? std::vector<double>() : particle_radii(context, rule, diagnostics);
}

// What the rows' rules give; empty lists where they say nothing.
struct Measures {
  std::vector<double> radii, lengths, ends, head_radii, head_lengths;
  [[nodiscard]] static double at(const std::vector<double>& list, std::uint64_t row, double otherwise) { return list.empty() ? otherwise : list[row]; }
};

struct Axial { // of one row
  glm::vec3 h{0};
  double length{}, radius{};
};

bool usable(double x) { return x >= 0.0 && x <= 1e30; }

void capsule(const Axial& a, Glyphs& out, std::uint64_t row) {
  const auto r = static_cast<float>(a.radius);
  out.record(row)[0] = glm::vec4(a.h, r);
  out.bounds[row] = (double{glm::length(a.h)} + double{r}) * glyph_padding;
  out.half[row] = (glm::abs(glm::dvec3(a.h)) + double{r}) * glyph_padding;
  out.finest[row] = double{r};
}

} // namespace

Glyphs make_axial(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics) {
  const std::uint64_t count = context.frame.count;
  Glyphs out("capsule", 2, count);
  const std::optional<Vectors> vectors = vectors_of(context, desc, diagnostics);
  const Measures m{radii, measure(context, desc.axial.length, diagnostics), {}, {}, {}};
  if (!vectors || diagnostics.has_errors()) return out;
  for (std::uint64_t row = 0; row < count; ++row) {
    const glm::dvec3 v = vectors->at(row);
    const double size = norm(v), length = Measures::at(m.lengths, row, size * desc.axial.scale);
    const glm::dvec3 unit = size > 0.0 ? v / size : glm::dvec3(0);
    const Axial a{glm::vec3(unit * (0.5 * length)), length, Measures::at(m.radii, row, thickness * length)};
    const double shift = desc.axial.anchor == Anchor::Start ? 0.5 : desc.axial.anchor == Anchor::End ? -0.5 : 0.0;
    const data::Column& p = *vectors->position;
    out.centers[row] = glm::dvec3(p.number(row, 0), p.number(row, 1), p.number(row, 2));
    if (!std::isfinite(size) || !usable(length)) {
      out.verdicts[row] = Verdict::NoShape;
      continue;
    }
    out.centers[row] += unit * (shift * length);
    out.verdicts[row] = a.radius < 0.0 ? Verdict::NegativeRadius : !usable(a.radius) ? Verdict::NoRadius : static_cast<float>(a.radius) == 0.0f ? Verdict::ZeroRadius : Verdict::Draw;
    capsule(a, out, row);
  }
  return out;
}

} // namespace mote
