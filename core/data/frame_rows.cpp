// SPDX-License-Identifier: MIT
#include "core/data/frame_rows.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace mote::data {
namespace {

template <class T> std::vector<T> taken(const std::vector<T>& from, std::uint32_t components, std::span<const std::uint32_t> rows) {
  std::vector<T> out(rows.size() * components);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t k = 0; k < components; ++k) out[i * components + k] = from[std::size_t{rows[i]} * components + k];
  return out;
}

void take_bonds(Bonds& bonds, std::uint64_t count, std::span<const std::uint32_t> rows) {
  constexpr std::uint32_t gone = 0xFFFFFFFFu;
  if (bonds.rows.empty()) return;
  std::vector<std::uint32_t> place(count, gone);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<std::uint32_t>(i);
  Bonds kept;
  for (std::size_t b = 0; b < bonds.rows.size(); ++b) {
    const auto [first, second] = std::minmax(place[bonds.rows[b][0]], place[bonds.rows[b][1]]);
    if (second == gone) continue;
    kept.rows.push_back({first, second});
    if (!bonds.types.empty()) kept.types.push_back(bonds.types[b]);
  }
  bonds = std::move(kept);
}

} // namespace

void take_rows(Frame& frame, std::span<const std::uint32_t> rows) {
  for (Column& column : frame.columns)
    std::visit(
        [&](auto& held) {
          if constexpr (std::is_same_v<std::decay_t<decltype(held)>, TextColumn>) held.codes = taken(held.codes, 1, rows);
          else held = taken(held, column.components, rows);
        },
        column.values);
  take_bonds(frame.bonds, frame.count, rows);
  frame.count = rows.size();
}

std::vector<std::int64_t> ids_of(const Frame& frame) {
  const Column* id = frame.find("id");
  if (!id || id->components != 1) return {};
  if (const auto* whole = std::get_if<std::vector<std::int64_t>>(&id->values)) return *whole;
  const auto* reals = std::get_if<std::vector<double>>(&id->values);
  if (!reals) return {};
  std::vector<std::int64_t> ids(reals->size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!(std::abs((*reals)[i]) < 9e15) || (*reals)[i] != std::floor((*reals)[i])) return {};
    ids[i] = static_cast<std::int64_t>((*reals)[i]);
  }
  return ids;
}

} // namespace mote::data
