// SPDX-License-Identifier: MIT
// The key=value line of extended XYZ (libAtoms/extxyz): bare keys mean true, values may stand in "",
// '', [] or {}; a backslash keeps the next character. Readers of such lines call it; it knows no keys.
#pragma once

#include "core/data/text.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace mote::data {

struct KeyValue {
  std::string key{}, value{};
  std::string_view at{}; // where the key stands in the line
};

// D021 for a quote or bracket that is not closed.
std::vector<KeyValue> parse_key_values(const std::string& file, const Line& line);

// All numbers in a value; brackets and commas between them are ignored. False if anything else is there.
[[nodiscard]] bool parse_reals(std::string_view value, std::vector<double>& out);

} // namespace mote::data
