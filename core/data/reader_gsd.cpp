// SPDX-License-Identifier: MIT
// GSD, HOOMD-blue's trajectory: a header of 256 bytes, an index of 32 bytes for each chunk (frame,
// rows, place, columns, name, type), a list of names, and the chunks anywhere between. Little-endian,
// file versions 1.0 to 2.x, schema hoomd. A chunk that a frame does not have is that of frame 0 (if the
// number of particles is the same), otherwise the schema's default, which is no column here. Reduced
// units; the box is centered on the origin. Quaternions are w x y z.
#include "core/data/binary.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mote::data {
namespace {

constexpr std::uint64_t magic = 0x65DF65DF65DF65DF;
constexpr std::uint64_t header_size = 256, entry_size = 32, name_size = 64;
enum Type : std::uint8_t { u8 = 1, u16, u32, u64, i8, i16, i32, i64, f32, f64, character };

struct Chunk {
  std::uint64_t frame{}, rows{}, at{};
  std::uint32_t columns{};
  std::uint16_t name{};
  std::uint8_t type{};
};

std::uint64_t width_of(std::uint8_t type) {
  constexpr std::array<std::uint8_t, 12> widths{0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8, 1};
  return type < widths.size() ? widths[type] : 0;
}

double number_at(const char* from, std::uint8_t type) {
  switch (type) {
  case u8: return load_number<std::uint8_t>(from, Order::Little);
  case u16: return load_number<std::uint16_t>(from, Order::Little);
  case u32: return load_number<std::uint32_t>(from, Order::Little);
  case u64: return static_cast<double>(load_number<std::uint64_t>(from, Order::Little));
  case i8: return load_number<std::int8_t>(from, Order::Little);
  case i16: return load_number<std::int16_t>(from, Order::Little);
  case i32: return load_number<std::int32_t>(from, Order::Little);
  case i64: return static_cast<double>(load_number<std::int64_t>(from, Order::Little));
  case f32: return static_cast<double>(load_number<float>(from, Order::Little));
  case f64: return load_number<double>(from, Order::Little);
  default: return load_number<std::uint8_t>(from, Order::Little);
  }
}

// A chunk of the schema that becomes a column.
struct Known {
  std::string_view chunk{}, column{};
  std::uint32_t components{};
  double scale{1};
  std::string_view unit{};
};
constexpr std::array<Known, 11> known_chunks{{
    {"particles/position", "position", 3},
    {"particles/velocity", "velocity", 3},
    {"particles/orientation", "orientation", 4, 1, "wxyz"},
    {"particles/angmom", "angular_momentum", 4, 1, "wxyz"},
    {"particles/moment_inertia", "moment_inertia", 3},
    {"particles/diameter", "radius", 1, 0.5},
    {"particles/mass", "mass", 1},
    {"particles/charge", "charge", 1},
    {"particles/slength", "slength", 1},
    {"particles/image", "image", 3},
    {"particles/body", "body", 1},
}};

class GsdSource : public BinarySource {
public:
  explicit GsdSource(std::shared_ptr<Bytes> bytes) : BinarySource(std::move(bytes)) {
    ByteReader in = reader(Order::Little);
    if (in.number<std::uint64_t>("the header") != magic)
      in.refuse_at(0, molecule_code::structure, "a GSD file begins with the bytes df 65 df 65 df 65 df 65");
    const auto index_at = in.number<std::uint64_t>("the header");
    const auto index_entries = in.number<std::uint64_t>("the header");
    const auto names_at = in.number<std::uint64_t>("the header");
    const auto names_entries = in.number<std::uint64_t>("the header");
    const auto schema_version = in.number<std::uint32_t>("the header");
    version_ = in.number<std::uint32_t>("the header");
    in.skip(64, "the header");
    const std::string_view schema = in.take(64, "the header");
    check_version(in, schema.substr(0, std::min(schema.find('\0'), schema.size())), schema_version);
    in.seek(header_size);
    read_names(table(names_at, names_entries, name_size, "the list of names"));
    read_index(table(index_at, index_entries, entry_size, "the index"), index_at);
  }
  std::string_view format() const override { return "gsd"; }
  std::uint64_t frame_count() override { return frames_; }

