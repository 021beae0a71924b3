// SPDX-License-Identifier: MIT
// Legacy VTK files (.vtk), ascii and binary (big endian), versions 1 to 5: POLYDATA, UNSTRUCTURED_GRID,
// STRUCTURED_GRID, RECTILINEAR_GRID, STRUCTURED_POINTS. Points become particles, point data columns; cells
// are stepped over. A grid without point data gives its cells' centers with the cell data.
// Format: VTK File Formats, docs.vtk.org; 5.x adds OFFSETS/CONNECTIVITY and METADATA.
#include "core/data/codes_fields.hpp"
#include "core/data/grid.hpp"
#include "core/data/registry.hpp"
#include "core/data/scan.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

constexpr std::array<std::pair<std::string_view, Scalar>, 16> type_words{{
    {"char", Scalar::Int8},
    {"signed_char", Scalar::Int8},
    {"unsigned_char", Scalar::UInt8},
    {"short", Scalar::Int16},
    {"unsigned_short", Scalar::UInt16},
    {"int", Scalar::Int32},
    {"unsigned_int", Scalar::UInt32},
    {"long", Scalar::Int64},
    {"unsigned_long", Scalar::UInt64},
    {"float", Scalar::Float32},
    {"double", Scalar::Float64},
    {"vtkidtype", Scalar::Int32},
    {"vtktypeint64", Scalar::Int64},
    {"vtktypeuint64", Scalar::UInt64},
    {"vtktypeint32", Scalar::Int32},
    {"vtktypeuint32", Scalar::UInt32},
}};

class LegacyVtk {
public:
  LegacyVtk(const Bytes& bytes, Diagnostics& warnings)
      : scan_(bytes.name(), bytes.view()), file_(bytes.name()), warnings_(warnings) {}

  Frame read() {
    read_head();
    for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word()) section(lower(word));
    return finish();
  }

