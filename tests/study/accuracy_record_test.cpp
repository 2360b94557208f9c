#include "launchsafe/study/accuracy_record.hpp"

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "store/temporary_folder.hpp"
#include "study/made_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

TEST(AccuracyRecord, ItsBoundsFollowFromWhatTheSettingsGave) {
  const AccuracyRecord record = made_record();
  EXPECT_TRUE(record.unvaried.empty());
  EXPECT_NEAR(record.rise, recorded_rise - 0.25 + 0.25, 1e-9) << "of the coolest mesh, the finest";
  EXPECT_NEAR(record.settings[0].temperature_bound, limit_uncertainty, 1e-6);
  EXPECT_NEAR(record.settings[2].temperature_bound, own_bound, 1e-6);
  EXPECT_NEAR(record.settings[3].temperature_bound, scaled_bound, 1e-6);
  EXPECT_NEAR(record.settings[3].critical_gap_bound, 1e-6 * scaled_bound, 1e-12);
}

TEST(AccuracyRecord, ASettingWithoutACriticalGapHasNoBoundOfIt) {
  AccuracyRecord record = made_record();
  record.settings[3].critical_gap = std::nan("");
  find_bounds(record);
  EXPECT_TRUE(std::isnan(record.settings[3].critical_gap_bound));
  EXPECT_NEAR(record.settings[3].temperature_bound, scaled_bound, 1e-6);
  EXPECT_NEAR(record.settings[4].critical_gap_bound, 1e-6 * (29.75 + limit_uncertainty), 1e-12);
}

/// A key, what all runs of a record have it at instead of its exact value.
struct Shared {
  const char* key;
  scene::Value value;
};

AccuracyRecord sharing(const Shared& shared) {
  AccuracyRecord record = made_record();
  record.settings.resize(3);
  for (RecordedSetting& each : record.settings) {
    each.setting = setting_of(even(own_scene()));
    each.setting["numerics.cell_size"] = each.cell / 0.99;
    each.setting[shared.key] = shared.value;
  }
  find_bounds(record);
  return record;
}

const Shared inexact[] = {
    {"numerics.inertial_scaling", 16.0}, {"numerics.damping_time", 1e-4}, {"numerics.pic_fraction", 0.01}};

TEST(AccuracyRecord, VouchesForNothingThatAllItsRunsShareAndThatIsNotExact) {
  for (const Shared& shared : inexact) {
    AccuracyRecord record = sharing(shared);
    EXPECT_EQ(record.unvaried, std::vector<std::string>{shared.key});
    for (const RecordedSetting& each : record.settings) EXPECT_TRUE(std::isnan(each.temperature_bound));
    EXPECT_EQ(cheapest_within(record, 1e9), nullptr);
    EXPECT_EQ(most_accurate(record), nullptr);
    EXPECT_NE(why_foreign(record, own_scene()).find(shared.key), std::string::npos);
    // A setting with the exact value is compared with the same inexact limit: by itself it does not help.
    RecordedSetting exact = made_setting("exact", even(own_scene()), 1.0, 1.0);
    exact.setting["numerics.time_step_factor"] = 0.25;
    record.settings.push_back(exact);
    find_bounds(record);
    EXPECT_TRUE(std::isnan(record.settings.back().temperature_bound)) << shared.key;
  }
}

TEST(AccuracyRecord, WhatASharedKeyChangesIsAddedWhereASettingTells) {
  for (const Shared& shared : inexact) {
    AccuracyRecord record = sharing(shared);
    // The scene's own cells with the exact value are 1.5 K hotter: three times that counts.
    record.settings.push_back(made_setting("exact", even(own_scene()), 3.5, 1.0));
    find_bounds(record);
    EXPECT_TRUE(record.unvaried.empty()) << shared.key;
    EXPECT_NEAR(record.settings[2].temperature_bound, own_bound + 4.5, 1e-6) << shared.key;
    EXPECT_NEAR(record.settings[3].temperature_bound, own_bound + 1.5 + 4.5, 1e-6) << shared.key;
    EXPECT_EQ(why_foreign(record, own_scene()), "") << shared.key;
  }
}

