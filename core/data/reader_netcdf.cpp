// SPDX-License-Identifier: MIT
// AMBER's NetCDF trajectories and restarts (also written by LAMMPS and VMD): classic NetCDF with the
// dimensions frame, atom, spatial and the variables coordinates, velocities, forces, cell_lengths,
// cell_angles, time ("AMBER NetCDF Trajectory/Restart Convention"). scale_factor is applied. Any other
// variable with one row for each atom becomes a column. Records have one length: any frame is found at
// once. Units are those of the attributes (A, ps).
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/names.hpp"
#include "core/data/netcdf.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mote::data {
namespace {

std::string short_unit(std::string unit) {
  for (const auto& [word, symbol] : {std::pair<std::string_view, std::string_view>{"angstrom", "A"},
                                     {"picosecond", "ps"},
                                     {"femtosecond", "fs"}}) {
    const std::size_t at = lower(unit).find(word);
    if (at == std::string::npos) continue;
    const std::size_t plural =
        at + word.size() < unit.size() && (unit[at + word.size()] | 0x20) == 's' ? 1 : 0;
    unit.replace(at, word.size() + plural, symbol);
  }
  return unit;
}

class NetcdfSource : public BinarySource {
public:
  explicit NetcdfSource(std::shared_ptr<Bytes> bytes)
      : BinarySource(std::move(bytes)), header_(read_netcdf_header(this->bytes())) {
    positions_ = header_.find("coordinates");
    if (!positions_) {
      std::vector<std::string> names;
      for (const NcVariable& v : header_.variables) names.push_back(v.name);
      reader(Order::Big)
          .refuse_at(0, code::no_position, "the file has no variable 'coordinates' (AMBER convention)",
                     {"variables: " + list_of(names)});
    }
    if (per_atom(*positions_) != 3)
      reader(Order::Big)
          .refuse_at(0, molecule_code::variant,
                     "the variable 'coordinates' is not one of (frame, atom, spatial) or (atom, spatial)");
    atom_dimension_ = positions_->dimensions[positions_->record ? 1 : 0];
    atoms_ = header_.dimensions[atom_dimension_].length;
    if (atoms_ == 0) reader(Order::Big).refuse_at(0, molecule_code::count, "the number of atoms is 0");
    count_frames();
  }
  std::string_view format() const override { return "netcdf"; }
  std::uint64_t frame_count() override { return frames_; }

  Frame read(std::uint64_t index) override {
    if (index >= frames_) no_such_frame(index, frames_);
    Frame frame;
    frame.count = atoms_;
    frame.box = box_of(index);
    if (const NcVariable* time = header_.find("time"); time && time->values == 1 && usable(*time, index)) {
      frame.time =
          netcdf_number(bytes(), header_, *time, index, 0) * time->number("scale_factor").value_or(1.0);
      if (const std::string unit = short_unit(time->text("units")); !unit.empty())
        frame.properties.emplace_back("time_unit", unit);
    }
    for (const NcVariable& v : header_.variables) add(v, index, frame);
    for (const std::string_view key : {"title", "program"})
      if (std::string text = header_.text(key); !text.empty())
        frame.properties.emplace_back(key, std::move(text));
    return frame;
  }

private:
  // Values for each atom, 0 when the variable is not of atoms.
  [[nodiscard]] std::uint64_t per_atom(const NcVariable& v) const {
    const std::size_t first = v.record ? 1 : 0;
    if (v.type == NcType::Char || v.dimensions.size() <= first || v.dimensions.size() > first + 3) return 0;
    const bool mine = positions_ == &v ? header_.dimensions[v.dimensions[first]].length > 0
                                       : v.dimensions[first] == atom_dimension_;
    if (!mine) return 0;
    std::uint64_t count = 1;
    for (std::size_t k = first + 1; k < v.dimensions.size(); ++k)
      count *= header_.dimensions[v.dimensions[k]].length;
    return count <= max_fields ? count : 0;
  }

