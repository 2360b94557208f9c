#include "launchsafe/study/accuracy_record.hpp"

#include "launchsafe/run/model_version.hpp"
#include "store/temporary_folder.hpp"
#include "study/read_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

scene::Scene own_scene() { return study_of(critical_text).scene.scene; }

scene::Scene scaled(double scaling) {
  scene::Scene scene = own_scene();
  scene.numerics.inertial_scaling = scaling;
  return scene;
}

/// The scene's own setting, known to 3 K for 20 s; a scaled one to 8 K for 5 s; one that failed.
AccuracyRecord some_record() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {"made up",
          run::model_version,
          shell_of(own_scene()),
          496e6,
          200.0,
          {{"as in the scene", setting_of(own_scene()), 3.0, 1e-5, 20.0},
           {"inertial_scaling 16", setting_of(scaled(16)), 8.0, 3e-5, 5.0},
           {"inertial_scaling 100", setting_of(scaled(100)), infinity, std::nan(""), 2.0}}};
}

TEST(AccuracyRecord, IsReadBackAsItWasWritten) {
  const auto record = accuracy_record_from(to_json_text(some_record()));
  ASSERT_TRUE(record);
  EXPECT_EQ(record->shell, some_record().shell);
  EXPECT_EQ(record->rise, 200.0);
  ASSERT_EQ(record->settings.size(), 3u);
  EXPECT_TRUE(same_setting(record->settings[1].setting, setting_of(scaled(16))));
  EXPECT_EQ(record->settings[1].temperature_bound, 8.0);
  EXPECT_TRUE(std::isnan(record->settings[2].critical_gap_bound));
  EXPECT_FALSE(std::isfinite(record->settings[2].temperature_bound));
  EXPECT_FALSE(accuracy_record_from("{}"));
  EXPECT_FALSE(accuracy_record_from("no json"));
  EXPECT_FALSE(accuracy_record_from(R"({"format": "launchsafe accuracy record 1", "title": 3})"));
}

TEST(AccuracyRecord, PicksTheCheapestSettingWithinATolerance) {
  const AccuracyRecord record = some_record();
  EXPECT_EQ(cheapest_within(record, 10.0)->label, "inertial_scaling 16");
  EXPECT_EQ(cheapest_within(record, 3.0)->label, "as in the scene");
  EXPECT_EQ(cheapest_within(record, 2.9), nullptr);
  EXPECT_EQ(cheapest_within({}, 1e9), nullptr);
}

TEST(AccuracyRecord, KnowsASettingByItsValuesAndAShellByWhatErrorsDependOn) {
  const AccuracyRecord record = some_record();
  EXPECT_EQ(recorded_setting(record, scaled(16))->temperature_bound, 8.0);
  EXPECT_EQ(recorded_setting(record, scaled(4)), nullptr);
  scene::Scene scene = own_scene();
  scene.load.peak = 300e6;
  scene.charge.cracks.initial_crack_radius = 1e-3;
  scene.surface.localisation = 5;
  scene.numerics.cell_size = 2.5e-3 * (1.0 + 1e-15);  // 0.25 cm is not always 2.5 mm to the last digit
  EXPECT_EQ(why_foreign(record, scene), "");
  EXPECT_NE(recorded_setting(record, scene), nullptr);
  scene.bodies.front().r_end *= 1.01;
  EXPECT_NE(why_foreign(record, scene), "");
  scene = own_scene();
  scene.surface.friction = scene::FrictionClosure::inelastic;
  EXPECT_NE(why_foreign(record, scene), "");
  AccuracyRecord old = record;
  old.model_version -= 1;
  EXPECT_NE(why_foreign(old, own_scene()), "");
}

/// A study beside a record in a folder of its own.
class RecordedStudy : public launchsafe::testing::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    std::ofstream(folder() / "accuracy.json") << to_json_text(some_record());
    std::ofstream(folder() / "broken.json") << "{}";
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
  EXPECT_EQ(own.cases.front().numerical_uncertainty, 3.0);
  EXPECT_EQ(own.cases.front().rise_of_uncertainty, 200.0);
  EXPECT_FALSE(own.study.numerical_uncertainty_assumed);
  const StudyFile other = read(record_key + "[set]\nnumerics.inertial_scaling = 16\n");
  EXPECT_EQ(other.cases.front().numerical_uncertainty, 8.0);
}

