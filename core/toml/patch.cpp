// SPDX-License-Identifier: MIT
// Places come from the located tree, ends of values from a small scanner. What comes out is parsed again and compared with
// the tree that --set would make: a text that means anything else is never returned.
#include "core/toml/patch.hpp"

#include "core/toml/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace mote::config {
namespace {

constexpr std::string_view name_of_text = "scene";

// A line and a column, which counts code points from 1, as a place in the text.
std::size_t offset_of(std::string_view text, const SourceLoc& loc) {
  std::size_t at = 0;
  for (std::uint64_t line = 1; line < loc.line; ++line) {
    at = text.find('\n', at);
    if (at == std::string_view::npos) return text.size();
    ++at;
  }
  for (std::uint64_t column = 1; column < loc.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u) ++at;
  }
  return at;
}

std::size_t line_end(std::string_view text, std::size_t at) { return std::min(text.find('\n', at), text.size()); }

// Behind a string that begins at `at`.
std::size_t string_end(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool long_one = text.substr(at, 3) == std::string(3, quote);
  const std::string_view closing = text.substr(at, long_one ? 3 : 1);
  for (at += closing.size(); at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') ++at;
    else if (text.substr(at, closing.size()) == closing) {
      at += closing.size();
      while (long_one && at < text.size() && text[at] == quote) ++at; // up to two more belong to it
      return at;
    }
  }
  return text.size();
}