private:
  void read_head() {
    if (!lower(scan_.line()).starts_with("# vtk datafile version"))
      scan_.refuse(code::heading, "the first line of a VTK file is '# vtk DataFile Version ...'");
    title_ = std::string(scan_.line());
    const std::string_view kind = scan_.need_word("ASCII or BINARY");
    if (!same_word(kind, "ASCII") && !same_word(kind, "BINARY"))
      scan_.refuse(code::heading, fmt::format("the third line is ASCII or BINARY, not {}", shown(kind)));
    scan_.binary = same_word(kind, "BINARY");
    if (const auto word = scan_.need_word("DATASET"); !same_word(word, "DATASET"))
      scan_.refuse(code::heading, fmt::format("DATASET is missing; here stands {}", shown(word)));
    dataset_ = lower(scan_.need_word("the kind of the dataset"));
    const std::vector<std::string> kinds{"polydata", "unstructured_grid", "structured_grid",
                                         "rectilinear_grid", "structured_points"};
    if (std::find(kinds.begin(), kinds.end(), dataset_) == kinds.end())
      scan_.refuse(field_code::variant, fmt::format("a DATASET {} cannot be read", shown(dataset_)),
                   {"readable: " + list_of(kinds)});
  }

  void section(const std::string& word) {
    if (word == "dimensions") return read_dimensions();
    if (word == "origin") return read_three(image_.origin, "ORIGIN");
    if (word == "spacing" || word == "aspect_ratio") return read_three(image_.spacing, "SPACING");
    if (word == "points") return read_points();
    if (word == "x_coordinates") return read_axis(0);
    if (word == "y_coordinates") return read_axis(1);
    if (word == "z_coordinates") return read_axis(2);
    if (word == "vertices" || word == "lines" || word == "polygons" || word == "triangle_strips" ||
        word == "cells")
      return skip_cells(word);
    if (word == "cell_types")
      return skip_array("CELL_TYPES", scan_.count("the number of cell types"), 1, Scalar::Int32);
    if (word == "metadata") return skip_metadata();
    if (word == "point_data" || word == "cell_data") return begin_data(word);
    if (word == "field") return read_field();
    attribute(word);
  }

  void read_dimensions() {
    for (std::uint64_t& n : image_.size.nodes) n = scan_.count("a dimension");
  }
  void read_three(std::array<double, 3>& out, std::string_view what) {
    for (double& value : out) value = scan_.real(what);
  }
  void read_points() {
    const std::uint64_t count = scan_.count("the number of points");
    Column points = array("points", count, 3, type());
    points_.resize(points.rows() * 3);
    for (std::uint64_t i = 0; i < points_.size(); ++i)
      points_[i] = points.number(i / 3, static_cast<std::uint32_t>(i % 3));
    has_points_ = true;
  }
  void read_axis(std::size_t axis) {
    const std::uint64_t count = scan_.count("the number of coordinates");
    const Column values = array("coordinates", count, 1, type());
    axes_[axis].clear();
    for (std::uint64_t i = 0; i < count; ++i) axes_[axis].push_back(values.number(i));
  }

  // Up to 4.2: "CELLS n size" and size integers. From 5.0: "CELLS n+1 size", OFFSETS type, CONNECTIVITY type.
  void skip_cells(const std::string& word) {
    const std::uint64_t cells = scan_.count("the number of cells");
    const std::uint64_t size = scan_.count("the size of the cells");
    if (!same_word(scan_.peek(), "OFFSETS")) return skip_array(word, size, 1, Scalar::Int32);
    (void)scan_.word();
    skip_array("OFFSETS", cells, 1, type());
    if (!same_word(scan_.need_word("CONNECTIVITY"), "CONNECTIVITY"))
      scan_.refuse(code::heading, "CONNECTIVITY is missing behind OFFSETS");
    skip_array("CONNECTIVITY", size, 1, type());
  }
  // Name lines and their values until a blank line or the end.
  void skip_metadata() {
    (void)scan_.line();
    while (scan_.left() && !trim(scan_.line()).empty()) {
    }
  }

  void begin_data(const std::string& word) {
    in_cells_ = word == "cell_data";
    rows_ = scan_.count("the number of rows");
    const std::uint64_t wanted = in_cells_ ? rows_ : point_count();
    if (rows_ != wanted)
      scan_.refuse(field_code::length,
                   fmt::format("POINT_DATA has {} rows, but there are {} points", rows_, wanted));
    attributes_ = true;
  }

  void attribute(const std::string& word) {
    if (!attributes_) scan_.refuse(code::heading, fmt::format("{} is no part of a VTK file", shown(word)));
    if (word == "lookup_table") {
      (void)scan_.need_word("the name of the lookup table");
      const std::uint64_t count = scan_.count("the size of the lookup table");
      return skip_array("LOOKUP_TABLE", count, 4, scan_.binary ? Scalar::UInt8 : Scalar::Float32);
    }
    const std::string name = decode_percent(scan_.need_word("the name of the array"));
    if (word == "scalars") return read_scalars(name);
    if (word == "color_scalars") {
      const std::uint32_t components = small(scan_.count("the number of components"));
      return keep(array(name, rows_, components, scan_.binary ? Scalar::UInt8 : Scalar::Float32));
    }
    if (word == "texture_coordinates") {
      const std::uint32_t components = small(scan_.count("the number of components"));
      return keep(array(name, rows_, components, type()));
    }
    if (word == "vectors" || word == "normals")
      return keep(array(word == "normals" ? "normal" : name, rows_, 3, type()));
    if (word == "tensors") return keep(array(name, rows_, 9, type()));
    if (word == "tensors6") return keep(array(name, rows_, 6, type()));
    if (word == "global_ids" || word == "pedigree_ids" || word == "edge_flags")
      return keep(array(name, rows_, 1, type()));
    const std::vector<std::string> known{"SCALARS",    "COLOR_SCALARS",       "LOOKUP_TABLE", "VECTORS",
                                         "NORMALS",    "TEXTURE_COORDINATES", "TENSORS",      "FIELD",
                                         "GLOBAL_IDS", "PEDIGREE_IDS",        "METADATA",     "POINT_DATA",
                                         "CELL_DATA"};
    scan_.refuse(code::heading, fmt::format("{} is no part of a VTK file", shown(word)),
                 {did_you_mean(word, known)});
  }

  void read_scalars(const std::string& name) {
    const Kind kind = type();
    std::uint64_t components = 1;
    if (!same_word(scan_.peek(), "LOOKUP_TABLE") && parse_count(scan_.peek(), components)) (void)scan_.word();
    if (same_word(scan_.peek(), "LOOKUP_TABLE")) {
      (void)scan_.word();
      (void)scan_.need_word("the name of the lookup table");
    }
    keep(array(name, rows_, small(components), kind));
  }

  // FIELD name n, then n times: name components rows type. Outside of POINT_DATA it is data of the file.
  void read_field() {
    (void)scan_.need_word("the name of the field");
    const std::uint64_t arrays = scan_.count("the number of arrays");
    for (std::uint64_t i = 0; i < arrays; ++i) {
      std::string name = decode_percent(scan_.need_word("the name of an array"));
      while (same_word(name, "METADATA")) {
        skip_metadata();
        name = decode_percent(scan_.need_word("the name of an array"));
      }
      const std::uint32_t components = small(scan_.count("the number of components"));
      const std::uint64_t rows = scan_.count("the number of rows");
      if (attributes_ && rows != rows_)
        scan_.refuse(field_code::length,
                     fmt::format("the array {} has {} rows where {} are needed", shown(name), rows, rows_));
      Column values = array(name, rows, components, type());
      if (attributes_) {
        keep(std::move(values));
      } else if (values.type() != ColumnType::Text && rows == 1 && components == 1) {
        if (same_word(name, "TIME") || same_word(name, "TimeValue")) frame_.time = values.number(0);
        if (same_word(name, "CYCLE") && std::abs(values.number(0)) < 1e15)
          frame_.step = static_cast<std::int64_t>(values.number(0));
      }
    }
  }

  struct Kind {
    Scalar scalar{};
    bool bits{}, text{};
    Kind(Scalar s) : scalar(s) {} // NOLINT: a scalar is a kind
  };
  Kind type() {
    const std::string word = lower(scan_.need_word("the type of the values"));
    Kind out(Scalar::UInt8);
    out.bits = word == "bit";
    out.text = word == "string" || word == "utf8_string";
    if (out.bits || out.text) return out;
    for (const auto& [name, scalar] : type_words)
      if (name == word) return scalar;
    std::vector<std::string> known{"bit", "string"};
    for (const auto& [name, scalar] : type_words) known.emplace_back(name);
    scan_.refuse(field_code::variant, fmt::format("values of type {} cannot be read", shown(word)),
                 {did_you_mean(word, known), "readable: " + list_of(known)});
  }
  std::uint32_t small(std::uint64_t components) const {
    if (components == 0 || components > max_fields)
      scan_.refuse(code::heading,
                   fmt::format("'{}' components are not possible; 1 to {} are", components, max_fields));
    return static_cast<std::uint32_t>(components);
  }

  // The values of one array; what lies behind the line of the type word if binary.
  Column array(const std::string& name, std::uint64_t rows, std::uint32_t components, Kind kind) {
    if (kind.text) return texts(name, times(rows, components));
    if (!scan_.binary) return scan_.numbers(name, rows, components, !is_real(kind.scalar));
    (void)scan_.line();
    const std::uint64_t values = times(rows, components);
    if (kind.bits)
      return unpack_bits(name, rows, components, scan_.take(values / 8 + (values % 8 != 0), shown(name)));
    const std::string_view bytes = scan_.take(times(values, size_of(kind.scalar)), shown(name));
    return unpack(name, bytes, {kind.scalar, Order::Big, rows, components, 0});
  }
  static Column unpack_bits(const std::string& name, std::uint64_t rows, std::uint32_t components,
                            std::string_view bytes) {
    std::vector<std::int64_t> values(rows * components);
    for (std::uint64_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<unsigned char>(bytes[i / 8]) >> (7 - i % 8) & 1;
    return {name, components, std::move(values), {}};
  }
  void skip_array(std::string_view name, std::uint64_t rows, std::uint32_t components, Kind kind) {
    (void)array(std::string(name), rows, components, kind);
  }

  // Ascii: one line each, percent-encoded. Binary: the two top bits of the first byte tell how many bytes
  // the length has (3: 1, 2: 2, 1: 4, 0: 8), as vtkDataReader reads them. Particles get no texts of it.
  Column texts(const std::string& name, std::uint64_t count) {
    (void)scan_.line();
    if (count > scan_.left() + 1) need_bytes(count, scan_.left(), scan_.place(), shown(name));
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!scan_.binary) {
        if (scan_.left() == 0) need_bytes(1, 0, scan_.place(), shown(name));
        (void)scan_.line();
        continue;
      }
      const auto first = static_cast<unsigned char>(scan_.take(1, shown(name))[0]);
      std::uint64_t length = first & 0x3f;
      for (int more = (1 << (3 - (first >> 6))) - 1; more > 0; --more)
        length = length << 8 | static_cast<unsigned char>(scan_.take(1, shown(name))[0]);
      (void)scan_.take(length, shown(name));
    }
    return {name, 1, TextColumn{}, {}};
  }

  void keep(Column column) {
    if (column.type() == ColumnType::Text) {
      warnings_.note(field_code::left_out, {file_},
                     fmt::format("the texts {} are left out", shown(column.name)));
    } else {
      (in_cells_ ? cell_data_ : point_data_).push_back(std::move(column));
    }
  }

  std::uint64_t point_count() const {
    if (dataset_ == "structured_points") return image_.size.points();
    if (dataset_ == "rectilinear_grid")
      return times(times(axes_[0].size(), axes_[1].size()), axes_[2].size());
    return points_.size() / 3;
  }

  Frame finish() {
    const bool image = dataset_ == "structured_points", rectilinear = dataset_ == "rectilinear_grid";
    if (!image && !rectilinear && !has_points_)
      scan_.refuse(code::ends_early, "the file ends early: POINTS is missing");
    if (dataset_ == "structured_grid" && image_.size.points() != point_count())
      scan_.refuse(field_code::length, fmt::format("DIMENSIONS {} give {} points, but POINTS has {}",
                                                   image_.size.text(), image_.size.points(), point_count()));
    if (rectilinear && point_count() == 0)
      scan_.refuse(code::ends_early, "the file ends early: coordinates are missing");
    if (rectilinear)
      for (std::size_t a = 0; a < 3; ++a) image_.size.nodes[a] = axes_[a].size();
    const bool grid = image || rectilinear || dataset_ == "structured_grid";
    const bool centers = grid && point_data_.empty() && !cell_data_.empty() &&
                         cell_data_.front().rows() == image_.size.cells();
    std::vector<double> at = image         ? image_points(image_, centers, {file_})
                             : rectilinear ? rectilinear_points(axes_, centers, {file_})
                             : centers     ? structured_centers(image_.size, points_, {file_})
                                           : std::move(points_);
    if (centers)
      warnings_.note(field_code::left_out, {file_},
                     "there is no point data: the particles are the centers of the cells");
    else if (!cell_data_.empty())
      warnings_.note(field_code::left_out, {file_},
                     fmt::format("{} arrays of cell data are left out", cell_data_.size()));
    std::vector<Column> arrays{position_column(std::move(at))};
    for (Column& column : centers ? cell_data_ : point_data_)
      if (column.rows() == arrays.front().rows()) arrays.push_back(std::move(column));
    assemble(frame_, std::move(arrays), {}, {file_});
    if (!title_.empty()) frame_.properties.emplace_back("title", title_);
    return std::move(frame_);
  }

  Scan scan_;
  std::string file_, title_{}, dataset_{};
  Diagnostics& warnings_;
  ImageGrid image_{};
  std::array<std::vector<double>, 3> axes_{};
  std::vector<double> points_{};
  bool has_points_{}, attributes_{}, in_cells_{};
  std::uint64_t rows_{};
  std::vector<Column> point_data_{}, cell_data_{};
  Frame frame_{};
};

Frame parse_vtk(Bytes& bytes, Diagnostics& warnings) {
  check_last_line(bytes, warnings); // VTK ends binary arrays with one, too
  return LegacyVtk(bytes, warnings).read();
}

Sureness probe_vtk(const Probe& probe) {
  return lower(probe.head.substr(0, 22)) == "# vtk datafile version" ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader vtk_reader();
Reader vtk_reader() {
  return {{"vtk", "legacy VTK, ascii and binary: points and point data of all five kinds of dataset", "vtk"},
          probe_vtk,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("vtk", std::move(bytes), parse_vtk); }};
}

} // namespace mote::data
