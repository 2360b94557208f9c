#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "study/read_error.hpp"

#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The group starts at line 4, its own keys at line 6.
const std::string stability_start =
    "kind = \"stability\"\nscene = \"stability/small_shell.toml\"\ntemperature_tolerance = \"5 K\"\n"
    "[[group]]\nname = \"load\"\n";

std::string cases(const std::string& keys) { return "cases = [ { name = \"high\", " + keys + " } ]\n"; }

const std::vector<StressCase>& cases_of(const StudyFile& study) {
  return kinds::settings_of<StabilitySettings>(study.study).cases;
}

TEST(ReadStability, ACaseAddsToWhatItsGroupSetsAndReplacesWhatElseItSays) {
  const StudyFile study = study_of(
      stability_start +
      "set = { load.peak = \"1 GPa\", numerics.time_step_factor = 0.6 }\n"
      "against = { numerics.time_step_factor = 0.1 }\nexpect = \"held, caught\"\n"
      "caught_within = 500\ntolerance = \"9 K\"\ncases = [ { name = \"high\" },\n"
      "{ name = \"other\", set = { load.peak = \"2 GPa\", gap.thickness = \"0, 1 mm\" }, against = {}, "
      "expect = \"held\", tolerance = \"3 K\" } ]\n"
      "[set]\ngap.exchange_time = \"0.01 ms\"\n");
  ASSERT_EQ(cases_of(study).size(), 2u);
  const StressCase &high = cases_of(study)[0], &other = cases_of(study)[1];
  EXPECT_EQ(high.label(), "load: high");
  EXPECT_EQ(high.expected, (std::vector{Outcome::held, Outcome::caught}));
  EXPECT_EQ(high.run, 0u);
  EXPECT_EQ(high.against, 1u);
  EXPECT_EQ(high.gaps, study.study.gaps);
  EXPECT_EQ(other.expected, (std::vector{Outcome::held}));
  EXPECT_EQ(other.caught_within, 500u);
  EXPECT_EQ(other.run, 2u);
  EXPECT_FALSE(other.against);
  EXPECT_EQ(other.gaps, (std::vector<double>{0.0, 1e-3}));
  const std::vector<std::string> labels{"load: high", "load: high, against", "load: other"};
  EXPECT_EQ(high.tolerance, 9.0);
  EXPECT_EQ(other.tolerance, 3.0);
  const std::vector<double> peaks{1e9, 1e9, 2e9}, factors{0.6, 0.1, 0.6};
  ASSERT_EQ(study.cases.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(study.cases[i].label, labels[i]);
    EXPECT_EQ(study.cases[i].scene.scene.load.peak, peaks[i]);
    EXPECT_EQ(study.cases[i].scene.scene.numerics.time_step_factor, factors[i]);
    EXPECT_EQ(study.cases[i].scene.scene.surface.exchange_time, 1e-5);
  }
}

TEST(ReadStability, ACaseMayHaveASceneOfItsOwnAndTheStudysTolerance) {
  const StudyFile study =
      study_of(stability_start + cases("scene = \"scene_155mm.toml\", set = { load.peak = \"1 GPa\" }") +
               "[set]\nnumerics.inertial_scaling = 16\n");
  ASSERT_EQ(study.cases.size(), 1u);
  EXPECT_EQ(study.cases[0].scene.scene.load.muzzle_exit, 18e-3);
  EXPECT_EQ(study.cases[0].scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_EQ(cases_of(study)[0].tolerance, 5.0);
}

TEST(ReadStability, WhatTheReaderRefusesIsACaseWithoutARun) {
  const std::string refused =
      "refused = \"to 2\"\ncases = [ { name = \"too long\", set = { numerics.time_step_factor = 3 } },\n"
      "{ name = \"fine\", set = { numerics.time_step_factor = 1 } } ]\n";
  const StudyFile study =
      study_of(stability_start + refused + "[[group]]\nname = \"run\"\n" + cases("expect = \"held\""));
  ASSERT_EQ(cases_of(study).size(), 3u);
  EXPECT_EQ(study.cases.size(), 1u);
  EXPECT_FALSE(cases_of(study)[0].run);
  EXPECT_NE(cases_of(study)[0].refusal.find("numerics.time_step_factor: found 3"), std::string::npos)
      << cases_of(study)[0].refusal;
  EXPECT_TRUE(cases_of(study)[1].refusal.empty());
  // Alone they are no study: something has to run.
  expect_error_in(stability_start + refused, {4, "group", ""});
}

TEST(ReadStability, FaultsNameTheTableTheKeyAndTheLine) {
  const auto expect = [](const std::string& keys, const ExpectedError& error) {
    expect_error_in(stability_start + cases(keys), error);
  };
  expect("set = { load.peek = \"1 GPa\" }", {6, "group.cases.set.load.peek", "", "", "load.peak"});
  expect("against = { load.peak = 3 }", {6, "group.cases.against.load.peak", ""});
  expect("set = 3", {6, "group.cases.set", "3"});
  expect("expect = \"WRONG\"", {6, "group.cases.expect", "\"WRONG\"", "\"held\""});
  expect("scene = \"nowhere.toml\"", {6, "group.cases.scene", ""});
  expect("caught_within = 9, expect = \"held\"", {6, "group.cases.caught_within", "9"});
  expect("set = { } }, { name = \"high\"", {6, "group.cases.name", "\"high\""});
  expect_error_in(stability_start, {4, "group.cases", ""});
  expect("tolerance = \"0 K\"", {6, "group.cases.tolerance", "0 K"});
}

TEST(ReadStability, TheShippedTablesAreValid) {
  for (const char* name : {"stability.toml", "stability/smoke.toml"}) {
    const auto study = read_study(studies_folder / name);
    ASSERT_TRUE(study) << study.error().message();
    EXPECT_GT(cases_of(*study).size(), 5u);
    for (const StressCase& each : cases_of(*study))
      EXPECT_NE(each.refusal.find(each.refused), std::string::npos) << each.name << ": " << each.refusal;
  }
}

}  // namespace
