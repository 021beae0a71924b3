// SPDX-License-Identifier: MIT
// One number per particle, by name: a column, a component of one ("velocity.x", "stress.3"), the
// length of a vector column ("velocity", "force"), the words x, y, z and speed; "type" is the element where a
// file has elements and no types. Text columns count as
// kinds: 0, 1, ... in order of first appearance. Color and radius mappings read particles through this.
#pragma once

#include "core/data/dataset.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mote {

struct Attribute {
  const data::Column* column{};         // never null in what find_attribute() returns
  std::optional<std::uint32_t> component{}; // absent: the only one, or the length of the vector
  [[nodiscard]] bool is_text() const { return column->type() == data::ColumnType::Text; }
  [[nodiscard]] bool is_whole() const { return column->type() == data::ColumnType::Int && (component || column->components == 1); }
  [[nodiscard]] double at(std::uint64_t row) const;
};

// The frame must outlive the attribute.
std::optional<Attribute> find_attribute(const data::Frame& frame, std::string_view name);
std::vector<std::string> attribute_names(const data::Frame& frame);
// Least and largest finite value; nothing when there is none.
std::optional<std::pair<double, double>> finite_range(const Attribute& attribute, std::uint64_t rows);

} // namespace mote