  // Numbers, and the file holds the record.
  [[nodiscard]] bool usable(const NcVariable& v, std::uint64_t index) const {
    return v.type != NcType::Char && (!v.record || index < header_.records);
  }

  void count_frames() {
    frames_ = positions_->record ? header_.records : 1;
    if (frames_ == 0) {
      if (header_.stated_records == 0) no_such_frame(0, 0);
      ByteReader in = reader(Order::Big, positions_->at);
      in.skip(header_.record_size, "the first frame");
      no_such_frame(0, 0);
    }
    if (!positions_->record || header_.stated_records == ~std::uint64_t{0}) return;
    if (header_.stated_records > frames_)
      warnings_.warning(
          molecule_code::header_count, byte_place(bytes(), 4),
          fmt::format("the header promises {} frames, but the file has {}", header_.stated_records, frames_));
  }

  // The convention fixes A for positions where the file names no unit.
  [[nodiscard]] std::string unit_of(const NcVariable& v) const {
    std::string unit = short_unit(v.text("units"));
    const bool amber = lower(header_.text("Conventions")).find("amber") != std::string::npos;
    return unit.empty() && &v == positions_ && amber ? "A" : unit;
  }

  void add(const NcVariable& v, std::uint64_t index, Frame& frame) const {
    const auto components = static_cast<std::uint32_t>(per_atom(v));
    if (components == 0 || !usable(v, index)) return;
    std::string name = &v == positions_ ? "position" : canonical_name(v.name, components);
    if (v.name == "velocities") name = "velocity";
    if (v.name == "atom_types") name = "type";
    if (frame.find(name)) name = v.name;
    const double scale = v.number("scale_factor").value_or(1.0);
    std::vector<double> values = netcdf_reals(bytes(), header_, v, index, scale);
    const bool whole =
        v.type != NcType::Float && v.type != NcType::Double && scale == 1.0 && name != "position";
    if (whole) {
      std::vector<std::int64_t> numbers(values.size());
      std::transform(values.begin(), values.end(), numbers.begin(), whole_number);
      frame.columns.push_back(int_column(std::move(name), std::move(numbers), components));
      return;
    }
    frame.columns.push_back(real_column(std::move(name), components, std::move(values), unit_of(v)));
  }

  [[nodiscard]] std::optional<Box> box_of(std::uint64_t index) const {
    const NcVariable* lengths = header_.find("cell_lengths");
    const NcVariable* angles = header_.find("cell_angles");
    if (!lengths || lengths->values != 3 || !usable(*lengths, index)) return std::nullopt;
    const bool has_angles = angles && angles->values == 3 && usable(*angles, index);
    glm::dvec3 edge(0), angle(90);
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::uint64_t>(k);
      edge[k] = netcdf_number(bytes(), header_, *lengths, index, at) *
                lengths->number("scale_factor").value_or(1.0);
      if (has_angles)
        angle[k] = netcdf_number(bytes(), header_, *angles, index, at) *
                   angles->number("scale_factor").value_or(1.0);
    }
    std::optional<Box> box = cell_box(edge, angle);
    const NcVariable* origin = header_.find("cell_origin"); // LAMMPS
    for (int k = 0; box && origin && origin->values == 3 && usable(*origin, index) && k < 3; ++k)
      box->origin[k] = netcdf_number(bytes(), header_, *origin, index, static_cast<std::uint64_t>(k));
    return box;
  }

  NcHeader header_;
  const NcVariable* positions_{};
  std::uint32_t atom_dimension_{};
  std::uint64_t atoms_{}, frames_{};
};

Sureness probe(const Probe& file) {
  if (file.head.size() < 4 || !file.head.starts_with("CDF")) return Sureness::No;
  return file.head[3] == 1 || file.head[3] == 2 || file.head[3] == 5 ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader netcdf_reader() {
  return {{"netcdf", "AMBER trajectory or restart in classic NetCDF", "nc ncdf ncrst", true},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<NetcdfSource>(std::move(bytes));
          }};
}

} // namespace mote::data
