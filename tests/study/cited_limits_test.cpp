// [[cited_limit]]: how it is read, and which case stands beside it.
#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/study/verdict.hpp"
#include "study/read_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string limit_text =
    "[[cited_limit]]\ngap = \"0.381 mm\"\npeak_pressure = \"506 MPa\"\nsource = \"a laboratory\"\n"
    "[[cited_limit]]\ngap = \"0.5 mm\"\nsource = \"finite elements\"\n";

TEST(CitedLimits, AreReadInSi) {
  const StudyFile study = study_of(critical_kind + limit_text);
  const auto& limits = study.study.cited_limits;
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_DOUBLE_EQ(limits[0].gap, 0.381e-3);
  EXPECT_DOUBLE_EQ(limits[0].peak_pressure, 506e6);
  EXPECT_EQ(limits[0].source, "a laboratory");
  EXPECT_TRUE(std::isnan(limits[1].peak_pressure));
}

TEST(CitedLimits, OfTheShippedStudiesAreThoseOfThePaper) {
  for (const char* name : {"critical_gap_155mm.toml", "sweep_pressure_defect.toml"}) {
    const auto study = read_study(studies_folder / name);
    ASSERT_TRUE(study) << study.error().message();
    ASSERT_EQ(study->study.cited_limits.size(), 3u) << name;
    EXPECT_DOUBLE_EQ(study->study.cited_limits[0].gap, 0.381e-3);
  }
}

TEST(CitedLimits, WhatIsNoneIsRefused) {
  const auto expect = [](const std::string& line, const ExpectedError& error) {
    expect_error_in(critical_kind + line + "\n", error);
  };
  const std::string limit = "[[cited_limit]]\ngap = \"0.5 mm\"\nsource = \"someone\"\n";
  expect(limit + "set = { load.peak = \"450 MPa\" }",
         {6, "cited_limit.set.load.peak", "unknown key", "the keys gap", "set above the first [table]"});
  expect("cited_limit = 3", {3, "cited_limit", "3", "[[cited_limit]]"});
  expect("cited_limit = [{ source = \"someone\" }]", {3, "cited_limit.gap", "missing"});
  expect("cited_limit = [{ gap = \"0.5 mm\" }]", {3, "cited_limit.source", "missing"});
  expect("cited_limit = [{ gap = \"0 mm\", source = \"someone\" }]", {3, "cited_limit.gap", "0"});
  expect("cited_limit = [{ gap = \"1 mm\", pressure = \"5 MPa\", source = \"someone\" }]",
         {3, "cited_limit.pressure", "unknown"});
  expect_error_in("kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n" + limit_text,
                  {3, "cited_limit", "critical-gap"});
}

TEST(CitedLimits, AreDocumented) {
  const auto keys = describe_study_keys();
  const auto found = std::find_if(keys.begin(), keys.end(), [](const auto& key) {
    return key.description.name == "cited_limit.peak_pressure";
  });
  ASSERT_NE(found, keys.end());
  EXPECT_NE(found->description.sentence.find("critical-gap"), std::string::npos);
}

CriticalGap value(double gap) {
  CriticalGap critical;
  critical.kind = CriticalGapKind::value;
  critical.value = gap;
  return critical;
}

/// A sweep of two pressures by two crack radii, of which 30 um is the scene's.
StudyFile four_cases() {
  return study_of(critical_kind + vary({{"peak_pressure", "496, 506 MPa"}, {"crack_radius", "30, 300 um"}}) +
                  limit_text);
}

TEST(CitedLimits, StandBesideTheNearestPressureAndTheOwnDefect) {
  const CriticalGap a = value(3.95e-4), b = value(2e-4), c = value(3.8e-4), d = value(1.8e-4);
  const auto compared = compare_with_limits(four_cases(), {&a, &b, &c, &d});
  ASSERT_EQ(compared.size(), 2u);
  EXPECT_EQ(compared[0].nearest, 2u);  // 506 MPa, 30 um
  EXPECT_NEAR(compared[0].difference, 3.8e-4 - 3.81e-4, 1e-12);
  EXPECT_EQ(compared[1].nearest, 0u);  // no pressure: the scene's 496 MPa
  EXPECT_NEAR(compared[1].difference, 3.95e-4 - 5e-4, 1e-12);
}

TEST(CitedLimits, ABoundHasNoDifference) {
  CriticalGap bound;
  bound.kind = CriticalGapKind::all_safe;
  bound.lower = 1e-3;
  const auto compared = compare_with_limits(four_cases(), {&bound, &bound, &bound, &bound});
  EXPECT_EQ(compared[0].nearest, 2u);
  EXPECT_TRUE(std::isnan(compared[0].difference));
}

/// Of several cases at one pressure the worst stands beside the limit: one that ignites without a gap, or one
/// of which nothing is known.
TEST(CitedLimits, ABoundBelowEveryNumberStandsBesideTheLimit) {
  StudyFile study = four_cases();
  for (std::size_t i = 0; i < study.cases.size(); ++i)  // none has the scene's own defect
    change_case(study, i,
                [](StudyCase& each) { each.scene.scene.charge().strength.initial_crack_radius *= 2.0; });
  const CriticalGap known = value(3.8e-4);
  CriticalGap ignites, unknown;
  ignites.kind = CriticalGapKind::all_ignite;
  unknown.kind = CriticalGapKind::indeterminate;
  const auto without_gap = compare_with_limits(study, {&known, &known, &known, &ignites});
  EXPECT_EQ(without_gap[0].nearest, 3u);
  EXPECT_TRUE(std::isnan(without_gap[0].difference));
  const auto not_known = compare_with_limits(study, {&known, &known, &known, &unknown});
  EXPECT_EQ(not_known[0].nearest, 3u);
  EXPECT_TRUE(std::isnan(not_known[0].difference));
}

TEST(CitedLimits, OtherPressuresHaveNoDifference) {
  const StudyFile study = study_of(critical_kind + vary({{"peak_pressure", "480, 496 MPa"}}) + limit_text);
  const CriticalGap low = value(4.3e-4), own = value(3.95e-4);
  const auto compared = compare_with_limits(study, {&low, &own});
  EXPECT_EQ(compared[0].nearest, 1u);  // 496 is nearer to 506
  EXPECT_TRUE(std::isnan(compared[0].difference)) << "2 % off";
  EXPECT_TRUE(std::isfinite(compared[1].difference));
  EXPECT_FALSE(compare_with_limits(study, {})[0].nearest);
}

}  // namespace
