// SPDX-License-Identifier: MIT
// VTK XML files: .vtp, .vtu, .vti, .vtr, .vts. Points and point data of all pieces become particles and
// columns; cells are left out. A grid without point data gives its cells' centers with the cell data.
// Format: VTK XML Formats, docs.vtk.org. Parallel files (.pvtu ...) only name others and are refused.
#include "core/data/codes_fields.hpp"
#include "core/data/grid.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"
#include "core/data/vtk_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mote::data {
namespace {

class XmlDataset {
public:
  XmlDataset(Bytes& bytes, Diagnostics& warnings) : xml_(bytes), file_(bytes.name()), warnings_(warnings) {}

  Frame read() {
    find_dataset();
    Frame frame;
    read_file_data(frame);
    bool any = false;
    for (const pugi::xml_node piece : dataset_.children("Piece")) {
      add(read_piece(piece), piece);
      any = true;
    }
    if (!any) xml_.refuse(dataset_, field_code::part, fmt::format("{} has no Piece", dataset_.name()));
    if (left_out_ > 0)
      warnings_.note(field_code::left_out, {file_},
                     fmt::format("{} arrays of cell data are left out", left_out_));
    if (centers_)
      warnings_.note(field_code::left_out, {file_},
                     "there is no point data: the particles are the centers of the cells");
    assemble(frame, std::move(arrays_), {}, {file_});
    return frame;
  }

private:
  void find_dataset() {
    const std::vector<std::string> kinds{"PolyData", "UnstructuredGrid", "ImageData", "RectilinearGrid",
                                         "StructuredGrid"};
    const std::string type = xml_.root().attribute("type").value();
    if (std::find(kinds.begin(), kinds.end(), type) == kinds.end()) {
      std::vector<std::string> hints{"readable: " + list_of(kinds)};
      if (type.starts_with("P") || type == "Collection" || type.starts_with("vtkMulti"))
        hints.push_back("this file only names others: open those");
      xml_.refuse(xml_.root(), field_code::variant,
                  fmt::format("a VTKFile of type {} cannot be read", shown(type)), std::move(hints));
    }
    dataset_ = xml_.root().child(type.c_str());
    if (!dataset_) xml_.refuse(xml_.root(), field_code::part, fmt::format("the element {} is missing", type));
    kind_ = type;
  }

  // TimeValue and CYCLE, as ParaView and VisIt write them.
  void read_file_data(Frame& frame) {
    for (const pugi::xml_node array : dataset_.child("FieldData").children("DataArray")) {
      const std::string name = array.attribute("Name").value();
      if (name != "TimeValue" && name != "TIME" && name != "CYCLE") continue;
      const Column value = xml_.read(array, 1);
      if (value.type() == ColumnType::Text || value.components != 1) continue;
      if (name != "CYCLE")
        frame.time = value.number(0);
      else if (value.type() == ColumnType::Int)
        frame.step = std::get<std::vector<std::int64_t>>(value.values)[0];
    }
  }

  // first and last node per axis -> size and first index
  void read_extent(pugi::xml_node piece, ImageGrid& grid) const {
    const std::vector<double> extent = xml_.numbers(piece, "Extent", 6);
    for (std::size_t a = 0; a < 3; ++a) {
      const double first = extent[2 * a], last = extent[2 * a + 1];
      if (!(std::abs(first) < 4e15 && std::abs(last) < 4e15 && last >= first) || first != std::floor(first) ||
          last != std::floor(last))
        xml_.refuse(piece, field_code::part,
                    fmt::format("the Extent {} is impossible", shown(piece.attribute("Extent").value())));
      grid.first[a] = static_cast<std::int64_t>(first);
      grid.size.nodes[a] = static_cast<std::uint64_t>(last - first) + 1;
    }
  }

  static bool has_arrays(pugi::xml_node parent) { return parent.child("DataArray"); }

  std::vector<Column> read_piece(pugi::xml_node piece) {
    const bool points = kind_ == "PolyData" || kind_ == "UnstructuredGrid";
    ImageGrid grid;
    if (!points) read_extent(piece, grid);
    const std::uint64_t nodes = points ? xml_.count(piece, "NumberOfPoints") : grid.size.points();
    const pugi::xml_node point_data = piece.child("PointData"), cell_data = piece.child("CellData");
    const bool centers = !points && !has_arrays(point_data) && has_arrays(cell_data);
    // Values first: they prove the counts before any point is generated.
    const std::uint64_t rows = centers ? grid.size.cells() : nodes;
    std::vector<Column> out(1);
    for (const pugi::xml_node array : (centers ? cell_data : point_data).children())
      if (array.name() == std::string_view("DataArray") || array.name() == std::string_view("Array"))
        out.push_back(xml_.read(array, rows));
    out.front() = position_column(nodes > 0 ? positions(piece, grid, nodes, centers) : std::vector<double>{});
    for (Column& column : out)
      if (column.name == "Normals" && column.components == 3) column.name = "normal";
    if (!centers) left_out_ = std::max<std::size_t>(left_out_, count_arrays(cell_data));
    centers_ |= centers;
    return out;
  }
  static std::size_t count_arrays(pugi::xml_node parent) {
    const auto children = parent.children("DataArray");
    return static_cast<std::size_t>(std::distance(children.begin(), children.end()));
  }

