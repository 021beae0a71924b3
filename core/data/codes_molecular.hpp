// SPDX-License-Identifier: MIT
// The codes that only readers of molecular files report (pdb, mmcif, gro, xtc, trr, dcd, gsd, netcdf,
// lammps-data), with one line each. What they share with all readers (a file that ends early, a word
// that is no number, ...) is in codes.hpp. A code keeps its meaning for ever; new ones go to the end.
// All errors here end with Exit::BadInput.
#pragma once

#include "core/data/codes.hpp"

namespace mote::data {

namespace molecule_code { // a name of its own: other formats have codes of the same word
inline constexpr std::string_view structure = "D040";
inline constexpr std::string_view compressed = "D041";
inline constexpr std::string_view variant = "D042";
inline constexpr std::string_view count = "D043";
inline constexpr std::string_view cif_syntax = "D044";
inline constexpr std::string_view assembly = "D045";
inline constexpr std::string_view atom_style = "D046";
inline constexpr std::string_view bond = "D047";
inline constexpr std::string_view guessed_style = "D048";
inline constexpr std::string_view left_out = "D049";
inline constexpr std::string_view header_count = "D050";
inline constexpr std::string_view last_line = "D051";
inline constexpr std::string_view anisotropy = "D052";
} // namespace molecule_code

inline constexpr std::array<CodeLine, 13> molecule_code_table{{
    {molecule_code::structure,
     "error: a magic number, a record length or a chunk of a binary file is not what the format asks for"},
    {molecule_code::compressed, "error: the compressed coordinates of a frame are damaged"},
    {molecule_code::variant,
     "error: a variant of the format that is not read (velocity DCD, newer GSD, other NetCDF)"},
    {molecule_code::count, "error: a count is impossible: negative, or more than the file can hold"},
    {molecule_code::cif_syntax, "error: the syntax of a CIF file is broken"},
    {molecule_code::assembly, "error: an assembly or one of its operators is malformed"},
    {molecule_code::atom_style,
     "error: the atom style of a LAMMPS data file is unknown or does not fit its rows"},
    {molecule_code::bond, "error (lammps-data, gsd), warning (pdb): a bond names an atom that is not there"},
    {molecule_code::guessed_style,
     "warning: the file does not name its atom style; it is guessed from the rows"},
    {molecule_code::left_out, "warning: frames without positions are left out"},
    {molecule_code::header_count,
     "warning: the header's number of frames is not the number of frames in the file"},
    {molecule_code::last_line, "warning: the last line has no line end and may be cut off"},
    {molecule_code::anisotropy, "warning: ANISOU records or rows that belong to no atom are ignored"},
}};

} // namespace mote::data
