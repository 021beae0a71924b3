// SPDX-License-Identifier: MIT
// tests/chart_check.py recomputes points of charts with formulas and numbers of its own: what `mote chart` writes must agree.
// The quick topics; all of them by hand as docs/accuracy.md says.
#include "run_mote.hpp"

#include <gmock/gmock.h>

namespace mote::test {
namespace {

using ::testing::HasSubstr;

class ChartCheck : public CommandTest {};

TEST_F(ChartCheck, AnIndependentProgramAgrees) {
  if (shell("command -v python3").exit != 0) GTEST_SKIP() << "python3 is missing: apt-get install python3";
  for (const char* topic : {"depth", "placement", "ocio"}) ASSERT_EQ(mote(std::string("chart --topic ") + topic + " -o " + topic + ".csv").exit, 0) << topic;
  const Ran ran = shell("python3 '" MOTE_SOURCE_DIR "/tests/chart_check.py' .");
  EXPECT_EQ(ran.exit, 0) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr(" 0 differ by more than 10 %"));
  // It can fail.
  const Ran spoiled = shell("sed -i 's/relative error, p99\",,\\([0-9]\\)/relative error, p99\",,9\\1/' depth.csv && python3 '" MOTE_SOURCE_DIR "/tests/chart_check.py' .");
  EXPECT_EQ(spoiled.exit, 1) << spoiled.out;
  EXPECT_THAT(spoiled.out, HasSubstr("DIFFERS"));
}

} // namespace
} // namespace mote::test
