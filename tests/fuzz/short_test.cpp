// SPDX-License-Identifier: MIT
// The short form of fuzzing: every kept seed cut at every byte and changed in a few hundred ways, always the same ones.
#include "core/data/source.hpp"
#include "tests/data/support.hpp"
#include "tests/fuzz/inputs.hpp"
#include "tests/fuzz/mutations.hpp"

#include <gtest/gtest.h>

namespace mote::fuzz {
namespace {

const auto& all_inputs() {
  static const auto inputs = inputs_by_format(12000);
  return inputs;
}

TEST(FuzzShort, EveryReaderHasInputs) {
  for (const data::Format& format : data::formats())
    if (format.name != "hdf5") { // a library of its own
      EXPECT_TRUE(all_inputs().contains(std::string(format.name))) << format.name;
    }
}

class OfFormat : public testing::TestWithParam<std::string> {};

const std::vector<double>& positions_of(const data::Frame& frame) { return std::get<std::vector<double>>(frame.find("position")->values); }

// Empty when the cut file is refused, or gives the first frames of the whole one and the first rows of them. The last
// number of a text may have lost digits: then a warning says so.
std::string flaw_of_cut(const std::vector<data::Frame>& whole, std::string_view cut, const Input& input) {
  try {
    const auto source = data::test::open_text(cut, input.extension);
    const data::Frame first = source->read(0); // a file may have frames, but no index
    const std::uint64_t count = source->frame_count();
    if (count == 0 || count > whole.size()) return fmt::format("{} frames", count);
    for (std::uint64_t f = 0; f < count; ++f) {
      const data::Frame part = source->read(f);
      if (const std::string flaw = data::test::broken_promise(part); !flaw.empty()) return flaw;
      if (!source->warnings().empty()) continue;
      const auto &mine = positions_of(part), &all = positions_of(whole[f]);
      if (mine.size() > all.size() || std::memcmp(mine.data(), all.data(), mine.size() * sizeof(double)) != 0) return fmt::format("garbage in frame {}", f);
    }
  } catch (const Failure& failure) {
    if (failure.exit() != Exit::BadInput || failure.diagnostic().code.empty()) return "a failure that is not one of input";
  }
  return {};
}

std::vector<data::Frame> frames_of(const Input& input) {
  std::vector<data::Frame> out;
  try {
    const auto source = data::test::open_text(input.content, input.extension);
    for (std::uint64_t f = 0; f < source->frame_count(); ++f) out.push_back(source->read(f));
  } catch (const Failure&) {
    out.clear(); // refused as a whole: it may be valid up to its flaw
  }
  return out;
}

TEST_P(OfFormat, CutAtEveryByte) {
  const auto found = all_inputs().find(GetParam());
  if (found == all_inputs().end()) GTEST_SKIP() << "no inputs"; // EveryReaderHasInputs fails then
  int small = 0;
  for (const Input& input : found->second) {
    const std::vector<data::Frame> whole = frames_of(input);
    const std::size_t step = 1 + input.content.size() / 3000;
    small += step == 1 && !whole.empty();
    for (std::size_t length = 0; length < input.content.size(); length += step) {
      const std::string_view cut = std::string_view(input.content).substr(0, length);
      ASSERT_EQ(whole.empty() ? data::test::survives(cut, input.extension) : flaw_of_cut(whole, cut, input), "") << input.name << " cut at " << length;
    }
  }
  EXPECT_GE(small, 1) << "no file is cut at every single byte";
}

TEST_P(OfFormat, ChangedFilesAreReadOrRefused) {
  const auto found = all_inputs().find(GetParam());
  if (found == all_inputs().end()) GTEST_SKIP() << "no inputs";
  Random random(20240601);
  for (int i = 0; i < 1500; ++i) {
    const Input& from = found->second[random() % found->second.size()];
    const std::string content = mutated(from.content, found->second[random() % found->second.size()].content, random);
    ASSERT_EQ(data::test::survives(content, from.extension), "") << from.name << ", change " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, OfFormat, testing::ValuesIn(reader_names()), [](const auto& tested) { return word_of(tested.param); });

} // namespace
} // namespace mote::fuzz
