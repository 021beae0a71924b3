// SPDX-License-Identifier: MIT
// DCD, the trajectory of CHARMM, NAMD and X-PLOR: Fortran records (length, bytes, length) of either byte
// order, lengths of 4 or 8 bytes. Header, titles, number of atoms, list of free atoms when some are
// fixed; then for each frame the cell (CHARMM), x, y, z (and a fourth coordinate, ignored) as floats.
// Frames have one length, so that any of them is found at once. Positions in A; the time step's unit is
// the program's own, so that no time is given.
#include "core/data/binary.hpp"
#include "core/data/codes_molecular.hpp"
#include "core/data/molecule.hpp"
#include "core/data/registry.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace mote::data {
namespace {

// What the first eight bytes say of the file's kind: order and width of record lengths.
struct Marks {
  Order order{};
  std::uint64_t width{};
};
std::optional<Marks> find_marks(std::string_view head) {
  for (const Order order : {Order::Little, Order::Big}) {
    if (head.size() >= 8 && load_number<std::uint32_t>(head.data(), order) == 84 &&
        (head.substr(4, 4) == "CORD" || head.substr(4, 4) == "VELD"))
      return Marks{order, 4};
    if (head.size() >= 12 && load_number<std::uint64_t>(head.data(), order) == 84 &&
        (head.substr(8, 4) == "CORD" || head.substr(8, 4) == "VELD"))
      return Marks{order, 8};
  }
  return std::nullopt;
}

class DcdSource : public BinarySource {
public:
  explicit DcdSource(std::shared_ptr<Bytes> bytes) : BinarySource(std::move(bytes)) {
    const auto marks = find_marks(this->bytes().view());
    if (!marks)
      reader(Order::Little)
          .refuse(molecule_code::structure,
                  "a DCD file begins with a record of 84 bytes and the word 'CORD'");
    marks_ = *marks;
    ByteReader in = reader(marks_.order);
    read_header(in);
    measure_frames(in);
  }
  std::string_view format() const override { return "dcd"; }
  std::uint64_t frame_count() override { return frames_; }

  Frame read(std::uint64_t index) override {
    if (index >= frames_) no_such_frame(index, frames_);
    if (some_fixed_ && fixed_positions_.empty())
      fixed_positions_ = read_positions(reader_at(0), false).second;
    auto [box, positions] = read_positions(reader_at(index), index > 0 && some_fixed_);
    Frame frame;
    frame.count = atoms_;
    frame.box = box;
    frame.step = first_step_ + static_cast<std::int64_t>(index) * step_interval_;
    frame.columns.push_back(real_column("position", 3, std::move(positions), "A"));
    return frame;
  }

private:
  [[nodiscard]] ByteReader reader_at(std::uint64_t index) const {
    return reader(marks_.order, index == 0 ? first_at_ : first_at_ + first_size_ + (index - 1) * later_size_);
  }
  [[nodiscard]] std::uint64_t mark(ByteReader& in, std::string_view what) const {
    return marks_.width == 8 ? in.number<std::uint64_t>(what) : in.number<std::uint32_t>(what);
  }
  // The content of the next record; `expected` bytes of it when given.
  std::string_view record(ByteReader& in, std::string_view what,
                          std::optional<std::uint64_t> expected = {}) const {
    const std::uint64_t start = in.at();
    const std::uint64_t length = mark(in, what);
    if (expected && length != *expected)
      in.refuse_at(start, molecule_code::structure,
                   fmt::format("the record of {} has {} bytes, but {} are needed", what, length, *expected));
    const std::string_view content = in.take(length, what);
    const std::uint64_t end = in.at();
    if (const std::uint64_t again = mark(in, what); again != length)
      in.refuse_at(
          end, molecule_code::structure,
          fmt::format("the record of {} begins with length {} and ends with {}", what, length, again));
    return content;
  }

  void read_header(ByteReader& in) {
    const std::string_view head = record(in, "the header", 84);
    if (head.starts_with("VELD"))
      in.refuse_at(marks_.width, molecule_code::variant,
                   "the file holds velocities ('VELD'), not positions ('CORD')");
    std::array<std::int32_t, 20> words{};
    for (std::size_t k = 0; k < words.size(); ++k)
      words[k] = load_number<std::int32_t>(head.data() + 4 + 4 * k, marks_.order);
    stated_frames_ = words[0];
    first_step_ = words[1];
    step_interval_ = words[2];
    const bool charmm = words[19] != 0;
    has_cell_ = charmm && words[10] != 0;
    has_fourth_ = charmm && words[11] == 1;
    (void)record(in, "the titles");
    const std::uint64_t at = in.at() + marks_.width;
    const auto atoms = load_number<std::int32_t>(record(in, "the number of atoms", 4).data(), marks_.order);
    if (atoms < 1) in.refuse_at(at, molecule_code::count, fmt::format("the number of atoms is {}", atoms));
    atoms_ = static_cast<std::uint64_t>(atoms);
    const std::int32_t fixed = words[8];
    if (fixed < 0 || fixed > atoms)
      in.refuse_at(marks_.width + 36, molecule_code::count,
                   fmt::format("{} atoms are fixed, but there are {}", fixed, atoms_));
    if (fixed > 0) read_free_atoms(in, atoms_ - static_cast<std::uint64_t>(fixed));
  }

