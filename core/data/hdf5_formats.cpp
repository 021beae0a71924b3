// SPDX-License-Identifier: MIT
#include "core/data/hdf5_formats.hpp"

#include "core/data/codes.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/fields.hpp"
#include "core/data/molecule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mote::data {
namespace {

using Shape = std::vector<std::uint64_t>;

class Hdf5Source : public Source {
public:
  explicit Hdf5Source(std::shared_ptr<Hdf5File> file) : file_(std::move(file)) {}

protected:
  [[nodiscard]] const Hdf5File& file() const { return *file_; }
  void check_frame(std::uint64_t index, std::uint64_t count) const {
    if (index >= count) fail(Exit::BadInput, code::no_frame, {file().name()}, fmt::format("there is no frame {}: the file has {}", index, count));
  }
  // Values of one row each (or 3, 9, ... of them): 0 when the shape is none of `rows`.
  static std::uint32_t components(const Shape& shape, std::uint64_t rows) {
    if (shape.empty() || shape[0] != rows) return 0;
    std::uint64_t count = 1;
    for (std::size_t k = 1; k < shape.size(); ++k) count = times(count, shape[k]);
    return count >= 1 && count <= max_fields ? static_cast<std::uint32_t>(count) : 0;
  }

private:
  std::shared_ptr<Hdf5File> file_;
};

// ---- H5MD: /particles/GROUP/ELEMENT is a dataset, or a group with value, step and time.

class H5mdSource : public Hdf5Source {
public:
  H5mdSource(const std::shared_ptr<Hdf5File>& file, std::string group) : Hdf5Source(file), group_(std::move(group)) {
    const Shape shape = file->shape(value_of("position"));
    moving_ = file->is_group(group_ + "/position");
    const std::size_t axes = moving_ ? 3 : 2;
    if (shape.size() != axes || shape.back() != 3)
      file->refuse(code::no_position, fmt::format("'{}' is no list of positions in three dimensions", value_of("position")));
    frames_ = moving_ ? shape[0] : 1;
    rows_ = shape[axes - 2];
    if (frames_ == 0) file->refuse(code::empty, "the file has positions of no frame");
  }
  std::string_view format() const override { return "hdf5"; }
  std::uint64_t frame_count() override { return frames_; }

  Frame read(std::uint64_t index) override {
    check_frame(index, frames_);
    Frame frame;
    frame.count = rows_;
    std::vector<Column> columns;
    for (const std::string& name : file().members(group_)) {
      if (name == "box") continue;
      if (auto column = element(name, index)) columns.push_back(std::move(*column));
    }
    assemble(frame, std::move(columns), {}, {file().name()});
    read_box(index, frame);
    if (moving_) read_time(index, frame);
    return frame;
  }

private:
  [[nodiscard]] std::string value_of(const std::string& name) const {
    const std::string path = group_ + "/" + name;
    return file().is_group(path) ? path + "/value" : path;
  }
  // Elements are written less often than positions at times: the frame of the same step counts, or the last before it.
  [[nodiscard]] std::uint64_t frame_of(const std::string& name, std::uint64_t index, std::uint64_t count) const {
    const std::string own = group_ + "/" + name + "/step", master = group_ + "/position/step";
    if (name == "position" || !file().has(own) || !file().has(master)) return std::min(index, count - 1);
    if (file().shape(own).size() != 1 || file().shape(master).size() != 1) return std::min(index, count - 1); // evenly spaced
    const std::vector<std::int64_t> steps = file().wholes(own), times_of = file().wholes(master);
    if (index >= times_of.size() || steps.empty()) return std::min(index, count - 1);
    const auto later = std::upper_bound(steps.begin(), steps.end(), times_of[index]);
    return std::min<std::uint64_t>(later == steps.begin() ? 0 : static_cast<std::uint64_t>(later - steps.begin()) - 1, count - 1);
  }
  std::optional<Column> element(const std::string& name, std::uint64_t index) {
    const std::string path = value_of(name);
    if (!file().has(path)) return std::nullopt;
    const Hdf5File::Type type = file().type(path);
    if (type == Hdf5File::Type::Text || type == Hdf5File::Type::Other) return std::nullopt;
    Shape shape = file().shape(path);
    const bool in_time = file().is_group(group_ + "/" + name);
    if (in_time && !shape.empty()) {
      const std::uint64_t count = shape[0];
      shape.erase(shape.begin());
      const std::uint32_t width = count ? components(shape, rows_) : 0;
      if (width) return file().column(canonical(name), width, path, frame_of(name, index, count));
    } else if (const std::uint32_t width = components(shape, rows_)) {
      return file().column(canonical(name), width, path);
    }
    return std::nullopt;
  }
  static std::string canonical(const std::string& name) { return name == "species" ? "type" : name; }

