// SPDX-License-Identifier: MIT
// mote chart as a user runs it: the list, files by their ending, what is refused.
#include "run_mote.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace mote::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ChartCommand : public CommandTest {};

TEST_F(ChartCommand, ListsItsTopics) {
  const Ran r = mote("chart --list");
  EXPECT_EQ(r.exit, 0) << r.err;
  for (const char* topic : {"sphere", "proxy", "mesh", "placement", "depth", "sampling", "shadow", "transparency", "color_models", "ocio"}) EXPECT_THAT(r.out, HasSubstr(topic));
}

TEST_F(ChartCommand, UnknownTopicsAndEndingsSayWhatExists) {
  Ran r = mote("chart --topic spher");
  EXPECT_EQ(r.exit, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("A030"), HasSubstr("Did you mean 'sphere'?"), HasSubstr("color_models")));
  r = mote("chart");
  EXPECT_EQ(r.exit, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("A030"), HasSubstr("no topic is named")));
  r = mote("chart --topic depth -o depth.svgg");
  EXPECT_EQ(r.exit, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("A003"), HasSubstr("Did you mean '.svg'?"), HasSubstr(".csv")));
  r = mote("chart spheres:10:fit --topic depth");
  EXPECT_EQ(r.exit, 2);
  EXPECT_THAT(r.err, AllOf(HasSubstr("A001"), HasSubstr("topic 'depth' draws no scene")));
  r = mote("chart missing.toml --topic shadow");
  EXPECT_EQ(r.exit, 3) << r.err;
  EXPECT_FALSE(exists("depth.svgg"));
}

// The numbers of the CSV are those of the picture: reverse-Z keeps 1e-7, standard depth loses a decade each decade.
TEST_F(ChartCommand, DepthHasItsKnownErrors) {
  const Ran r = mote("chart --topic depth -o depth.csv --quiet --validation");
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_EQ(r.err, "");
  std::istringstream lines(read("depth.csv"));
  std::string line;
  std::size_t found = 0;
  const double expected_standard[] = {6e-7, 8.7e-6, 9.3e-5, 8.6e-4};
  while (std::getline(lines, line)) {
    if (line.find("relative error") == std::string::npos) continue;
    const bool reverse = line.find("reverse, infinite far, D32F") != std::string::npos, standard = line.find(",standard D32F,") != std::string::npos;
    if (!reverse && !standard) continue;
    const std::size_t at = line.find("\"relative error, p99\",,") + 23;
    const double error = std::stod(line.substr(at));
    ++found;
    const auto decade = static_cast<std::size_t>(line[line.find("= 1e") + 4] - '1');
    if (reverse) {
      EXPECT_LE(error, 1e-7) << line;
    } else if (decade < 4) {
      EXPECT_NEAR(error / expected_standard[decade], 1.0, 0.2) << line;
    }
  }
  EXPECT_EQ(found, 12u);
}

TEST_F(ChartCommand, ScenesAreDrawnAndPicturesWritten) {
  const Ran r = mote("chart spheres:100:fit --topic transparency --size 96x54 -o p.html --validation");
  ASSERT_EQ(r.exit, 0) << r.err;
  EXPECT_THAT(read("p.html"), AllOf(HasSubstr("mote chart spheres:100:fit --topic transparency --size 96x54"), HasSubstr("spheres:100:fit, 96x54"), HasSubstr("exact lists (mote)"), HasSubstr("<svg"), HasSubstr("</table>")));
}

TEST_F(ChartCommand, PicturesOfPixels) {
  EXPECT_EQ(mote("chart --topic placement --quiet -o p.png").exit, 0);
  EXPECT_EQ(read("p.png").substr(1, 3), "PNG");
}

TEST_F(ChartCommand, CompareRefusesTwoCameras) {
  ASSERT_EQ(mote("render spheres:10:fit --size 32x32 -o a.png").exit, 0);
  ASSERT_EQ(mote("render spheres:10:fit --size 32x32 --set camera.fov_y=40 -o b.png").exit, 0);
  const Ran r = mote("compare a.png b.png");
  EXPECT_EQ(r.exit, 3) << r.out;
  EXPECT_THAT(r.err, AllOf(HasSubstr("K008"), HasSubstr("fov_y = 40")));
  EXPECT_EQ(mote("compare a.png a.png").exit, 0);
}

} // namespace
} // namespace mote::test
