// SPDX-License-Identifier: MIT
// Every code that reading particle files can report, with one line each: the only place where they
// are given out. Readers name the constants, `docs/errors.md` and the tests name the codes. A code
// keeps its meaning for ever; new ones go to the end. All errors here end with Exit::BadInput.
#pragma once

#include <array>
#include <string_view>

namespace mote::data {

namespace code {
inline constexpr std::string_view cannot_open = "D001";
inline constexpr std::string_view empty = "D002";
inline constexpr std::string_view gzip = "D003";
inline constexpr std::string_view memory = "D004";
inline constexpr std::string_view unknown_format = "D005";
inline constexpr std::string_view ends_early = "D006";
inline constexpr std::string_view follows = "D007";
inline constexpr std::string_view heading = "D008";
inline constexpr std::string_view properties = "D009";
inline constexpr std::string_view too_few = "D010";
inline constexpr std::string_view too_many = "D011";
inline constexpr std::string_view not_a_value = "D012";
inline constexpr std::string_view no_position = "D013";
inline constexpr std::string_view box = "D014";
inline constexpr std::string_view duplicate_id = "D015";
inline constexpr std::string_view many_columns = "D016";
inline constexpr std::string_view no_frame = "D017";
inline constexpr std::string_view npy_header = "D018";
inline constexpr std::string_view npy_type = "D019";
inline constexpr std::string_view npy_shape = "D020";
inline constexpr std::string_view quote = "D021";
inline constexpr std::string_view cut_frame = "D022";
inline constexpr std::string_view trailing = "D023";
inline constexpr std::string_view unnamed = "D024";
inline constexpr std::string_view series_pattern = "D025";
inline constexpr std::string_view pair = "D026";
inline constexpr std::string_view frame_list = "D027";
} // namespace code

struct CodeLine {
  std::string_view code{}, line{};
};

inline constexpr std::array<CodeLine, 27> code_table{{
    {code::cannot_open, "error: a file is missing, is a folder or may not be read"},
    {code::empty, "error: a file holds no data at all"},
    {code::gzip, "error: a gzip stream is cut off or damaged"},
    {code::memory, "error: the content needs more memory than there is"},
    {code::unknown_format, "error: no reader recognizes the content"},
    {code::ends_early, "error: the file ends before the rows or bytes that its own count promises"},
    {code::follows, "error: something else than a new frame follows the counted rows"},
    {code::heading, "error: a count or a heading line is not what the format asks for"},
    {code::properties, "error: the Properties of an extended XYZ comment are malformed"},
    {code::too_few, "error: a row has fewer values than there are columns"},
    {code::too_many, "error: a row has more values than there are columns"},
    {code::not_a_value, "error: a word stands where a number, an integer or a truth value is needed"},
    {code::no_position, "error: no columns give the position (x y z)"},
    {code::box, "error: the box (cell) is malformed"},
    {code::duplicate_id, "error: two particles of a frame have the same id"},
    {code::many_columns, "error: there are more columns than any reader takes"},
    {code::no_frame, "error: a frame is asked for that the file does not have"},
    {code::npy_header, "error: the header of a .npy file is malformed"},
    {code::npy_type, "error: the element type of a .npy array cannot be read"},
    {code::npy_shape, "error: the shape of a .npy array is not that of particles"},
    {code::quote, "error: a quoted text is not closed"},
    {code::cut_frame, "warning: the last frame is cut off and left out"},
    {code::trailing, "warning: bytes behind the end of the data are ignored"},
    {code::unnamed, "warning: columns without names are kept as column_4, column_5, ..."},
    {code::series_pattern, "error: a pattern of file names that no file fits"},
    {code::pair, "error: topology and trajectory do not belong together"},
    {code::frame_list, "usage: a list of frames that is none"},
}};

// No reader takes more fields per row than this; a longer row is an accident or an attack.
inline constexpr std::size_t max_fields = 4096;

} // namespace mote::data
