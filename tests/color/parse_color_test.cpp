// SPDX-License-Identifier: MIT
#include "core/color/parse_color.hpp"
#include "core/color/srgb.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace {
using namespace mote;
using testing::HasSubstr;

template <class F> Diagnostic failure_of(F&& f) {
  try {
    f();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit(), Exit::BadInput);
    Diagnostic d = failure.diagnostic();
    for (const std::string& hint : d.hints) d.text += "\n" + hint;
    return d;
  }
  ADD_FAILURE() << "no failure";
  return {};
}

TEST(ParseColor, ReadsEveryForm) {
  EXPECT_EQ(parse_color("#ff8000").rgb, (std::array<double, 3>{1.0, 128 / 255.0, 0.0}));
  EXPECT_EQ(parse_color("#FfA").rgb, (std::array<double, 3>{1.0, 1.0, 170 / 255.0}));
  const ParsedColor half = parse_color("#00000080");
  EXPECT_TRUE(half.has_alpha);
  EXPECT_DOUBLE_EQ(half.alpha, 128 / 255.0);
  EXPECT_FALSE(parse_color("#000000").has_alpha);
  EXPECT_EQ(parse_color("Teal").rgb, (std::array<double, 3>{0.0, 128 / 255.0, 128 / 255.0}));
  EXPECT_EQ(parse_color("transparent").alpha, 0.0);
  const double numbers[] = {0.25, 2.0, 0.0, 0.5};
  EXPECT_EQ(parse_color(numbers), (ParsedColor{{0.25, 2.0, 0.0}, 0.5, true}));
  EXPECT_FALSE(parse_color(std::span(numbers, 3)).has_alpha);
}

TEST(ParseColor, NamesWhatIsNotAColor) {
  for (const char* bad : {"#12345", "#gggggg", "#-12345", "#", "#12 456"}) {
    const Diagnostic d = failure_of([&] { parse_color(bad, {"scene.toml", 3, 9}); });
    EXPECT_EQ(d.code, "C008");
    EXPECT_THAT(d.text, HasSubstr(std::string("'") + bad + "' is not a color"));
    EXPECT_THAT(d.text, HasSubstr("#rrggbbaa"));
    EXPECT_EQ(d.loc.line, 3u);
  }
  EXPECT_THAT(failure_of([] { parse_color("orenge"); }).text, HasSubstr("Did you mean 'orange'?"));
  EXPECT_THAT(failure_of([] { parse_color(""); }).text, HasSubstr("'' is not a color"));
}

TEST(ParseColor, ChecksNumbers) {
  auto words = [](std::vector<double> numbers) {
    const Diagnostic d = failure_of([&] { parse_color(numbers); });
    EXPECT_EQ(d.code, "C009");
    return d.text;
  };
  EXPECT_THAT(words({1, 2}), HasSubstr("not 2"));
  EXPECT_THAT(words({1, 2, 3, 0, 0}), HasSubstr("not 5"));
  EXPECT_THAT(words({0, -0.5, 0}), HasSubstr("the component '-0.5' of a color is outside 0 and above"));
  EXPECT_THAT(words({0, 0, 0, 1.5}), HasSubstr("the alpha '1.5' of a color is outside 0..1"));
  EXPECT_THAT(words({0, std::numeric_limits<double>::quiet_NaN(), 0}), HasSubstr("not a finite number"));
  EXPECT_THAT(words({0, 0, 0, std::numeric_limits<double>::infinity()}), HasSubstr("not a finite number"));
}

TEST(Srgb, IsItsOwnInverseAndMeetsKnownValues) {
  for (int i = 0; i <= 255; ++i) {
    EXPECT_NEAR(srgb_encode(srgb_decode(i / 255.0)), i / 255.0, 1e-15 * 255) << i;
    EXPECT_EQ(to_8bit(i / 255.0), i);
  }
  EXPECT_NEAR(srgb_decode(128 / 255.0), 0.21586050011389926, 1e-15);
  EXPECT_NEAR(srgb_encode(0.18), 0.46135612950044164, 1e-15);
  EXPECT_DOUBLE_EQ(srgb_encode(-0.001), -0.01292);
  EXPECT_EQ(to_8bit(std::nan("")), 0);
  EXPECT_EQ(to_8bit(7.0), 255);
}
} // namespace