  Frame read(std::uint64_t index) override {
    if (index >= frames_) no_such_frame(index, frames_);
    Frame frame;
    if (const Chunk* step = find(index, "configuration/step")) frame.step = whole_number(single(*step));
    frame.count = count_of(index, "particles/N");
    frame.box = box_of(index);
    for (const Known& known : known_chunks) add_known(index, known, frame);
    if (!frame.find("position"))
      reader(Order::Little)
          .refuse_at(0, code::no_position, fmt::format("frame {} has no chunk particles/position", index));
    add_types(index, frame);
    add_logged(index, frame);
    add_bonds(index, frame);
    return frame;
  }

private:
  void check_version(const ByteReader& in, std::string_view schema, std::uint32_t schema_version) const {
    if ((version_ >> 16) > 2)
      in.refuse_at(44, molecule_code::variant,
                   fmt::format("the file has GSD version {}.{}; versions 1 and 2 are read", version_ >> 16,
                               version_ & 0xffff));
    if (schema != "hoomd")
      in.refuse_at(112, molecule_code::variant,
                   fmt::format("the schema of the file is {}; only 'hoomd' is read", shown(schema)));
    if ((schema_version >> 16) > 1)
      in.refuse_at(40, molecule_code::variant,
                   fmt::format("the schema has version {}; version 1 is read", schema_version >> 16));
  }

  std::string_view table(std::uint64_t at, std::uint64_t entries, std::uint64_t size,
                         std::string_view what) const {
    ByteReader in = reader(Order::Little, at);
    std::uint64_t length = 0;
    if (!multiply(entries, size, length))
      in.refuse_at(8, molecule_code::count, fmt::format("{} cannot have {} entries", what, entries));
    return in.take(length, what);
  }

  // Version 1: 64 bytes for each name; version 2: names one behind the other, each ended by a zero.
  void read_names(std::string_view all) {
    if ((version_ >> 16) < 2) {
      for (std::uint64_t at = 0; at < all.size() && all[at] != '\0'; at += name_size)
        names_.emplace_back(all.substr(at, std::min(all.substr(at, name_size).find('\0'), name_size)));
      return;
    }
    while (!all.empty() && all[0] != '\0') {
      const std::size_t end = std::min(all.find('\0'), all.size());
      names_.emplace_back(all.substr(0, end));
      all.remove_prefix(std::min(end + 1, all.size()));
    }
  }

  void read_index(std::string_view all, std::uint64_t start) {
    for (std::uint64_t at = 0; at < all.size(); at += entry_size) {
      const char* from = all.data() + at;
      Chunk chunk;
      chunk.frame = load_number<std::uint64_t>(from, Order::Little);
      chunk.rows = load_number<std::uint64_t>(from + 8, Order::Little);
      chunk.at = load_number<std::uint64_t>(from + 16, Order::Little);
      if (chunk.at == 0) break; // the unused rest of the table
      chunk.columns = load_number<std::uint32_t>(from + 24, Order::Little);
      chunk.name = load_number<std::uint16_t>(from + 28, Order::Little);
      chunk.type = load_number<std::uint8_t>(from + 30, Order::Little);
      check_chunk(chunk, start + at);
      chunks_.push_back(chunk);
    }
    auto before = [](const Chunk& a, const Chunk& b) {
      return std::pair(a.frame, a.name) < std::pair(b.frame, b.name);
    };
    std::stable_sort(chunks_.begin(), chunks_.end(), before);
    frames_ = chunks_.empty() ? 0 : chunks_.back().frame + 1;
    if (frames_ == 0) no_such_frame(0, 0);
  }

  void check_chunk(const Chunk& chunk, std::uint64_t entry_at) const {
    const ByteReader in = reader(Order::Little, entry_at);
    std::uint64_t values = 0, length = 0;
    if (chunk.name >= names_.size() || width_of(chunk.type) == 0)
      in.refuse(molecule_code::structure,
                fmt::format("an entry of the index has name {} and type {}; there are {} names and 11 types",
                            chunk.name, chunk.type, names_.size()));
    if (!multiply(chunk.rows, chunk.columns, values) || !multiply(values, width_of(chunk.type), length))
      in.refuse(molecule_code::count, fmt::format("chunk '{}' cannot have {} rows of {}", names_[chunk.name],
                                                  chunk.rows, chunk.columns));
    if (chunk.at > in.size() || length > in.size() - chunk.at)
      in.refuse(code::ends_early,
                fmt::format("the file ends within chunk '{}' of frame {}", names_[chunk.name], chunk.frame));
    if (chunk.frame > in.size() / entry_size) // the index has an entry for every frame
      in.refuse(
          molecule_code::count,
          fmt::format("an entry of the index belongs to frame {}, which the file cannot hold", chunk.frame));
  }

