// SPDX-License-Identifier: MIT
// The codes of the field, mesh and raw formats (VTK, bgeo, OVF, npz, PLY, OBJ, STL, OFF, raw) and of packed
// files. They continue codes.hpp under the same promise: a code keeps its meaning for ever, new ones go to
// the end. What these formats share with the others (a file that ends early, a word that is no number, a
// need of memory) has its code there. All errors here end with Exit::BadInput.
#pragma once

#include "core/data/codes.hpp"

namespace mote::data {

namespace field_code { // a name of its own: other formats have codes of the same word
inline constexpr std::string_view packed = "D060";
inline constexpr std::string_view markup = "D061";
inline constexpr std::string_view part = "D062";
inline constexpr std::string_view base64 = "D063";
inline constexpr std::string_view length = "D064";
inline constexpr std::string_view variant = "D065";
inline constexpr std::string_view index = "D066";
inline constexpr std::string_view raw_syntax = "D067";
inline constexpr std::string_view raw_key = "D068";
inline constexpr std::string_view raw_value = "D069";
inline constexpr std::string_view raw_layout = "D070";
inline constexpr std::string_view raw_join = "D071";
inline constexpr std::string_view left_out = "D072";
inline constexpr std::string_view end_mark = "D073";
} // namespace field_code

inline constexpr std::array<CodeLine, 14> field_code_table{{
    {field_code::packed, "error: packed data (xz, zstd, zip, a block of a VTK array) are cut off or damaged"},
    {field_code::markup, "error: an XML file is malformed"},
    {field_code::part,
     "error: a part or an attribute is missing, appears twice or has a value that cannot be read"},
    {field_code::base64, "error: base64 text holds something else"},
    {field_code::length, "error: an array has another length than the number of points asks for"},
    {field_code::variant, "error: a variant of the format that cannot be read"},
    {field_code::index, "error: an index names something that the file does not have"},
    {field_code::raw_syntax, "error: a raw description (mote_raw = 1) is not valid TOML"},
    {field_code::raw_key, "error: a raw description has an unknown key or lacks one"},
    {field_code::raw_value, "error: a value of a raw description has the wrong type or range"},
    {field_code::raw_layout, "error: a layout entry of a raw description is malformed"},
    {field_code::raw_join, "error: the files of a raw description do not hold the same particles"},
    {field_code::left_out, "note: parts of the file that are no particles are left out"},
    {field_code::end_mark, "warning: the end mark or the last line end is missing: the file may be cut off"},
}};

} // namespace mote::data
