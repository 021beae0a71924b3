// SPDX-License-Identifier: MIT
#include "core/data/pdb_header.hpp"

#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"

#include <fmt/format.h>

#include <array>

namespace mote::data {
namespace {

class HeaderReader {
public:
  HeaderReader(const std::string& file, Cursor cursor) : file_(file), cursor_(cursor) {}

  PdbHeader read() {
    while (const auto line = cursor_.next()) {
      const std::string_view record = pdb_record(line->text);
      if (pdb_is_coordinate(record)) break;
      if (record == "CRYST1")
        read_cell(*line);
      else if (record == "REMARK" && trim(pdb_columns(line->text, 8, 10)) == "350")
        read_assembly(*line);
      else if (record == "TITLE")
        header_.title += trim(pdb_columns(line->text, 11, 80));
      else if (record == "HEADER")
        header_.identifier = trim(pdb_columns(line->text, 63, 66));
    }
    if (rows_ != 0)
      refuse(last_, last_.text, fmt::format("operator {} has no row BIOMT{}", serial_, rows_ + 1));
    return std::move(header_);
  }

private:
  [[noreturn]] void refuse(const Line& line, std::string_view part, std::string text) const {
    fail(Exit::BadInput, molecule_code::assembly, place_in(file_, line, part), std::move(text));
  }

  void read_cell(const Line& line) {
    constexpr std::array<std::size_t, 7> ends{7, 16, 25, 34, 41, 48, 55};
    std::array<double, 6> v{};
    for (std::size_t k = 0; k < 6; ++k) {
      const std::string_view field = pdb_columns(line.text, ends[k], ends[k + 1] - 1);
      if (!parse_real(trim(field), v[k]))
        fail(Exit::BadInput, code::box, place_in(file_, line, field),
             fmt::format("{} in CRYST1 is not a number", shown(trim(field))));
    }
    header_.space_group = trim(pdb_columns(line.text, 56, 66));
    const bool placeholder = v[0] == 1 && v[1] == 1 && v[2] == 1; // structures without a crystal
    if (placeholder || (v[0] == 0 && v[1] == 0 && v[2] == 0)) return;
    header_.box = cell_box({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
    if (!header_.box)
      fail(Exit::BadInput, code::box, {file_, line.number},
           fmt::format("lengths {} {} {} and angles {} {} {} form no cell", v[0], v[1], v[2], v[3], v[4],
                       v[5]));
  }

  void read_assembly(const Line& line) {
    const std::string_view text = trim(pdb_columns(line.text, 11, 80));
    if (text.starts_with("BIOMOLECULE:")) {
      header_.assemblies.push_back({std::string(trim(text.substr(12))), "chain", {}});
      serial_ = 0;
    } else if (const std::size_t chains = text.find("CHAINS:"); chains != std::string_view::npos) {
      add_chains(text.substr(chains + 7), text.starts_with("AND"));
    } else if (text.starts_with("BIOMT")) {
      add_row(line);
    }
  }

  Assembly& assembly() {
    if (header_.assemblies.empty()) header_.assemblies.push_back({"1", "chain", {}});
    return header_.assemblies.back();
  }

  void add_chains(std::string_view list, bool more) {
    std::vector<AssemblyPart>& parts = assembly().parts;
    if (!more || parts.empty() || !parts.back().transforms.empty()) parts.emplace_back();
    while (!list.empty()) {
      const std::size_t end = std::min(list.find(','), list.size());
      const std::string_view chain = trim(list.substr(0, end));
      if (!chain.empty() && chain != "NULL") parts.back().chains.emplace_back(chain);
      list.remove_prefix(std::min(end + 1, list.size()));
    }
  }

  // REMARK 350   BIOMT1   1  1.000000  0.000000  0.000000       42.38700
  // By words: from operator 1000 on, files move all numbers by one column.
  void add_row(const Line& line) {
    Words words(pdb_columns(line.text, 14, 80));
    const std::string_view name = words.next(), number = words.next();
    std::uint64_t row = 0, serial = 0;
    if (name.size() < 6 || !parse_count(name.substr(5), row) || row != rows_ + 1)
      refuse(line, name,
             fmt::format("row BIOMT{} of an operator is needed here, not {}", rows_ + 1, shown(name)));
    if (!parse_count(number, serial) || (row > 1 && serial != serial_))
      refuse(line, number, fmt::format("the number of an operator is {}", shown(number)));
    for (int column = 0; column < 4; ++column) {
      const std::string_view word = words.next();
      double value = 0;
      if (!parse_real(word, value))
        refuse(line, word, fmt::format("{} in an operator is not a number", shown(word)));
      matrix_[column][static_cast<int>(row) - 1] = value;
    }
    serial_ = serial;
    rows_ = row % 3;
    last_ = line;
    if (row != 3) return;
    matrix_[3][3] = 1;
    std::vector<AssemblyPart>& parts = assembly().parts;
    if (parts.empty()) parts.emplace_back();
    parts.back().transforms.push_back(matrix_);
  }

  const std::string& file_;
  Cursor cursor_;
  PdbHeader header_{};
  glm::dmat4 matrix_{0.0};
  std::uint64_t rows_{}, serial_{};
  Line last_{};
};

} // namespace

std::string_view pdb_columns(std::string_view line, std::size_t first, std::size_t last) {
  return first > line.size() ? line.substr(line.size()) : line.substr(first - 1, last - first + 1);
}

std::string_view pdb_record(std::string_view line) { return trim(line.substr(0, 6)); }

bool pdb_is_coordinate(std::string_view record) {
  return record == "ATOM" || record == "HETATM" || record == "MODEL";
}

PdbHeader read_pdb_header(const std::string& file, Cursor cursor) {
  return HeaderReader(file, cursor).read();
}

} // namespace mote::data