  [[nodiscard]] const Chunk* in_frame(std::uint64_t frame, std::string_view name) const {
    const auto id = std::find(names_.begin(), names_.end(), name);
    if (id == names_.end()) return nullptr;
    const std::pair<std::uint64_t, std::uint16_t> key(frame, static_cast<std::uint16_t>(id - names_.begin()));
    const auto at =
        std::lower_bound(chunks_.begin(), chunks_.end(), key, [](const Chunk& c, const auto& wanted) {
          return std::pair(c.frame, c.name) < wanted;
        });
    return at != chunks_.end() && std::pair(at->frame, at->name) == key ? &*at : nullptr;
  }
  [[nodiscard]] const Chunk* find(std::uint64_t frame, std::string_view name) const {
    const Chunk* own = in_frame(frame, name);
    return own ? own : in_frame(0, name);
  }
  [[nodiscard]] const char* data(const Chunk& chunk) const { return bytes().view().data() + chunk.at; }
  [[nodiscard]] double single(const Chunk& chunk) const {
    return chunk.rows * chunk.columns > 0 ? number_at(data(chunk), chunk.type) : 0;
  }
  [[nodiscard]] std::uint64_t count_of(std::uint64_t frame, std::string_view name) const {
    const Chunk* chunk = find(frame, name);
    return chunk && (chunk->type == u32 || chunk->type == u64)
               ? static_cast<std::uint64_t>(whole_number(single(*chunk)))
               : 0;
  }
  // A chunk with one row for each of `rows` things; frame 0's only if it fits.
  [[nodiscard]] const Chunk* fitting(std::uint64_t frame, std::string_view name, std::uint64_t rows,
                                     std::uint32_t columns) const {
    const Chunk* chunk = find(frame, name);
    if (!chunk || (chunk->rows == rows && chunk->columns == columns)) return chunk;
    if (chunk->frame != frame) return nullptr;
    reader(Order::Little)
        .refuse_at(chunk->at, molecule_code::count,
                   fmt::format("chunk '{}' of frame {} has {} x {} values, but {} x {} are needed", name,
                               frame, chunk->rows, chunk->columns, rows, columns));
  }

  [[nodiscard]] Column column_of(const Chunk& chunk, std::string name, double scale, std::string unit) const {
    const std::uint64_t values = chunk.rows * chunk.columns, width = width_of(chunk.type);
    if (chunk.type >= f32 || scale != 1) {
      std::vector<double> out(values);
      for (std::uint64_t i = 0; i < values; ++i)
        out[i] = number_at(data(chunk) + i * width, chunk.type) * scale;
      return real_column(std::move(name), chunk.columns, std::move(out), std::move(unit));
    }
    std::vector<std::int64_t> out(values);
    for (std::uint64_t i = 0; i < values; ++i)
      out[i] = whole_number(number_at(data(chunk) + i * width, chunk.type));
    return int_column(std::move(name), std::move(out), chunk.columns);
  }

  void add_known(std::uint64_t index, const Known& known, Frame& frame) const {
    if (const Chunk* chunk = fitting(index, known.chunk, frame.count, known.components))
      frame.columns.push_back(
          column_of(*chunk, std::string(known.column), known.scale, std::string(known.unit)));
  }

  // Names of types: one row of letters for each, filled up with zeros. Without the chunk: "A".
  [[nodiscard]] std::vector<std::string> names_in(const Chunk* chunk) const {
    std::vector<std::string> out;
    if (!chunk || width_of(chunk->type) != 1 || chunk->columns == 0) return {"A"};
    for (std::uint64_t row = 0; row < chunk->rows; ++row) {
      const std::string_view name(data(*chunk) + row * chunk->columns, chunk->columns);
      out.emplace_back(name.substr(0, std::min(name.find('\0'), name.size())));
    }
    return out;
  }

