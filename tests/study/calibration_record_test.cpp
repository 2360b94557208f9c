#include "launchsafe/study/calibration_record.hpp"

#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "study/synthetic_launch.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string fitted_load =
    "kind = \"calibration\"\ntitle = \"a calibration\"\nscene = \"scene_155mm.toml\"\n"
    "references = \"table8.toml\"\nload_fitted = true\nmeshes = \"1.25 mm\"\n";

CalibrationResult calibrated() { return run_calibration(study_of(fitted_load), squared_pressure_options()); }

CalibrationRecord made_calibration() {
  const auto record = record_of(calibrated());
  EXPECT_TRUE(record);
  return record.value_or(CalibrationRecord{});
}

TEST(CalibrationRecord, ReadsBackWhatWasWritten) {
  const CalibrationRecord record = made_calibration();
  ASSERT_TRUE(record.failure.empty()) << record.failure;
  const auto read = parse_calibration_record(to_json_text(record), "calibration.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_json_text(*read), to_json_text(record));
  EXPECT_TRUE(distance_to_record(RecordKind::calibration, read->calibration.scene, record.calibration.scene)
                  .inside());
}

// Student's factor for 3 misfits, 95 % one-sided, is 2.353; they are 1, 2 and 2 K, 3 K squared on average.
TEST(CalibrationRecord, BoundsMisfitsByStudentsFactorForTheirNumber) {
  CalibrationResult result = calibrated();
  for (CalibrationRow& row : result.rows) {
    row.compared.clear();
    for (const double misfit : {1.0, -2.0, 2.0})
      row.compared.push_back({.computed = 400.0 + misfit, .published = 400.0, .use = Use::chosen_by});
    row.compared.push_back({.computed = 500.0, .published = 400.0, .use = Use::fitted});
    row.root_mean_square = std::sqrt(3.0);
  }
  const auto record = record_of(result);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->misfits, 3);
  EXPECT_NEAR(record->misfit_bound, 2.3534 * std::sqrt(3.0), 1e-3);
  EXPECT_GE(record->calibration.evidence.fit_uncertainty, record->misfit_bound);
}

TEST(CalibrationRecord, WithoutAnyMisfitThatOfTheShippedOneCounts) {
  CalibrationResult result = calibrated();
  for (CalibrationRow& row : result.rows) row.compared.clear();
  const auto record = record_of(result);
  ASSERT_TRUE(record);
  EXPECT_GE(record->calibration.evidence.fit_uncertainty, CalibrationEvidence{}.fit_uncertainty);
}

TEST(CalibrationRecord, KeepsTheCovarianceOfALoadThatWasFitted) {
  const CalibrationRecord record = made_calibration();
  ASSERT_EQ(record.covariance.size(), fitted_keys.size() * fitted_keys.size());
  for (std::size_t i = 0; i < fitted_keys.size(); ++i) {
    EXPECT_GT(record.covariance[i * fitted_keys.size() + i], 0.0) << fitted_keys[i];
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NEAR(record.covariance[i * fitted_keys.size() + j],
                  record.covariance[j * fitted_keys.size() + i], 1e-12);
  }
}

TEST(CalibrationRecord, NoConstantsAreFittedToARunWithAValidityWarning) {
  StudyFile study = study_of(fitted_load);
  study.scene.scene.numerics.inertial_scaling = 1e6;  // matters: run::validity_warnings says so
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    change_case(study, i, [](StudyCase& each) { each.scene.scene.numerics.inertial_scaling = 1e6; });
  const auto record = record_of(run_calibration(study, squared_pressure_options()));
  ASSERT_TRUE(record);
  EXPECT_NE(record->failure.find("validity warning"), std::string::npos) << record->failure;
}

TEST(CalibrationRecord, AFailedCalibrationGivesAReasonAndNoConstants) {
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(0.0);
  const auto record = record_of(run_calibration(study_of(fitted_load), options));
  ASSERT_TRUE(record);
  EXPECT_NE(record->failure.find("no localisation"), std::string::npos) << record->failure;
  EXPECT_TRUE(parse_calibration_record(to_json_text(*record), "calibration.json"));
}

