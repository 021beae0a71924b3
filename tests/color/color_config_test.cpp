// SPDX-License-Identifier: MIT
#include "core/color/codes.hpp"
#include "core/color/color_config.hpp"
#include "core/color/default_config.hpp"
#include "core/color/srgb.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {
using namespace mote;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class ColorConfigTest : public testing::Test {
protected:
  void SetUp() override {
    for (const char* name :
         {"OCIO", "OCIO_ACTIVE_DISPLAYS", "OCIO_ACTIVE_VIEWS", "OCIO_INACTIVE_COLORSPACES"})
      unsetenv(name);
    folder = fs::temp_directory_path() / ("mote-color-" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override {
    unsetenv("OCIO");
    fs::remove_all(folder);
  }
  std::string write(const std::string& name, std::string_view text) const {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  fs::path folder;
};

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

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(ColorConfigTest, ShipsOneThatNeedsNoFile) {
  const ColorConfig config = ColorConfig::load();
  EXPECT_EQ(config.origin(), "shipped");
  EXPECT_EQ(config.working_space(), "Linear Rec.709");
  EXPECT_THAT(config.displays(), ElementsAre("sRGB"));
  EXPECT_THAT(config.views("sRGB"), ElementsAre("Un-tone-mapped", "ACES SDR", "Raw"));
  EXPECT_EQ(config.default_display(), "sRGB");
  EXPECT_EQ(config.default_view("sRGB"), "Un-tone-mapped");
  EXPECT_THAT(config.color_spaces(),
              ElementsAre("ACES2065-1", "Linear Rec.709", "sRGB", "ACEScg", "ACEScct", "Raw"));
  EXPECT_THAT(config.messages(), testing::IsEmpty());
  config.check_view("sRGB", "Raw");
  config.check_color_space("scene_linear"); // a role is a name, too
}

TEST_F(ColorConfigTest, PathBeatsVariableBeatsShipped) {
  const std::string a = write("a.ocio", default_color_config()), b = write("b.ocio", default_color_config());
  setenv("OCIO", "", 1); // empty is as unset
  EXPECT_EQ(ColorConfig::load().origin(), "shipped");
  setenv("OCIO", a.c_str(), 1);
  EXPECT_EQ(ColorConfig::load().origin(), a);
  EXPECT_EQ(ColorConfig::load(b).origin(), b);
}

TEST_F(ColorConfigTest, NamesAFileThatCannotBeRead) {
  const Diagnostic missing = failure_of([] { ColorConfig::load("/no/such.ocio"); });
  EXPECT_EQ(missing.code, "C001");
  EXPECT_EQ(missing.loc.file, "/no/such.ocio");
  EXPECT_THAT(missing.text, HasSubstr("'/no/such.ocio' cannot be read: No such file or directory"));
  EXPECT_THAT(failure_of([&] { ColorConfig::load(folder.string()); }).text, HasSubstr("Is a directory"));
  setenv("OCIO", "/no/other.ocio", 1);
  EXPECT_THAT(failure_of([] { ColorConfig::load(); }).text, HasSubstr("'/no/other.ocio' named by $OCIO"));
}

TEST_F(ColorConfigTest, PassesOnWhatOpenColorIOSays) {
  testing::internal::CaptureStderr();
  const std::string newer =
      write("newer.ocio", replaced(std::string(default_color_config()), "version: 2.1", "version: 2.9"));
  const Diagnostic d = failure_of([&] { ColorConfig::load(newer); });
  EXPECT_EQ(d.code, "C002");
  EXPECT_EQ(d.loc.file, newer);
  EXPECT_THAT(d.text, HasSubstr("version 2.9"));
  EXPECT_EQ(failure_of([&] { ColorConfig::load(write("x.ocio", "not: [a, config")); }).code, "C002");
  EXPECT_EQ(failure_of([&] { ColorConfig::from_text("", "empty"); }).code, "C002");
  const ColorConfig odd = ColorConfig::from_text(
      replaced(std::string(default_color_config()), "    name: ACEScg\n", "    name: ACEScg\n    foo: 3\n"),
      "odd");
  ASSERT_EQ(odd.messages().size(), 1u);
  EXPECT_THAT(odd.messages()[0], HasSubstr("unknown key 'foo'"));
  const ColorConfig flawed = ColorConfig::from_text(
      replaced(std::string(default_color_config()), "color_picking: sRGB", "color_picking: absent"),
      "flawed");
  ASSERT_EQ(flawed.messages().size(), 1u);
  EXPECT_THAT(flawed.messages()[0], HasSubstr("absent"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ColorConfigTest, NeedsAWorkingSpace) {
  std::string text(default_color_config());
  text = replaced(text, "    name: Linear Rec.709\n", "    name: Mine\n");
  text = replaced(text, "rendering: Linear Rec.709", "rendering: ACEScg");
  const ColorConfig by_role =
      ColorConfig::from_text(replaced(text, "scene_linear: Linear Rec.709", "scene_linear: ACEScg"), "t");
  EXPECT_EQ(by_role.working_space(), "ACEScg");
  const auto red = by_role.to_working("sRGB", {1.0, 0.0, 0.0}); // ACEScg of Rec.709 red, by its matrix
  EXPECT_NEAR(red[0], 0.6131, 1e-3);
  EXPECT_NEAR(red[1], 0.0702, 1e-3);
  const Diagnostic d = failure_of(
      [&] { ColorConfig::from_text(replaced(text, "  scene_linear: Linear Rec.709\n", ""), "t"); });
  EXPECT_EQ(d.code, "C006");
  EXPECT_THAT(d.text, HasSubstr("scene_linear"));
}

TEST_F(ColorConfigTest, ListsWhatExistsForAWrongName) {
  const ColorConfig config = ColorConfig::load();
  const Diagnostic display = failure_of([&] { config.check_display("sRBG", {"g.toml", 4, 2}); });
  EXPECT_EQ(display.code, "C003");
  EXPECT_EQ(display.loc.line, 4u);
  EXPECT_THAT(display.text, HasSubstr("displays: sRGB"));
  const Diagnostic view = failure_of([&] { config.check_view("sRGB", "ACES SRD"); });
  EXPECT_EQ(view.code, "C004");
  EXPECT_THAT(view.text, HasSubstr("Did you mean 'ACES SDR'?"));
  EXPECT_THAT(view.text, HasSubstr("view transforms: Un-tone-mapped, ACES SDR, Raw"));
  const Diagnostic space = failure_of([&] { config.check_color_space("ACEScgg"); });
  EXPECT_EQ(space.code, "C005");
  EXPECT_THAT(space.text, HasSubstr("Did you mean 'ACEScg'?"));
  EXPECT_THAT(space.text, HasSubstr("Linear Rec.709, sRGB"));
  EXPECT_EQ(failure_of([&] { config.check_color_space(""); }).code, "C005");
}

TEST_F(ColorConfigTest, BringsColorsIntoTheWorkingSpace) {
  const ColorConfig config = ColorConfig::load();
  EXPECT_EQ(config.to_working("sRGB", {0.5, 0.25, 0.0}), srgb_decode({0.5, 0.25, 0.0}));
  EXPECT_EQ(config.to_working("Raw", {0.5, 0.25, 0.125}), (std::array<double, 3>{0.5, 0.25, 0.125}));
  const auto grey = config.to_working("ACEScg", {0.18, 0.18, 0.18});
  for (const double v : grey) EXPECT_NEAR(v, 0.18, 1e-6);
  // the config's own sRGB space against the formula, as a picture; alpha is untouched
  std::vector<float> rgba;
  for (int i = 0; i <= 255; ++i) rgba.insert(rgba.end(), {static_cast<float>(i) / 255.0f, 0.5f, 0.0f, 0.3f});
  config.to_working("sRGB", rgba);
  for (int i = 0; i <= 255; ++i) {
    EXPECT_NEAR(rgba[4 * i], srgb_decode(i / 255.0), 1e-5) << i;
    EXPECT_EQ(rgba[4 * i + 3], 0.3f);
  }
  EXPECT_EQ(failure_of([&] { (void)config.to_working("nothing", {0, 0, 0}); }).code, "C005");
}

TEST(ColorCodes, AreInOrder) {
  for (std::size_t i = 1; i < color_codes.size(); ++i)
    EXPECT_LT(color_codes[i - 1].first, color_codes[i].first);
}
} // namespace
