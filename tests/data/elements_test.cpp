// SPDX-License-Identifier: MIT
#include "core/data/elements.hpp"

#include <gtest/gtest.h>

namespace mote::data {
namespace {

TEST(Elements, WellKnownValues) {
  EXPECT_EQ(elements().size(), 118u);
  for (std::size_t i = 0; i < elements().size(); ++i)
    EXPECT_EQ(elements()[i].number, static_cast<int>(i + 1));
  const Element& carbon = *element(6);
  EXPECT_EQ(carbon.symbol, "C");
  EXPECT_NEAR(carbon.mass, 12.011, 1e-9);
  EXPECT_FLOAT_EQ(carbon.covalent_radius, 0.76f);
  EXPECT_FLOAT_EQ(carbon.vdw_radius(), 1.7f);
  EXPECT_EQ(carbon.color, 0x909090u);
  EXPECT_FLOAT_EQ(element(26)->vdw_radius(), 2.44f); // no Bondi radius: Alvarez'
  EXPECT_EQ(element(26)->color, 0xe06633u);
  EXPECT_EQ(element(118)->color, unknown_color);
  EXPECT_EQ(element(0), nullptr);
  EXPECT_EQ(element(119), nullptr);
}

TEST(Elements, Labels) {
  for (const auto& [label, symbol] : {std::pair{"C", "C"},
                                      {"FE", "Fe"},
                                      {"fe", "Fe"},
                                      {"o2", "O"},
                                      {"Na+", "Na"},
                                      {"H1'", "H"},
                                      {"D", "H"},
                                      {"CL", "Cl"}}) {
    ASSERT_TRUE(find_element(label)) << label;
    EXPECT_EQ(find_element(label)->symbol, symbol);
  }
  for (const char* label : {"", "A", "CT", "OW", "X", "water", "12", "C H", "Uuo"})
    EXPECT_FALSE(find_element(label)) << label;
}

TEST(Elements, TypeColorsInTurn) {
  EXPECT_EQ(type_color(1), 0xff6666u);
  EXPECT_EQ(type_color(9), 0x66ff66u);
  EXPECT_EQ(type_color(10), type_color(1));
  EXPECT_EQ(type_color(0), type_color(9));
  EXPECT_EQ(type_color(-9223372036854775807 - 1), type_color(1));
}

} // namespace
} // namespace mote::data
