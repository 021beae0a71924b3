// SPDX-License-Identifier: MIT
// OOMMF vector fields (.omf .ovf .ohf .oef), OVF 1.0 (binary: big endian) and 2.0 (little endian); text,
// binary 4 and binary 8; rectangular meshes (points are the nodes) and irregular ones. The first segment
// is read. Format: OOMMF User's Guide, chapter "File Formats: Vector Field File Format".
#include "core/data/codes_fields.hpp"
#include "core/data/grid.hpp"
#include "core/data/registry.hpp"
#include "core/data/scan.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace mote::data {
namespace {

struct Entry {
  std::string value{};
  std::uint64_t at{};
};

class Ovf {
public:
  Ovf(Bytes& bytes, Diagnostics& warnings)
      : file_(bytes.name()), scan_(file_, bytes.view()), warnings_(warnings) {}

  Frame read() {
    read_version();
    read_header();
    const bool irregular = lower(text("meshtype", "rectangular")) == "irregular";
    if (!irregular && lower(text("meshtype", "rectangular")) != "rectangular")
      refuse("meshtype", field_code::part,
             fmt::format("the meshtype {} is unknown", shown(text("meshtype", ""))),
             {"known: rectangular, irregular"});
    ImageGrid grid;
    std::uint64_t rows = 0;
    if (irregular) {
      rows = count("pointcount");
    } else {
      read_grid(grid);
      rows = grid.size.points();
      need_memory(times(rows, 6 * sizeof(double)), scan_.place(),
                  fmt::format("the {} points and their values", grid.size.text()));
    }
    const std::uint32_t values = value_count();
    std::vector<Column> arrays;
    Column data = read_data(rows, values + (irregular ? 3 : 0));
    std::uint32_t used = 0;
    if (irregular)
      arrays.push_back(split(data, used, 3, "position"));
    else
      arrays.push_back(position_column(image_points(grid, false, scan_.place())));
    arrays.front().unit = text("meshunit", "");
    add_values(data, used, values, arrays);
    finish();
    Frame frame;
    assemble(frame, std::move(arrays), {}, {file_});
    for (const char* key : {"title", "desc"})
      if (header_.contains(key)) frame.properties.emplace_back(key, header_.at(key).value);
    return frame;
  }

private:
  [[noreturn]] void refuse(const std::string& key, std::string_view code, std::string text,
                           std::vector<std::string> hints = {}) const {
    const auto found = header_.find(key);
    fail(Exit::BadInput, code, found == header_.end() ? scan_.place() : scan_.place_of(found->second.at),
         std::move(text), std::move(hints));
  }

  void read_version() {
    const std::string first = lower(scan_.line());
    if (first.find("ovf 2.0") != std::string::npos) {
      version_ = 2;
    } else if (first.find("mesh v1.0") != std::string::npos ||
               first.find("mesh v0.99") != std::string::npos || first.find("ovf 1.0") != std::string::npos) {
      version_ = 1;
    } else {
      scan_.refuse(field_code::variant,
                   fmt::format("the version of the OVF file is unknown: {}", shown(first)),
                   {"known: '# OOMMF OVF 2.0', '# OOMMF: rectangular mesh v1.0'"});
    }
  }

  // "# key: value" lines up to "# Begin: Data ..."; comments begin with ##.
  void read_header() {
    while (scan_.left() > 0) {
      const std::uint64_t at = scan_.offset();
      std::string_view line = trim(scan_.line());
      if (line.empty() || line.starts_with("##")) continue;
      if (!line.starts_with('#'))
        scan_.refuse(code::heading, fmt::format("a header line begins with '#', not {}", shown(line)));
      line = trim(
          line.substr(1, line.find("##", 1) == std::string_view::npos ? line.npos : line.find("##", 1) - 1));
      const std::size_t colon = line.find(':');
      if (line.empty()) continue;
      if (colon == std::string_view::npos)
        scan_.refuse(code::heading,
                     fmt::format("a header line has the form '# key: value': {}", shown(line)));
      const std::string key = lower(trim(line.substr(0, colon)));
      const std::string value(trim(line.substr(colon + 1)));
      if (key == "begin" && lower(value).starts_with("data")) {
        kind_ = lower(value);
        data_line_ = at;
        return;
      }
      if (key == "segment count" && value != "1") more_segments_ = value;
      header_.try_emplace(key, Entry{value, at});
    }
    scan_.refuse(code::ends_early, "the file ends early: '# Begin: Data' is missing");
  }

