// SPDX-License-Identifier: MIT
// Camera, lights and colors of a scene file.
#include "core/color/parse_color.hpp"
#include "core/color/srgb.hpp"
#include "core/scene/scene_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace mote::scene_parser {
namespace {

using config::Kind;
using config::Node;
using config::Range;
using config::TableReader;

const std::vector<std::string> color_spaces{"srgb", "linear"};
const std::vector<std::string> projections{"perspective", "orthographic"};
const std::vector<std::string> light_kinds{"directional", "point", "spot", "headlight"}; // order of LightKind

glm::dvec3 vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

// Reports a key that stands in the table but belongs to another kind.
void only_for(TableReader& reader, std::string_view key, bool allowed, std::string_view this_kind, std::string_view those) {
  const Node* node = reader.find(key);
  if (!node || allowed) return;
  reader.diagnostics().error(code::key_not_of_kind, node->loc,
                             fmt::format("{} belongs to {}, and this is {}", reader.name_of(key), those, this_kind));
}

} // namespace

bool read_color_space(TableReader& reader, bool inherited) {
  const auto word = reader.word("color_space", color_spaces);
  return word ? *word == 1 : inherited;
}

std::optional<glm::dvec4> as_color(TableReader& reader, const Node& node, std::string_view key, bool linear, bool alpha_allowed) {
  ParsedColor parsed;
  try {
    if (node.kind == Kind::Text) {
      parsed = parse_color(node.text, node.loc);
    } else if (node.kind == Kind::Array && (node.items.size() == 3 || node.items.size() == 4)) {
      std::vector<double> numbers(node.items.size());
      if (!reader.read_numbers(node, key, numbers)) return std::nullopt;
      parsed = parse_color(numbers, node.loc);
    } else {
      reader.wrong_type(node, key, "a color like \"#ff8800\" or [1.0, 0.5, 0.0]");
      return std::nullopt;
    }
  } catch (const Failure& failure) {
    reader.diagnostics().add(failure.diagnostic());
    return std::nullopt;
  }
  if (parsed.has_alpha && !alpha_allowed) {
    reader.diagnostics().error(code::key_not_of_kind, node.loc,
                               fmt::format("{} takes a color without alpha, not '{}'", reader.name_of(key), config::to_text(node)),
                               {"The opacity of particles is the key 'alpha' of their [[data]]"});
    return std::nullopt;
  }
  const std::array<double, 3> rgb = linear ? parsed.rgb : srgb_decode(parsed.rgb);
  return glm::dvec4(rgb[0], rgb[1], rgb[2], parsed.alpha);
}

std::optional<glm::dvec4> read_color(TableReader& reader, std::string_view key, bool linear, bool alpha_allowed) {
  const Node* node = reader.find(key);
  return node ? as_color(reader, *node, key, linear, alpha_allowed) : std::nullopt;
}

CameraDesc read_camera(const Node& table, Diagnostics& diagnostics) {
  TableReader reader(table, "camera", reader_codes, diagnostics);
  CameraDesc c;
  c.loc = table.loc;
  for (std::string_view key : {"up", "eye", "target"}) // where a message about the camera as a whole points to
    if (const Node* node = reader.find(key)) c.loc = node->loc;
  c.projection = static_cast<Projection>(reader.word("projection", projections).value_or(0));
  auto point = [&](std::string_view key, std::optional<glm::dvec3>& out) {
    if (const auto numbers = reader.numbers<3>(key)) out = vec(*numbers);
  };
  point("eye", c.eye);
  point("target", c.target);
  point("up", c.up);
  const bool perspective = c.projection == Projection::Perspective;
  only_for(reader, "fov_y", perspective, "an orthographic camera", "perspective cameras");
  only_for(reader, "height", !perspective, "a perspective camera", "orthographic cameras");
  c.fov_y = reader.number("fov_y", {0.0, 180.0, true, true});
  c.height = reader.number("height", config::positive);
  c.near = reader.number("near", config::positive);
  c.far = reader.number("far", config::positive);
  reader.finish();
  return c;
}

