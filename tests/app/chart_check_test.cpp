// SPDX-License-Identifier: MIT
// tests/chart_check.py recomputes points of charts with formulas and numbers of its own: what `mote chart` writes must agree.
// The quick topics; all of them by hand as docs/accuracy.md says.
#include "run_mote.hpp"

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class ChartCheck : public CommandTest {};

TEST_F(ChartCheck, AnIndependentProgramAgrees) {
  if (shell("python3 -c 'import tomllib'").exit != 0) GTEST_SKIP() << "python3 (3.11 or later) is missing: apt-get install python3";
  for (const char* topic : {"depth", "placement", "ocio"}) ASSERT_EQ(mote(std::string("chart --topic ") + topic + " -o " + topic + ".csv").exit, 0) << topic;
  const std::string scene = "chart '" MOTE_SOURCE_DIR "/tests/chart_scene.toml' --size 160x120 --topic ";
  ASSERT_EQ(mote(scene + "sampling --set light.sun.shadows=false -o sampling.csv").exit, 0);
  ASSERT_EQ(mote(scene + "shadow -o shadow.csv").exit, 0);
  const Ran ran = shell("python3 '" MOTE_SOURCE_DIR "/tests/chart_check.py' .");
  EXPECT_EQ(ran.exit, 0) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr(" 0 differ by more than 10 %"));
  // It can fail: a digit before every error of three topics.
  const Ran spoiled = shell("rm placement.csv ocio.csv && sed -i -E 's/(relative error, p99\",|\"color error, RMS\",steps of 255|wrongly lit or shadowed,%),([0-9])/\\1,9\\2/' *.csv && python3 '" MOTE_SOURCE_DIR "/tests/chart_check.py' .");
  EXPECT_EQ(spoiled.exit, 1) << spoiled.out;
  for (const char* topic : {"depth", "sampling", "shadow"}) EXPECT_THAT(spoiled.out, ContainsRegex(std::string("\n") + topic + " [^\n]*DIFFERS")) << topic;
}

} // namespace
} // namespace mote::test
