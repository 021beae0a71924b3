// SPDX-License-Identifier: MIT
// Makers of the types with three axes of their own: ellipsoid, box, superquadric. Axes and orientation come from columns (half
// lengths, quaternions) or from symmetric tensors, whose eigenvectors are the axes.
//
// Superquadrics of a tensor: Kindlmann, Superquadric Tensor Glyphs (VisSym 2004). With eigenvalues l1 >= l2 >= l3 of sum s,
// linearity cl = (l1 - l2) / s, planarity cp = 2 (l2 - l3) / s and sharpness y: where cl >= cp, the glyph's z axis is the first
// eigenvector, e1 = (1 - cl)^y, e2 = (1 - cp)^y; else the third one, e1 = (1 - cp)^y, e2 = (1 - cl)^y.
#include "core/scene/codes.hpp"
#include "core/scene/glyphs.hpp"

#include "core/math/principal_axes.hpp"
#include "core/scene/attributes.hpp"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace mote {
namespace {

constexpr double sharpest_exponent = 0.05; // of tensors' superquadrics: below, edges are thinner than anything shows
constexpr double flattest = 1e-6;          // axes shorter than this times the longest make a tensor singular

// A column of `components` numbers.
const data::Column* wanted_numbers(const FrameContext& context, const Located<std::string>& name, std::uint32_t components, std::string_view what,
                                   Diagnostics& diagnostics) {
  const std::optional<Attribute> found = wanted_attribute(context, name, true, diagnostics);
  if (!found) return nullptr;
  if (!found->component && found->column->components == components) return found->column;
  std::vector<std::string> fitting;
  for (const data::Column& column : context.frame.columns)
    if (column.components == components && column.type() != data::ColumnType::Text) fitting.push_back(column.name);
  diagnostics.error(code::wrong_components, name.loc,
                    fmt::format("'{}' of {} has {} numbers a particle; {} needs {}", name.value, context.name, found->component ? 1 : found->column->components, what, components),
                    {fmt::format("Attributes of {}: {}", components, fitting.empty() ? "none" : list_of(fitting))});
  return nullptr;
}

glm::dvec3 three(const data::Column& column, std::uint64_t row) { return {column.number(row, 0), column.number(row, 1), column.number(row, 2)}; }

// One row's solid.
struct Solid {
  glm::dquat turn{1, 0, 0, 0};
  glm::dvec3 axes{0};
  glm::dvec2 exponents{1};
};

struct Counts {
  std::uint64_t unnormalized{}, zero_quaternion{}, negative{}, singular{}, not_finite{};
};

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Quaternions by a column, of a stated order; none: along the axes of space.
class Turns {
public:
  Turns(const FrameContext& context, const OrientedDesc& desc, Diagnostics& diagnostics) {
    if (desc.orientation) column_ = wanted_numbers(context, *desc.orientation, 4, "a quaternion", diagnostics);
    else if (const data::Column* column = context.frame.find("orientation"); column && column->components == 4) column_ = column;
    if (!column_) return;
    const std::string order = desc.order ? desc.order->value : column_->unit;
    xyzw_ = order == "xyzw";
    if (order != "xyzw" && order != "wxyz")
      diagnostics.error(code::order_unknown, desc.orientation ? desc.orientation->loc : context.contents,
                        fmt::format("{} does not say in which order '{}' holds the components of a quaternion", context.name, column_->name),
                        {fmt::format("orientation = {{ attribute = \"{}\", order = \"xyzw\" }}, or \"wxyz\"", column_->name)});
  }

  // False: no direction in this row.
  bool at(std::uint64_t row, glm::dquat& out, Counts& counts) const {
    if (!column_) return true;
    const auto q = [&](std::uint32_t k) { return column_->number(row, k); };
    const glm::dquat turn = xyzw_ ? glm::dquat(q(3), q(0), q(1), q(2)) : glm::dquat(q(0), q(1), q(2), q(3));
    const double length = glm::length(turn);
    if (!(length > 0.0) || !std::isfinite(length)) {
      ++counts.zero_quaternion;
      return false;
    }
    if (std::abs(length - 1.0) > 1e-4) ++counts.unnormalized;
    out = turn / length;
    return true;
  }

private:
  const data::Column* column_{};
  bool xyzw_{};
};

// Quaternions and half lengths by columns.
class Columns {
public:
  Columns(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics)
      : desc_(desc.oriented), radii_(radii), turns_(context, desc.oriented, diagnostics) {
    find_axes(context, desc, diagnostics);
    if (desc_.exponents_of) exponents_ = wanted_numbers(context, *desc_.exponents_of, 2, "exponents (e1, e2)", diagnostics);
  }

