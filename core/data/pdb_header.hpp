// SPDX-License-Identifier: MIT
// What stands before the atoms of a PDB file and holds for all its models: cell (CRYST1), biological
// assemblies (REMARK 350) and title. reader_pdb.cpp calls it. It reads no atoms.
#pragma once

#include "core/data/dataset.hpp"
#include "core/data/text.hpp"

#include <string>
#include <vector>

namespace mote::data {

// The record name of a line, without the blanks behind it: "ATOM", "CRYST1", ...
[[nodiscard]] std::string_view pdb_record(std::string_view line);
// Columns first..last (from 1, as in the format's description), cut where the line ends.
[[nodiscard]] std::string_view pdb_columns(std::string_view line, std::size_t first, std::size_t last);
// The record name of a coordinate or the begin of a model: the header ends there.
[[nodiscard]] bool pdb_is_coordinate(std::string_view record);

struct PdbHeader {
  std::optional<Box> box{};
  std::vector<Assembly> assemblies{};
  std::string title{}, identifier{}, space_group{};
};

// From `cursor` to the first coordinate. D014, D045.
PdbHeader read_pdb_header(const std::string& file, Cursor cursor);

} // namespace mote::data
