// Critical gaps and what studies accept, as text.
#include "launchsafe/report/study_text.hpp"

#include <gtest/gtest.h>

namespace launchsafe::report {
namespace {

using study::CaseRow, study::CriticalGapKind, study::Remark;

CaseRow row_of(CriticalGapKind kind, double gap, double at_least, double at_most) {
  CaseRow row;
  row.critical = {kind, gap};
  row.bounds = {at_least, at_most};
  return row;
}

TEST(VerdictText, ACriticalGapIsQuotedInTheDigitsOfItsBounds) {
  EXPECT_EQ(measured_text(row_of(CriticalGapKind::value, 391e-6, 246e-6, 536e-6)), "0.039 ± 0.015 cm");
  EXPECT_EQ(measured_text(row_of(CriticalGapKind::value, 391e-6, math::not_a_number, math::not_a_number)),
            "0.0391 cm");
  EXPECT_EQ(measured_text(row_of(CriticalGapKind::all_safe, 0.01, 0.005, study::no_ignition)), "> 1 cm");
  EXPECT_EQ(measured_text(row_of(CriticalGapKind::all_ignite, 0.0, 0.0, 1e-4)), "ignites without a gap");
  EXPECT_EQ(measured_text(row_of(CriticalGapKind::several_crossings, 391e-6, 246e-6, 536e-6)),
            "several, the first at 0.0391 cm");
  EXPECT_EQ(measured_text({}), "unknown");
}

TEST(VerdictText, ANumberIsPrintedWhereTheSearchFoundIgnition) {
  const auto number = [](CriticalGapKind kind, double gap) {
    return json_of(case_quantities(), row_of(kind, gap, 0.0, gap))["critical_gap_cm"];
  };
  EXPECT_EQ(number(CriticalGapKind::value, 4e-4), 0.04);
  EXPECT_EQ(number(CriticalGapKind::several_crossings, 4e-4), 0.04);
  EXPECT_EQ(number(CriticalGapKind::all_ignite, 0.0), 0.0);
  EXPECT_TRUE(number(CriticalGapKind::all_safe, 0.01).is_null());
  EXPECT_TRUE(number(CriticalGapKind::unknown, math::not_a_number).is_null());
}

TEST(VerdictText, WhatIsOpenAndAcceptableIsWrittenOnce) {
  CaseRow row;
  row.warnings = {
      {"shell-yields", "", true, ""}, {"energy", "", false, ""}, {"low-velocity", "", true, "as meant"}};
  row.extrapolated = {{"steel", "", true, ""}, {"explosive", "", false, ""}, {"calibre", "", true, ""}};
  EXPECT_EQ(acceptances_to_write({row, row}),
            (std::vector<std::string>{"[accept]", "shell-yields = \"...\"", "[accept.extrapolation]",
                                      "calibre = \"...\"", "steel = \"...\""}));
  EXPECT_TRUE(acceptances_to_write({CaseRow()}).empty());
}

TEST(VerdictText, NotesOfAStudyWithoutAnExpectedVelocitySaySo) {
  study::StudyFile study;
  const auto names_key = [&] {
    return std::ranges::any_of(verdict_notes(study, {}), [](const std::string& note) {
      return note.find("load.expected_velocity") != std::string::npos;
    });
  };
  EXPECT_TRUE(names_key());
  study.scene.scene.load.expected_velocity = 800.0;
  EXPECT_FALSE(names_key());
  study.study.kind.gives_verdicts = false;
  study.scene.scene.load.expected_velocity.reset();
  EXPECT_FALSE(names_key());
}

}  // namespace
}  // namespace launchsafe::report