  // False: no solid in this row.
  bool at(std::uint64_t row, Solid& out, Counts& counts) const {
    out.axes = desc_.scale * (axes_ ? three(*axes_, row) : desc_.constant_axes ? *desc_.constant_axes : glm::dvec3(radii_[row]));
    out.exponents = exponents_ ? glm::dvec2(exponents_->number(row, 0), exponents_->number(row, 1)) : desc_.exponents.value_or(glm::dvec2(1.0));
    return turns_.at(row, out.turn, counts);
  }

private:
  void find_axes(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics) {
    if (desc_.constant_axes) return;
    if (desc_.axes) axes_ = wanted_numbers(context, *desc_.axes, 3, "axes", diagnostics);
    else if (const data::Column* shape = context.frame.find("shape"); shape && shape->components == 3) axes_ = shape;
    else if (radii_.empty())
      diagnostics.error(code::attribute_missing, desc.loc, fmt::format("particles of type '{}' need half axes, and {} has no column 'shape' or 'radius'", desc.type, context.name),
                        {fmt::format("axes = [a, b, c] or a vector's name, tensor = \"...\", or radius; attributes: {}", list_of(attribute_names(context.frame)))});
  }

  const OrientedDesc& desc_;
  const std::vector<double>& radii_;
  Turns turns_;
  const data::Column *axes_{}, *exponents_{};
};

// How many standard deviations hold the probability P of a normal distribution in three dimensions:
// P = erf(k / sqrt 2) - sqrt(2 / pi) k exp(-k^2 / 2), by bisection.
double deviations(double probability) {
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 100; ++i) {
    const double k = 0.5 * (low + high);
    const double held = std::erf(k / std::numbers::sqrt2) - std::sqrt(2.0 / std::numbers::pi) * k * std::exp(-0.5 * k * k);
    (held < probability ? low : high) = k;
  }
  return low;
}

// Eigenvectors (columns, right-handed) and eigenvalues of a symmetric tensor, the largest first; nullopt: one is negative.
struct Eigen {
  glm::dmat3 vectors{1};
  glm::dvec3 values{0};
};
std::optional<Eigen> eigen(const glm::dmat3& tensor) {
  const PrincipalAxes p = principal_axes(tensor); // of a positive tensor: lengths are its eigenvalues
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return p.lengths[a] > p.lengths[b]; });
  Eigen out;
  for (int k = 0; k < 3; ++k) {
    out.values[k] = p.lengths[order[static_cast<std::size_t>(k)]];
    out.vectors[k] = p.axes[order[static_cast<std::size_t>(k)]];
    // an axis whose image does not lie along it mixes two eigenvectors of opposite sign
    if (glm::dot(out.vectors[k], tensor * out.vectors[k]) < out.values[k] - 1e-9 * p.longest()) return std::nullopt;
  }
  out.vectors[2] = glm::cross(out.vectors[0], out.vectors[1]);
  return out;
}

// Which entry (row, column) each number of a tensor column is; empty for an order that is none.
std::vector<std::array<int, 2>> tensor_order(std::string_view text) {
  std::vector<std::array<int, 2>> out;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == ' ') {
      ++at;
      continue;
    }
    const std::string_view word = text.substr(at, text.find(' ', at) - at);
    if (word.size() != 2 || word[0] < 'x' || word[0] > 'z' || word[1] < 'x' || word[1] > 'z') return {};
    out.push_back({word[0] - 'x', word[1] - 'x'});
    at += 2;
  }
  std::array<bool, 9> said{};
  for (const auto& [i, j] : out) said[static_cast<std::size_t>(3 * i + j)] = true;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      if (!said[3 * i + j] && !said[3 * j + i]) return {};
  return out;
}

