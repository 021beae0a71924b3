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
  axial.anchor = axial.end ? Anchor::Start : Anchor::Center;
  if (const auto anchor = reader.word("anchor", anchors)) axial.anchor = static_cast<Anchor>(*anchor);
  axial.length = read_radius(reader, "length");
  axial.scale = reader.number("scale", config::positive).value_or(1.0);
}

} // namespace

void read_shape(TableReader& reader, DataDesc& data) {
  if (find_glyph_maker(data.type) == make_axial) read_axial(reader, data);
}

} // namespace mote::scene_parser
