// SPDX-License-Identifier: MIT
// The parameters of one pass (or of a nested table): typed, located, with defaults. A pass asks for
// everything it knows in declare(); a key that nobody asked for is an error (G021) that lists what
// exists. A wrong value is reported at its place and the default is used, so that all problems of a
// file come out together. The same calls, run on an empty table, describe the kind for `--kinds`.
//
//   exposure_ = params.number("exposure", 0.0, {.min = -20, .max = 20}, "stops");
//   mode_     = params.word("mode", "fast", {"fast", "exact"}, "how it is done");
//   if (params.has("samples")) { Params s = params.table("samples"); n_ = s.integer("n", 16, {.min = 1}); }
//   for (const LocatedString& type : params.draw()) ...   // draw = ["sphere", "cone"] of the pass
//
// Codes: G020 wrong type, G021 unknown, G022 out of range, G023 not one of the words, G024 not a
// color, G025 missing, G030 `draw` given to a kind that draws nothing. No device, no TOML types.
#pragma once

#include "core/gpu/types.hpp"
#include "render_graph/value.hpp"

#include <array>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>

namespace mote::rg {

// Inclusive bounds. `open_min` excludes min itself ("above 0").
struct Range {
  double min{-std::numeric_limits<double>::infinity()};
  double max{std::numeric_limits<double>::infinity()};
  bool open_min{};
};

// One parameter as a kind asked for it, for `--kinds` and the documentation.
struct ParamInfo {
  std::string name{};     // nested ones with dots: "samples.n"
  std::string type{};     // "number", "integer", "boolean", "string", "color", "3 numbers", "strings", "table", "tables"
  std::string fallback{}; // default, as TOML writes it; empty: none
  std::string range{};    // ">= 0, <= 1", "fast, exact", or empty
  std::string summary{};
};

// A named list of what a pass draws; `draw = [...]` is the list named "", `draw = { a = [...] }` gives several.
struct DrawList {
  std::string name{};
  SourceLoc loc{};
  std::vector<LocatedString> items{};
};

class Params {
public:
  Params(); // empty, without a file: what declare() asks of it describes the kind
  // `diagnostics` must outlive this object and its copies.
  Params(Table values, std::vector<DrawList> draw, std::string pass, std::string kind, SourceLoc pass_loc,
         Diagnostics& diagnostics);

  [[nodiscard]] bool has(std::string_view name) const;      // does not count as reading
  [[nodiscard]] bool is_table(std::string_view name) const; // n = 16 or n = { ... }
  [[nodiscard]] bool is_string(std::string_view name) const;
  [[nodiscard]] const std::string& pass() const;
  [[nodiscard]] const std::string& kind() const;
  [[nodiscard]] SourceLoc loc(std::string_view name) const; // of the value; of the table if absent

  double number(std::string_view name, double fallback, Range range = {}, std::string_view summary = {});
  std::int64_t integer(std::string_view name, std::int64_t fallback, Range range = {}, std::string_view summary = {});
  bool boolean(std::string_view name, bool fallback, std::string_view summary = {});
  std::string string(std::string_view name, std::string_view fallback, std::string_view summary = {});
  std::string word(std::string_view name, std::string_view fallback, std::span<const std::string> words, std::string_view summary = {});
  std::string word(std::string_view name, std::string_view fallback, std::initializer_list<std::string_view> words, std::string_view summary = {});
  // A path; a relative one is taken from the folder of the file that says it (of the working folder for --set).
  std::string path(std::string_view name, std::string_view fallback, std::string_view summary = {});
  // "#rgb", "#rrggbb", "#rrggbbaa", [r, g, b] or [r, g, b, a], as written (0..1, no conversion of color space).
  gpu::Color color(std::string_view name, gpu::Color fallback, std::string_view summary = {});
  // Exactly as many numbers as the default has.
  template <std::size_t N> std::array<double, N> vec(std::string_view name, const std::array<double, N>& fallback, std::string_view summary = {}) {
    std::array<double, N> out = fallback;
    vec_values(name, out, summary);
    return out;
  }
  std::vector<double> numbers(std::string_view name, std::vector<double> fallback, std::string_view summary = {});
  std::vector<std::string> strings(std::string_view name, std::vector<std::string> fallback, std::string_view summary = {}); // a single string is a list of one
  Params table(std::string_view name, std::string_view summary = {});               // empty if absent
  std::vector<Params> tables(std::string_view name, std::string_view summary = {}); // array of tables; a single table is a list of one
  void require(std::string_view name); // G025 if absent

  // The pass's draw list; asking tells that the kind draws. Absent: empty.
  std::vector<LocatedString> draw(std::string_view list = {});
  [[nodiscard]] const std::vector<DrawList>& draw_lists();

  // A pass's own complaint about a parameter, located at it: "pass 'p' parameter 'n' <text>".
  void error(std::string_view code, std::string_view name, std::string_view text, std::vector<std::string> hints = {});
  void error_at(std::string_view code, const SourceLoc& loc, std::string text, std::vector<std::string> hints = {});

  // For the compiler: reports unread keys (G021) and an unasked draw list (G030). Once, after declare().
  void finish();
  [[nodiscard]] const std::vector<ParamInfo>& asked() const; // all levels, in order of asking
  [[nodiscard]] bool asked_draw() const;

private:
  struct Shared;
  Params(std::shared_ptr<Shared> shared, Table values, SourceLoc loc, std::string prefix);
  const Value* ask(std::string_view name, std::string_view type, std::string fallback, std::string range, std::string_view summary);
  void wrong_type(std::string_view name, const Value& value, std::string_view wanted);
  bool in_range(std::string_view name, double value, const Range& range, const Value& at);
  void vec_values(std::string_view name, std::span<double> values, std::string_view summary);
  struct Level;
  void finish_level(const Level& level);
  std::shared_ptr<Shared> shared_;
  std::shared_ptr<Level> level_;
};

} // namespace mote::rg