// Axes by tensors: eigenvectors, and square roots of the eigenvalues (of mean squares) or the eigenvalues themselves.
class Tensors {
public:
  Tensors(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics) : desc_(desc.oriented), superquadric_(desc.type == "superquadric") {
    const std::optional<Attribute> found = wanted_attribute(context, *desc_.tensor, true, diagnostics);
    if (!found) return;
    column_ = found->column;
    const std::uint32_t components = found->component ? 1 : column_->components;
    std::string order = desc_.tensor_order ? desc_.tensor_order->value : components == 9 ? "xx xy xz yx yy yz zx zy zz" : column_->name == "anisou" ? "xx yy zz xy xz yz" : "";
    places_ = tensor_order(order);
    factor_ = desc_.scale * (desc_.mean_squares ? deviations(desc_.probability) : 1.0);
    if (components != 6 && components != 9) {
      diagnostics.error(code::wrong_components, desc_.tensor->loc, fmt::format("'{}' of {} has {} numbers a particle; a symmetric tensor has 6 or 9", desc_.tensor->value, context.name, components),
                        {fmt::format("Attributes: {}", list_of(attribute_names(context.frame)))});
    } else if (places_.size() != components) {
      diagnostics.error(code::order_unknown, desc_.tensor_order ? desc_.tensor_order->loc : desc_.tensor->loc,
                        order.empty() ? fmt::format("{} does not say in which order '{}' holds the entries of a tensor", context.name, column_->name)
                                      : fmt::format("'{}' is no order of the {} entries of '{}'", order, components, column_->name),
                        {fmt::format("tensor = {{ attribute = \"{}\", order = \"xx yy zz xy xz yz\" }}", column_->name)});
    }
  }

  bool at(std::uint64_t row, Solid& out, Counts& counts) const {
    glm::dmat3 tensor(0), said(0);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const auto [i, j] = places_[k];
      const double value = column_->number(row, static_cast<std::uint32_t>(k));
      tensor[i][j] += value;
      said[i][j] += 1.0;
      if (i == j) continue;
      tensor[j][i] += value;
      said[j][i] += 1.0;
    }
    for (int i = 0; i < 3; ++i) tensor[i] /= said[i]; // entries that come twice: their mean
    if (!finite(tensor[0]) || !finite(tensor[1]) || !finite(tensor[2])) {
      ++counts.not_finite;
      return false;
    }
    const std::optional<Eigen> e = eigen(tensor);
    if (!e) {
      ++counts.negative;
      return false;
    }
    out.axes = desc_.mean_squares ? glm::sqrt(e->values) : e->values;
    if (!(out.axes.z > flattest * out.axes.x)) {
      ++counts.singular;
      return false;
    }
    out.axes *= factor_;
    glm::dmat3 vectors = e->vectors;
    if (superquadric_) exponents(e->values, out, vectors);
    out.turn = glm::normalize(glm::quat_cast(vectors));
    return true;
  }

private:
  void exponents(const glm::dvec3& values, Solid& out, glm::dmat3& vectors) const {
    const double sum = values.x + values.y + values.z, cl = (values.x - values.y) / sum, cp = 2.0 * (values.y - values.z) / sum;
    const auto power = [&](double c) { return std::max(sharpest_exponent, std::pow(std::max(0.0, 1.0 - c), desc_.sharpness)); };
    const bool linear = cl >= cp;
    out.exponents = linear ? glm::dvec2(power(cl), power(cp)) : glm::dvec2(power(cp), power(cl));
    if (desc_.exponents) out.exponents = *desc_.exponents;
    if (!linear) return;
    vectors = glm::dmat3(vectors[1], vectors[2], vectors[0]);
    out.axes = glm::dvec3(out.axes.y, out.axes.z, out.axes.x);
  }

  const OrientedDesc& desc_;
  bool superquadric_;
  const data::Column* column_{};
  std::vector<std::array<int, 2>> places_{};
  double factor_{1};
};

Verdict judge(const Solid& s, bool plate) {
  const double least = std::min({s.axes.x, s.axes.y, s.axes.z}), most = std::max({s.axes.x, s.axes.y, s.axes.z});
  const auto exponent = [](double e) { return e > 0.0 && e <= 2.0; };
  if (!finite(s.axes) || most > 1e30 || !exponent(s.exponents.x) || !exponent(s.exponents.y)) return Verdict::NoShape;
  if (least < 0.0) return Verdict::NoShape;
  const double middle = s.axes.x + s.axes.y + s.axes.z - least - most;
  return static_cast<float>(plate ? middle : least) == 0.0f ? Verdict::ZeroRadius : Verdict::Draw; // a box of two dimensions is a plate
}

