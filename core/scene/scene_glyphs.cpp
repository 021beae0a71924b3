// SPDX-License-Identifier: MIT
// Keys of [[data]] that belong to particle types with more than a center and a radius.
#include "core/scene/glyphs.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

namespace mote::scene_parser {
namespace {

using config::Kind;
using config::Node;
using config::TableReader;

const std::vector<std::string> anchors{"center", "start", "end"}; // order of Anchor
const std::vector<std::string> ends{"flat", "open", "round"};     // order of Ends

// direction = "column" or [x, y, z]
void read_direction(TableReader& reader, AxialDesc& axial) {
  const Node* node = reader.find("direction");
  if (!node) return;
  if (node->kind == Kind::Text) {
    axial.direction = Located<std::string>{node->text, node->loc};
    return;
  }
  if (node->kind != Kind::Array) return reader.wrong_type(*node, "direction", "a vector attribute's name, or [x, y, z]");
  const auto v = reader.numbers<3>("direction");
  if (!v) return;
  axial.constant = glm::dvec3((*v)[0], (*v)[1], (*v)[2]);
  if (*axial.constant == glm::dvec3(0)) reader.diagnostics().error(code::scene_out_of_range, node->loc, reader.name_of("direction") + " has no length");
}

void read_axial(TableReader& reader, DataDesc& data) {
  AxialDesc& axial = data.axial;
  read_direction(reader, axial);
  if (const auto end = reader.text("end")) axial.end = Located<std::string>{*end, reader.find("end")->loc};
  if (axial.end && (axial.direction || axial.constant))
    reader.diagnostics().error(code::key_not_of_kind, axial.end->loc, reader.name_of("end") + " and direction both say where the axis goes; one of them is enough");
  if (axial.end) axial.anchor = Anchor::Start;
  if (const auto anchor = reader.word("anchor", anchors)) axial.anchor = static_cast<Anchor>(*anchor);
  axial.length = read_radius(reader, "length");
  axial.scale = reader.number("scale", config::positive).value_or(1.0);
  if (data.type == "cylinder" || data.type == "cone") axial.radius_end = read_radius(reader, "radius_end");
  if (data.type == "cylinder") {
    if (const auto word = reader.word("ends", ends)) axial.ends = static_cast<Ends>(*word);
    if (axial.ends == Ends::Round && axial.radius_end.rule != RadiusRule::Auto)
      reader.diagnostics().error(code::key_not_of_kind, axial.radius_end.loc, reader.name_of("radius_end") + " does not go with ends = \"round\", which take one radius");
  }
  if (data.type == "arrow") {
    axial.head_radius = read_radius(reader, "head_radius");
    axial.head_length = read_radius(reader, "head_length");
  }
}

// a vector's name, or [a, b, c]
void read_axes(TableReader& reader, OrientedDesc& oriented) {
  const Node* node = reader.find("axes");
  if (!node) return;
  if (node->kind == Kind::Text) {
    oriented.axes = Located<std::string>{node->text, node->loc};
    return;
  }
  if (node->kind != Kind::Array) return reader.wrong_type(*node, "axes", "a vector attribute's name, or [a, b, c]");
  if (const auto v = reader.numbers<3>("axes", config::not_negative)) oriented.constant_axes = glm::dvec3((*v)[0], (*v)[1], (*v)[2]);
}

const std::vector<std::string> quaternion_orders{"xyzw", "wxyz"};

// an attribute's name, or { attribute, order }
void read_orientation(TableReader& outer, OrientedDesc& oriented) {
  const Node* node = outer.find("orientation");
  if (!node) return;
  if (node->kind == Kind::Text) {
    oriented.orientation = Located<std::string>{node->text, node->loc};
    return;
  }
  if (node->kind != Kind::Table) return outer.wrong_type(*node, "orientation", "an attribute's name, or { attribute, order }");
  TableReader reader(*node, outer.name_of("orientation"), reader_codes, outer.diagnostics());
  if (const auto name = reader.text("attribute")) oriented.orientation = Located<std::string>{*name, reader.find("attribute")->loc};
  else if (!reader.find("attribute")) reader.missing("attribute", "four numbers a particle");
  if (const auto order = reader.word("order", quaternion_orders)) oriented.order = Located<std::string>{quaternion_orders[*order], reader.find("order")->loc};
  reader.finish();
}

const std::vector<std::string> tensor_kinds{"mean_squares", "axes"};

// an attribute's name, or { attribute, order, kind, probability, sharpness }
void read_tensor(TableReader& outer, OrientedDesc& oriented) {
  const Node* node = outer.find("tensor");
  if (!node) return;
  if (node->kind == Kind::Text) {
    oriented.tensor = Located<std::string>{node->text, node->loc};
    return;
  }
  if (node->kind != Kind::Table) return outer.wrong_type(*node, "tensor", "an attribute's name, or { attribute, order, kind, probability, sharpness }");
  TableReader reader(*node, outer.name_of("tensor"), reader_codes, outer.diagnostics());
  if (const auto name = reader.text("attribute")) oriented.tensor = Located<std::string>{*name, reader.find("attribute")->loc};
  else if (!reader.find("attribute")) reader.missing("attribute", "six or nine numbers a particle");
  if (const auto order = reader.text("order")) oriented.tensor_order = Located<std::string>{*order, reader.find("order")->loc};
  if (const auto kind = reader.word("kind", tensor_kinds)) oriented.mean_squares = *kind == 0;
  if (const auto p = reader.number("probability", {0.0, 1.0, true, true})) oriented.probability = *p;
  if (const auto s = reader.number("sharpness", config::not_negative)) oriented.sharpness = *s;
  reader.finish();
}

// [e1, e2], or the name of an attribute of two numbers
void read_exponents(TableReader& reader, OrientedDesc& oriented) {
  const Node* node = reader.find("exponents");
  if (!node) return;
  if (node->kind == Kind::Text) {
    oriented.exponents_of = Located<std::string>{node->text, node->loc};
    return;
  }
  if (node->kind != Kind::Array) return reader.wrong_type(*node, "exponents", "[e1, e2], or an attribute's name");
  if (const auto v = reader.numbers<2>("exponents", {0.0, 2.0, true})) oriented.exponents = glm::dvec2((*v)[0], (*v)[1]);
}

void read_oriented(TableReader& reader, DataDesc& data) {
  OrientedDesc& oriented = data.oriented;
  read_axes(reader, oriented);
  read_orientation(reader, oriented);
  read_tensor(reader, oriented);
  if (data.type == "superquadric") read_exponents(reader, oriented);
  oriented.scale = reader.number("scale", config::positive).value_or(1.0);
  const bool columns = oriented.axes || oriented.constant_axes || oriented.orientation;
  if (oriented.tensor && columns)
    reader.diagnostics().error(code::key_not_of_kind, oriented.tensor->loc, reader.name_of("tensor") + " says axes and orientation already; axes and orientation are for data without one");
}

} // namespace

namespace {
// attributes = { name = "column" or a number }, of a type from files
void read_attributes(TableReader& outer, DataDesc& data) {
  const Node* table = outer.table("attributes");
  if (!table) return;
  TableReader reader(*table, outer.name_of("attributes"), reader_codes, outer.diagnostics());
  for (const UserAttribute& wanted : data.user->attributes) {
    const Node* node = reader.find(wanted.name);
    if (!node) continue;
    AttributeDesc said{.name = wanted.name};
    if (node->kind == Kind::Text) said.column = {node->text, node->loc};
    else if (const auto number = reader.as_number(*node, wanted.name)) said.constant = *number;
    else continue;
    data.attributes.push_back(std::move(said));
  }
  reader.finish();
}
} // namespace

void read_shape(TableReader& reader, DataDesc& data) {
  if (data.user) {
    read_orientation(reader, data.oriented);
    read_attributes(reader, data);
    if (data.radius.rule != RadiusRule::Auto)
      reader.diagnostics().error(code::key_not_of_kind, data.radius.loc, fmt::format("{} is not of type '{}', which takes attributes = {{ ... }}", reader.name_of("radius"), data.type));
    return;
  }
  if (find_glyph_maker(data.type) == make_axial) read_axial(reader, data);
  if (find_glyph_maker(data.type) == make_oriented) read_oriented(reader, data);
  if (find_glyph_maker(data.type) == make_polyline)
    if (const auto chain = reader.text("chain")) data.polyline.chain = Located<std::string>{*chain, reader.find("chain")->loc};
}

} // namespace mote::scene_parser
