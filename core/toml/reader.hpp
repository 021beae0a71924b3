// SPDX-License-Identifier: MIT
// Typed reading of one table of a located tree. Each getter marks its key as read; finish() reports
// the keys that nobody asked for. Getters never throw: what is wrong goes to the diagnostics, with the
// place and the value, and the getter answers as if the key were absent, so that one reading of a file
// reports everything that is wrong with it.
#pragma once

#include "core/toml/node.hpp"

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mote::config {

struct Codes { // under which the reader reports
  std::string_view unknown_key{}, wrong_type{}, out_of_range{}, unknown_word{}, missing_key{};
};

struct Range { // of a number; an open end leaves the bound itself out
  double min{-std::numeric_limits<double>::infinity()}, max{std::numeric_limits<double>::infinity()};
  bool open_min{}, open_max{};
  [[nodiscard]] bool holds(double value) const;
  [[nodiscard]] std::string text() const; // "at least 0", "between 0 and 180", ...
};
inline constexpr Range any_number{};
inline constexpr Range not_negative{0.0};
inline constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true};
inline constexpr Range unit{0.0, 1.0};

class TableReader {
public:
  // `path` is how messages call the table ("camera", "data[0]"); empty for the top of the file.
  TableReader(const Node& table, std::string path, const Codes& codes, Diagnostics& diagnostics);

  [[nodiscard]] const Node* find(std::string_view key); // marks the key as known, whether present or not
  [[nodiscard]] const Node* table(std::string_view key); // a table, or nothing
  // The items of an array of tables ([[key]]); none when absent.
  [[nodiscard]] std::vector<const Node*> tables(std::string_view key);

  std::optional<double> number(std::string_view key, const Range& range = any_number); // finite
  std::optional<std::int64_t> integer(std::string_view key);
  std::optional<bool> boolean(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  // One of `words`; the answer is its place in the list.
  std::optional<std::size_t> word(std::string_view key, std::span<const std::string> words);
  template <std::size_t N> std::optional<std::array<double, N>> numbers(std::string_view key, const Range& range = any_number) {
    const Node* node = find(key);
    std::array<double, N> out{};
    if (!node || !read_numbers(*node, key, out, range)) return std::nullopt;
    return out;
  }

  // Reading of a value that has been found already.
  std::optional<double> as_number(const Node& node, std::string_view key, const Range& range = any_number);
  bool read_numbers(const Node& node, std::string_view key, std::span<double> out, const Range& range = any_number);

  void wrong_type(const Node& node, std::string_view key, std::string_view wanted);
  void missing(std::string_view key, std::string_view why);
  void finish(); // reports unread keys

  [[nodiscard]] std::string name_of(std::string_view key) const; // "camera.eye"
  [[nodiscard]] const Node& node() const { return table_; }
  [[nodiscard]] const Codes& codes() const { return codes_; }
  [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }

private:
  const Node& table_;
  std::string path_;
  const Codes& codes_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_{};
};

} // namespace mote::config
