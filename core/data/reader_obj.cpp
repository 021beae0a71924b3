// SPDX-License-Identifier: MIT
// Wavefront .obj: vertices as points. Normals become a column when every face corner names one (the first
// that a vertex meets counts; vertices of no face have 0 0 0) or when there are as many normals as
// vertices and no face names any. Six numbers of a vertex are a position and a color. Faces, texture
// coordinates, groups and materials are left out.
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace mote::data {
namespace {

constexpr std::string_view keywords =
    " v vn vt vp f fo l p o g s mtllib usemtl usemap maplib cstype deg bmat step "
    "curv curv2 surf parm trim hole scrv sp end con mg bevel c_interp d_interp lod "
    "shadow_obj trace_obj ctech stech call csh # ";
bool is_keyword(std::string_view word) {
  return keywords.find(fmt::format(" {} ", word)) != std::string_view::npos;
}

class Obj {
public:
  explicit Obj(Bytes& bytes) : file_(bytes.name()), cursor_(bytes.text()) {}

  Frame read() {
    while (const auto line = cursor_.next()) {
      line_ = *line;
      Words words(line_.text);
      const std::string_view word = words.next();
      if (word.empty() || word.starts_with('#')) continue;
      if (word == "v")
        vertex(words);
      else if (word == "vn")
        normal(words);
      else if (word == "f" && !normals_.empty())
        face(words);
      else if (!is_keyword(word))
        refuse(code::heading, word, fmt::format("{} is no word of an .obj file", shown(word)));
    }
    if (points_.empty())
      fail(Exit::BadInput, code::no_position, {file_}, "the file has no vertices ('v x y z')");
    std::vector<Column> arrays{position_column(std::move(points_))};
    const std::uint64_t rows = arrays.front().rows();
    if (corners_with_normals_ == 0 && normals_.size() == rows * 3) {
      arrays.push_back({"normal", 3, std::move(normals_), {}});
    } else if (corners_with_normals_ > 0 && corners_with_normals_ == corners_) {
      of_vertex_.resize(rows * 3);
      arrays.push_back({"normal", 3, std::move(of_vertex_), {}});
    }
    if (colors_.size() == rows * 3) arrays.push_back({"color", 3, std::move(colors_), {}});
    Frame frame;
    assemble(frame, std::move(arrays), {}, {file_});
    return frame;
  }

private:
  [[noreturn]] void refuse(std::string_view code, std::string_view part, std::string text) const {
    fail(Exit::BadInput, code, place_in(file_, line_, part), std::move(text));
  }

  // The numbers of a line, at least three, at most `most`.
  std::size_t numbers(Words& words, std::array<double, 8>& out, std::size_t most) const {
    std::size_t count = 0;
    for (std::string_view word = words.next(); !word.empty() && !word.starts_with('#'); word = words.next()) {
      if (count == most) refuse(code::too_many, word, fmt::format("the line has more than {} numbers", most));
      if (!parse_real(word, out[count]))
        refuse(code::not_a_value, word, fmt::format("a coordinate is not a number: {}", shown(word)));
      ++count;
    }
    if (count < 3)
      refuse(code::too_few, line_.text, fmt::format("the line has {} numbers instead of 3", count));
    return count;
  }
  void vertex(Words& words) {
    std::array<double, 8> xyz{};
    const std::size_t count = numbers(words, xyz, 7);
    points_.insert(points_.end(), {xyz[0], xyz[1], xyz[2]});
    if (count >= 6) colors_.insert(colors_.end(), {xyz[3], xyz[4], xyz[5]});
  }
  void normal(Words& words) {
    std::array<double, 8> xyz{};
    (void)numbers(words, xyz, 3);
    normals_.insert(normals_.end(), {xyz[0], xyz[1], xyz[2]});
  }

  // From 1, or from -1 backwards; the answer is from 0.
  std::uint64_t index(std::string_view word, std::uint64_t there, std::string_view what) const {
    std::int64_t value = 0;
    if (!parse_integer(word, value))
      refuse(code::not_a_value, word,
             fmt::format("the index of a {} is not an integer: {}", what, shown(word)));
    const std::int64_t from_zero = value > 0 ? value - 1 : static_cast<std::int64_t>(there) + value;
    if (value == 0 || from_zero < 0 || from_zero >= static_cast<std::int64_t>(there))
      refuse(field_code::index, word,
             fmt::format("the face names {} {}, but there are {} so far", what, shown(word), there));
    return static_cast<std::uint64_t>(from_zero);
  }
  // v, v/vt, v//vn or v/vt/vn
  void face(Words& words) {
    for (std::string_view word = words.next(); !word.empty() && !word.starts_with('#'); word = words.next()) {
      const std::size_t first = word.find('/');
      const std::uint64_t vertex = index(word.substr(0, first), points_.size() / 3, "vertex");
      ++corners_;
      const std::size_t second = first == std::string_view::npos ? first : word.find('/', first + 1);
      if (second == std::string_view::npos) continue;
      const std::uint64_t normal = index(word.substr(second + 1), normals_.size() / 3, "normal");
      ++corners_with_normals_;
      if (of_vertex_.size() < points_.size()) of_vertex_.resize(points_.size());
      if (seen_.size() < points_.size() / 3) seen_.resize(points_.size() / 3);
      if (seen_[vertex]) continue;
      seen_[vertex] = true;
      for (std::size_t k = 0; k < 3; ++k) of_vertex_[3 * vertex + k] = normals_[3 * normal + k];
    }
  }

  std::string file_;
  Cursor cursor_;
  Line line_{};
  std::vector<double> points_{}, normals_{}, colors_{}, of_vertex_{};
  std::vector<bool> seen_{};
  std::uint64_t corners_{}, corners_with_normals_{};
};

Frame parse_obj(Bytes& bytes, Diagnostics& warnings) {
  check_last_line(bytes, warnings);
  return Obj(bytes).read();
}

// All complete lines of the beginning start with a keyword, and there is a vertex or a face among them.
Sureness probe_obj(const Probe& probe) {
  Cursor cursor(probe.head.substr(0, 4096));
  bool vertex = false;
  while (const auto line = cursor.next()) {
    if (cursor.at_end() && probe.head.size() > 4096) break;
    Words words(line->text);
    const std::string_view word = words.next();
    if (word.empty() || word.starts_with('#')) continue;
    if (!is_keyword(word)) return Sureness::ByName;
    double value = 0;
    vertex |= word == "mtllib" || (word == "v" && parse_real(words.next(), value));
  }
  return vertex ? Sureness::Likely : Sureness::ByName;
}

} // namespace

Reader obj_reader();
Reader obj_reader() {
  return {{"obj", "Wavefront OBJ: vertices, normals and vertex colors", "obj"},
          probe_obj,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("obj", std::move(bytes), parse_obj); }};
}

} // namespace mote::data
