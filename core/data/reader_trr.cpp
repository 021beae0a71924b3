// SPDX-License-Identifier: MIT
// TRR, the full-precision trajectory of GROMACS: XDR (big-endian), float or double. One frame: magic
// 1993, version text, the byte lengths of its parts, then box, virial, pressure, positions, velocities,
// forces, each of which may be missing. Frames without positions are left out (D049). nm and ps.
#include "core/data/binary.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/registry.hpp"
#include "core/data/text.hpp"

#include <fmt/format.h>

#include <array>

namespace mote::data {
namespace {

constexpr std::int32_t magic = 1993;
constexpr std::string_view version = "GMX_trn_file";

struct TrrHead {
  std::uint64_t box{}, before{}, position{}, velocity{},
      force{};                    // bytes; `before`: between box and positions
  std::uint64_t atoms{}, real{4}; // bytes of a real number
  std::int32_t step{};
  double time{};
};

class TrrSource : public BinaryTrajectory {
public:
  explicit TrrSource(std::shared_ptr<Bytes> bytes) : BinaryTrajectory(std::move(bytes), Order::Big) {}
  std::string_view format() const override { return "trr"; }

protected:
  bool skip_frame(ByteReader& in) const override {
    const TrrHead head = read_head(in);
    for (const std::uint64_t part : {head.box, head.before, head.position, head.velocity, head.force})
      in.skip(part, "the values of a frame");
    return head.position > 0;
  }

  Frame read_frame(ByteReader in) const override {
    const TrrHead head = read_head(in);
    Frame frame;
    frame.count = head.atoms;
    frame.time = head.time;
    frame.step = head.step;
    if (head.box > 0) {
      std::array<double, 9> edges{};
      in.reals(head.real, edges, 1.0, "the box");
      Box box;
      for (int k = 0; k < 9; ++k) box.edges[k / 3][k % 3] = edges[static_cast<std::size_t>(k)];
      if (box.edges != glm::dmat3(0.0)) frame.box = box;
    }
    in.skip(head.before, "virial and pressure");
    add(in, head, head.position, "position", "nm", frame);
    add(in, head, head.velocity, "velocity", "nm/ps", frame);
    add(in, head, head.force, "force", "kJ/mol/nm", frame);
    frame.properties.emplace_back("time_unit", "ps");
    return frame;
  }

private:
  static void add(ByteReader& in, const TrrHead& head, std::uint64_t bytes, std::string name,
                  std::string unit, Frame& frame) {
    if (bytes == 0) return;
    if (bytes > in.left()) in.skip(bytes, "the values of a frame"); // says so, before anything is allocated
    std::vector<double> values(3 * head.atoms);
    in.reals(head.real, values, 1.0, "the values of a frame");
    frame.columns.push_back(real_column(std::move(name), 3, std::move(values), std::move(unit)));
  }

  static void read_version(ByteReader& in) {
    const std::uint64_t start = in.at();
    if (const auto word = in.number<std::int32_t>("the header of a frame"); word != magic)
      in.refuse_at(start, molecule_code::structure,
                   fmt::format("a frame of a TRR file begins with 1993, not with {}", word));
    (void)in.number<std::int32_t>("the header of a frame"); // the length with the final zero
    const auto length = in.number<std::uint32_t>("the header of a frame");
    if (length != version.size())
      in.refuse_at(start + 8, molecule_code::structure,
                   fmt::format("the version text of a TRR frame has 12 letters, not {}", length));
    if (const std::string_view text = in.take(length, "the header of a frame"); text != version)
      in.refuse_at(start + 12, molecule_code::structure,
                   fmt::format("the version text of a TRR frame is '{}', not {}", version, shown(text)));
  }

  static TrrHead read_head(ByteReader& in) {
    read_version(in);
    const std::uint64_t start = in.at();
    std::array<std::int32_t, 13> words{}; // ir e box vir pres top sym x v f, atoms, step, nre
    for (std::int32_t& word : words) word = in.number<std::int32_t>("the header of a frame");
    for (std::size_t k = 0; k < 11; ++k)
      if (words[k] < 0)
        in.refuse_at(start + 4 * k, molecule_code::count,
                     fmt::format("a length in the header of a frame is {}", words[k]));
    auto length = [&](std::size_t k) { return static_cast<std::uint64_t>(words[k]); };
    TrrHead head{length(2), length(0) + length(1) + length(3) + length(4) + length(5) + length(6),
                 length(7), length(8),
                 length(9), length(10)};
    head.step = words[11];
    check_lengths(in, start, head);
    head.time = read_real(in, head.real);
    (void)read_real(in, head.real); // lambda
    return head;
  }

  // The size of a real number follows from the box or the vectors; all must agree.
  static void check_lengths(const ByteReader& in, std::uint64_t start, TrrHead& head) {
    for (const std::uint64_t part :
         {head.box / 9, head.atoms ? head.position / (3 * head.atoms) : 0,
          head.atoms ? head.velocity / (3 * head.atoms) : 0, head.atoms ? head.force / (3 * head.atoms) : 0})
      if (part > 0) {
        head.real = part;
        break;
      }
    const std::uint64_t vectors = 3 * head.atoms * head.real;
    const bool fits = (head.real == 4 || head.real == 8) && (head.box == 0 || head.box == 9 * head.real) &&
                      (head.position == 0 || head.position == vectors) &&
                      (head.velocity == 0 || head.velocity == vectors) &&
                      (head.force == 0 || head.force == vectors);
    if (!fits)
      in.refuse_at(
          start, molecule_code::count,
          fmt::format(
              "the lengths in the header of a frame do not fit {} atoms: box {}, positions {}, velocities "
              "{}, forces {} bytes",
              head.atoms, head.box, head.position, head.velocity, head.force));
  }

  static double read_real(ByteReader& in, std::uint64_t width) {
    if (width == 8) return in.number<double>("the time of a frame");
    return static_cast<double>(in.number<float>("the time of a frame"));
  }
};

Sureness probe(const Probe& file) {
  if (file.head.size() < 24) return Sureness::No;
  const auto word = load_number<std::int32_t>(file.head.data(), Order::Big);
  return word == magic && file.head.substr(12, version.size()) == version ? Sureness::Certain : Sureness::No;
}

} // namespace

Reader trr_reader() {
  return {{"trr", "GROMACS full-precision trajectory (nm, ps)", "trr", true},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<TrrSource>(std::move(bytes));
          }};
}

} // namespace mote::data
