// SPDX-License-Identifier: MIT
// How fast frames are read: printed (best of five), and the processor time held against a floor that
// only a mistake would miss.
#include "tests/data_molecular/samples.hpp"
#include "tests/data_molecular/support.hpp"

#include <chrono>
#include <ctime>

namespace mote::data::test {
namespace {

struct Speed {
  double atoms{}, seconds{1e9}, processor_seconds{1e9};
};

// All frames of a file, from opening it to the last value; the best of five.
Speed speed_of(const std::filesystem::path& file) {
  Speed best;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    const auto source = open(file);
    best.atoms = 0;
    for (std::uint64_t f = 0, count = source->frame_count(); f < count; ++f)
      best.atoms += static_cast<double>(source->read(f).count);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    best.seconds = std::min(best.seconds, passed.count());
    best.processor_seconds =
        std::min(best.processor_seconds, static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
  }
  return best;
}

TEST(Speed, FramesOfThePack) {
  MOTE_NEED_PACK();
  for (const char* name :
       {"md/md.xtc", "md/water.trr", "md/water.dcd", "md/water.nc", "md/LJsampletraj.gsd", "md/md.gro",
        "md/solvated.lmp", "protein/1IHM.pdb", "protein/4opj.pdb", "protein/4hhb.cif"}) {
    const Speed speed = speed_of(pack() / name);
    fmt::print("{:24} {:8.2f} ms ({:.2f} ms of processor) {:8.2f} M atoms/s {:8.1f} MB/s\n", name,
               speed.seconds * 1e3, speed.processor_seconds * 1e3, speed.atoms / speed.seconds / 1e6,
               static_cast<double>(std::filesystem::file_size(pack() / name)) / speed.seconds / 1e6);
    EXPECT_LT(speed.processor_seconds * 5e4, speed.atoms) << name; // 50 000 atoms per second
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
