#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "study/read_error.hpp"

#include <filesystem>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The first [[case]] starts at line 4, its own keys at line 8.
const std::string head =
    "kind = \"stability\"\nscene = \"stability/small_shell.toml\"\nnumerical_uncertainty = \"4 K\"\n";
const std::string named = "[[case]]\ngroup = \"load\"\nname = \"high\"\nmust_hold = \"it ends\"\n";

void expect_case_error(const std::string& keys, const ExpectedError& expected) {
  expect_error_in(head + named + keys + "\n", expected);
}

TEST(ReadStability, ACaseIsTheSceneWithItsKeysAndASafeComputation) {
  const StudyFile study = study_of(head + named +
                                   "set = { load.peak = \"1 GPa\", numerics.time_step_factor = 0.6 }\n"
                                   "against = { numerics.time_step_factor = 0.1 }\n"
                                   "expect = [\"held\", \"caught\"]\ncaught_within = 500\n"
                                   "[set]\ngap.exchange_time = \"0.01 ms\"\n");
  ASSERT_EQ(study::settings_of<kinds::StabilitySettings>(study.study).cases.size(), 1u);
  ASSERT_EQ(study.cases.size(), 2u);
  const StressCase& launch = study::settings_of<kinds::StabilitySettings>(study.study).cases.front();
  EXPECT_EQ(launch.group, "load");
  EXPECT_EQ(launch.name, "high");
  EXPECT_EQ(launch.must_hold, "it ends");
  EXPECT_EQ(launch.expected, (std::vector{Outcome::held, Outcome::caught}));
  EXPECT_EQ(launch.caught_within, 500u);
  EXPECT_EQ(launch.run, 0u);
  EXPECT_EQ(launch.against, 1u);
  EXPECT_EQ(launch.gaps, study.study.gaps);
  EXPECT_EQ(study.cases[0].label, "load: high");
  EXPECT_EQ(study.cases[1].label, "load: high, against");
  for (const StudyCase& each : study.cases) {
    EXPECT_EQ(each.scene.scene.load.peak, 1e9);
    EXPECT_EQ(each.scene.scene.surface.exchange_time, 1e-5);
    EXPECT_EQ(each.numerical_uncertainty, 4.0);
  }
  EXPECT_EQ(study.cases[0].scene.scene.numerics.time_step_factor, 0.6);
  EXPECT_EQ(study.cases[1].scene.scene.numerics.time_step_factor, 0.1);
}

TEST(ReadStability, TheStatedUncertaintyStandsWhateverNumericsACaseSets) {
  const StudyFile study = study_of(head + named + "set = { numerics.inertial_scaling = 4 }\n" +
                                   "[[case]]\ngroup = \"load\"\nname = \"other\"\nmust_hold = \"it "
                                   "ends\"\nnumerical_uncertainty = \"9 K\"\n");
  ASSERT_EQ(study.cases.size(), 2u);
  EXPECT_EQ(study.cases[0].numerical_uncertainty, 4.0);
  EXPECT_EQ(study.cases[1].numerical_uncertainty, 9.0);
  EXPECT_FALSE(study.study.numerical_uncertainty_assumed);
}

TEST(ReadStability, ACaseMayHaveASceneOfItsOwnAndItsGaps) {
  const StudyFile study = study_of(head + named +
                                   "scene = \"scene_155mm.toml\"\nset = { gap.thickness = \"0, 1 mm\" }\n"
                                   "[set]\nnumerics.inertial_scaling = 16\n");
  ASSERT_EQ(study.cases.size(), 1u);
  EXPECT_EQ(study.cases[0].scene.scene.load.duration, 18e-3);
  EXPECT_EQ(study.cases[0].scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_EQ(study::settings_of<kinds::StabilitySettings>(study.study).cases[0].gaps,
            (std::vector<double>{0.0, 1e-3}));
}

TEST(ReadStability, WhatTheReaderRefusesIsACaseWithoutARun) {
  const std::string reader =
      "[[case]]\ngroup = \"reader\"\nname = \"too long\"\nmust_hold = \"refused\"\nrefused = \"to 2\"\n"
      "set = { numerics.time_step_factor = 3 }\n"
      "[[case]]\ngroup = \"reader\"\nname = \"fine\"\nmust_hold = \"refused\"\nrefused = \"to 2\"\n"
      "set = { numerics.time_step_factor = 1 }\n";
  const StudyFile study = study_of(head + named + reader);
  ASSERT_EQ(study::settings_of<kinds::StabilitySettings>(study.study).cases.size(), 3u);
  EXPECT_EQ(study.cases.size(), 1u);
  EXPECT_FALSE(study::settings_of<kinds::StabilitySettings>(study.study).cases[1].run);
  EXPECT_NE(study::settings_of<kinds::StabilitySettings>(study.study)
                .cases[1]
                .refusal.find("numerics.time_step_factor: found 3"),
            std::string::npos)
      << study::settings_of<kinds::StabilitySettings>(study.study).cases[1].refusal;
  EXPECT_TRUE(study::settings_of<kinds::StabilitySettings>(study.study).cases[2].refusal.empty());
  // Alone they are no study: something has to run.
  expect_error_in(head + reader, {4, "case", "no case that runs", "[[case]]"});
}

TEST(ReadStability, FaultsNameTheCaseTheKeyAndTheLine) {
  expect_case_error("set = { load.peek = \"1 GPa\" }",
                    {8, "case.set.load.peek", "unknown key", "", "load.peak"});
  expect_case_error("set = { load.peak = \"1 mm\" }", {8, "case.set.load.peak", "a length"});
  expect_case_error("set = { body.wall.r = \"1.4 to 2 cm\" }", {8, "case.set.body.wall.r", "overlaps"});
  expect_case_error("against = { load.peak = 3 }", {8, "case.against.load.peak", "without a unit"});
  expect_case_error("set = 3", {8, "case.set", "3", "a table of scene keys"});
  expect_case_error("expect = \"WRONG\"", {8, "case.expect", "\"WRONG\"", "\"held\""});
  expect_case_error("expect = [\"held\", 3]", {8, "case.expect", "3", "\"caught\""});
  expect_case_error("scene = \"nowhere.toml\"", {8, "case.scene", "does not exist"});
  expect_case_error("sets = { }", {8, "case.sets", "unknown key", "", "set"});
  expect_case_error("refused = \"x\"\nexpect = \"caught\"", {9, "case.expect", "a case that runs"});
  expect_case_error(named, {10, "case.name", "\"high\" a second time"});
  expect_error_in(head, {1, "case", "no case that runs", "[[case]]"});
  expect_error_in("kind = \"stability\"\nscene = \"scene_155mm.toml\"\n" + named,
                  {0, "numerical_uncertainty", "missing", "WRONG"});
  expect_error_in("kind = \"sweep\"\nscene = \"scene_155mm.toml\"\n" + named,
                  {3, "case", "kind \"stability\""});
}

TEST(ReadStability, TheShippedMatricesAreValid) {
  for (const char* name : {"stability.toml", "stability/smoke.toml"}) {
    const auto study = read_study(studies_folder / name);
    ASSERT_TRUE(study) << study.error().message();
    EXPECT_GT(settings_of<StabilitySettings>(study->study).cases.size(), 5u);
    for (const StressCase& launch : settings_of<StabilitySettings>(study->study).cases) {
      EXPECT_NE(launch.refusal.find(launch.must_refuse), std::string::npos)
          << launch.name << ": " << launch.refusal;
    }
  }
}

}  // namespace