  std::vector<double> positions(pugi::xml_node piece, ImageGrid& grid, std::uint64_t nodes, bool centers) {
    if (kind_ == "ImageData") {
      const auto three = [&](const char* name, std::array<double, 3>& to) {
        if (!dataset_.attribute(name)) return;
        const std::vector<double> values = xml_.numbers(dataset_, name, 3);
        std::copy_n(values.begin(), 3, to.begin());
      };
      three("Origin", grid.origin);
      three("Spacing", grid.spacing);
      if (dataset_.attribute("Direction")) {
        const std::vector<double> values = xml_.numbers(dataset_, "Direction", 9);
        std::copy_n(values.begin(), 9, grid.axes.begin());
      }
      return image_points(grid, centers, xml_.place(piece));
    }
    if (kind_ == "RectilinearGrid")
      return rectilinear_points(axes(piece, grid.size), centers, xml_.place(piece));
    need_memory(times(nodes, 3 * sizeof(double)), xml_.place(piece), fmt::format("the {} points", nodes));
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (!array) xml_.refuse(piece, field_code::part, "the Piece has no Points");
    const Column column = xml_.read(array, nodes);
    if (column.components != 3 || column.type() == ColumnType::Text)
      xml_.refuse(array, field_code::part,
                  fmt::format("Points has {} components instead of 3", column.components));
    std::vector<double> values(nodes * 3);
    for (std::uint64_t i = 0; i < values.size(); ++i)
      values[i] = column.number(i / 3, static_cast<std::uint32_t>(i % 3));
    return centers ? structured_centers(grid.size, values, xml_.place(piece)) : values;
  }

  std::array<std::vector<double>, 3> axes(pugi::xml_node piece, const GridSize& size) {
    std::array<std::vector<double>, 3> out;
    std::size_t axis = 0;
    for (const pugi::xml_node array : piece.child("Coordinates").children("DataArray")) {
      if (axis == 3) break;
      const Column values = xml_.read(array, size.nodes[axis]);
      if (values.components != 1 || values.type() == ColumnType::Text)
        xml_.refuse(array, field_code::part, "coordinates have one component");
      for (std::uint64_t i = 0; i < values.rows(); ++i) out[axis].push_back(values.number(i));
      ++axis;
    }
    if (axis != 3)
      xml_.refuse(piece, field_code::part, fmt::format("Coordinates has {} arrays instead of 3", axis));
    return out;
  }

  // Pieces one behind the other; all have the same arrays.
  void add(std::vector<Column> piece, pugi::xml_node node) {
    if (arrays_.empty()) {
      arrays_ = std::move(piece);
      return;
    }
    bool same = piece.size() == arrays_.size();
    for (std::size_t i = 0; same && i < piece.size(); ++i)
      same = piece[i].name == arrays_[i].name && piece[i].components == arrays_[i].components &&
             piece[i].type() == arrays_[i].type();
    if (!same) xml_.refuse(node, field_code::part, "the pieces of the file have different arrays");
    for (std::size_t i = 0; i < piece.size(); ++i) append(arrays_[i], piece[i]);
  }
  static void append(Column& to, const Column& from) {
    if (auto* text = std::get_if<TextColumn>(&to.values)) {
      const auto& more = std::get<TextColumn>(from.values);
      const auto shift = static_cast<std::uint32_t>(text->dictionary.size());
      text->dictionary.insert(text->dictionary.end(), more.dictionary.begin(), more.dictionary.end());
      for (const std::uint32_t code : more.codes) text->codes.push_back(code + shift);
    } else if (auto* reals = std::get_if<std::vector<double>>(&to.values)) {
      const auto& more = std::get<std::vector<double>>(from.values);
      reals->insert(reals->end(), more.begin(), more.end());
    } else {
      auto& whole = std::get<std::vector<std::int64_t>>(to.values);
      const auto& more = std::get<std::vector<std::int64_t>>(from.values);
      whole.insert(whole.end(), more.begin(), more.end());
    }
  }

  VtkXml xml_;
  std::string file_, kind_{};
  Diagnostics& warnings_;
  pugi::xml_node dataset_{};
  std::vector<Column> arrays_{};
  std::size_t left_out_{};
  bool centers_{};
};

Frame parse_vtk_xml(Bytes& bytes, Diagnostics& warnings) { return XmlDataset(bytes, warnings).read(); }

Sureness probe_vtk_xml(const Probe& probe) {
  return probe.head.substr(0, 4096).find("<VTKFile") != std::string_view::npos ? Sureness::Certain
                                                                               : Sureness::No;
}

} // namespace

Reader vtk_xml_reader();
Reader vtk_xml_reader() {
  return {
      {"vtk-xml", "VTK XML, ascii, base64 and raw, compressed: points and point data", "vtp vtu vti vtr vts"},
      probe_vtk_xml,
      [](std::shared_ptr<Bytes> bytes) { return one_frame("vtk-xml", std::move(bytes), parse_vtk_xml); }};
}

} // namespace mote::data
