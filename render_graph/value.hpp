// SPDX-License-Identifier: MIT
// What a TOML file says, as plain values that know their place. Tables keep the order of the file.
//
// core/toml reads the text; everything after it (includes, variables, GraphDesc, Params, command-line
// overrides) works on these values, so that a value from `--set`, from an included file or from a
// variable is like any other, with a place of its own.
#pragma once

#include "core/base/diagnostic.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mote::rg {

struct Value;
struct Entry;
using Array = std::vector<Value>;
using Table = std::vector<Entry>; // in the order of the file, keys unique

struct Value {
  SourceLoc loc{};
  std::variant<bool, std::int64_t, double, std::string, Array, Table> data{};
};
struct Entry {
  std::string key{};
  SourceLoc key_loc{};
  Value value{};
};
struct LocatedString {
  std::string text{};
  SourceLoc loc{};
};

std::string_view type_name(const Value& value); // "a number", "an integer", "a string", "an array", ...
std::string to_text(const Value& value);        // as TOML would write it; strings in double quotes
const Entry* find(const Table& table, std::string_view key);
std::vector<std::string> keys_of(const Table& table);

// The whole file as a table. A syntax error is G001 at its place, a date or time is G004, and a file
// that is not UTF-8 is G001; the table then holds what could be read (nothing after a syntax error).
Table parse_toml_text(std::string_view text, const std::string& file, Diagnostics& diagnostics);

// The value of a command-line setting: a TOML value if it is one ("0.5", "[1, 2]", "true"), else the
// text itself as a string ("ACES SDR"). Everything in it is located at `loc`.
Value parse_setting(std::string_view text, const SourceLoc& loc);

} // namespace mote::rg