// Behind the value that begins at `at`.
std::size_t value_end(std::string_view text, std::size_t at) {
  if (at >= text.size()) return text.size();
  if (text[at] == '"' || text[at] == '\'') return string_end(text, at);
  if (text[at] == '[' || text[at] == '{') {
    int depth = 0;
    while (at < text.size()) {
      const char c = text[at];
      if (c == '"' || c == '\'') {
        at = string_end(text, at);
        continue;
      }
      if (c == '#') {
        at = line_end(text, at);
        continue;
      }
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      ++at;
      if (depth == 0) return at;
    }
    return at;
  }
  std::size_t end = std::min(text.find_first_of(",]}#\r\n", at), text.size());
  while (end > at && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
  return end;
}

struct Word {
  std::string key{};
  bool index{};
};
std::vector<Word> words_of(std::string_view path) {
  std::vector<Word> out;
  for (std::size_t at = 0; at < path.size();) {
    if (path[at] == '.') ++at;
    if (at < path.size() && path[at] == '[') {
      const std::size_t close = std::min(path.find(']', at), path.size());
      out.push_back({std::string(path.substr(at + 1, close - at - 1)), true});
      at = std::min(close + 1, path.size());
      continue;
    }
    const std::size_t stop = std::min(path.find_first_of(".[", at), path.size());
    out.push_back({std::string(path.substr(at, stop - at)), false});
    at = std::max(stop, at + 1);
  }
  return out;
}

const Node* child(const Node& node, const Word& word) {
  if (node.kind == Kind::Table) return word.index ? nullptr : node.find(word.key);
  if (node.kind != Kind::Array) return nullptr;
  if (word.index) {
    for (std::size_t i = 0; i < node.items.size(); ++i)
      if (fmt::format("{}", i) == word.key) return &node.items[i];
    return nullptr;
  }
  for (const Node& item : node.items)
    if (const Node* name = item.find("name"); name && name->text == word.key) return &item;
  return nullptr;
}

bool same(const Node& a, const Node& b) {
  if (a.kind == Kind::Integer && b.kind == Kind::Real) return a.real == b.real;
  if (a.kind == Kind::Real && b.kind == Kind::Integer) return a.real == b.real;
  if (a.kind != b.kind || a.boolean != b.boolean || a.text != b.text || a.items.size() != b.items.size() || a.members.size() != b.members.size()) return false;
  if (a.kind == Kind::Real && a.real != b.real && !(a.real != a.real && b.real != b.real)) return false;
  if (a.kind == Kind::Integer && a.integer != b.integer) return false;
  for (std::size_t i = 0; i < a.items.size(); ++i)
    if (!same(a.items[i], b.items[i])) return false;
  return std::all_of(a.members.begin(), a.members.end(), [&](const Member& m) {
    const Node* other = b.find(m.key);
    return other && same(m.value, *other);
  });
}

class Patch {
public:
  Patch(std::string_view text, std::string_view path, std::string_view value, std::string_view code)
      : text_(text), path_(path), code_(code), root_(parse(text, std::string(name_of_text), code)), words_(words_of(path)), value_(as_toml(value)) {}

  std::string run() {
    std::string out = changed();
    Node wanted = root_;
    apply_override(wanted, fmt::format("{}={}", path_, value_), code_);
    if (!same(wanted, parse(out, std::string(name_of_text), code_))) refuse("it cannot be changed where it stands");
    return out;
  }

  // `values`: what is put behind the items of the array at the path.
  std::string append(std::string_view values) {
    const Node* at = &root_;
    for (const Word& word : words_)
      if (at) at = child(*at, word);
    const std::string list = "[ " + std::string(values) + " ]";
    const Node added_items = parse("list = " + list, std::string(name_of_text), code_);
    if (!at) return Patch(text_, path_, list, code_).run();
    if (at->kind != Kind::Array || !starts_with(*at, '[') || has_header(*at)) refuse("it is no list");
    Node wanted = *at;
    for (const Node& item : added_items.find("list")->items) wanted.items.push_back(item);
    const std::size_t begin = offset_of(text_, at->loc);
    const std::size_t end = at->items.empty() ? value_end(text_, begin) - 1 : value_end(text_, offset_of(text_, at->items.back().loc));
    std::string out = spliced(end, end, (at->items.empty() ? " " : ", ") + std::string(values) + (at->items.empty() ? " " : ""));
    const Node made = parse(out, std::string(name_of_text), code_);
    const Node* now = &made;
    for (const Word& word : words_)
      if (now) now = child(*now, word);
    if (!now || !same(wanted, *now)) refuse("it cannot be changed where it stands");
    return out;
  }

private:
  std::string changed() {
    const Node* at = &root_;
    const Node* table = &root_; // the innermost one that has a place to add lines to
    std::size_t walked = 0, table_walked = 0;
    for (; walked < words_.size(); ++walked) {
      const Node* next = child(*at, words_[walked]);
      if (!next) break;
      at = next;
      if (at->kind == Kind::Table && (starts_with(*at, '[') || starts_with(*at, '{'))) {
        table = at;
        table_walked = walked + 1;
      }
    }
    if (walked == words_.size()) return replaced(*at);
    if (at->kind != Kind::Table) refuse(fmt::format("'{}' is not there", words_[walked].key));
    return added(*table, table_walked);
  }

  std::string replaced(const Node& node) {
    const std::size_t begin = offset_of(text_, node.loc);
    const bool header = starts_with(node, '[') && (node.kind == Kind::Table || (node.kind == Kind::Array && text_.substr(begin, 2) == "[[" && !node.items.empty() && node.items[0].kind == Kind::Table));
    if (header) refuse("it is a table of several lines");
    return spliced(begin, value_end(text_, begin), value_);
  }

  std::string added(const Node& table, std::size_t walked) {
    std::string key;
    for (std::size_t i = walked; i < words_.size(); ++i) {
      if (words_[i].index) refuse(fmt::format("there is no entry [{}]", words_[i].key));
      key += (key.empty() ? "" : ".") + words_[i].key;
    }
    const std::string assignment = key + " = " + value_;
    if (&table != &root_ && starts_with(table, '{')) {
      const std::size_t begin = offset_of(text_, table.loc), close = value_end(text_, begin) - 1, last = last_value(table, begin + 1);
      return table.members.empty() ? spliced(begin, close + 1, "{ " + assignment + " }") : spliced(last, last, ", " + assignment);
    }
    if (&table != &root_) {
      const std::size_t end = line_end(text_, last_value(table, offset_of(text_, table.loc)));
      return spliced(end, end, "\n" + assignment);
    }
    if (words_.size() - walked > 1) { // a table of its own, at the end
      const std::size_t dot = key.rfind('.');
      const std::string gap = text_.empty() ? "" : text_.ends_with('\n') ? "\n" : "\n\n";
      return spliced(text_.size(), text_.size(), fmt::format("{}[{}]\n{} = {}\n", gap, key.substr(0, dot), key.substr(dot + 1), value_));
    }
    std::size_t end = 0; // behind the last key of the top
    for (const Member& m : root_.members)
      if (!has_header(m.value)) end = std::max(end, line_end(text_, last_value_of(m.value, offset_of(text_, m.value.loc))));
    return end == 0 ? spliced(0, 0, assignment + "\n") : spliced(end, end, "\n" + assignment);
  }

  [[nodiscard]] bool starts_with(const Node& node, char c) const {
    const std::size_t at = offset_of(text_, node.loc);
    return node.loc.line > 0 && at < text_.size() && text_[at] == c;
  }
  // Does it stand under a [header], and not in the lines of the table around it?
  [[nodiscard]] bool has_header(const Node& node) const {
    if (node.kind == Kind::Table) return starts_with(node, '[') || (!starts_with(node, '{') && !node.members.empty() && has_header(node.members[0].value));
    return node.kind == Kind::Array && !node.items.empty() && node.items[0].kind == Kind::Table && starts_with(node.items[0], '[');
  }
  // Behind the last value that stands in the table's own lines; `otherwise`: where there is none.
  [[nodiscard]] std::size_t last_value(const Node& table, std::size_t otherwise) const {
    std::size_t end = otherwise;
    for (const Member& m : table.members)
      if (!has_header(m.value)) end = std::max(end, last_value_of(m.value, otherwise));
    return end;
  }
  [[nodiscard]] std::size_t last_value_of(const Node& node, std::size_t otherwise) const {
    if (node.kind == Kind::Table && !starts_with(node, '{')) return last_value(node, otherwise); // dotted keys
    return value_end(text_, offset_of(text_, node.loc));
  }

  std::string spliced(std::size_t begin, std::size_t end, const std::string& with) const {
    return std::string(text_.substr(0, begin)) + with + std::string(text_.substr(end));
  }
  std::string as_toml(std::string_view value) const {
    try {
      (void)parse("value = " + std::string(value), std::string(name_of_text), code_);
      return std::string(value);
    } catch (const Failure&) {
      std::string quoted = "\"";
      for (const char c : value) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
      }
      return quoted + "\"";
    }
  }
  [[noreturn]] void refuse(const std::string& why) const {
    fail(Exit::BadInput, code_, {}, fmt::format("'{}' cannot be written into the file: {}", path_, why), {"Change it in the file itself"});
  }

  std::string_view text_, path_, code_;
  Node root_;
  std::vector<Word> words_;
  std::string value_;
};

} // namespace

