// SPDX-License-Identifier: MIT
// The transform list of a data set: affine steps composed in double precision, first step first.
#include "core/math/principal_axes.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::scene_parser {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

const std::vector<std::string> step_names{"translate", "rotate", "scale", "shear", "reflect", "matrix"};

glm::dmat4 affine(const glm::dmat3& linear, const glm::dvec3& shift) {
  glm::dmat4 m(linear);
  m[3] = glm::dvec4(shift, 1.0);
  return m;
}
// x -> through + linear (x - through)
glm::dmat4 about(const glm::dmat3& linear, const glm::dvec3& through) { return affine(linear, through - linear * through); }

glm::dvec3 vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

void malformed(TableReader& step, const Node& node, std::string text) {
  step.diagnostics().error(code::transform_form, node.loc, std::move(text));
}

std::optional<glm::dvec3> read_vec(TableReader& step, const Node& node, std::string_view key) {
  std::array<double, 3> out{};
  if (!step.read_numbers(node, key, out)) return std::nullopt;
  return vec(out);
}

// { axis = [x, y, z], angle = degrees, through = [x, y, z] }: counter-clockwise seen against the axis (Rodrigues).
std::optional<glm::dmat4> rotation(TableReader& step, const Node& node) {
  if (node.kind != Kind::Table) {
    step.wrong_type(node, "rotate", "a table { axis = [x, y, z], angle = degrees }");
    return std::nullopt;
  }
  TableReader reader(node, step.name_of("rotate"), step.codes(), step.diagnostics());
  const auto axis = reader.numbers<3>("axis");
  const auto angle = reader.number("angle");
  const auto through = reader.numbers<3>("through");
  if (!node.find("axis")) reader.missing("axis", "write axis = [0, 0, 1]");
  if (!node.find("angle")) reader.missing("angle", "write angle = 90 (degrees)");
  reader.finish();
  if (!axis || !angle) return std::nullopt;
  if (glm::length(vec(*axis)) == 0.0) {
    malformed(step, *node.find("axis"), "the axis of a rotation is zero");
    return std::nullopt;
  }
  const glm::dvec3 a = glm::normalize(vec(*axis));
  const double c = std::cos(glm::radians(*angle)), s = std::sin(glm::radians(*angle));
  const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0); // columns of v -> a x v
  const glm::dmat3 linear = glm::dmat3(c) + s * cross + (1.0 - c) * glm::outerProduct(a, a);
  return about(linear, vec(through.value_or(std::array<double, 3>{})));
}

std::optional<glm::dmat4> scaling(TableReader& step, const Node& node) {
  glm::dvec3 s(1.0);
  if (node.kind == Kind::Array) {
    const auto three = read_vec(step, node, "scale");
    if (!three) return std::nullopt;
    s = *three;
  } else {
    const auto one = step.as_number(node, "scale");
    if (!one) return std::nullopt;
    s = glm::dvec3(*one);
  }
  return affine(glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z), glm::dvec3(0));
}

// { xy = a }: x grows by a times y; likewise xz, yx, yz, zx, zy.
std::optional<glm::dmat4> shear(TableReader& step, const Node& node) {
  if (node.kind != Kind::Table) {
    step.wrong_type(node, "shear", "a table like { xy = 0.5 } (x grows by 0.5 y)");
    return std::nullopt;
  }
  TableReader reader(node, step.name_of("shear"), step.codes(), step.diagnostics());
  glm::dmat3 linear(1.0);
  const std::string_view axes = "xyz";
  for (int to = 0; to < 3; ++to)
    for (int from = 0; from < 3; ++from) {
      if (to == from) continue;
      const std::string key{axes[static_cast<std::size_t>(to)], axes[static_cast<std::size_t>(from)]};
      linear[from][to] = reader.number(key).value_or(0.0);
    }
  reader.finish();
  return affine(linear, glm::dvec3(0));
}

