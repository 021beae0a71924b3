// SPDX-License-Identifier: MIT
// A TOML file as a tree in which every key and every value knows its place. The scene file is read
// through it; `--set path=value` changes the tree before it is read, so that an override meets the same
// checks as a line of the file. No toml++ type leaves this library.
#pragma once

#include "core/base/diagnostic.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mote::config {

enum class Kind : std::uint8_t { Boolean, Integer, Real, Text, Time, Array, Table };
std::string_view to_string(Kind kind); // "a truth value", "an integer", "a number", "a text", ...

struct Member;
struct Node {
  Kind kind{Kind::Table};
  SourceLoc loc{};
  bool boolean{};
  std::int64_t integer{};
  double real{}; // Integer: the same number
  std::string text{};
  std::vector<Node> items{};     // Array
  std::vector<Member> members{}; // Table, in file order

  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
  Node& set(std::string_view key, Node value); // adds or replaces; returns the value in the tree
};
struct Member {
  std::string key{};
  SourceLoc loc{}; // of the key
  Node value{};
};

Node text_node(std::string_view text, SourceLoc loc = {});
Node number_node(double value, SourceLoc loc = {});
Node array_node(std::vector<Node> items, SourceLoc loc = {});
Node table_node(std::vector<std::pair<std::string, Node>> members, SourceLoc loc = {});

// The value as one would write it, for messages; long ones are cut.
std::string to_text(const Node& node);

// Throws Failure (BadInput, `syntax_code`) at the place of the first syntax error.
Node parse(std::string_view text, const std::string& file, std::string_view syntax_code);

// Applies "path=value": path is keys joined by dots; [i] picks an item of an array, and a word behind an array picks
// the table whose `name` it is. The value is TOML; what is not TOML is taken as text, so quotes may be left out
// ("background=#000"). Tables on the way are made as needed. Errors: Usage, place "--set".
void apply_override(Node& root, std::string_view assignment, std::string_view path_code);

} // namespace mote::config