TEST_F(RecordedStudy, AssumesTheUsualForASettingThatIsNotRecordedOrHasNoBound) {
  for (const char* scaling : {"4", "100"}) {
    const StudyFile study = read(record_key + "[set]\nnumerics.inertial_scaling = " + scaling + "\n");
    EXPECT_EQ(study.cases.front().numerical_uncertainty, assumed_numerical_uncertainty) << scaling;
    EXPECT_TRUE(study.study.numerical_uncertainty_assumed) << scaling;
  }
}

TEST_F(RecordedStudy, AToleranceReplacesTheSettingAndSaysWhich) {
  const StudyFile study = read(record_key, {10.0});
  EXPECT_EQ(study.cases.front().scene.scene.numerics.inertial_scaling, 16.0);
  EXPECT_EQ(study.cases.front().numerical_uncertainty, 8.0);
  EXPECT_NE(study.chosen_setting.find("inertial_scaling 16"), std::string::npos);
  EXPECT_EQ(read(record_key + "setting_tolerance = \"10 K\"\n").chosen_setting, study.chosen_setting);
  EXPECT_EQ(read(record_key + "setting_tolerance = \"10 K\"\n", {3.0}).cases.front().numerical_uncertainty,
            3.0)
      << "the command line has the last word";
  EXPECT_TRUE(read(record_key).chosen_setting.empty());
}

TEST_F(RecordedStudy, RefusesAToleranceThatNothingMeets) {
  const auto too_small = parse(record_key, {1.0});
  ASSERT_FALSE(too_small);
  EXPECT_NE(too_small.error().allowed.find("3 K"), std::string::npos) << too_small.error().message();
  EXPECT_FALSE(parse("", {10.0})) << "there is no record";
  EXPECT_FALSE(parse(record_key + "[set]\nnumerics.inertial_scaling = 4\n", {10.0}));
}

/// A bound below 0 would make every verdict safer than it is.
TEST_F(RecordedStudy, RefusesARecordWithABoundOrACostBelowZero) {
  for (double RecordedSetting::*number :
       {&RecordedSetting::temperature_bound, &RecordedSetting::critical_gap_bound,
        &RecordedSetting::processor_time}) {
    AccuracyRecord record = some_record();
    record.settings[0].*number = -1e-9;
    EXPECT_FALSE(accuracy_record_from(to_json_text(record)));
  }
  AccuracyRecord record = some_record();
  std::string text = to_json_text(record);
  text.replace(text.find("\"model_version\": "), 17, "\"model_version\": 1e300, \"x\": ");
  EXPECT_FALSE(accuracy_record_from(text));
}

/// No reader of scenes has checked the values of a record.
TEST_F(RecordedStudy, RefusesASettingThatNoSceneMayHave) {
  const std::vector<std::pair<std::string, scene::Value>> impossible{{"numerics.cell_size", -1e-3},
                                                                     {"numerics.particles_per_cell", 1.5},
                                                                     {"frame", std::string("sideways")}};
  for (const auto& [key, value] : impossible) {
    AccuracyRecord record = some_record();
    record.settings[0].setting[key] = value;
    std::ofstream(folder() / "accuracy.json") << to_json_text(record);
    const auto study = parse(record_key, {3.0});
    ASSERT_FALSE(study) << key;
    EXPECT_NE(study.error().found.find(key), std::string::npos) << study.error().message();
  }
}

TEST_F(RecordedStudy, RefusesWhatIsNoRecord) {
  for (const char* name : {"broken.json", "missing.json"}) {
    const auto study = parse("accuracy = \"" + std::string(name) + "\"\n");
    ASSERT_FALSE(study) << name;
    EXPECT_EQ(study.error().key, "accuracy");
    EXPECT_EQ(study.error().line, 3);
  }
  const auto both = parse(record_key + "numerical_uncertainty = \"1 K\"\n");
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().key, "numerical_uncertainty");
}

}  // namespace