  std::string text(const std::string& key, const std::string& otherwise) const {
    const auto found = header_.find(key);
    return found == header_.end() ? otherwise : found->second.value;
  }
  std::uint64_t count(const std::string& key) const {
    if (!header_.contains(key))
      refuse(key, field_code::part, fmt::format("the header has no {}", shown(key)));
    std::uint64_t value = 0;
    if (!parse_count(header_.at(key).value, value))
      refuse(key, code::heading, fmt::format("{} is not a count: {}", key, shown(header_.at(key).value)));
    return value;
  }
  double real(const std::string& key) const {
    if (!header_.contains(key))
      refuse(key, field_code::part, fmt::format("the header has no {}", shown(key)));
    double value = 0;
    if (!parse_real(header_.at(key).value, value))
      refuse(key, code::not_a_value,
             fmt::format("{} is not a number: {}", key, shown(header_.at(key).value)));
    return value;
  }
  void read_grid(ImageGrid& grid) const {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string axis(1, static_cast<char>('x' + a));
      grid.size.nodes[a] = count(axis + "nodes");
      grid.origin[a] = real(axis + "base");
      grid.spacing[a] = real(axis + "stepsize");
    }
  }
  std::uint32_t value_count() const {
    if (version_ == 1 || !header_.contains("valuedim")) return 3;
    const std::uint64_t dim = count("valuedim");
    if (dim == 0 || dim > max_fields)
      refuse("valuedim", code::heading,
             fmt::format("valuedim is '{}'; 1 to {} are possible", dim, max_fields));
    return static_cast<std::uint32_t>(dim);
  }

  Column read_data(std::uint64_t rows, std::uint32_t columns) {
    if (kind_ == "data text") return scan_.numbers("values", rows, columns, false);
    scan_.binary = true;
    const bool wide = kind_ == "data binary 8";
    if (!wide && kind_ != "data binary 4") {
      scan_.binary = false;
      fail(Exit::BadInput, field_code::variant, scan_.place_of(data_line_),
           fmt::format("data of the kind {} cannot be read", shown(kind_)),
           {"readable: Data Text, Data Binary 4, Data Binary 8"});
    }
    const Order order = version_ == 1 ? Order::Big : Order::Little;
    const std::uint64_t at = scan_.offset();
    const std::string_view mark = scan_.take(wide ? 8 : 4, "the check value");
    const double seen = wide ? load_number<double>(mark.data(), order)
                             : static_cast<double>(load_number<float>(mark.data(), order));
    const double wanted = wide ? 123456789012345.0 : 1234567.0;
    if (seen != wanted)
      fail(Exit::BadInput, code::heading, scan_.place_of(at),
           fmt::format("the check value in front of the data is '{}' instead of {}", seen, wanted));
    const Scalar type = wide ? Scalar::Float64 : Scalar::Float32;
    const std::string_view bytes =
        scan_.take(times(times(rows, columns), size_of(type)), fmt::format("the values of {} points", rows));
    return unpack("values", bytes, {type, order, rows, columns, 0});
  }

  // `components` columns of `data` from `used` on.
  static Column split(const Column& data, std::uint32_t& used, std::uint32_t components, std::string name) {
    const auto& from = std::get<std::vector<double>>(data.values);
    std::vector<double> values;
    values.reserve(data.rows() * components);
    for (std::uint64_t r = 0; r < data.rows(); ++r)
      for (std::uint32_t k = 0; k < components; ++k) values.push_back(from[r * data.components + used + k]);
    used += components;
    return {std::move(name), components, std::move(values), {}};
  }