TEST(AccuracyRecord, PicksTheCheapestSettingWithinATolerance) {
  const AccuracyRecord record = made_record();
  EXPECT_EQ(cheapest_within(record, 10.0)->label, "inertial_scaling 16");
  EXPECT_EQ(cheapest_within(record, 3.0), &record.settings[2]);
  EXPECT_EQ(cheapest_within(record, 0.3), nullptr);
  EXPECT_EQ(cheapest_within({}, 1e9), nullptr);
  EXPECT_EQ(most_accurate(record), &record.settings[0]);
}

TEST(AccuracyRecord, KnowsASettingByItsValuesAndAShellByWhatErrorsDependOn) {
  const AccuracyRecord record = made_record();
  EXPECT_NEAR(recorded_setting(record, scaled(16))->temperature_bound, scaled_bound, 1e-6);
  EXPECT_EQ(recorded_setting(record, scaled(4)), nullptr);
  scene::Scene scene = own_scene();
  scene.load.peak = 300e6;
  scene.charge().strength.initial_crack_radius = 1e-3;
  scene.surface.localisation = 5;
  scene.numerics.cell_size = 1.25e-3 * (1.0 + 1e-15);  // 0.125 cm is not always 1.25 mm to the last digit
  EXPECT_EQ(why_foreign(record, scene), "");
  EXPECT_NE(recorded_setting(record, scene), nullptr);
  scene.initial_temperature = 310.0;
  EXPECT_EQ(why_foreign(record, scene), "") << "coverage_of carries the errors";
}

TEST(AccuracyRecord, IsForeignToAnotherShellOrClosure) {
  const std::vector<std::function<void(scene::Scene&)>> changes{
      [](auto& s) { s.bodies.front().r_end *= 1.01; },
      [](auto& s) { s.charge().strength.face_friction = 0.0; },
      [](auto& s) { s.barrel = scene::Barrel::none; },
      [](auto& s) { s.surface.friction = scene::FrictionClosure::none; },
      [](auto& s) {
        s.interfaces = {{.body = "wall", .condition = scene::Condition::sliding, .friction = 0.1}};
      }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    scene::Scene scene = own_scene();
    changes[i](scene);
    EXPECT_NE(why_foreign(made_record(), scene), "") << i;
  }
}

/// A study beside a record in a folder of its own.
class RecordedStudy : public launchsafe::testing::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    write(made_record());
    std::ofstream(folder() / "broken.json") << "{}";
  }
  void write(const AccuracyRecord& record) const {
    std::ofstream(folder() / "accuracy.json") << to_json_text(record);
  }
  scene::Expected<StudyFile> parse(const std::string& more, const StudyRequest& request = {}) const {
    return parse_study("kind = \"critical-gap\"\nscene = \"" +
                           (studies_folder / "scene_155mm.toml").string() + "\"\n" + more,
                       folder() / "study.toml", request);
  }
  StudyFile read(const std::string& more, const StudyRequest& request = {}) const {
    auto study = parse(more, request);
    EXPECT_TRUE(study) << (study ? "" : study.error().message());
    return study ? *study : StudyFile{};
  }
};

const std::string record_key = "accuracy = \"accuracy.json\"\n";

TEST_F(RecordedStudy, TakesTheUncertaintyOfItsOwnSetting) {
  const StudyFile own = read(record_key);
  EXPECT_NEAR(own.cases.front().numerical_uncertainty, own_bound, 1e-6);
  EXPECT_NEAR(own.cases.front().rise_of_uncertainty, recorded_rise, 1e-6);
  EXPECT_FALSE(numerical_uncertainty_of(own).assumed);
  const StudyFile other = read(record_key + "[set]\nnumerics.inertial_scaling = 16\n");
  EXPECT_NEAR(other.cases.front().numerical_uncertainty, scaled_bound, 1e-6);
}

