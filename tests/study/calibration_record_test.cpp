#include "launchsafe/study/calibration_record.hpp"

#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/scene/load_shape.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The bottom of a launch whose friction heats with the square of the pressure, in loading as in unloading.
run::MechanicsResult squared_pressure_mechanics(const scene::Scene& scene) {
  run::MechanicsResult result = synthetic_mechanics(scene);
  const scene::PressureHistory pressure(scene.load);
  trace::BottomTrace& trace = result.trace;
  double work = 0.0, before = 0.0;
  for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
    const double p = pressure.at(trace.time[sample]) / scene.load.peak;
    work += std::abs(p * p - before);
    before = p * p;
    trace.bottom_pressure[sample] = trace.mean_bottom_pressure[sample] = 101325.0 + 140e6 * p;
    const std::size_t stations = trace.stations.size();
    for (std::size_t station = 0; station < stations; ++station)
      for (auto& energies : trace.friction) energies[sample * stations + station] = friction_for(60.0) * work;
  }
  return result;
}

StudyOptions squared_pressure_options() {
  StudyOptions options = synthetic_options();
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    return squared_pressure_mechanics(scene);
  };
  return options;
}

const std::string fitted_load =
    "kind = \"calibration\"\ntitle = \"a calibration\"\nscene = \"scene_155mm.toml\"\n"
    "references = \"table8.toml\"\nfast_rise = \"7.0, 15.6 ms\"\nmeshes = \"1.25 mm\"\n";

CalibrationResult calibrated() { return run_calibration(study_of(fitted_load), squared_pressure_options()); }

TEST(CalibrationOfLoad, MeetsTheTimeOfFastRiseAndTheEarlyTemperature) {
  const CalibrationResult result = calibrated();
  ASSERT_TRUE(result.load);
  ASSERT_TRUE(result.load->failure.empty()) << result.load->failure;
  EXPECT_NEAR(result.load->turning.between(), 8.6e-3, 1e-9);  // 15.6 - 7.0 ms
  EXPECT_LE(std::abs(result.load->early_misfit), 1e-3);
  const auto turning = scene::turning_times(result.load->peak_time, result.load->exponent);
  EXPECT_NEAR(turning.fast, result.load->turning.fast, 1e-12);
  ASSERT_TRUE(result.recommendation.row);
  const CalibrationRow& row = result.rows[*result.recommendation.row];
  for (const HoldOut& each : row.hold_outs) {
    if (each.use == Use::calibration && each.temperature) {
      EXPECT_NEAR(each.predicted, 328.5, 2e-3);  // table 8
    }
  }
}

TEST(CalibrationOfLoad, CountsWhatEachRowIsUsedFor) {
  const CalibrationResult result = calibrated();
  const CalibrationRow& row = result.rows.at(*result.recommendation.row);
  std::size_t held_out = 0, selection = 0;
  for (const HoldOut& each : row.hold_outs) {
    if (each.temperature) (each.use == Use::held_out ? held_out : selection) += each.use != Use::calibration;
  }
  EXPECT_EQ(held_out, 3u);              // 442.2, 492.9, 523.3 K
  EXPECT_EQ(selection, 5u);             // at 10 ms: 339.1 to 370.5 K
  EXPECT_EQ(row.selection.size(), 9u);  // and two spreads, two places
}

TEST(CalibrationOfLoad, NeedsAnEarlyTemperatureToFitTo) {
  const auto study = parse_here(
      "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\nfast_rise = \"7.0, 15.6 ms\"\n"
      "reference = [ { gap = \"0 cm\", maximum_temperature = \"416 K\", calibrated = true },"
      "{ gap = \"0.02 cm\", maximum_temperature = \"468 K\", calibrated = true },"
      "{ gap = \"0.04 cm\", ignition_time = \"17 ms\" } ]\n");
  ASSERT_FALSE(study);
  EXPECT_NE(study.error().message().find("early_calibrated"), std::string::npos) << study.error().message();
}

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
  EXPECT_TRUE(distance_to_calibration(read->calibration.scene, record.calibration).inside());
}

TEST(CalibrationRecord, RefusesEveryEditedNumber) {
  const nlohmann::ordered_json whole = nlohmann::ordered_json::parse(to_json_text(made_calibration()));
  for (const auto& [key, value] : whole.items()) {
    nlohmann::ordered_json edited = whole;
    edited[key] = value.is_number() ? nlohmann::ordered_json(value.get<double>() * 1.0001 + 1e-9)
                                    : nlohmann::ordered_json("edited");
    EXPECT_FALSE(parse_calibration_record(edited.dump(), "calibration.json")) << key;
  }
}

