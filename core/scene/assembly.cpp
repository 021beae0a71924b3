// SPDX-License-Identifier: MIT
#include "core/scene/assembly.hpp"

#include "core/scene/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote {
namespace {

// The rigid motion nearest to one that was rounded to a few decimals: the average of the matrix and its inverse
// transpose converges to the orthogonal polar factor (Higham 1986). Nothing when it is off by more than 1e-3.
std::optional<glm::dmat4> made_rigid(const glm::dmat4& m) {
  const glm::dmat3 given(m);
  if (!(std::abs(std::abs(glm::determinant(given)) - 1.0) < 1e-3)) return std::nullopt;
  glm::dmat3 r = given;
  for (int i = 0; i < 6; ++i) r = 0.5 * (r + glm::inverse(glm::transpose(r)));
  double off = 0.0;
  for (int i = 0; i < 3; ++i) off = std::max(off, glm::length(r[i] - given[i]));
  if (!(off < 1e-3)) return std::nullopt;
  glm::dmat4 out(r);
  out[3] = glm::dvec4(glm::dvec3(m[3]), 1.0);
  return out;
}

const data::Assembly* choose(const data::Frame& frame, const std::optional<Located<std::string>>& wanted,
                             const std::string& file, Diagnostics& diagnostics) {
  if (!wanted) return frame.assemblies.empty() ? nullptr : &frame.assemblies.front();
  if (wanted->value == "none") return nullptr;
  std::vector<std::string> names;
  for (const data::Assembly& assembly : frame.assemblies) {
    if (assembly.name == wanted->value) return &assembly;
    names.push_back(assembly.name);
  }
  const std::string what = names.empty() ? fmt::format("{} has no assemblies", file) : fmt::format("{} has no assembly '{}'", file, wanted->value);
  std::vector<std::string> hints{"assembly = \"none\" draws the particles of the file as they are"};
  if (!names.empty()) hints.insert(hints.begin(), fmt::format("Assemblies: {}", list_of(names)));
  diagnostics.error(code::no_assembly, wanted->loc, what, hints);
  return nullptr;
}

// Rows whose text in the assembly's column is one of the part's chains; empty when that is all of them.
std::vector<bool> rows_of(const data::Frame& frame, const data::Assembly& assembly, const data::AssemblyPart& part) {
  const data::Column* column = frame.find(assembly.chain_column);
  const auto* text = column ? std::get_if<data::TextColumn>(&column->values) : nullptr;
  if (part.chains.empty() || !text) return {};
  std::vector<bool> listed(text->dictionary.size());
  for (std::size_t code = 0; code < listed.size(); ++code)
    listed[code] = std::find(part.chains.begin(), part.chains.end(), text->dictionary[code]) != part.chains.end();
  if (std::find(listed.begin(), listed.end(), false) == listed.end()) return {};
  std::vector<bool> rows(frame.count);
  for (std::uint64_t row = 0; row < frame.count; ++row) rows[row] = listed[text->codes[row]];
  return rows;
}

} // namespace

std::vector<Copies> copies_of(const data::Frame& frame, const std::optional<Located<std::string>>& wanted,
                              const std::string& file, Diagnostics& diagnostics) {
  const data::Assembly* assembly = choose(frame, wanted, file, diagnostics);
  if (!assembly || assembly->parts.empty()) return {{{}, {glm::dmat4(1.0)}}};
  std::vector<Copies> all;
  for (const data::AssemblyPart& part : assembly->parts) {
    Copies copies;
    copies.rows = rows_of(frame, *assembly, part);
    if (!copies.rows.empty() && std::find(copies.rows.begin(), copies.rows.end(), true) == copies.rows.end()) continue;
    for (const glm::dmat4& transform : part.transforms) {
      if (const std::optional<glm::dmat4> rigid = made_rigid(transform)) copies.transforms.push_back(*rigid);
      else
        diagnostics.error(code::transform_not_similar, {file},
                          fmt::format("a transform of the assembly '{}' is no rigid motion", assembly->name));
    }
    if (!copies.transforms.empty()) all.push_back(std::move(copies));
  }
  return all;
}

} // namespace mote