std::string patched(std::string_view text, std::string_view path, std::string_view value, std::string_view code) {
  return Patch(text, path, value, code).run();
}

std::string appended(std::string_view text, std::string_view path, std::string_view values, std::string_view code) {
  return Patch(text, path, "[]", code).append(values);
}

std::string removed(std::string_view text, std::string_view path, std::string_view code) {
  Node root = parse(text, std::string(name_of_text), code);
  const std::vector<Word> words = words_of(path);
  Node* table = &root;
  for (std::size_t i = 0; i + 1 < words.size() && table; ++i) table = const_cast<Node*>(child(*table, words[i]));
  const Node* node = table && !words.empty() ? child(*table, words.back()) : nullptr;
  if (!node) return std::string(text);
  const std::size_t begin = offset_of(text, node->loc), end = line_end(text, value_end(text, begin));
  const std::size_t newline = begin == 0 ? std::string_view::npos : text.rfind('\n', begin - 1);
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  std::string out(text.substr(0, start));
  out += text.substr(std::min(end + 1, text.size()));
  std::erase_if(table->members, [&](const Member& m) { return m.key == words.back().key; });
  bool good = false;
  try {
    good = same(root, parse(out, std::string(name_of_text), code));
  } catch (const Failure&) { // the line held more than that
  }
  if (!good) fail(Exit::BadInput, code, {}, fmt::format("'{}' cannot be taken out of the file where it stands", path), {"Change it in the file itself"});
  return out;
}

std::optional<std::string> written_value(std::string_view text, std::string_view path, std::string_view code) {
  const Node root = parse(text, std::string(name_of_text), code);
  const Node* at = &root;
  for (const Word& word : words_of(path))
    if (at) at = child(*at, word);
  if (!at || at->loc.line == 0) return std::nullopt;
  const std::size_t begin = offset_of(text, at->loc);
  return std::string(text.substr(begin, value_end(text, begin) - begin));
}

} // namespace mote::config