  // Labels such as Magnetization_x Magnetization_y Magnetization_z are one vector: assemble() joins them.
  void add_values(const Column& data, std::uint32_t used, std::uint32_t count,
                  std::vector<Column>& arrays) const {
    std::vector<std::string> labels, units;
    for (auto [key, list] : {std::pair{"valuelabels", &labels}, std::pair{"valueunits", &units}}) {
      const std::string line = text(key, "");
      Words words(line);
      for (std::string_view word = words.next(); !word.empty(); word = words.next()) list->emplace_back(word);
    }
    const std::string unit = units.empty() ? text("valueunit", "") : units.front();
    const double scale = header_.contains("valuemultiplier") ? real("valuemultiplier") : 1.0;
    const bool vector = count == 3 && (labels.size() != 3 || common_base(labels).has_value());
    const std::string whole = labels.size() == 3 && vector ? *common_base(labels)
                              : unit == "A/m"              ? "magnetization"
                                                           : "field";
    const std::size_t first = arrays.size();
    if (vector || labels.size() != count)
      arrays.push_back(split(data, used, count, whole));
    else
      for (std::uint32_t k = 0; k < count; ++k) arrays.push_back(split(data, used, 1, labels[k]));
    for (std::size_t i = first; i < arrays.size(); ++i) {
      arrays[i].unit = arrays.size() - first == units.size() ? units[i - first] : unit;
      if (scale != 1.0)
        for (double& value : std::get<std::vector<double>>(arrays[i].values)) value *= scale;
    }
  }
  static std::optional<std::string> common_base(const std::vector<std::string>& labels) {
    const std::string base = labels[0].substr(0, labels[0].size() - 1);
    for (std::size_t k = 0; k < 3; ++k)
      if (labels[k] != base + static_cast<char>('x' + k)) return std::nullopt;
    const std::size_t end = base.find_last_not_of("_. ");
    return base.empty() || end == std::string::npos ? std::string("field") : base.substr(0, end + 1);
  }

  void finish() {
    scan_.binary = false;
    std::string_view line;
    while (scan_.left() > 0 && line.empty()) line = trim(scan_.line());
    std::string end = lower(line.substr(std::min<std::size_t>(1, line.size())));
    if (lower(trim(end)) != "end: " + kind_)
      scan_.refuse(
          scan_.left() == 0 ? code::ends_early : code::follows,
          fmt::format("'# End: {}' is missing behind the values; here stands {}", kind_, shown(line)));
    if (scan_.rest().find("End: Segment") == std::string_view::npos &&
        lower(scan_.rest()).find("end: segment") == std::string::npos)
      scan_.refuse(code::ends_early, "the file ends early: '# End: Segment' is missing");
    if (!more_segments_.empty())
      warnings_.note(field_code::left_out, {file_},
                     fmt::format("the file has {} segments; the first is read", more_segments_));
  }

  std::string file_;
  Scan scan_;
  Diagnostics& warnings_;
  int version_{2};
  std::map<std::string, Entry> header_{};
  std::string kind_{}, more_segments_{};
  std::uint64_t data_line_{};
};

Frame parse_ovf(Bytes& bytes, Diagnostics& warnings) { return Ovf(bytes, warnings).read(); }

Sureness probe_ovf(const Probe& probe) {
  return lower(probe.head.substr(0, 7)) == "# oommf" ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader ovf_reader();
Reader ovf_reader() {
  return {{"ovf", "OOMMF vector field, OVF 1.0 and 2.0: text, binary 4, binary 8", "omf ovf ohf oef"},
          probe_ovf,
          [](std::shared_ptr<Bytes> bytes) { return one_frame("ovf", std::move(bytes), parse_ovf); }};
}

} // namespace mote::data
