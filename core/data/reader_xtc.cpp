// SPDX-License-Identifier: MIT
// XTC, the compressed trajectory of GROMACS: XDR (big-endian). One frame: magic 1995 (2023 with a
// 64-bit length), number of atoms, step, time, box of nine floats, then positions: plain floats up to
// nine atoms, otherwise packed (xtc_coordinates.hpp). Lengths in nm, times in ps. Positions only.
#include "core/data/binary.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/registry.hpp"
#include "core/data/xtc_coordinates.hpp"

#include <fmt/format.h>

namespace mote::data {
namespace {

constexpr std::int32_t magic_1995 = 1995, magic_2023 = 2023;
constexpr std::uint64_t plain_atoms = 9; // so few are not packed

struct XtcHead {
  std::uint64_t atoms{};
  std::int32_t step{};
  float time{};
  double box[9]{};
  bool long_size{}; // the length of the packed bits has 64 bits
};

class XtcSource : public BinaryTrajectory {
public:
  explicit XtcSource(std::shared_ptr<Bytes> bytes) : BinaryTrajectory(std::move(bytes), Order::Big) {}
  std::string_view format() const override { return "xtc"; }

protected:
  bool skip_frame(ByteReader& in) const override {
    const XtcHead head = read_head(in);
    if (head.atoms <= plain_atoms) {
      in.skip(head.atoms * 12, "the positions of a frame");
    } else {
      in.skip(32, "the header of the packed positions");
      skip_packed(in, head);
    }
    return true;
  }

  Frame read_frame(ByteReader in) const override {
    const XtcHead head = read_head(in);
    Frame frame;
    frame.count = head.atoms;
    frame.time = static_cast<double>(head.time);
    frame.step = head.step;
    frame.box = box_of(head);
    std::vector<double> positions;
    if (head.atoms <= plain_atoms) {
      positions.resize(3 * head.atoms);
      in.reals(4, positions, 1.0, "the positions of a frame");
    } else {
      positions = read_packed(in, head, frame);
    }
    frame.columns.push_back(real_column("position", 3, std::move(positions), "nm"));
    frame.properties.emplace_back("time_unit", "ps");
    return frame;
  }

private:
  static XtcHead read_head(ByteReader& in) {
    const std::uint64_t start = in.at();
    const auto magic = in.number<std::int32_t>("the header of a frame");
    if (magic != magic_1995 && magic != magic_2023)
      in.refuse_at(start, molecule_code::structure,
                   fmt::format("a frame of an XTC file begins with 1995 or 2023, not with {}", magic));
    XtcHead head;
    head.long_size = magic == magic_2023;
    const auto atoms = in.number<std::int32_t>("the header of a frame");
    head.step = in.number<std::int32_t>("the header of a frame");
    head.time = in.number<float>("the header of a frame");
    in.reals(4, head.box, 1.0, "the box of a frame");
    const std::uint64_t at = in.at();
    const auto again = in.number<std::int32_t>("the number of positions");
    if (atoms < 0)
      in.refuse_at(start + 4, molecule_code::count, fmt::format("the number of atoms is {}", atoms));
    if (again != atoms)
      in.refuse_at(at, molecule_code::count,
                   fmt::format("the frame has {} atoms, but {} positions", atoms, again));
    head.atoms = static_cast<std::uint64_t>(atoms);
    return head;
  }

  // Stands on the length of the packed bits; returns them and moves behind their padding.
  static std::string_view skip_packed(ByteReader& in, const XtcHead& head) {
    const std::uint64_t at = in.at();
    const std::int64_t length = head.long_size
                                    ? in.number<std::int64_t>("the length of the packed positions")
                                    : in.number<std::int32_t>("the length of the packed positions");
    if (length < 0)
      in.refuse_at(at, molecule_code::count, fmt::format("the length of the packed positions is {}", length));
    const auto bytes = static_cast<std::uint64_t>(length);
    const std::string_view packed = in.take(bytes, "the packed positions");
    in.skip((4 - bytes % 4) % 4, "the padding of the packed positions");
    // an atom takes at least two bits: a number of one bit and a flag
    if (head.atoms > 4 * bytes)
      in.refuse_at(at, molecule_code::count,
                   fmt::format("{} atoms cannot be packed in {} bytes", head.atoms, bytes));
    return packed;
  }

  static std::vector<double> read_packed(ByteReader& in, const XtcHead& head, Frame& frame) {
    XtcPacking packing;
    const std::uint64_t at = in.at();
    packing.precision = in.number<float>("the header of the packed positions");
    for (std::int32_t& value : packing.smallest)
      value = in.number<std::int32_t>("the header of the packed positions");
    for (std::int32_t& value : packing.largest)
      value = in.number<std::int32_t>("the header of the packed positions");
    packing.small_index = in.number<std::int32_t>("the header of the packed positions");
    if (!(packing.precision > 0 && packing.precision < 1e12f))
      in.refuse_at(at, molecule_code::compressed,
                   fmt::format("the precision of the packed positions is {}", packing.precision));
    const std::string_view packed = skip_packed(in, head);
    std::vector<double> positions(3 * head.atoms);
    if (const std::string_view wrong = unpack_xtc(packing, packed, positions); !wrong.empty())
      in.refuse_at(at, molecule_code::compressed, fmt::format("the packed positions are damaged: {}", wrong));
    frame.properties.emplace_back("precision", fmt::format("{}", packing.precision));
    return positions;
  }

  static std::optional<Box> box_of(const XtcHead& head) {
    Box box;
    bool any = false;
    for (int k = 0; k < 9; ++k) {
      box.edges[k / 3][k % 3] = head.box[k];
      any = any || head.box[k] != 0;
    }
    return any ? std::optional(box) : std::nullopt;
  }
};

Sureness probe(const Probe& file) {
  if (file.head.size() < 8) return Sureness::No;
  const auto magic = load_number<std::int32_t>(file.head.data(), Order::Big);
  return magic == magic_1995 || magic == magic_2023 ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader xtc_reader() {
  return {{"xtc", "GROMACS compressed trajectory (nm, ps)", "xtc", true},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<XtcSource>(std::move(bytes));
          }};
}

} // namespace mote::data
