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

TEST_P(OfFormat, CutAtEveryByte) {
  const auto found = all_inputs().find(GetParam());
  if (found == all_inputs().end()) GTEST_SKIP() << "no inputs"; // EveryReaderHasInputs fails then
  for (const Input& input : found->second) {
    std::uint64_t whole = 0;
    ASSERT_EQ(data::test::survives(input.content, input.extension, &whole), "") << input.name;
    if (whole == 0) continue; // a file that is refused as a whole may be valid up to its flaw
    const std::size_t step = 1 + input.content.size() / 3000;
    for (std::size_t length = 0; length < input.content.size(); length += step) {
      std::uint64_t frames = 0;
      ASSERT_EQ(data::test::survives(std::string_view(input.content).substr(0, length), input.extension, &frames), "") << input.name << " cut at " << length;
      ASSERT_LE(frames, whole) << input.name << " cut at " << length; // a shorter valid series
    }
  }
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

std::vector<std::string> names() {
  std::vector<std::string> out;
  for (const data::Format& format : data::formats())
    if (format.name != "hdf5") out.emplace_back(format.name);
  return out;
}
INSTANTIATE_TEST_SUITE_P(Readers, OfFormat, testing::ValuesIn(names()), [](const auto& tested) {
  std::string name = tested.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

} // namespace
} // namespace mote::fuzz