  void read_free_atoms(ByteReader& in, std::uint64_t count) {
    const std::uint64_t at = in.at() + marks_.width;
    const std::string_view list = record(in, "the list of free atoms", 4 * count);
    free_.resize(count);
    for (std::uint64_t k = 0; k < count; ++k) {
      const auto number = load_number<std::int32_t>(list.data() + 4 * k, marks_.order);
      if (number < 1 || static_cast<std::uint64_t>(number) > atoms_)
        in.refuse_at(at + 4 * k, molecule_code::count,
                     fmt::format("the list of free atoms names atom {}, but there are {}", number, atoms_));
      free_[k] = static_cast<std::uint32_t>(number - 1);
    }
    some_fixed_ = true;
  }

  // Frame lengths and number of frames, from the file's size: writers often leave the header's count.
  void measure_frames(const ByteReader& in) {
    first_at_ = in.at();
    const std::uint64_t cell = has_cell_ ? 48 + 2 * marks_.width : 0;
    const std::uint64_t sets = has_fourth_ ? 4 : 3;
    first_size_ = cell + sets * (4 * atoms_ + 2 * marks_.width);
    const std::uint64_t moving = some_fixed_ ? free_.size() : atoms_;
    later_size_ = cell + sets * (4 * moving + 2 * marks_.width);
    if (in.left() < first_size_) {
      ByteReader tail = in;
      tail.skip(first_size_, "the first frame");
    }
    const std::uint64_t behind = in.left() - first_size_;
    frames_ = 1 + behind / later_size_;
    if (behind % later_size_ != 0)
      warnings_.warning(code::cut_frame, byte_place(bytes(), in.size() - behind % later_size_),
                        fmt::format("frame {} is cut off and left out: the file ends within it", frames_));
    if (stated_frames_ > 0 && static_cast<std::uint64_t>(stated_frames_) != frames_)
      warnings_.warning(
          molecule_code::header_count, byte_place(bytes(), marks_.width + 4),
          fmt::format("the header promises {} frames, but the file has {}", stated_frames_, frames_));
  }

  std::pair<std::optional<Box>, std::vector<double>> read_positions(ByteReader in, bool only_free) const {
    std::optional<Box> box;
    if (has_cell_) {
      std::array<double, 6> cell{};
      const std::string_view content = record(in, "the cell", 48);
      load_reals<double>(content.data(), marks_.order, cell);
      box = cell_of(cell);
    }
    const std::uint64_t count = only_free ? free_.size() : atoms_;
    std::array<std::string_view, 3> axes;
    for (std::size_t k = 0; k < 3; ++k)
      axes[k] = record(in,
                       k == 0   ? "the x positions"
                       : k == 1 ? "the y positions"
                                : "the z positions",
                       4 * count);
    std::vector<double> positions = only_free ? fixed_positions_ : std::vector<double>(3 * atoms_);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t row = only_free ? free_[i] : i;
      for (std::size_t k = 0; k < 3; ++k)
        positions[3 * row + k] =
            static_cast<double>(load_number<float>(axes[k].data() + 4 * i, marks_.order));
    }
    return {box, std::move(positions)};
  }

  // CHARMM's order: A, gamma, B, beta, alpha, C. Angles are cosines (NAMD, CHARMM) or degrees; what is
  // neither is the lower triangle of the symmetric cell matrix (CHARMM 25 and later).
  static std::optional<Box> cell_of(const std::array<double, 6>& c) {
    glm::dvec3 angles(c[4], c[3], c[1]);
    bool cosines = true, degrees = true;
    for (int k = 0; k < 3; ++k) {
      cosines = cosines && std::abs(angles[k]) <= 1;
      degrees = degrees && angles[k] > 0 && angles[k] < 180;
    }
    if (cosines) {
      for (int k = 0; k < 3; ++k)
        angles[k] = angles[k] == 0 ? 90 : std::acos(angles[k]) * 180 / std::numbers::pi;
      return cell_box({c[0], c[2], c[5]}, angles);
    }
    if (degrees) return cell_box({c[0], c[2], c[5]}, angles);
    Box box;
    box.edges = glm::dmat3(c[0], c[1], c[3], c[1], c[2], c[4], c[3], c[4], c[5]);
    return box;
  }

  Marks marks_{};
  std::int64_t stated_frames_{}, first_step_{}, step_interval_{};
  bool has_cell_{}, has_fourth_{}, some_fixed_{};
  std::uint64_t atoms_{}, frames_{}, first_at_{}, first_size_{}, later_size_{};
  std::vector<std::uint32_t> free_{};
  std::vector<double> fixed_positions_{};
};

Sureness probe(const Probe& file) { return find_marks(file.head) ? Sureness::Certain : Sureness::No; }

} // namespace

Reader dcd_reader() {
  return {{"dcd", "CHARMM, NAMD and X-PLOR trajectory", "dcd", true},
          probe,
          [](std::shared_ptr<Bytes> bytes) -> std::unique_ptr<Source> {
            return std::make_unique<DcdSource>(std::move(bytes));
          }};
}

} // namespace mote::data