TEST_F(RecordedStudy, AssumesTheUsualForASettingThatIsNotRecorded) {
  const StudyFile study = read(record_key + "[set]\nnumerics.inertial_scaling = 4\n");
  EXPECT_EQ(study.cases.front().numerical_uncertainty, assumed_numerical_uncertainty);
  EXPECT_TRUE(numerical_uncertainty_of(study).assumed);
}

/// All runs had a scaling of 16: their record said nothing of its 8 K.
TEST_F(RecordedStudy, AssumesTheUsualWhereTheReferenceHasTheSameError) {
  write(sharing(inexact[0]));
  const StudyFile study = read(record_key + "[set]\nnumerics.inertial_scaling = 16\n");
  EXPECT_EQ(study.cases.front().numerical_uncertainty, assumed_numerical_uncertainty);
  const std::string source = numerical_uncertainty_of(study).source;
  EXPECT_NE(source.find("numerics.inertial_scaling = 16"), std::string::npos) << source;
  EXPECT_FALSE(parse(record_key, {100.0}));
}

/// Studies of other launches and what they get: at least the recorded bound, grown within some range.
TEST_F(RecordedStudy, CarriesABoundToOtherLaunchesOnlySoFar) {
  struct Expected {
    std::string keys;
    double uncertainty;  // K
  };
  const double own = own_bound, assumed = assumed_numerical_uncertainty;
  const Expected launches[] = {{vary({{"peak_pressure", "300 MPa"}}), own},
                               {vary({{"peak_pressure", "595.2 MPa"}}), own * 1.44},  // 1.2 squared
                               {vary({{"peak_pressure", "650 MPa"}}), assumed},
                               {vary({{"peak_pressure", "500 MPa"}, {"crack_radius", "3000 um"}}), assumed},
                               {vary({{"crack_radius", "10 um"}}), own},
                               {vary({{"crack_radius", "60 um"}}), own * std::sqrt(2.0)},
                               {vary({{"flaw_size", "0.5 mm"}}), own * std::sqrt(2.0)},
                               {vary({{"crack_radius", "100 um"}}), assumed},
                               {vary({{"flaw_size", "0.1 mm"}}), assumed},
                               {"gaps = \"0, 0.2 cm\"\n", own},
                               {"[set]\nload.steepness = 1.5\n", own},
                               {"[set]\nload.width = \"1 ms\"\nload.muzzle_exit = \"13.5 ms\"\n", assumed},
                               {"[set]\nload.peak_time = \"5 ms\"\nload.muzzle_exit = \"10 ms\"\n", assumed},
                               {"[set]\nload.duration = \"30 ms\"\n", assumed},
                               {"[set]\nfriction.localisation = 2553.588\n", 2.0 * own},
                               {"[set]\nfriction.localisation = 5000\n", assumed},
                               {"[set]\ninitial_temperature = \"219 K\"\n", own},
                               // (336/300)^2 = 1.2544 of the recorded 300 K; 366 K are hotter by 22 %.
                               {"[set]\ninitial_temperature = \"336 K\"\n", own * 1.2544},
                               {"[set]\ninitial_temperature = \"366 K\"\n", assumed}};
  for (const Expected& launch : launches) {
    const StudyFile study = read(record_key + launch.keys);
    ASSERT_FALSE(study.cases.empty());
    const StudyCase& first = study.cases.front();
    EXPECT_NEAR(first.numerical_uncertainty, launch.uncertainty, 1e-3) << launch.keys;
    EXPECT_EQ(numerical_uncertainty_of(study).assumed, launch.uncertainty == assumed) << launch.keys;
    // From the recorded rise on the bound would grow in proportion, whatever it is now.
    EXPECT_NEAR(first.numerical_uncertainty / first.rise_of_uncertainty, own / recorded_rise, 1e-6)
        << launch.keys;
  }
}

