// SPDX-License-Identifier: MIT
// What a graph file says: plain structs, every name and value with its place. Made by parse_graph(),
// changed only by apply_setting() (the command line's --set), read by compile(). It knows no kinds:
// whether a kind or slot exists is the compiler's business.
#pragma once

#include "render_graph/params.hpp"
#include "render_graph/slots.hpp"
#include "render_graph/value.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mote::rg {

struct InputDesc {
  LocatedString slot{};
  LocatedString source{}; // "pass.slot"
};

// What the file changes of an output; everything absent stays as the kind made it.
struct OutputDesc {
  LocatedString slot{};
  std::optional<LocatedString> format{};
  std::optional<SizeSpec> size{};
  SourceLoc size_loc{};
  std::optional<std::uint32_t> layers{}, mips{};
  std::optional<LocatedString> dimension{}; // "1d", "2d", "3d"
  std::optional<std::uint64_t> count{};     // buffers: records
  SourceLoc shape_loc{};                    // of layers, mips, dimension or count: the last one given
};

struct PassDesc {
  LocatedString name{}, kind{};
  SourceLoc loc{}; // of [[pass]]
  bool enabled{true};
  SourceLoc enabled_loc{};
  std::vector<DrawList> draw{};
  std::vector<InputDesc> inputs{};
  std::vector<OutputDesc> outputs{};
  Table params{};
};

struct GraphDesc {
  std::string file{};
  LocatedString name{};   // the file's stem if it gives none
  LocatedString output{}; // "display.color"
  std::vector<PassDesc> passes{}; // in file order
};

// Splits "pass.slot". Nothing if it is anything else.
struct Source { std::string pass{}, slot{}; };
std::optional<Source> split_source(std::string_view text);
bool valid_name(std::string_view text); // [a-z][a-z0-9_]*

struct GraphText {
  std::string file{}, text{};
};
// A file relative to the folder of the file `from`.
std::optional<GraphText> read_beside(const std::string& name, const std::string& from);

struct ParseOptions {
  // What `include` reads: `name` as written in the file `from`. Default: read_beside().
  std::function<std::optional<GraphText>(const std::string& name, const std::string& from)> read{};
  std::vector<std::string> settings{}; // of which "variables.NAME=VALUE" count here
};

// The text of a graph file, with what it includes (include.hpp). All problems go to `diagnostics` (G001..G009,
// G027..G029, G040, G043); what could be understood is returned, so that the compiler can report the rest together
// with them.
GraphDesc parse_graph(std::string_view toml, const std::string& file, Diagnostics& diagnostics, const ParseOptions& options = {});
// The same from a file (G007 if it cannot be read).
GraphDesc load_graph(const std::string& path, Diagnostics& diagnostics, const ParseOptions& options = {});

// "pass.param=value", "pass.table.key=value" or "pass.enabled=false": what --set says (settings of variables are
// passed over: parse_graph() has taken them). The value is TOML, or else a string. G008 malformed, G026 no such pass; unknown parameters are found by compile().
void apply_setting(GraphDesc& graph, std::string_view assignment, Diagnostics& diagnostics);

} // namespace mote::rg