/// A study beside a record in a folder of its own.
class StudyWithRecord : public FolderWithScene {
 protected:
  scene::Expected<StudyFile> study(const std::string& more) {
    return parse_study(critical_kind + "calibration = \"calibration.json\"\n" + more, folder_ / "study.toml");
  }
  void write(const CalibrationRecord& record) {
    std::ofstream(folder_ / "calibration.json") << to_json_text(record);
  }
};

TEST_F(StudyWithRecord, TakesLoadAndConstants) {
  const CalibrationRecord record = made_calibration();
  write(record);
  const auto read = study("");
  ASSERT_TRUE(read) << read.error().message();
  const scene::Scene &ours = read->scene.scene, &theirs = record.calibration.scene;
  EXPECT_EQ(ours.load.peak_time, theirs.load.peak_time);
  EXPECT_EQ(ours.load.width, theirs.load.width);
  EXPECT_EQ(ours.load.steepness, theirs.load.steepness);
  EXPECT_EQ(ours.surface.localisation, theirs.surface.localisation);
  EXPECT_EQ(ours.surface.exchange_time, theirs.surface.exchange_time);
  EXPECT_EQ(ours.charge().kinetics.ignition_temperature, theirs.charge().kinetics.ignition_temperature);
  EXPECT_TRUE(distance_to_record(RecordKind::calibration, ours, read->study.calibration.scene).inside());
}

TEST_F(StudyWithRecord, KeepsALoadThatTheStudyStates) {
  write(made_calibration());
  const auto read =
      study("[set]\nload.peak_time = \"4 ms\"\nload.steepness = 1.5\nload.muzzle_exit = \"11 ms\"\n");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->scene.scene.load.peak_time, 4e-3);
  EXPECT_EQ(read->scene.scene.load.steepness, 1.5);
  EXPECT_TRUE(distance_to_record(RecordKind::calibration, read->scene.scene, read->study.calibration.scene)
                  .other_load_shape);
}

TEST_F(StudyWithRecord, LeavesTheLoadWhereItWasNotFitted) {
  CalibrationRecord record = made_calibration();
  record.load_fitted = false;
  record.covariance.clear();
  write(record);
  const auto read = study("");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->scene.scene.load.peak_time, scene::Scene{}.load.peak_time);
}

TEST_F(StudyWithRecord, RefusesASceneThatStatesOtherConstants) {
  write(made_calibration());
  std::ifstream shipped(studies_folder / "scene_155mm.toml");
  std::string text{std::istreambuf_iterator<char>(shipped), {}};
  text.insert(text.find("[kinetics]\n") + 11, "ignition_temperature = \"470 K\"\n");
  std::ofstream(folder_ / "scene_155mm.toml") << text;
  const auto read = study("");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("kinetics.ignition_temperature"), std::string::npos)
      << read.error().message();
}

TEST_F(StudyWithRecord, RefusesAFitUncertaintyBelowThatOfTheRecord) {
  const CalibrationRecord record = made_calibration();
  write(record);
  const double shown = record.calibration.evidence.fit_uncertainty;
  const auto stated = [](double kelvin) {
    return "fit_uncertainty = { value = \"" + std::to_string(kelvin) + " K\", because = \"for a test\" }\n";
  };
  EXPECT_FALSE(study(stated(0.5 * shown)));
  const auto larger = study(stated(2.0 * shown));
  ASSERT_TRUE(larger) << larger.error().message();
  EXPECT_NEAR(larger->study.fit_uncertainty, 2.0 * shown, 1e-6);
}

TEST_F(StudyWithRecord, RefusesConstantsInSetBesideIt) {
  write(made_calibration());
  const auto read = study("[set]\nfriction.localisation = 900\n");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("friction.localisation"), std::string::npos);
}

TEST_F(StudyWithRecord, RefusesARecordWithoutConstants) {
  CalibrationRecord failed = made_calibration();
  failed.failure = "no exchange time";
  failed.calibration.evidence = {not_a_number, not_a_number, not_a_number, not_a_number};
  failed.ignition_lowest = failed.ignition_highest = not_a_number;
  failed.misfits = 0;
  failed.misfit_bound = not_a_number;
  failed.covariance.clear();
  failed.load_fitted = false;
  failed.selection_root_mean_square = not_a_number;
  failed.stations = {};
  write(failed);
  const auto read = study("");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("no exchange time"), std::string::npos) << read.error().message();
}

}  // namespace
