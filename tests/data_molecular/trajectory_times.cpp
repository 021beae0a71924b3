// SPDX-License-Identifier: MIT
// Makes a large trajectory, and measures what any frame of one costs: how long the index takes, then frames in no order,
// and the most memory that was resident. No test: docs/performance.md has its figures.
//
//   trajectory_times make ATOMS FRAMES FILE      by the ending: .xtc .trr .dcd .lammpstrj .xyz
//   trajectory_times FILE [READS]                100 reads if nothing is said
#include "core/data/source.hpp"
#include "tests/data_molecular/samples.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>

namespace {

using namespace mote::data;
namespace fs = std::filesystem;

std::string text_rows(std::uint64_t frame, std::uint64_t atoms, bool numbered) {
  std::string out;
  for (std::uint64_t a = 0; a < atoms; ++a) {
    numbered ? (void)(out += fmt::format("{} {}", a + 1, a % 3 + 1)) : (void)(out += a % 3 ? "H" : "O");
    for (int k = 0; k < 3; ++k) out += fmt::format(" {:.3f}", test::position(frame, a, k) + 0.001 * static_cast<double>(a % 97));
    out += '\n';
  }
  return out;
}

// Frame `frame` of a format whose frames stand one behind the other.
std::string one_frame(const std::string& ending, std::uint64_t frame, std::uint64_t atoms) {
  if (ending == ".xyz") return fmt::format("{}\nframe {}\n", atoms, frame) + text_rows(frame, atoms, false);
  if (ending == ".lammpstrj")
    return fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n0 64\n0 64\n0 64\nITEM: ATOMS id type x y z\n", 100 * frame, atoms) +
           text_rows(frame, atoms, true);
  const std::string all = ending == ".xtc" ? test::make_xtc(2, atoms) : test::make_trr(2, atoms, false);
  return frame % 2 ? all.substr(all.size() / 2) : all.substr(0, all.size() / 2);
}

int make(std::uint64_t atoms, std::uint64_t frames, const fs::path& file) {
  const std::string ending = file.extension().string();
  std::ofstream out(file, std::ios::binary);
  if (ending == ".dcd") { // head of all frames, then the frames of a short one again and again
    const std::string none = test::make_dcd(0, atoms, {}), two = test::make_dcd(2, atoms, {});
    std::string head = none;
    const auto count = static_cast<std::uint32_t>(frames);
    std::memcpy(head.data() + 8, &count, 4);
    out << head;
    const std::size_t length = (two.size() - none.size()) / 2;
    for (std::uint64_t f = 0; f < frames; ++f) out << std::string_view(two).substr(none.size() + f % 2 * length, length);
  } else if (ending == ".xtc" || ending == ".trr" || ending == ".lammpstrj" || ending == ".xyz") {
    std::vector<std::string> some; // eight different ones are enough
    for (std::uint64_t f = 0; f < std::min<std::uint64_t>(frames, 8); ++f) some.push_back(one_frame(ending, f, atoms));
    for (std::uint64_t f = 0; f < frames; ++f) out << some[f % some.size()];
  } else {
    fmt::print(stderr, "{}: no format that is made here\n", ending);
    return 2;
  }
  out.close();
  return out ? 0 : 1;
}

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
double processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double resident_megabytes() { // the most so far
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

int measure(const fs::path& file, std::uint64_t reads) {
  double start = seconds(), start_processor = processor();
  const auto source = open(file);
  const std::uint64_t frames = source->frame_count();
  fmt::print("{}: {:.2f} GB, {} frames; index {:.3f} s ({:.3f} s of processor), {:.0f} MB resident\n", file.filename().string(),
             static_cast<double>(fs::file_size(file)) / 1e9, frames, seconds() - start, processor() - start_processor, resident_megabytes());
  std::mt19937_64 random(1);
  std::vector<double> wall, busy;
  std::uint64_t atoms = 0;
  for (std::uint64_t n = 0; n < reads; ++n) {
    const std::uint64_t frame = random() % frames;
    start = seconds(), start_processor = processor();
    atoms = source->read(frame).count;
    wall.push_back(seconds() - start);
    busy.push_back(processor() - start_processor);
    source->release_pages();
  }
  std::sort(wall.begin(), wall.end());
  std::sort(busy.begin(), busy.end());
  fmt::print("{} frames of {} atoms in no order: median {:.1f} ms, 95th percentile {:.1f}, most {:.1f}; of processor {:.1f}, {:.1f}, {:.1f}; {:.0f} MB resident\n", reads, atoms,
             1e3 * wall[reads / 2], 1e3 * wall[reads * 95 / 100], 1e3 * wall.back(), 1e3 * busy[reads / 2], 1e3 * busy[reads * 95 / 100], 1e3 * busy.back(), resident_megabytes());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  if (argc == 5 && std::string_view(argv[1]) == "make") return make(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10), argv[4]);
  if (argc == 2 || argc == 3) return measure(argv[1], argc == 3 ? std::max<std::uint64_t>(1, std::strtoull(argv[2], nullptr, 10)) : 100);
  fmt::print(stderr, "trajectory_times make ATOMS FRAMES FILE\ntrajectory_times FILE [READS]\n");
  return 2;
}
