// SPDX-License-Identifier: MIT
#include "core/toml/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mote::config {

bool Range::holds(double value) const {
  return (open_min ? value > min : value >= min) && (open_max ? value < max : value <= max);
}

std::string Range::text() const {
  if (std::isinf(max)) return fmt::format("{} {}", open_min ? "above" : "at least", min);
  if (std::isinf(min)) return fmt::format("{} {}", open_max ? "below" : "at most", max);
  const bool both_open = open_min && open_max;
  return fmt::format("{} {} {} {}", both_open ? "between" : "from", min, both_open ? "and" : "to", max);
}

TableReader::TableReader(const Node& table, std::string path, const Codes& codes, Diagnostics& diagnostics)
    : table_(table), path_(std::move(path)), codes_(codes), diagnostics_(diagnostics) {}

std::string TableReader::name_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const Node* TableReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_.find(key);
}

void TableReader::wrong_type(const Node& node, std::string_view key, std::string_view wanted) {
  diagnostics_.error(codes_.wrong_type, node.loc,
                     fmt::format("{} takes {}, not {} ('{}')", name_of(key), wanted, to_string(node.kind), to_text(node)));
}

void TableReader::missing(std::string_view key, std::string_view why) {
  diagnostics_.error(codes_.missing_key, table_.loc, fmt::format("{} is missing: {}", name_of(key), why));
}

const Node* TableReader::table(std::string_view key) {
  const Node* node = find(key);
  if (!node || node->kind == Kind::Table) return node;
  wrong_type(*node, key, fmt::format("a table, written [{}]", name_of(key)));
  return nullptr;
}

std::vector<const Node*> TableReader::tables(std::string_view key) {
  const Node* node = find(key);
  std::vector<const Node*> out;
  if (!node) return out;
  const bool right = node->kind == Kind::Array &&
                     std::all_of(node->items.begin(), node->items.end(), [](const Node& n) { return n.kind == Kind::Table; });
  if (!right) {
    wrong_type(*node, key, fmt::format("tables, each written [[{}]]", name_of(key)));
    return out;
  }
  for (const Node& item : node->items) out.push_back(&item);
  return out;
}

std::optional<double> TableReader::as_number(const Node& node, std::string_view key, const Range& range) {
  if (node.kind != Kind::Integer && node.kind != Kind::Real) {
    wrong_type(node, key, "a number");
    return std::nullopt;
  }
  if (!std::isfinite(node.real) || !range.holds(node.real)) {
    const std::string bound = range.holds(1e300) && range.holds(-1e300) ? "finite" : range.text();
    diagnostics_.error(codes_.out_of_range, node.loc, fmt::format("{} is '{}'; it must be {}", name_of(key), node.real, bound));
    return std::nullopt;
  }
  return node.real;
}

std::optional<double> TableReader::number(std::string_view key, const Range& range) {
  const Node* node = find(key);
  return node ? as_number(*node, key, range) : std::nullopt;
}

std::optional<std::int64_t> TableReader::integer(std::string_view key) {
  const Node* node = find(key);
  if (!node) return std::nullopt;
  if (node->kind == Kind::Integer) return node->integer;
  wrong_type(*node, key, "an integer");
  return std::nullopt;
}

std::optional<bool> TableReader::boolean(std::string_view key) {
  const Node* node = find(key);
  if (!node) return std::nullopt;
  if (node->kind == Kind::Boolean) return node->boolean;
  wrong_type(*node, key, "true or false");
  return std::nullopt;
}

std::optional<std::string> TableReader::text(std::string_view key) {
  const Node* node = find(key);
  if (!node) return std::nullopt;
  if (node->kind == Kind::Text) return node->text;
  wrong_type(*node, key, "a text");
  return std::nullopt;
}

std::optional<std::size_t> TableReader::word(std::string_view key, std::span<const std::string> words) {
  const Node* node = find(key);
  if (!node) return std::nullopt;
  if (node->kind != Kind::Text) {
    wrong_type(*node, key, fmt::format("one of the words {}", list_of(words)));
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), node->text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  diagnostics_.error(codes_.unknown_word, node->loc, fmt::format("{} does not know '{}'", name_of(key), node->text),
                     {did_you_mean(node->text, words), fmt::format("{} takes: {}", name_of(key), list_of(words))});
  return std::nullopt;
}

bool TableReader::read_numbers(const Node& node, std::string_view key, std::span<double> out, const Range& range) {
  if (node.kind != Kind::Array || node.items.size() != out.size()) {
    const std::string got = node.kind == Kind::Array ? fmt::format("an array of {}", node.items.size())
                                                     : std::string(to_string(node.kind));
    diagnostics_.error(codes_.wrong_type, node.loc,
                       fmt::format("{} takes an array of {} numbers, not {} ('{}')", name_of(key), out.size(), got, to_text(node)));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::optional<double> value = as_number(node.items[i], fmt::format("{}[{}]", key, i), range);
    good = good && value;
    out[i] = value.value_or(0.0);
  }
  return good;
}

void TableReader::finish() {
  for (const Member& member : table_.members) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
    const std::string where = path_.empty() ? "the file" : path_;
    diagnostics_.error(codes_.unknown_key, member.loc, fmt::format("{} has no key '{}'", where, member.key),
                       {did_you_mean(member.key, known_), fmt::format("{} takes: {}", where, list_of(known_))});
  }
}

} // namespace mote::config
