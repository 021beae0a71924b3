// SPDX-License-Identifier: MIT
// Every registered pass kind has a test whose answer is known: the table names one for each, and the test
// named must be in this program. A kind without a row, a row without a kind or without its test fails.
#include "passes/builtin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace mote::test {
namespace {

struct KnownAnswer {
  std::string_view kind;
  std::string_view test; // suite.name
};
constexpr std::array known_answers{
    KnownAnswer{"opaque_impostors", "Sphere.OneSphereHasItsExactOutlineAndDepth"},
    KnownAnswer{"ocio_tonemap", "Sphere.ShadesAsTheEquationSays"}, // linear red is (255, 0, 0) on an sRGB display
    KnownAnswer{"shadow_map", "Shadows.KnownAnswer/vertex"},
    KnownAnswer{"fullscreen", "FilePasses.FullscreenKnownAnswer"},
    KnownAnswer{"compute", "FilePasses.ComputeKnownAnswerAndInputsOfOtherPasses"},
    KnownAnswer{"sorted_glyphs", "Transparent.TwoStackedGlyphsInBothOrders"},
};

bool is_in_this_program(std::string_view test) {
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s)
    for (int t = 0; t < all.GetTestSuite(s)->total_test_count(); ++t)
      if (std::string(all.GetTestSuite(s)->name()) + "." + all.GetTestSuite(s)->GetTestInfo(t)->name() == test) return true;
  return false;
}

TEST(PassKinds, EachHasAKnownAnswerTest) {
  rg::Registry registry;
  passes::register_builtin_passes(registry);
  std::vector<std::string> tested;
  for (const KnownAnswer& row : known_answers) {
    tested.emplace_back(row.kind);
    EXPECT_TRUE(is_in_this_program(row.test)) << row.test << " does not exist";
  }
  EXPECT_THAT(tested, ::testing::UnorderedElementsAreArray(registry.names()));
}

} // namespace
} // namespace mote::test
