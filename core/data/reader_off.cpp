// SPDX-License-Identifier: MIT
// Geomview's Object File Format (.off, also COFF, NOFF, STOFF, CNOFF): vertices as points, with normals
// (N) and colors (C, as in the file) as columns. Faces are stepped over and counted.
#include "core/data/codes_fields.hpp"
#include "core/data/fields.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <array>

namespace mote::data {
namespace {

// Which parts a vertex has, in their order: [ST][C][N][4][n]OFF.
struct OffKind {
  bool texture{}, color{}, normal{}, known{};
};
OffKind kind_of_off(std::string_view word) {
  OffKind kind;
  if (word.starts_with("ST")) kind.texture = true, word.remove_prefix(2);
  if (word.starts_with('C')) kind.color = true, word.remove_prefix(1);
  if (word.starts_with('N')) kind.normal = true, word.remove_prefix(1);
  kind.known = word == "OFF";
  return kind;
}

class Off {
public:
  Off(Bytes& bytes, Diagnostics& warnings)
      : file_(bytes.name()), cursor_(bytes.text()), warnings_(warnings) {}

  Frame read() {
    next_line("the first line");
    Words words(line_.text);
    std::string_view word = words.next();
    const OffKind kind = kind_of_off(word);
    if (!kind.known)
      refuse(field_code::variant, word, fmt::format("the kind {} of OFF cannot be read", shown(word)),
             {"readable: OFF with any of ST, C, N in front"});
    word = words.next();
    if (same_word(word, "BINARY")) refuse(field_code::variant, word, "binary OFF cannot be read");
    if (word.empty() || word.starts_with('#')) {
      next_line("the numbers of vertices, faces and edges");
      words = Words(line_.text);
      word = words.next();
    }
    const std::uint64_t vertices = count(word, "vertices");
    const std::uint64_t faces = count(words.next(), "faces");
    if (times(vertices, 6) > cursor_.rest().size() + 2 || times(faces, 2) > cursor_.rest().size())
      refuse(code::ends_early, line_.text,
             fmt::format("the file ends early: {} vertices and {} faces are announced, but {} bytes are left",
                         vertices, faces, cursor_.rest().size()));
    for (std::uint64_t v = 0; v < vertices; ++v) vertex(kind, v, vertices);
    for (std::uint64_t f = 0; f < faces; ++f) face(f, faces);
    while (const auto more = cursor_.next()) {
      if (trim(more->text).empty() || trim(more->text).starts_with('#')) continue;
      warnings_.warning(code::trailing, {file_, more->number, 1}, "lines behind the last face are ignored");
      break;
    }
    return finish(vertices);
  }

private:
  [[noreturn]] void refuse(std::string_view code, std::string_view part, std::string text,
                           std::vector<std::string> hints = {}) const {
    fail(Exit::BadInput, code, place_in(file_, line_, part), std::move(text), std::move(hints));
  }
  void next_line(std::string_view what) {
    while (const auto line = cursor_.next()) {
      line_ = *line;
      const std::string_view inner = trim(line->text);
      if (!inner.empty() && !inner.starts_with('#')) return;
    }
    fail(Exit::BadInput, code::ends_early, {file_, cursor_.line()},
         fmt::format("the file ends early: {} is missing", what));
  }
  std::uint64_t count(std::string_view word, std::string_view what) const {
    std::uint64_t value = 0;
    if (!parse_count(word, value))
      refuse(code::heading, word.empty() ? line_.text : word,
             fmt::format("the number of {} is not a count: {}", what, shown(word)));
    return value;
  }
  void vertex(const OffKind& kind, std::uint64_t v, std::uint64_t vertices) {
    next_line(fmt::format("vertex {} of {}", v + 1, vertices));
    std::array<double, 12> values{};
    std::size_t have = 0;
    Words words(line_.text);
    for (std::string_view word = words.next(); !word.empty() && !word.starts_with('#'); word = words.next()) {
      if (have == values.size()) refuse(code::too_many, word, "the vertex has too many numbers");
      if (!parse_real(word, values[have]))
        refuse(code::not_a_value, word, fmt::format("a coordinate is not a number: {}", shown(word)));
      ++have;
    }
    const std::size_t least =
        3u + (kind.normal ? 3u : 0u) + (kind.color ? 3u : 0u) + (kind.texture ? 2u : 0u);
    if (have < least)
      refuse(code::too_few, line_.text, fmt::format("the vertex has {} numbers instead of {}", have, least));
    points_.insert(points_.end(), values.begin(), values.begin() + 3);
    std::ptrdiff_t at = 3;
    if (kind.normal) {
      normals_.insert(normals_.end(), values.begin() + at, values.begin() + at + 3);
      at += 3;
    }
    if (kind.color) colors_.insert(colors_.end(), values.begin() + at, values.begin() + at + 3);
  }
  void face(std::uint64_t f, std::uint64_t faces) {
    next_line(fmt::format("face {} of {}", f + 1, faces));
    Words words(line_.text);
    const std::uint64_t corners = count(words.next(), "corners of a face");
    for (std::uint64_t c = 0; c < corners; ++c) {
      const std::string_view word = words.next();
      if (word.empty())
        refuse(code::too_few, line_.text, fmt::format("the face has {} corners of {}", c, corners));
      std::uint64_t index = 0;
      if (!parse_count(word, index) || index >= points_.size() / 3)
        refuse(field_code::index, word,
               fmt::format("the face names vertex {}, but there are {}", shown(word), points_.size() / 3));
    }
  }
  Frame finish(std::uint64_t vertices) {
    std::vector<Column> arrays{position_column(std::move(points_))};
    if (normals_.size() == vertices * 3 && vertices > 0)
      arrays.push_back({"normal", 3, std::move(normals_), {}});
    if (colors_.size() == vertices * 3 && vertices > 0)
      arrays.push_back({"color", 3, std::move(colors_), {}});
    Frame frame;
    assemble(frame, std::move(arrays), {}, {file_});
    return frame;
  }

  std::string file_;
  Cursor cursor_;
  Line line_{};
  Diagnostics& warnings_;
  std::vector<double> points_{}, normals_{}, colors_{};
};

Frame parse_off(Bytes& bytes, Diagnostics& warnings) {
  check_last_line(bytes, warnings);
  return Off(bytes, warnings).read();
}

Sureness probe_off(const Probe& probe) {
  Cursor cursor(probe.head.substr(0, 4096));
  while (const auto line = cursor.next()) {
    const std::string_view word = Words(line->text).next();
    if (word.empty() || word.starts_with('#')) continue;
    return word.size() <= 8 && word.ends_with("OFF") ? Sureness::Certain : Sureness::No;
  }
  return Sureness::No;
}

} // namespace

Reader off_reader();
Reader off_reader() {
  return {{"off", "Object File Format: vertices, normals and colors", "off coff noff"},
          probe_off,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("off", std::move(bytes), parse_off); }};
}

} // namespace mote::data