TEST(CalibrationRecord, WithoutHeldOutRowsAnyMisfitCounts) {
  CalibrationResult result = calibrated();
  for (CalibrationRow& row : result.rows)
    for (HoldOut& each : row.hold_outs)
      if (each.use == Use::held_out) each.use = Use::selection;
  const auto record = record_of(result);
  ASSERT_TRUE(record);
  EXPECT_GE(fit_uncertainty_of(*record), CalibrationEvidence{}.largest_misfit);
}

TEST(CalibrationRecord, WithoutAnyMisfitThatOfTheShippedOneCounts) {
  CalibrationResult result = calibrated();
  for (CalibrationRow& row : result.rows) row.hold_outs.clear();
  const auto record = record_of(result);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->calibration.evidence.largest_misfit, CalibrationEvidence{}.largest_misfit);
}

TEST(CalibrationRecord, NoConstantsAreFittedToARunWithAValidityWarning) {
  StudyFile study = study_of(fitted_load);
  study.scene.scene.numerics.inertial_scaling = 1e6;  // matters: run::validity_warnings says so
  for (StudyCase& each : study.cases) each.scene.scene.numerics.inertial_scaling = 1e6;
  const auto record = record_of(run_calibration(study, synthetic_options()));
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
class StudyWithRecord : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    std::filesystem::copy(studies_folder / "scene_155mm.toml", folder_ / "scene_155mm.toml",
                          std::filesystem::copy_options::overwrite_existing);
  }
  scene::Expected<StudyFile> study(const std::string& more) {
    return parse_study(critical_kind + "calibration = \"calibration.json\"\n" + more, folder_ / "study.toml");
  }
  void write(const CalibrationRecord& record) {
    std::ofstream(folder_ / "calibration.json") << to_json_text(record);
  }
  std::filesystem::path folder_;
};

TEST_F(StudyWithRecord, TakesLoadAndConstants) {
  const CalibrationRecord record = made_calibration();
  write(record);
  const auto read = study("");
  ASSERT_TRUE(read) << read.error().message();
  const scene::Scene &ours = read->scene.scene, &theirs = record.calibration.scene;
  EXPECT_EQ(ours.load.peak_time, theirs.load.peak_time);
  EXPECT_EQ(ours.load.exponent, theirs.load.exponent);
  EXPECT_EQ(ours.surface.localisation, theirs.surface.localisation);
  EXPECT_EQ(ours.surface.exchange_time, theirs.surface.exchange_time);
  EXPECT_EQ(ours.charge().kinetics.ignition_temperature, theirs.charge().kinetics.ignition_temperature);
  EXPECT_TRUE(distance_to_calibration(ours, read->study.calibration).inside());
}

TEST_F(StudyWithRecord, KeepsALoadThatTheStudyStates) {
  write(made_calibration());
  const auto read = study("[set]\nload.peak_time = \"4 ms\"\nload.exponent = 1.5\n");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->scene.scene.load.peak_time, 4e-3);
  EXPECT_EQ(read->scene.scene.load.exponent, 1.5);
  EXPECT_TRUE(distance_to_calibration(read->scene.scene, read->study.calibration).other_load_shape);
}

TEST_F(StudyWithRecord, LeavesTheLoadWhereItWasNotFitted) {
  CalibrationRecord record = made_calibration();
  record.load_fitted = false;
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

TEST_F(StudyWithRecord, LeavesAShapeThatTheStudyStates) {
  write(made_calibration());
  const auto read = study("[set]\nload.shape = \"bell\"\n");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->scene.scene.load.shape, scene::LoadShape::bell);
  EXPECT_TRUE(distance_to_calibration(read->scene.scene, read->study.calibration).other_load_shape);
}

TEST_F(StudyWithRecord, RefusesAFitUncertaintyBelowThatOfTheRecord) {
  const CalibrationRecord record = made_calibration();
  write(record);
  const double shown = fit_uncertainty_of(record);
  const auto stated = [](double kelvin) {
    return "fit_uncertainty = \"" + std::to_string(kelvin) + " K\"\n";
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

TEST_F(StudyWithRecord, DoesNotHoldForAnotherModel) {
  write(made_calibration());
  const auto read = study("[set]\ninterface.wall.friction = 0.3\n");
  ASSERT_TRUE(read) << read.error().message();
  const auto distance = distance_to_calibration(read->scene.scene, read->study.calibration);
  ASSERT_FALSE(distance.unknown.empty());
  EXPECT_EQ(distance.unknown.front(), "interface.wall.condition");
}

TEST_F(StudyWithRecord, RefusesARecordWithoutConstants) {
  CalibrationRecord failed = made_calibration();
  failed.failure = "no exchange time";
  failed.calibration.evidence = {not_a_number, not_a_number, not_a_number, not_a_number};
  failed.ignition_lowest = failed.ignition_highest = failed.held_out_misfit = not_a_number;
  failed.selection_root_mean_square = not_a_number;
  failed.stations = {};
  write(failed);
  const auto read = study("");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("no exchange time"), std::string::npos) << read.error().message();
}

}  // namespace