namespace {

void read_direction(TableReader& reader, bool aimed, Light& light) {
  const auto direction = reader.numbers<3>("direction");
  if (!aimed) return;
  const Node* node = reader.find("direction");
  if (!node) {
    reader.missing("direction", "directional and spot lights need the direction of their light's travel");
  } else if (direction && glm::length(vec(*direction)) == 0.0) {
    reader.diagnostics().error(code::light_useless, node->loc, fmt::format("{} is zero", reader.name_of("direction")));
  } else if (direction) {
    light.direction = glm::normalize(vec(*direction));
  }
}

void read_place(TableReader& reader, bool placed, Light& light) {
  const auto position = reader.numbers<3>("position");
  const auto attenuation = reader.numbers<3>("attenuation", config::not_negative);
  if (!placed) return;
  if (!reader.find("position")) reader.missing("position", "point and spot lights need a position");
  if (position) light.position = vec(*position);
  if (!attenuation) return;
  light.attenuation = vec(*attenuation);
  if (light.attenuation == glm::dvec3(0))
    reader.diagnostics().error(code::light_useless, reader.find("attenuation")->loc,
                               fmt::format("{} is zero: 1 / (a + b d + c d^2) needs one number above 0", reader.name_of("attenuation")));
}

void read_cone(TableReader& reader, bool spot, Light& light) {
  const Range cone{0.0, 90.0, false, false};
  const auto inner = reader.number("inner_angle", cone);
  const auto outer = reader.number("outer_angle", {0.0, 90.0, true, false});
  if (!spot) return;
  const double outer_degrees = outer.value_or(30.0);
  const double inner_degrees = inner.value_or(std::min(20.0, outer_degrees));
  light.inner_angle = glm::radians(inner_degrees);
  light.outer_angle = glm::radians(outer_degrees);
  if (inner_degrees > outer_degrees)
    reader.diagnostics().error(code::light_useless, reader.find("inner_angle") ? reader.find("inner_angle")->loc : reader.node().loc,
                               fmt::format("{} ({}) is above the outer angle ({})", reader.name_of("inner_angle"), inner_degrees, outer_degrees));
}

Light read_light(const Node& table, std::size_t index, bool inherited_linear, Diagnostics& diagnostics) {
  TableReader reader(table, fmt::format("light[{}]", index), reader_codes, diagnostics);
  Light light;
  light.name = reader.text("name").value_or(fmt::format("light {}", index));
  const auto kind = reader.word("kind", light_kinds);
  if (!reader.find("kind")) reader.missing("kind", "one of " + list_of(light_kinds));
  light.kind = static_cast<LightKind>(kind.value_or(3));
  const bool linear = read_color_space(reader, inherited_linear);
  if (const auto color = read_color(reader, "color", linear)) light.color = glm::dvec3(*color);
  light.intensity = reader.number("intensity", config::not_negative).value_or(1.0);
  light.shadows = reader.boolean("shadows").value_or(false);
  const bool spot = light.kind == LightKind::Spot;
  const bool placed = spot || light.kind == LightKind::Point;
  const bool aimed = spot || light.kind == LightKind::Directional;
  if (kind) {
    const std::string here = "a " + light_kinds[*kind] + (light.kind == LightKind::Headlight ? "" : " light");
    only_for(reader, "direction", aimed, here, "directional and spot lights");
    only_for(reader, "position", placed, here, "point and spot lights");
    only_for(reader, "attenuation", placed, here, "point and spot lights");
    only_for(reader, "inner_angle", spot, here, "spot lights");
    only_for(reader, "outer_angle", spot, here, "spot lights");
    read_direction(reader, aimed, light);
    read_place(reader, placed, light);
    read_cone(reader, spot, light);
  } else { // the kind is wrong: its keys cannot be judged
    for (std::string_view key : {"direction", "position", "attenuation", "inner_angle", "outer_angle"}) (void)reader.find(key);
  }
  reader.finish();
  return light;
}

} // namespace

std::vector<Light> read_lights(std::span<const Node* const> tables, bool linear, Diagnostics& diagnostics) {
  std::vector<Light> lights;
  std::set<std::string> names;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    lights.push_back(read_light(*tables[i], i, linear, diagnostics));
    if (names.insert(lights.back().name).second) continue;
    const Node* name = tables[i]->find("name");
    diagnostics.error(code::light_name_twice, name ? name->loc : tables[i]->loc,
                      fmt::format("there are two lights named '{}'", lights.back().name));
  }
  return lights;
}

} // namespace mote::scene_parser
