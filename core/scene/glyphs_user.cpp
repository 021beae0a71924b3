// SPDX-License-Identifier: MIT
// The maker of particles whose type comes from files: attributes by columns, by the scene or by default, an orientation, and bounds
// as the type's own shader says them (UserType::measure).
#include "core/scene/attributes.hpp"
#include "core/scene/codes.hpp"
#include "core/scene/glyphs.hpp"
#include "core/scene/user_type.hpp"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace mote {
namespace {

// Numbers of each row; nothing after an error.
std::vector<double> values_of(const FrameContext& context, const DataDesc& desc, const UserAttribute& wanted, Diagnostics& diagnostics) {
  const std::uint64_t count = context.frame.count;
  std::optional<Attribute> found;
  const auto said = std::find_if(desc.attributes.begin(), desc.attributes.end(), [&](const AttributeDesc& a) { return a.name == wanted.name; });
  if (said != desc.attributes.end()) {
    if (said->constant) return std::vector<double>(count, *said->constant);
    found = wanted_attribute(context, said->column, true, diagnostics);
    if (!found) return {};
  } else {
    found = find_attribute(context.frame, wanted.name);
  }
  if (!found && wanted.otherwise) return std::vector<double>(count, *wanted.otherwise);
  if (!found || found->is_text()) {
    diagnostics.error(found ? code::attribute_is_text : code::attribute_missing, desc.loc,
                      found ? fmt::format("particles of type '{}' need numbers for '{}', which is text in {}", desc.type, wanted.name, context.name)
                            : fmt::format("particles of type '{}' need '{}', and {} has no such attribute", desc.type, wanted.name, context.name),
                      {fmt::format("attributes = {{ {} = \"column\" }} names another one, {} = 1.5 one value for all", wanted.name, wanted.name),
                       fmt::format("Attributes: {}", list_of(attribute_names(context.frame)))});
    return {};
  }
  std::vector<double> out(count);
  for (std::uint64_t row = 0; row < count; ++row) out[row] = found->at(row);
  return out;
}

// Columns into the record: false where one is no finite float.
bool store(const UserType& type, const std::vector<std::vector<double>>& values, std::uint64_t row, glm::vec4* record) {
  int lengths = 0, others = 0;
  bool finite = true;
  for (std::size_t k = 0; k < type.attributes.size(); ++k) {
    const auto value = static_cast<float>(values[k][row]);
    finite = finite && std::isfinite(value);
    if (type.attributes[k].length) record[1][lengths++] = value;
    else record[2][others++] = value;
  }
  return finite;
}

void report(const UserType& type, const std::vector<MeasuredParticle>& measured, Diagnostics& diagnostics) {
  std::uint64_t tried = 0, nan = 0, disagree = 0, outside = 0, rays = 0, nan_rays = 0;
  for (const MeasuredParticle& m : measured) {
    tried += m.rays > 0;
    rays = std::max<std::uint64_t>(rays, m.rays);
    nan += m.nan > 0;
    nan_rays += m.nan;
    disagree += m.disagree * 20 > m.rays; // at edges the two may differ
    outside += m.outside > 0;
  }
  const auto warn = [&](std::uint64_t number, const std::string& what) {
    if (number) diagnostics.warning(code::user_type_wrong, {type.shader()}, fmt::format("type '{}': {} ({} of {} particles, {} rays each)", type.name, what, number, tried, rays));
  };
  warn(nan, fmt::format("hit() gives NaN on {} rays; what it gives NaN for is left out, and magenta with --validation", nan_rays));
  warn(disagree, "hit() and inside() do not agree where the surface is");
  warn(outside, "bound() leaves out points that are inside: particles will be cut off");
}

void measure(const UserType& type, Glyphs& out, Diagnostics& diagnostics) {
  const std::vector<MeasuredParticle> measured = type.measure(out.rest);
  std::vector<MeasuredParticle> drawn;
  for (std::uint64_t row = 0; row < out.verdicts.size(); ++row) {
    if (out.verdicts[row] != Verdict::Draw) continue;
    const glm::dvec3 half = glm::dvec3(measured[row].half);
    const double bound = glm::length(half);
    if (!(half.x >= 0.0 && half.y >= 0.0 && half.z >= 0.0 && bound <= 1e30)) {
      out.verdicts[row] = Verdict::NoShape;
      continue;
    }
    const glm::vec4 q = out.record(row)[0];
    const glm::dmat3 turn = glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z));
    out.bounds[row] = bound * glyph_padding;
    out.half[row] = (glm::abs(turn[0]) * half.x + glm::abs(turn[1]) * half.y + glm::abs(turn[2]) * half.z) * glyph_padding + 1e-6 * bound;
    out.finest[row] = std::max(std::min({half.x, half.y, half.z}), 1e-3 * bound);
    if (static_cast<float>(bound) == 0.0f) out.verdicts[row] = Verdict::ZeroRadius;
    else drawn.push_back(measured[row]);
  }
  report(type, drawn, diagnostics);
}

} // namespace

Glyphs make_user(const FrameContext& context, const DataDesc& desc, const std::vector<double>&, Diagnostics& diagnostics) {
  const UserType& type = *desc.user;
  const std::uint64_t count = context.frame.count;
  Glyphs out(type.key, user_record_vec4s, count);
  std::vector<std::vector<double>> values;
  for (const UserAttribute& a : type.attributes) values.push_back(values_of(context, desc, a, diagnostics));
  const std::vector<glm::dquat> turns = orientations(context, desc.oriented, out.verdicts, diagnostics);
  if (diagnostics.has_errors()) return out;
  if (!type.measure) fail(Exit::Failed, code::user_type, type.loc, fmt::format("the particle type '{}' needs a device to say how large its particles are", type.name));
  const data::Column& position = *context.frame.find("position");
  for (std::uint64_t row = 0; row < count; ++row) {
    out.centers[row] = glm::dvec3(position.number(row, 0), position.number(row, 1), position.number(row, 2));
    glm::vec4* record = out.record(row);
    record[0] = glm::vec4(glm::dvec4(turns[row].x, turns[row].y, turns[row].z, turns[row].w));
    if (!store(type, values, row, record) && out.verdicts[row] == Verdict::Draw) out.verdicts[row] = Verdict::NoShape;
  }
  measure(type, out, diagnostics);
  return out;
}

} // namespace mote
