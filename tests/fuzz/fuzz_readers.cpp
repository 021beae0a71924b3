// SPDX-License-Identifier: MIT
// Fuzzing of one reader for a given time: changed files are either read into frames that keep their promises or refused.
// Inputs that take a new way through the code (coverage.hpp) are kept and changed further.
//
//   fuzz_readers FORMAT SECONDS [SEED]      formats as `mote formats` lists them
//
// Seconds are processor time of this process, so that a run that gets part of a core only is as long as one that has a core
// to itself. The input that is being read lies in fuzz-FORMAT.input beside it, for the case that the process dies of it.
// Exit status 1 and the input kept when a promise is broken or reading takes more than 20 seconds of processor time.
#include "tests/data/support.hpp"
#include "tests/fuzz/coverage.hpp"
#include "tests/fuzz/inputs.hpp"
#include "tests/fuzz/mutations.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace {

using namespace mote;

constexpr std::size_t most_bytes = 1 << 16;

// The current input in a file that outlives the process.
class Trace {
public:
  explicit Trace(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || ::ftruncate(file, most_bytes + 8) != 0) std::exit(2);
    memory_ = static_cast<char*>(::mmap(nullptr, most_bytes + 8, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    ::close(file);
  }
  void keep(const std::string& input) { // length, then the bytes
    const std::uint64_t length = input.size();
    std::memcpy(memory_, &length, 8);
    std::memcpy(memory_ + 8, input.data(), input.size());
  }

private:
  char* memory_{};
};

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The process ends (SIGPROF) after so many further seconds of its processor time.
void end_after(long seconds) {
  const itimerval timer{.it_interval = {}, .it_value = {.tv_sec = seconds, .tv_usec = 0}};
  ::setitimer(ITIMER_PROF, &timer, nullptr);
}

int fuzz_format(const std::string& format, double seconds, std::uint64_t seed) {
  Trace trace("fuzz-" + format + ".input");
  const auto inputs = fuzz::inputs_by_format();
  const auto found = inputs.find(format);
  if (found == inputs.end()) {
    fmt::print(stderr, "no inputs for '{}'\n", format);
    return 2;
  }
  std::vector<fuzz::Input> pool = found->second;
  const std::size_t given = pool.size();
  fuzz::Random random(seed);
  const double start = processor_seconds();
  std::uint64_t runs = 0;
  for (; processor_seconds() - start < seconds; ++runs) {
    const bool as_is = runs < given; // first the ways that are known
    const fuzz::Input& from = pool[as_is ? runs : random() % pool.size()];
    fuzz::Input input{from.name, from.extension, from.content};
    if (!as_is) input.content = fuzz::mutated(from.content, pool[random() % pool.size()].content, random, most_bytes);
    if (input.content.size() > most_bytes) input.content.resize(most_bytes);
    trace.keep(input.content);
    end_after(20);
    fuzz::clear_coverage();
    const std::string flaw = data::test::survives(input.content, input.extension);
    if (!flaw.empty()) {
      fmt::print(stderr, "{}: {} (input kept in fuzz-{}.input, extension '{}')\n", format, flaw, format, input.extension);
      return 1;
    }
    if (fuzz::covered_anything_new() && !as_is && pool.size() < 20000) pool.push_back(std::move(input));
  }
  fmt::print("{:<12} {:>9} inputs in {:.0f} s of processor time, {} kept, no finding\n", format, runs, processor_seconds() - start, pool.size());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--list") {
    for (const auto& [format, inputs] : fuzz::inputs_by_format()) fmt::print("{}\n", format);
    return 0;
  }
  if (argc < 3) {
    fmt::print(stderr, "fuzz_readers FORMAT SECONDS [SEED]\n");
    return 2;
  }
  return fuzz_format(argv[1], std::atof(argv[2]), argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
}