void store(const Solid& s, bool ball, Glyphs& out, std::uint64_t row) {
  const glm::vec3 axes(s.axes);
  const glm::dmat3 turn = glm::mat3_cast(s.turn);
  const glm::dvec3 a(axes), x = turn[0] * a.x, y = turn[1] * a.y, z = turn[2] * a.z;
  glm::vec4* record = out.record(row);
  record[0] = glm::vec4(glm::dvec4(s.turn.x, s.turn.y, s.turn.z, s.turn.w));
  record[1] = glm::vec4(axes, 0.0f);
  if (out.vec4s_per_record > 3) record[2] = glm::vec4(glm::vec2(s.exponents), 0.0f, 0.0f);
  out.bounds[row] = (ball ? std::max({a.x, a.y, a.z}) : glm::length(a)) * glyph_padding;
  out.half[row] = (ball ? glm::sqrt(x * x + y * y + z * z) : glm::abs(x) + glm::abs(y) + glm::abs(z)) * glyph_padding + 1e-6 * out.bounds[row];
  out.finest[row] = std::min({a.x, a.y, a.z});
  if (!(out.finest[row] > 0.0)) out.finest[row] = out.bounds[row];
}

void report(const Counts& c, const FrameContext& context, Diagnostics& diagnostics) {
  const auto warn = [&](std::uint64_t number, std::string_view what) {
    if (number) diagnostics.warning(code::bad_orientation, context.contents, fmt::format("{} of {} particles have {}", number, context.frame.count, what));
  };
  warn(c.unnormalized, "a quaternion that is not of length 1; it was made so");
  warn(c.zero_quaternion, "a quaternion of no length and are left out");
  warn(c.negative, "a tensor with a negative eigenvalue and are left out");
  warn(c.singular, "a singular tensor and are left out");
  warn(c.not_finite, "a tensor that is not finite and are left out");
}

template <class From> void fill(const From& from, const FrameContext& context, const DataDesc& desc, Glyphs& out, Diagnostics& diagnostics) {
  const data::Column& position = *context.frame.find("position");
  Counts counts;
  for (std::uint64_t row = 0; row < context.frame.count; ++row) {
    out.centers[row] = three(position, row);
    Solid solid;
    Counts ignored;
    const bool drawn = context.rows.empty() || context.rows[row];
    if (!from.at(row, solid, drawn ? counts : ignored)) {
      out.verdicts[row] = Verdict::Told;
      continue;
    }
    out.verdicts[row] = judge(solid, desc.type == "box");
    if (out.verdicts[row] == Verdict::Draw) store(solid, desc.type == "ellipsoid", out, row);
  }
  report(counts, context, diagnostics);
}

} // namespace

std::vector<glm::dquat> orientations(const FrameContext& context, const OrientedDesc& desc, std::vector<Verdict>& verdicts, Diagnostics& diagnostics) {
  std::vector<glm::dquat> out(context.frame.count, glm::dquat(1, 0, 0, 0));
  const Turns turns(context, desc, diagnostics);
  if (diagnostics.has_errors()) return out;
  Counts counts, ignored;
  for (std::uint64_t row = 0; row < out.size(); ++row) {
    const bool drawn = context.rows.empty() || context.rows[row];
    if (!turns.at(row, out[row], drawn ? counts : ignored)) verdicts[row] = Verdict::Told;
  }
  report(counts, context, diagnostics);
  return out;
}

Glyphs make_oriented(const FrameContext& context, const DataDesc& desc, const std::vector<double>& radii, Diagnostics& diagnostics) {
  Glyphs out(desc.type, desc.type == "superquadric" ? 4 : 3, context.frame.count);
  if (desc.oriented.tensor) {
    const Tensors tensors(context, desc, diagnostics);
    if (!diagnostics.has_errors()) fill(tensors, context, desc, out, diagnostics);
  } else {
    const Columns columns(context, desc, radii, diagnostics);
    if (!diagnostics.has_errors()) fill(columns, context, desc, out, diagnostics);
  }
  return out;
}

} // namespace mote