  void read_box(std::uint64_t index, Frame& frame) {
    const std::string box_group = group_ + "/box";
    if (!file().has(box_group)) return;
    std::string path = box_group + "/edges";
    std::vector<double> edges;
    if (file().has(path + "/value")) {
      const Shape shape = file().shape(path + "/value");
      if (!shape.empty() && shape[0] > 0) edges = file().reals(path + "/value", std::min(index, shape[0] - 1));
    } else if (file().has(path)) {
      edges = file().reals(path);
    } else {
      edges = file().attribute_numbers(box_group, "edges");
    }
    if (edges.size() != 3 && edges.size() != 9) return;
    Box box;
    for (int k = 0; k < 3; ++k) {
      if (edges.size() == 3) box.edges[k][k] = edges[static_cast<std::size_t>(k)];
      else
        for (int i = 0; i < 3; ++i) box.edges[k][i] = edges[static_cast<std::size_t>(3 * k + i)]; // rows are the edges
    }
    const std::vector<std::string> boundary = file().attribute_texts(box_group, "boundary");
    for (std::size_t k = 0; k < 3 && boundary.size() == 3; ++k) box.periodic[static_cast<int>(k)] = boundary[k] == "periodic";
    frame.box = box;
  }
  void read_time(std::uint64_t index, Frame& frame) {
    const std::string step = group_ + "/position/step", time = group_ + "/position/time";
    if (file().has(step)) {
      const Shape shape = file().shape(step);
      if (shape.size() == 1 && index < shape[0]) frame.step = file().wholes(step, index).at(0);
      else if (shape.empty()) frame.step = static_cast<std::int64_t>(index) * file().wholes(step).at(0);
    }
    if (file().has(time)) {
      const Shape shape = file().shape(time);
      if (shape.size() == 1 && index < shape[0]) frame.time = file().reals(time, index).at(0);
      else if (shape.empty()) frame.time = static_cast<double>(index) * file().reals(time).at(0);
    }
  }

  std::string group_;
  bool moving_{};
  std::uint64_t frames_{}, rows_{};
};

// ---- GADGET: /PartTypeK/{Coordinates, Velocities, ParticleIDs, Masses, ...}, one behind the other with `type` = K.

class GadgetSource : public Hdf5Source {
public:
  using Hdf5Source::Hdf5Source;
  std::string_view format() const override { return "hdf5"; }
  std::uint64_t frame_count() override { return 1; }

