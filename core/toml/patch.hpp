// SPDX-License-Identifier: MIT
// Changes a value in the text of a TOML file and nothing else: comments, order and blanks of all other lines stay as they
// are. The window writes what a user changed back with it. Pure: text in, text out.
#pragma once

#include "core/base/diagnostic.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace mote::config {

// `text` with the value at `path` replaced by `value` (TOML; words that are none are taken as text, as --set does). Paths as
// in apply_override: "light.sun.intensity", "data[0].color". A key that is not there is added to its table, a table that is
// not there is added at the end. Throws Failure (BadInput, `code`) where the text is no TOML or the path leads through
// something that is no table; the result says what was asked, or nothing is changed.
std::string patched(std::string_view text, std::string_view path, std::string_view value, std::string_view code);

// `text` with `values` (TOML, joined by commas) behind what the array at `path` holds; an array that is not there is made. Throws as patched() does.
std::string appended(std::string_view text, std::string_view path, std::string_view values, std::string_view code);

// `text` without the line of the key at `path`, which must stand in a line of its own. Throws as patched() does; a key that
// is not there leaves the text as it is.
std::string removed(std::string_view text, std::string_view path, std::string_view code);

// The text of the value at `path` as it is written there; nothing where there is none.
std::optional<std::string> written_value(std::string_view text, std::string_view path, std::string_view code);

} // namespace mote::config
