// SPDX-License-Identifier: MIT
// Limits, verdicts and reports.
#include "core/compare/limits.hpp"
#include "core/compare/report.hpp"
#include "pictures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace mote::compare {
namespace {

using namespace mote::test;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CompareLimits, AListIsParsed) {
  Diagnostics d;
  const Limits limits = parse_limits(" id=0, depth_p99 = 2.5e-7 ,rms=1", d);
  EXPECT_TRUE(d.empty());
  ASSERT_EQ(limits.size(), 3u);
  EXPECT_EQ(limits[0].name, "id");
  EXPECT_EQ(limits[0].at_most, 0.0);
  EXPECT_EQ(limits[1].name, "depth_p99");
  EXPECT_EQ(limits[1].at_most, 2.5e-7);
  EXPECT_EQ(limits[2].at_most, 1.0);
  EXPECT_TRUE(parse_limits("  ", d).empty());
  EXPECT_TRUE(d.empty());
}

TEST(CompareLimits, UnknownNameListsTheOthers) {
  Diagnostics d;
  const Limits limits = parse_limits("id=0,depht_p99=1", d);
  EXPECT_EQ(limits.size(), 1u);
  ASSERT_TRUE(d.has("K001"));
  EXPECT_THAT(to_string(d), HasSubstr("no limit 'depht_p99'"));
  EXPECT_THAT(to_string(d), HasSubstr("Did you mean 'depth_p99'?"));
  EXPECT_THAT(to_string(d), HasSubstr("id, id_wrong, coverage"));
}

TEST(CompareLimits, NumbersMustBeNumbersFromZeroUp) {
  for (const char* text : {"rms", "rms=", "rms=one", "rms=-1", "rms=1px", "rms=nan", "rms=inf", ""}) {
    Diagnostics d;
    EXPECT_TRUE(parse_limits(std::string("id=0,") + text, d).size() == 1u);
    EXPECT_TRUE(d.has("K002")) << text;
  }
  Diagnostics d;
  (void)parse_limits("rms=one", d);
  EXPECT_THAT(to_string(d), HasSubstr("limit 'rms' is 'one', which is not a number from 0 up"));
}

TEST(CompareLimits, TwiceIsAnError) {
  Diagnostics d;
  EXPECT_EQ(parse_limits("rms=1,rms=2", d).size(), 1u);
  EXPECT_TRUE(d.has("K003"));
  EXPECT_THAT(to_string(d), HasSubstr("'rms' is given twice"));
}

TEST(CompareLimits, VerdictNamesWhatIsAbove) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.id[on_seven] = 9;
  a.color[on_seven].g -= 10.0f / 255.0f;
  Diagnostics d;
  const CompareResult r = compare(a, b);
  EXPECT_TRUE(judge(r, parse_limits("id=1,max=10.5", d), d).equal);
  const Verdict v = judge(r, parse_limits("id=0,max=10.5", d), d);
  EXPECT_FALSE(v.equal);
  ASSERT_EQ(v.exceeded.size(), 1u);
  EXPECT_EQ(v.exceeded[0].name, "id");
  EXPECT_EQ(v.exceeded[0].value, 1.0);
  EXPECT_TRUE(d.empty());
}

TEST(CompareLimits, NoLimitsMeanIdentical) {
  const CompareInput b = made_up();
  CompareInput a = b;
  Diagnostics d;
  EXPECT_TRUE(judge(compare(a, b), {}, d).equal);
  a.depth[on_seven] += 1e-9;
  const Verdict v = judge(compare(a, b), {}, d);
  EXPECT_FALSE(v.equal);
  EXPECT_THAT(report_text(compare(a, b), v), HasSubstr("above its limit: depth_max"));
  EXPECT_TRUE(d.empty());
}

TEST(CompareLimits, WhatIsNotMeasuredCannotBeLimited) {
  CompareInput a = made_up();
  a.normal.clear();
  Diagnostics d;
  const Verdict v = judge(compare(a, made_up()), {{"normal_p99", 1.0}}, d);
  EXPECT_FALSE(v.equal);
  ASSERT_TRUE(d.has("K006"));
  EXPECT_THAT(to_string(d), HasSubstr("'normal_p99'"));
}

TEST(CompareLimits, EveryMeasureIsReachableByItsName) {
  CompareInput b = made_up();
  b.projected_radius.assign(all_pixels, 10.0f);
  const CompareResult r = compare(made_up(), b);
  Limits limits;
  for (const Measure& m : measures()) {
    EXPECT_EQ(m.value(r), 0.0) << m.name;
    limits.push_back({std::string(m.name), 0.0});
  }
  EXPECT_EQ(limits.size(), 26u);
  Diagnostics d;
  EXPECT_TRUE(judge(r, limits, d).equal);
  EXPECT_TRUE(d.empty());
}

TEST(CompareReport, Text) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.id[on_seven] = no_id;
  Diagnostics d;
  const CompareResult r = compare(a, b);
  const std::string text = report_text(r, judge(r, {{"id", 0.0}}, d));
  EXPECT_THAT(text, HasSubstr("ids: 1 of 200 pixels differ (0 wrong, 0 extra, 1 missing)"));
  EXPECT_THAT(text, HasSubstr("above its limit: id = 1 > 0"));
  EXPECT_THAT(text, HasSubstr("different\n"));
  const CompareResult same = compare(b, b);
  const std::string good = report_text(same, judge(same, {}, d));
  EXPECT_THAT(good, HasSubstr("equal within the limits"));
  EXPECT_THAT(good, Not(HasSubstr("different\n")));
}

TEST(CompareReport, Json) {
  const CompareInput b = made_up();
  CompareInput a = b;
  a.id[on_seven] = 9;
  a.depth[on_nine] = std::numeric_limits<double>::quiet_NaN();
  Diagnostics d;
  const CompareResult r = compare(a, b);
  const nlohmann::json j = nlohmann::json::parse(report_json(r, judge(r, {{"id", 0.0}, {"rms", 1.0}}, d)));
  EXPECT_EQ(j["width"], 20);
  EXPECT_EQ(j["compared"]["depth"], particles - 1);
  EXPECT_EQ(j["measures"]["id"], 1.0);
  EXPECT_TRUE(j["measures"]["depth_max"].is_null()) << "infinite";
  EXPECT_EQ(j["limits"]["rms"], 1.0);
  ASSERT_EQ(j["exceeded"].size(), 1u);
  EXPECT_EQ(j["exceeded"][0]["name"], "id");
  EXPECT_EQ(j["equal"], false);
}

} // namespace
} // namespace mote::compare
