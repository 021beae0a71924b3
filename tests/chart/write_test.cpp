// SPDX-License-Identifier: MIT
// What the files hold: the CSV each point, the SVG axes with units, legend, machine, driver and date, the PNG the same sheet.
#include "core/chart/write.hpp"

#include <gmock/gmock.h>

namespace mote::chart {
namespace {

using testing::HasSubstr;

Chart sample() {
  Chart c{.topic = "t", .title = "Errors & times"};
  c.panels = {{"A, b", {"time", "ms"}, {"error", "rad"}, true, {{"good", false, {{"n = 4", 2.5, 1e-7}}}, {"\"old\"", true, {{"", 10.0, INFINITY}, {"n = 1", 3.0, 0.1}}}}}};
  c.notes = {"One thing is left out: the device lacks it."};
  c.origin = {"a processor", "a device", "a driver 1.2", "2026-01-02", "mote chart --topic t"};
  mark_front(c);
  return c;
}

TEST(Csv, HoldsEachPointAsItIs) {
  EXPECT_EQ(to_csv(sample()), "panel,method,parameter,x_quantity,x_unit,x,y_quantity,y_unit,y,baseline,front,machine,device,driver,date\n"
                              "\"A, b\",good,n = 4,time,ms,2.5,error,rad,1e-07,0,1,a processor,a device,a driver 1.2,2026-01-02\n"
                              "\"A, b\",\"\"\"old\"\"\",,time,ms,10,error,rad,inf,1,0,a processor,a device,a driver 1.2,2026-01-02\n"
                              "\"A, b\",\"\"\"old\"\"\",n = 1,time,ms,3,error,rad,0.1,1,0,a processor,a device,a driver 1.2,2026-01-02\n");
}

TEST(Svg, NamesUnitsMethodsMachineDriverDateAndNotes) {
  const std::string svg = to_svg(sample());
  for (const char* words : {"Errors &amp; times", "A, b", "time [ms]", "error [rad]", ">good<", "&quot;old&quot;", "n = 4", "2026-01-02 · a processor · a device · a driver 1.2",
                            "mote chart --topic t", "the device lacks it", "Pareto front", "Hollow marks: baselines", "fails", "stroke-dasharray"})
    EXPECT_THAT(svg, HasSubstr(words));
  EXPECT_TRUE(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n"));
}

TEST(Html, HasThePictureAndTheNumbers) {
  const std::string html = to_html(sample());
  EXPECT_THAT(html, HasSubstr("<svg xmlns="));
  EXPECT_THAT(html, HasSubstr("<tr><td>good</td><td>n = 4</td><td>2.5</td><td>1e-07</td><td>Pareto front</td></tr>"));
}

TEST(Text, IsATableOfThePoints) {
  const std::string text = to_text(sample());
  EXPECT_THAT(text, HasSubstr("good"));
  EXPECT_THAT(text, HasSubstr("\"old\" (baseline)"));
  EXPECT_THAT(text, HasSubstr("front"));
}

TEST(Pixels, ShowTheSheetOnWhite) {
  const Pixels one = to_pixels(sample(), 1.0), two = to_pixels(sample(), 2.0);
  EXPECT_EQ(one.width, 860u);
  EXPECT_EQ(two.width, 1720u);
  EXPECT_EQ(one.rgba.size(), std::size_t{one.width} * one.height * 4);
  EXPECT_EQ(one.rgba[0], 255); // the corner is empty
  std::size_t blue = 0, dark = 0; // the first series' color, and letters
  for (std::size_t i = 0; i < two.rgba.size(); i += 4) {
    blue += two.rgba[i] < 10 && two.rgba[i + 1] == 0x72 && two.rgba[i + 2] == 0xB2;
    dark += two.rgba[i] < 0x40 && two.rgba[i + 1] < 0x40 && two.rgba[i + 2] < 0x40;
    ASSERT_EQ(two.rgba[i + 3], 255);
  }
  EXPECT_GT(blue, 60u);
  EXPECT_GT(dark, 1000u);
}

} // namespace
} // namespace mote::chart
