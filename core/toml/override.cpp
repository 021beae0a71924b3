// SPDX-License-Identifier: MIT
#include "core/toml/node.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace mote::config {
namespace {

const SourceLoc command_line{"--set"};

struct Segment {
  std::string key{};                  // empty: an index
  std::optional<std::size_t> index{};
};

[[noreturn]] void refuse(std::string_view code, std::string_view assignment, std::string text, std::string hint = {}) {
  fail(Exit::Usage, code, command_line, fmt::format("'{}': {}", assignment, text), {std::move(hint)});
}

// "light[0].intensity" -> light, [0], intensity
std::vector<Segment> split(std::string_view path, std::string_view code, std::string_view assignment) {
  std::vector<Segment> out;
  for (std::size_t at = 0; at < path.size();) {
    if (path[at] == '[') {
      const std::size_t close = path.find(']', at);
      std::size_t index = 0;
      const char* last = path.data() + (close == std::string_view::npos ? path.size() : close);
      const auto [end, error] = std::from_chars(path.data() + at + 1, last, index);
      if (close == std::string_view::npos || error != std::errc{} || end != last)
        refuse(code, assignment, fmt::format("'{}' is not an index like [0]", path.substr(at)));
      out.push_back({{}, index});
      at = close + 1;
      if (at < path.size() && path[at] == '.') ++at;
      continue;
    }
    const std::size_t stop = std::min(path.find_first_of(".[", at), path.size());
    if (stop == at) refuse(code, assignment, "a key is missing in the path");
    out.push_back({std::string(path.substr(at, stop - at)), {}});
    at = stop + (stop < path.size() && path[stop] == '.' ? 1 : 0);
  }
  if (out.empty() || path.back() == '.') refuse(code, assignment, "a key is missing in the path");
  return out;
}

Node& item_of(Node& array, const Segment& segment, const std::string& walked, std::string_view code,
              std::string_view assignment) {
  if (segment.index) {
    if (*segment.index < array.items.size()) return array.items[*segment.index];
    refuse(code, assignment, fmt::format("{} has {} entries, numbered from 0", walked, array.items.size()));
  }
  std::vector<std::string> names;
  for (Node& item : array.items) {
    const Node* name = item.find("name");
    if (!name || name->kind != Kind::Text) continue;
    if (name->text == segment.key) return item;
    names.push_back(name->text);
  }
  refuse(code, assignment, fmt::format("{} has no entry named '{}'; names: {}", walked, segment.key, list_of(names)),
         fmt::format("Entries can be numbered, too: {}[0] to {}[{}]", walked, walked,
                     array.items.empty() ? 0 : array.items.size() - 1));
}

Node parse_value(std::string_view word, std::string_view code) {
  Node value;
  try {
    value = parse("value = " + std::string(word), "--set", code).members.at(0).value;
  } catch (const Failure&) {
    value = text_node(word);
  }
  value.loc = command_line;
  return value;
}

void relocate(Node& node) { // places inside the little file that parse_value made mean nothing
  node.loc = command_line;
  for (Node& item : node.items) relocate(item);
  for (Member& member : node.members) {
    member.loc = command_line;
    relocate(member.value);
  }
}

} // namespace

void apply_override(Node& root, std::string_view assignment, std::string_view path_code) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) refuse(path_code, assignment, "there is no '='; write path=value");
  const std::vector<Segment> path = split(assignment.substr(0, equals), path_code, assignment);
  Node value = parse_value(assignment.substr(equals + 1), path_code);
  relocate(value);

  Node* at = &root;
  std::string walked;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Segment& segment = path[i];
    const bool last = i + 1 == path.size();
    if (at->kind == Kind::Array) {
      at = &item_of(*at, segment, walked, path_code, assignment);
      if (last) *at = value;
    } else if (at->kind == Kind::Table && !segment.index) {
      Node* next = at->find(segment.key);
      if (last) at->set(segment.key, value);
      else at = next ? next : &at->set(segment.key, table_node({}, command_line));
    } else {
      refuse(path_code, assignment, fmt::format("{} is {} and has nothing inside", walked, to_string(at->kind)));
    }
    walked += segment.index ? fmt::format("[{}]", *segment.index) : (walked.empty() ? "" : ".") + segment.key;
  }
}

} // namespace mote::config
