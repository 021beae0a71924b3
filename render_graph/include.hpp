// SPDX-License-Identifier: MIT
// From the text of a graph file to one table with nothing left to look up: files that `include` names
// are merged in, and variables are put in place. parse_graph() reads the result as if one file had said
// it all; every value still knows the file, line and column it came from.
//
// include = "base.toml" or a list: what those files say comes first, in their order. A pass of a name that
// is there already changes that pass: tables (inputs, outputs, params) are merged key by key, everything
// else is replaced; other passes are added behind. `output` and [variables] are replaced likewise; `name`
// and `schema` are each file's own.
//
// [variables] name = value: a string that is "$name" as a whole becomes that value, of whatever type;
// "${name}" within a string becomes its text; "$$" is a dollar sign. Keys are never replaced, nor are
// variables within [variables].
#pragma once

#include "render_graph/graph_desc.hpp"

#include <string>
#include <string_view>

namespace mote::rg {

// Codes: G001, G004, G007 of included files; G027 a ring of includes; G028 a variable that does not exist;
// G029 a variable in the middle of a text that is no text or number, or a '$' that begins nothing.
Table assemble_graph(std::string_view toml, const std::string& file, const ParseOptions& options, Diagnostics& diagnostics);

// Does "--set" name a variable ("variables.side=512")? Those are taken by parse_graph(), all others by
// apply_setting().
bool sets_variable(std::string_view assignment);

} // namespace mote::rg