// [nx, ny, nz] or { normal = [...], through = [...] }: the mirror image in that plane (Householder).
std::optional<glm::dmat4> reflection(TableReader& step, const Node& node) {
  std::optional<glm::dvec3> normal;
  glm::dvec3 through(0);
  if (node.kind == Kind::Table) {
    TableReader reader(node, step.name_of("reflect"), step.codes(), step.diagnostics());
    if (const auto n = reader.numbers<3>("normal")) normal = vec(*n);
    if (const auto t = reader.numbers<3>("through")) through = vec(*t);
    if (!node.find("normal")) reader.missing("normal", "write normal = [1, 0, 0]");
    reader.finish();
  } else {
    normal = read_vec(step, node, "reflect");
  }
  if (!normal) return std::nullopt;
  if (glm::length(*normal) == 0.0) {
    malformed(step, node, "the normal of a reflection is zero");
    return std::nullopt;
  }
  const glm::dvec3 n = glm::normalize(*normal);
  return about(glm::dmat3(1.0) - 2.0 * glm::outerProduct(n, n), through);
}

// Three or four rows of four numbers, as one writes a matrix; the fourth row must be 0 0 0 1.
std::optional<glm::dmat4> matrix(TableReader& step, const Node& node) {
  if (node.kind != Kind::Array || (node.items.size() != 3 && node.items.size() != 4)) {
    step.wrong_type(node, "matrix", "3 or 4 rows of 4 numbers");
    return std::nullopt;
  }
  glm::dmat4 m(1.0);
  for (std::size_t row = 0; row < node.items.size(); ++row) {
    std::array<double, 4> numbers{};
    if (!step.read_numbers(node.items[row], fmt::format("matrix[{}]", row), numbers)) return std::nullopt;
    if (row == 3 && numbers != std::array<double, 4>{0, 0, 0, 1}) {
      malformed(step, node.items[row], "the last row of a matrix must be 0 0 0 1: perspective is the camera's business");
      return std::nullopt;
    }
    for (std::size_t column = 0; column < 4; ++column)
      m[static_cast<int>(column)][static_cast<int>(row)] = numbers[column];
  }
  return m;
}

std::optional<glm::dmat4> read_step(TableReader& step, const std::string& name, const Node& value) {
  if (name == "translate") {
    const auto shift = read_vec(step, value, name);
    return shift ? std::optional(affine(glm::dmat3(1.0), *shift)) : std::nullopt;
  }
  if (name == "rotate") return rotation(step, value);
  if (name == "scale") return scaling(step, value);
  if (name == "shear") return shear(step, value);
  if (name == "reflect") return reflection(step, value);
  return matrix(step, value);
}

// Does the map flatten space? Judged by the half axes of what it makes of a sphere, so that small units are fine.
constexpr double flattest = 1e-6;
constexpr std::string_view flat_text = "a sphere would become thinner than a millionth of its length";
bool singular(const glm::dmat4& m) {
  const PrincipalAxes shape = principal_axes(glm::dmat3(m));
  return !(shape.shortest() > flattest * shape.longest());
}

} // namespace

glm::dmat4 read_transform(TableReader& reader, std::string_view key) {
  glm::dmat4 all(1.0);
  const Node* list = reader.find(key);
  if (!list) return all;
  if (list->kind != Kind::Array) {
    reader.wrong_type(*list, key, "a list of steps like [ { translate = [1, 0, 0] } ]");
    return all;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const Node& item = list->items[i];
    TableReader step(item, fmt::format("{}[{}]", reader.name_of(key), i), reader.codes(), reader.diagnostics());
    const bool known = item.kind == Kind::Table && item.members.size() == 1 &&
                       std::find(step_names.begin(), step_names.end(), item.members[0].key) != step_names.end();
    if (!known) {
      const std::string word = item.kind == Kind::Table && !item.members.empty() ? item.members[0].key : "";
      reader.diagnostics().error(code::transform_form, item.loc,
                                 fmt::format("'{}' is not one step of a transform", config::to_text(item)),
                                 {did_you_mean(word, step_names),
                                  fmt::format("A step is a table with one of: {}", list_of(step_names))});
      continue;
    }
    const Node& value = item.members[0].value;
    const std::optional<glm::dmat4> m = read_step(step, item.members[0].key, value);
    if (!m) continue;
    if (singular(*m)) {
      reader.diagnostics().error(code::transform_singular, value.loc,
                                 fmt::format("'{}' flattens space: {}", config::to_text(item), flat_text));
      continue;
    }
    all = *m * all;
  }
  if (singular(all))
    reader.diagnostics().error(code::transform_singular, list->loc, fmt::format("all steps together flatten space: {}", flat_text));
  return all;
}

} // namespace mote::scene_parser
