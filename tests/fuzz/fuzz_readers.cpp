// SPDX-License-Identifier: MIT
// Fuzzing of one reader for a given time: changed files are either read into frames that keep their promises or refused.
// Inputs that have a new outcome (another code, another number of frames) are changed further.
//
//   fuzz_readers FORMAT SECONDS [SEED]      formats as `mote formats` lists them
//
// The input that is being read lies in fuzz-FORMAT.input beside it, for the case that the process dies of it. Exit
// status 1 and the input kept when a promise is broken or reading takes more than 20 seconds.
#include "tests/data/support.hpp"
#include "tests/fuzz/inputs.hpp"
#include "tests/fuzz/mutations.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <set>

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

// What reading gave, as a word: code of the refusal, or how many frames and columns.
std::string outcome(const std::string& content, const std::string& extension, std::string& flaw) {
  try {
    std::uint64_t frames = 0;
    flaw = data::test::survives(content, extension, &frames);
    if (frames > 0) return fmt::format("{} frames", frames);
    (void)data::test::open_text(content, extension)->read(0);
  } catch (const Failure& failure) {
    return failure.diagnostic().code + failure.diagnostic().text.substr(0, 24);
  }
  return "read";
}

int fuzz_format(const std::string& format, double seconds, std::uint64_t seed) {
  const auto inputs = fuzz::inputs_by_format();
  const auto found = inputs.find(format);
  if (found == inputs.end()) {
    fmt::print(stderr, "no inputs for '{}'\n", format);
    return 2;
  }
  std::vector<fuzz::Input> pool = found->second;
  std::set<std::string> outcomes;
  Trace trace("fuzz-" + format + ".input");
  fuzz::Random random(seed);
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t runs = 0;
  for (; std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds; ++runs) {
    const fuzz::Input& from = pool[random() % pool.size()];
    fuzz::Input input{from.name, from.extension, fuzz::mutated(from.content, pool[random() % pool.size()].content, random, most_bytes)};
    trace.keep(input.content);
    ::alarm(20);
    std::string flaw;
    const std::string word = outcome(input.content, input.extension, flaw);
    if (!flaw.empty()) {
      fmt::print(stderr, "{}: {} (input kept in fuzz-{}.input, extension '{}')\n", format, flaw, format, input.extension);
      return 1;
    }
    if (outcomes.insert(word).second && pool.size() < 4000) pool.push_back(std::move(input));
  }
  fmt::print("{:<12} {:>8} inputs in {:.0f} s, {} outcomes, no finding\n", format, runs, seconds, outcomes.size());
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