  Frame read(std::uint64_t index) override {
    check_frame(index, 1);
    Frame frame;
    std::vector<Part> parts;
    for (int kind = 0; kind < 10; ++kind)
      if (file().has(fmt::format("/PartType{}/Coordinates", kind))) parts.push_back(part(kind));
    std::uint64_t rows = 0;
    for (const Part& p : parts) rows = plus(rows, p.rows);
    std::vector<Column> columns = joined(parts, rows);
    add_masses(parts, rows, columns);
    std::vector<std::int64_t> kinds;
    for (const Part& p : parts) kinds.insert(kinds.end(), p.rows, p.kind);
    columns.push_back({"type", 1, std::move(kinds), {}});
    frame.count = rows;
    assemble(frame, std::move(columns), {}, {file().name()});
    if (const auto size = file().attribute_numbers("/Header", "BoxSize"); size.size() == 1 || size.size() == 3) {
      Box box;
      for (int k = 0; k < 3; ++k) box.edges[k][k] = size[size.size() == 3 ? static_cast<std::size_t>(k) : 0];
      if (box.edges[0][0] > 0.0) frame.box = box;
    }
    if (const auto time = file().attribute_numbers("/Header", "Time"); time.size() == 1) frame.time = time[0];
    return frame;
  }

private:
  struct Part {
    int kind{};
    std::uint64_t rows{};
    std::vector<Column> columns{};
  };
  static std::string canonical(const std::string& name) {
    if (name == "Coordinates") return "position";
    if (name == "Velocities") return "velocity";
    if (name == "ParticleIDs") return "id";
    if (name == "Masses") return "mass";
    return name;
  }
  Part part(int kind) {
    Part out{kind, 0, {}};
    const std::string group = fmt::format("/PartType{}", kind);
    const Shape places = file().shape(group + "/Coordinates");
    if (places.size() != 2 || places[1] != 3) file().refuse(code::no_position, fmt::format("'{}/Coordinates' is no list of x, y, z", group));
    out.rows = places[0];
    for (const std::string& name : file().members(group)) {
      const std::string path = group + "/" + name;
      const Hdf5File::Type type = file().is_group(path) ? Hdf5File::Type::Other : file().type(path);
      if (type != Hdf5File::Type::Real && type != Hdf5File::Type::Whole) continue;
      const std::uint32_t width = components(file().shape(path), out.rows);
      if (width) out.columns.push_back(file().column(canonical(name), width, path));
    }
    return out;
  }
  // Columns of all kinds; what a kind does not have is NaN, and such columns are real.
  static std::vector<Column> joined(const std::vector<Part>& parts, std::uint64_t rows) {
    std::vector<Column> out;
    for (const Part& first : parts)
      for (const Column& model : first.columns) {
        if (std::any_of(out.begin(), out.end(), [&](const Column& c) { return c.name == model.name; })) continue;
        bool everywhere_whole = true;
        std::vector<const Column*> pieces;
        for (const Part& p : parts) {
          const auto found = std::find_if(p.columns.begin(), p.columns.end(), [&](const Column& c) { return c.name == model.name && c.components == model.components; });
          pieces.push_back(found == p.columns.end() ? nullptr : &*found);
          everywhere_whole = everywhere_whole && (pieces.back() ? pieces.back()->type() == ColumnType::Int : p.rows == 0);
        }
        out.push_back(everywhere_whole ? whole_column(model, pieces) : real_values(model, pieces, parts, rows));
      }
    return out;
  }
  static Column whole_column(const Column& model, const std::vector<const Column*>& pieces) {
    std::vector<std::int64_t> values;
    for (const Column* piece : pieces)
      if (piece) values.insert(values.end(), std::get<std::vector<std::int64_t>>(piece->values).begin(), std::get<std::vector<std::int64_t>>(piece->values).end());
    return {model.name, model.components, std::move(values), {}};
  }
  static Column real_values(const Column& model, const std::vector<const Column*>& pieces, const std::vector<Part>& parts, std::uint64_t rows) {
    std::vector<double> values;
    values.reserve(rows * model.components);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::uint64_t k = 0; k < parts[i].rows * model.components; ++k)
        values.push_back(pieces[i] ? pieces[i]->number(k / model.components, static_cast<std::uint32_t>(k % model.components)) : std::numeric_limits<double>::quiet_NaN());
    return {model.name, model.components, std::move(values), {}};
  }
  // Kinds whose particles all have one mass state it in the header.
  void add_masses(const std::vector<Part>& parts, std::uint64_t rows, std::vector<Column>& columns) const {
    const std::vector<double> table = file().attribute_numbers("/Header", "MassTable");
    auto found = std::find_if(columns.begin(), columns.end(), [](const Column& c) { return c.name == "mass"; });
    if (std::none_of(table.begin(), table.end(), [](double m) { return m > 0.0; })) return;
    if (found == columns.end()) {
      columns.push_back({"mass", 1, std::vector<double>(rows, std::numeric_limits<double>::quiet_NaN()), {}});
      found = std::prev(columns.end());
    }
    auto* mass = std::get_if<std::vector<double>>(&found->values);
    std::uint64_t row = 0;
    for (const Part& p : parts) {
      const double same = static_cast<std::size_t>(p.kind) < table.size() ? table[static_cast<std::size_t>(p.kind)] : 0.0;
      for (std::uint64_t k = 0; k < p.rows && mass; ++k)
        if (same > 0.0 && std::isnan((*mass)[row + k])) (*mass)[row + k] = same;
      row += p.rows;
    }
  }
};

