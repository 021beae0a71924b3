// SPDX-License-Identifier: MIT
// How fast frames are read: printed, and held against a floor that only a mistake would miss.
#include "tests/data_molecular/samples.hpp"
#include "tests/data_molecular/support.hpp"

#include <chrono>

namespace mote::data::test {
namespace {

struct Speed {
  double atoms_per_second{}, seconds{};
};

// All frames of a file, from opening it to the last value; the best of three.
Speed speed_of(const std::filesystem::path& file) {
  Speed best;
  for (int round = 0; round < 3; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const auto source = open(file);
    std::uint64_t atoms = 0;
    for (std::uint64_t f = 0, count = source->frame_count(); f < count; ++f) atoms += source->read(f).count;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (static_cast<double>(atoms) / seconds > best.atoms_per_second) best = {static_cast<double>(atoms) / seconds, seconds};
  }
  return best;
}

TEST(Speed, FramesOfThePack) {
  MOTE_NEED_PACK();
  for (const char* name : {"md/md.xtc", "md/water.trr", "md/water.dcd", "md/water.nc", "md/LJsampletraj.gsd", "md/md.gro", "md/solvated.lmp",
                           "protein/1IHM.pdb", "protein/4opj.pdb", "protein/4hhb.cif"}) {
    const Speed speed = speed_of(pack() / name);
    fmt::print("{:24} {:8.2f} ms {:8.2f} M atoms/s {:8.1f} MB/s\n", name, speed.seconds * 1e3, speed.atoms_per_second / 1e6,
               static_cast<double>(std::filesystem::file_size(pack() / name)) / speed.seconds / 1e6);
    EXPECT_GT(speed.atoms_per_second, 5e4) << name;
  }
}

// Frame 0 needs no look at the others: a file whose second frame is broken still gives the first.
TEST(Speed, FrameZeroNeedsNoIndex) {
  std::string xtc = make_xtc(2, 17);
  xtc[xtc.size() / 2 + 3] = 0;
  EXPECT_EQ(open_text(xtc)->read(0).count, 17u);
  EXPECT_EQ(failure_of([&] { (void)open_text(xtc)->frame_count(); }).code, "D040");
}

} // namespace
} // namespace mote::data::test