/// A verdict does not depend on what else a study lists: a gap has its own uncertainty.
TEST_F(RecordedStudy, CoversGapsOneByOne) {
  for (const char* gaps : {"gaps = \"0, 0.01 cm\"\n", "gaps = \"0, 0.01, 0.3 cm\"\n"}) {
    const StudyFile study = read(record_key + gaps);
    const StudyCase& input = study.cases.front();
    EXPECT_NEAR(numerical_share(input, 1e-4, 1.0), own_bound, 1e-6) << gaps;
    EXPECT_EQ(numerical_share(input, 3e-3, 1.0), assumed_numerical_uncertainty) << gaps;
  }
}

TEST_F(RecordedStudy, AToleranceReplacesTheSettingAndSaysWhich) {
  const StudyFile study = read(record_key, {10.0});
  EXPECT_EQ(study.cases.front().scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_NEAR(study.cases.front().numerical_uncertainty, scaled_bound, 1e-6);
  EXPECT_NE(study.chosen_setting.find("inertial_scaling 16"), std::string::npos);
  EXPECT_EQ(read(record_key + "setting_tolerance = \"10 K\"\n").chosen_setting, study.chosen_setting);
  const StudyFile told = read(record_key + "setting_tolerance = \"10 K\"\n", {3.0});
  EXPECT_NEAR(told.cases.front().numerical_uncertainty, own_bound, 1e-6)
      << "the command line has the last word";
  EXPECT_TRUE(read(record_key).chosen_setting.empty());
}

TEST_F(RecordedStudy, RefusesAToleranceThatNothingMeets) {
  const auto too_small = parse(record_key, {0.1});
  ASSERT_FALSE(too_small);
  EXPECT_NE(too_small.error().allowed.find("0.313 K"), std::string::npos) << too_small.error().message();
  EXPECT_FALSE(parse("", {10.0})) << "there is no record";
  EXPECT_FALSE(parse(record_key + "[set]\nnumerics.inertial_scaling = 4\n", {10.0}));
  EXPECT_FALSE(parse(record_key + "[set]\nload.peak = \"700 MPa\"\n", {10.0})) << "not covered";
}

/// At 1.2 times the pressure the bounds are 1.44 times as large: 6.06 K are 8.7 K, above 7 K.
TEST_F(RecordedStudy, AToleranceIsMetByBoundsGrownToTheLaunch) {
  const std::string hotter = record_key + "[set]\nload.peak = \"595.2 MPa\"\n";
  EXPECT_EQ(read(record_key, {7.0}).cases.front().scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_EQ(read(hotter, {7.0}).cases.front().scene.scene.numerics.inertial_scaling, 1.0);
}

TEST_F(RecordedStudy, RefusesWhatIsNoRecord) {
  const auto missing = parse("accuracy = \"missing.json\"\n");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().key, "accuracy");
  EXPECT_EQ(missing.error().line, 3);
  const auto broken = parse("accuracy = \"broken.json\"\n");
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().file.find("broken.json"), std::string::npos) << broken.error().message();
  EXPECT_EQ(broken.error().key, "format");
  const auto both =
      parse(record_key + "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n");
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().key, "numerical_uncertainty.value");
}

// What is not known is not forgotten for something known that comes after it: stations of a calibration once
// passed as converged so.
TEST(AccuracyRecord, TheLargerBoundIsNoneWhereOneOfThemIs) {
  EXPECT_TRUE(std::isnan(larger_bound(not_a_number, 1.0)));
  EXPECT_TRUE(std::isnan(larger_bound(1.0, not_a_number)));
  EXPECT_EQ(larger_bound(1.0, 2.0), 2.0);
  EXPECT_EQ(larger_bound(2.0, 1.0), 2.0);
}

}  // namespace
