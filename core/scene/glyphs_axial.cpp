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

constexpr double thickness = 0.1, arrow_thickness = 0.04; // radius over length where nothing says it
constexpr double largest = 1e30;

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

// What the rules give each row; empty lists where they say nothing.
struct Measures {
  std::vector<double> radii, lengths, ends, head_radii, head_lengths;
  [[nodiscard]] static double at(const std::vector<double>& list, std::uint64_t row, double otherwise) { return list.empty() ? otherwise : list[row]; }
};

bool usable(double x) { return x >= 0.0 && x <= largest; }

struct Row {
  glm::vec3 h{0};          // half of the axis
  double length{}, radius{}, end{}, head{}, head_length{};
};

// The row's shape, or why there is none.
Verdict shape(const Measures& m, std::uint64_t row, const glm::dvec3& v, const DataDesc& desc, bool capsule, Row& out) {
  const double size = norm(v);
  out.length = Measures::at(m.lengths, row, size * desc.axial.scale);
  if (!std::isfinite(size) || !usable(out.length)) return Verdict::NoShape;
  out.h = glm::vec3(size > 0.0 ? v / size * (0.5 * out.length) : glm::dvec3(0));
  if (!capsule && !(glm::length(out.h) > 0.0f)) return Verdict::NoShape; // no axis: nothing but a capsule has a shape then
  out.radius = Measures::at(m.radii, row, (desc.type == "arrow" ? arrow_thickness : thickness) * out.length);
  out.end = Measures::at(m.ends, row, desc.type == "cone" ? 0.0 : out.radius);
  out.head = Measures::at(m.head_radii, row, 2.2 * out.radius);
  out.head_length = Measures::at(m.head_lengths, row, 2.5 * out.head);
  if (out.head_length > out.length) { // a short arrow is all head, of the same slope
    if (m.head_radii.empty()) out.head *= out.length / out.head_length;
    out.radius = std::min(out.radius, out.head);
    out.head_length = out.length;
  }
  if (out.radius < 0.0 || out.end < 0.0) return Verdict::NegativeRadius;
  if (!usable(out.radius) || !usable(out.end)) return Verdict::NoRadius;
  if (!usable(out.head) || !usable(out.head_length)) return Verdict::NoShape;
  const bool thin = desc.type == "arrow" ? static_cast<float>(std::max(out.radius, out.head)) == 0.0f : static_cast<float>(std::max(out.radius, out.end)) == 0.0f;
  return thin ? Verdict::ZeroRadius : Verdict::Draw;
}

double smallest(double a, double b) { return a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b); }

// The record and what bounds it.
void fill(const Row& a, bool open, Glyphs& out, std::uint64_t row) {
  const glm::dvec3 h(a.h);
  const double half = glm::length(h);
  glm::vec4* record = out.record(row);
  record[0] = glm::vec4(a.h, static_cast<float>(a.radius));
  double widest = a.radius;
  out.finest[row] = a.radius;
  if (out.type == "capsule") {
    out.bounds[row] = (half + a.radius) * glyph_padding;
  } else if (out.type == "arrow") {
    record[1] = glm::vec4(static_cast<float>(a.head), std::min(static_cast<float>(a.head_length), 2.0f * glm::length(a.h)), 0, 0);
    widest = std::max(a.radius, a.head);
    out.bounds[row] = std::max(std::hypot(half, a.radius), std::hypot(half - a.head_length, widest)) * glyph_padding;
    out.bounds[row] = std::max(out.bounds[row], half * glyph_padding);
    out.finest[row] = smallest(a.radius, a.head);
  } else {
    record[1] = glm::vec4(static_cast<float>(a.end), open ? 1.0f : 0.0f, 0, 0);
    widest = std::max(a.radius, a.end);
    out.bounds[row] = std::hypot(half, widest) * glyph_padding;
    out.finest[row] = smallest(a.radius, a.end);
  }
  out.half[row] = (glm::abs(h) + widest) * glyph_padding;
}

} // namespace

Glyphs make_axial(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics) {
  const std::uint64_t count = context.frame.count;
  const AxialDesc& axial = desc.axial;
  const bool capsule = desc.type == "capsule" || axial.ends == Ends::Round;
  Glyphs out(capsule ? "capsule" : desc.type, capsule ? 2 : 3, count);
  const std::optional<Vectors> vectors = vectors_of(context, desc, diagnostics);
  const auto measured = [&](const RadiusDesc& rule) { return rule.rule == RadiusRule::Auto ? std::vector<double>() : particle_radii(context, rule, diagnostics); };
  const Measures m{radii, measured(axial.length), measured(axial.radius_end), measured(axial.head_radius), measured(axial.head_length)};
  if (!vectors || diagnostics.has_errors()) return out;
  const Anchor anchor = axial.anchor.value_or(desc.type == "arrow" ? Anchor::Start : Anchor::Center);
  const float shift = anchor == Anchor::Start ? 1.0f : anchor == Anchor::End ? -1.0f : 0.0f;
  for (std::uint64_t row = 0; row < count; ++row) {
    Row shaped;
    const data::Column& p = *vectors->position;
    out.verdicts[row] = shape(m, row, vectors->at(row), desc, capsule, shaped);
    out.centers[row] = glm::dvec3(p.number(row, 0), p.number(row, 1), p.number(row, 2)) + glm::dvec3(shift * shaped.h);
    if (out.verdicts[row] == Verdict::Draw) fill(shaped, axial.ends == Ends::Open, out, row);
  }
  return out;
}

} // namespace mote
