// SPDX-License-Identifier: MIT
#include "core/scene/bond_sticks.hpp"

#include "core/data/bonds.hpp"
#include "core/data/cell.hpp"
#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mote {

data::Bonds drawn_bonds(const FrameContext& context, const DataDesc& desc, Diagnostics& diagnostics) {
  const data::Frame& frame = context.frame;
  if (frame.bonds.rows.empty() && !frame.find("element")) {
    diagnostics.error(code::no_bonds, desc.loc, fmt::format("{} states no bonds and has no elements to find them by", context.name),
                      {"style = \"spacefill\", or no style, draws the particles alone"});
    return {};
  }
  data::Bonds all = frame.bonds;
  if (3 * all.rows.size() < frame.count && frame.find("element")) { // PDB files state bridges between chains and the like only
    const data::Bonds found = data::bonds_by_distance(frame);
    all.rows.insert(all.rows.end(), found.rows.begin(), found.rows.end());
    std::sort(all.rows.begin(), all.rows.end());
    all.rows.erase(std::unique(all.rows.begin(), all.rows.end()), all.rows.end());
  }
  if (context.rows.empty()) return all;
  std::erase_if(all.rows, [&](const auto& pair) { return !context.rows[pair[0]] || !context.rows[pair[1]]; });
  return all;
}

Drawable bond_sticks(const data::Frame& frame, const data::Bonds& bonds, const std::vector<bool>& group, const std::vector<std::uint32_t>& colors, double radius, bool open) {
  const data::Column& position = *frame.find("position");
  const auto at = [&](std::uint32_t row) { return glm::dvec3(position.number(row, 0), position.number(row, 1), position.number(row, 2)); };
  std::optional<data::MinimumImage> image;
  if (frame.box && data::has_volume(*frame.box)) image.emplace(*frame.box);
  const auto r = static_cast<float>(radius);
  Drawable out{.vec4s_per_record = 3};
  for (std::uint32_t k = 0; k < bonds.rows.size(); ++k) {
    const auto [a, b] = bonds.rows[k];
    if (!group.empty() && (!group[a] || !group[b])) continue;
    const glm::dvec3 way = image ? (*image)(at(b) - at(a)) : at(b) - at(a);
    for (const bool first : {true, false}) {
      const glm::dvec3 h = (first ? 0.25 : -0.25) * way, center = at(first ? a : b) + h;
      const glm::vec3 hf(h);
      const double half = glm::length(glm::dvec3(hf));
      if (!(half > 0.0 && half < largest_coordinate) || !(glm::length(center) < largest_coordinate)) continue;
      out.centers.push_back(center);
      out.radii.push_back(std::hypot(half, double{r}) * glyph_padding);
      out.finest.push_back(double{r});
      out.half.push_back((glm::abs(glm::dvec3(hf)) + double{r}) * glyph_padding);
      out.rest.insert(out.rest.end(), {glm::vec4(hf, r), glm::vec4(r, open ? 1 : 0, 0, 0)});
      out.rows.push_back(k);
      if (!colors.empty()) out.colors.push_back(colors[first ? a : b]);
    }
  }
  return out;
}

double usual_bond_radius(const data::Frame& frame, MoleculeStyle style) {
  const data::Column* position = frame.find("position");
  return (style == MoleculeStyle::Licorice ? 0.25 : 0.12) * (position && position->unit == "nm" ? 0.1 : 1.0); // Angstrom otherwise
}

} // namespace mote
