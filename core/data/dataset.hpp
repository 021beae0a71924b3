// SPDX-License-Identifier: MIT
// What a particle file holds, whatever its format: frames of named columns. Readers make Frames;
// nobody else does. No rendering concept appears here: the scene turns columns into particles.
//
// Names are canonical where the field has a word (position, velocity, force, id, element, type,
// radius, mass, charge, color, orientation, molecule, ...); anything else keeps the file's name.
// Units are the file's own; Column::unit says which, where the format fixes it.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace mote::data {

// Text is stored as codes into a dictionary, so that a million "C" cost four bytes each.
struct TextColumn {
  std::vector<std::uint32_t> codes{};
  std::vector<std::string> dictionary{};
  [[nodiscard]] const std::string& at(std::uint64_t row) const { return dictionary[codes[row]]; }
};

enum class ColumnType : std::uint8_t { Double, Int, Text };
std::string_view to_string(ColumnType type);

// `components` values per row, row-major; text has one component.
struct Column {
  std::string name{};
  std::uint32_t components{1};
  std::variant<std::vector<double>, std::vector<std::int64_t>, TextColumn> values{};
  std::string unit{}; // "A", "nm", "" = unknown
  [[nodiscard]] ColumnType type() const { return static_cast<ColumnType>(values.index()); }
  [[nodiscard]] std::uint64_t rows() const;
  [[nodiscard]] double number(std::uint64_t row, std::uint32_t component = 0) const; // Int widened; Text: NaN
};

// A periodic cell: corner and three edge vectors (columns of `edges`) in the file's units.
struct Box {
  glm::dvec3 origin{0.0};
  glm::dmat3 edges{0.0};
  glm::bvec3 periodic{true};
};

// Bonds that the file states; none are guessed from distances. Pairs of rows of the frame, the smaller
// row first, each pair once, in the order of the file.
struct Bonds {
  std::vector<std::array<std::uint32_t, 2>> rows{};
  std::vector<std::int64_t> types{}; // one per pair, or empty where the format has none
};

// An arrangement of copies that the file describes (a biological assembly): the copies of each part are
// the rows whose text in the column `chain_column` is one of `chains`, once for every transform. The
// frame itself holds the rows once; whoever draws the assembly places the copies.
struct AssemblyPart {
  std::vector<std::string> chains{};       // empty: all rows
  std::vector<glm::dmat4> transforms{};    // position -> position in the file's units, column vectors
};
struct Assembly {
  std::string name{};                      // "1", "2", "PAU", as the file calls it
  std::string chain_column{"chain"};
  std::vector<AssemblyPart> parts{};
};

struct Frame {
  std::uint64_t count{};          // rows of every column
  std::vector<Column> columns{};  // position (3 components) is always among them
  std::optional<Box> box{};
  std::optional<double> time{};
  std::optional<std::int64_t> step{};
  std::vector<std::pair<std::string, std::string>> properties{}; // other words of the file, as text
  Bonds bonds{};
  std::vector<Assembly> assemblies{};
  [[nodiscard]] const Column* find(std::string_view name) const;
};

} // namespace mote::data