// ---- VTKHDF: /VTKHDF/Points and /VTKHDF/PointData/ARRAY; the steps of a time series lie one behind the other.

class VtkHdfSource : public Hdf5Source {
public:
  explicit VtkHdfSource(const std::shared_ptr<Hdf5File>& file) : Hdf5Source(file) {
    const Shape shape = file->shape("/VTKHDF/Points");
    if (shape.size() != 2 || shape[1] != 3) file->refuse(code::no_position, "'/VTKHDF/Points' is no list of x, y, z");
    rows_ = shape[0];
    if (file->has("/VTKHDF/Steps")) warnings_.warning(molecule_code::left_out, {file->name()}, "the file holds a time series: all its steps are read as one frame");
  }
  std::string_view format() const override { return "hdf5"; }
  std::uint64_t frame_count() override { return 1; }
  Frame read(std::uint64_t index) override {
    check_frame(index, 1);
    Frame frame;
    frame.count = rows_;
    std::vector<Column> columns{file().column("position", 3, "/VTKHDF/Points")};
    const std::string group = "/VTKHDF/PointData";
    for (const std::string& name : file().has(group) ? file().members(group) : std::vector<std::string>{}) {
      const std::string path = group + "/" + name;
      const Hdf5File::Type type = file().type(path);
      if (type != Hdf5File::Type::Real && type != Hdf5File::Type::Whole) continue;
      if (const std::uint32_t width = components(file().shape(path), rows_)) columns.push_back(file().column(name, width, path));
    }
    assemble(frame, std::move(columns), {}, {file().name()});
    return frame;
  }

private:
  std::uint64_t rows_{};
};

} // namespace

std::unique_ptr<Source> open_h5md(const std::shared_ptr<Hdf5File>& file) {
  if (!file->has("/h5md") || !file->has("/particles")) return nullptr;
  for (const std::string& group : file->members("/particles"))
    if (file->has("/particles/" + group + "/position")) return std::make_unique<H5mdSource>(file, "/particles/" + group);
  file->refuse(code::no_position, "no group under /particles has positions");
}

std::unique_ptr<Source> open_gadget(const std::shared_ptr<Hdf5File>& file) {
  for (int kind = 0; kind < 10; ++kind)
    if (file->has(fmt::format("/PartType{}/Coordinates", kind))) return std::make_unique<GadgetSource>(file);
  return nullptr;
}

std::unique_ptr<Source> open_vtkhdf(const std::shared_ptr<Hdf5File>& file) {
  if (!file->has("/VTKHDF")) return nullptr;
  if (!file->has("/VTKHDF/Points")) file->refuse(molecule_code::variant, "the VTKHDF file has no Points: of its kinds, PolyData and UnstructuredGrid are read");
  return std::make_unique<VtkHdfSource>(file);
}

} // namespace mote::data