  void add_types(std::uint64_t index, Frame& frame) const {
    const Chunk* typeid_chunk = fitting(index, "particles/typeid", frame.count, 1);
    TextColumn types{std::vector<std::uint32_t>(frame.count, 0), names_in(find(index, "particles/types"))};
    if (types.dictionary.empty()) types.dictionary.emplace_back("A");
    for (std::uint64_t row = 0; typeid_chunk && row < frame.count; ++row) {
      const double id =
          number_at(data(*typeid_chunk) + row * width_of(typeid_chunk->type), typeid_chunk->type);
      if (!(id >= 0 && id < static_cast<double>(types.dictionary.size())))
        reader(Order::Little)
            .refuse_at(typeid_chunk->at + row * width_of(typeid_chunk->type), molecule_code::count,
                       fmt::format("particle {} has type {}, but there are {} types", row, id,
                                   types.dictionary.size()));
      types.codes[row] = static_cast<std::uint32_t>(id);
    }
    frame.columns.push_back({"type", 1, std::move(types), {}});
  }

  // log/...: values for each particle become columns, single values become properties.
  void add_logged(std::uint64_t index, Frame& frame) const {
    for (const std::string& name : names_) {
      if (!name.starts_with("log/")) continue;
      const Chunk* chunk = in_frame(index, name);
      if (!chunk || frame.find(name.substr(4))) continue;
      if (name.starts_with("log/particles/") && chunk->rows == frame.count && chunk->columns > 0)
        frame.columns.push_back(column_of(*chunk, name.substr(4), 1, {}));
      else if (chunk->rows * chunk->columns == 1)
        frame.properties.emplace_back(name.substr(4), fmt::format("{}", single(*chunk)));
    }
  }

  void add_bonds(std::uint64_t index, Frame& frame) const {
    const std::uint64_t count = count_of(index, "bonds/N");
    const Chunk* group = count > 0 ? fitting(index, "bonds/group", count, 2) : nullptr;
    if (!group) return;
    const Chunk* types = fitting(index, "bonds/typeid", count, 1);
    const std::uint64_t width = width_of(group->type);
    BondList bonds;
    for (std::uint64_t k = 0; k < count; ++k) {
      const double a = number_at(data(*group) + 2 * k * width, group->type);
      const double b = number_at(data(*group) + (2 * k + 1) * width, group->type);
      const auto rows = static_cast<double>(frame.count);
      if (!(a >= 0 && b >= 0 && a < rows && b < rows))
        reader(Order::Little)
            .refuse_at(
                group->at + 2 * k * width, molecule_code::bond,
                fmt::format("bond {} joins particles {} and {}, but there are {}", k, a, b, frame.count));
      const double type = types ? number_at(data(*types) + k * width_of(types->type), types->type) : 0;
      bonds.add(static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b), whole_number(type));
    }
    frame.bonds = bonds.take();
  }

  // Lx Ly Lz xy xz yz: c = (xz Lz, yz Lz, Lz) and so on, as HOOMD-blue's documentation has it.
  [[nodiscard]] std::optional<Box> box_of(std::uint64_t index) const {
    const Chunk* chunk = find(index, "configuration/box");
    if (!chunk || chunk->rows * chunk->columns < 6) return std::nullopt;
    double v[6]{};
    for (std::uint64_t k = 0; k < 6; ++k)
      v[k] = number_at(data(*chunk) + k * width_of(chunk->type), chunk->type);
    Box box;
    box.edges = glm::dmat3(v[0], 0, 0, v[3] * v[1], v[1], 0, v[4] * v[2], v[5] * v[2], v[2]);
    box.origin = -0.5 * (box.edges[0] + box.edges[1] + box.edges[2]);
    const Chunk* dimensions = find(index, "configuration/dimensions");
    box.periodic.z = !(dimensions && single(*dimensions) == 2);
    return box;
  }

  std::uint32_t version_{};
  std::uint64_t frames_{};
  std::vector<std::string> names_{};
  std::vector<Chunk> chunks_{};
};

Sureness probe(const Probe& file) {
  const bool fits =
      file.head.size() >= 8 && load_number<std::uint64_t>(file.head.data(), Order::Little) == magic;
  return fits ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader gsd_reader() {
  return {{"gsd", "HOOMD-blue trajectory, schema hoomd", "gsd"},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<GsdSource>(std::move(bytes));
          }};
}

} // namespace mote::data
