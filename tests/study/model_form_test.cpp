#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/record_domain.hpp"
#include "study/synthetic_launch.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <list>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// Calibrations and sweeps of some models of the synthetic launch, the default first.
struct MadeModels {
  std::list<CalibrationRecord> calibrations;
  std::vector<ModelFormEntry> entries;
  std::vector<double> pressures{450e6, 500e6, 550e6};

  auto form() const { return make_model_form(entries, pressures); }
  void add(const std::string& name, std::vector<GapOrBound> gaps, double change,
           const std::string& failure = {}) {
    scene::Scene scene = study_of(critical_text + synthetic_constants).scene.scene;
    // Models of one launch, each another: one of each kind that a record must have.
    if (entries.size() == 1) scene.surface.station_width = 11e-3;
    if (entries.size() == 2) scene.surface.friction = scene::FrictionClosure::inelastic;
    if (entries.size() == 3) scene.surface.air_pressure = scene::AirPressure::chamber;
    if (entries.size() == 4) scene.charge().strength.face_friction = 0.0;
    if (entries.size() == 5) scene.interfaces.clear();
    CalibrationRecord calibration;
    calibration.title = name;
    calibration.failure = failure;
    calibration.calibration.scene = scene;
    calibration.stations = {change, change};
    calibrations.push_back(calibration);
    entries.push_back({name, "the model " + name, &calibrations.back(), scene, std::move(gaps)});
  }
};

/// The default ignites from 0.5, 0.4 and 0.3 mm on. `early` moves towards ignition, `late` away from it,
/// `rough` has no limit of meshes, `cold` no calibration, `bonded` moves nothing.
MadeModels made_models() {
  MadeModels made;
  made.add("own", {5e-4, 4e-4, 3e-4}, 0.5);
  made.add("early", {5e-4, 3.5e-4, 1e-4}, 0.5);
  made.add("late", {6e-4, 5e-4, 4e-4}, 0.5);
  made.add("rough", {1e-4, 1e-4, 1e-4}, 9.0);
  made.add("cold", {no_ignition, no_ignition, no_ignition}, 0.5, "no exchange time gives 467.7 K");
  made.add("bonded", {5e-4, 4e-4, 3e-4}, 0.5);
  return made;
}

ModelFormRecord made_record() {
  const MadeModels made = made_models();
  auto form = made.form();
  EXPECT_TRUE(form) << form.error();
  return form ? *form : ModelFormRecord{};
}

scene::Scene at_pressure(double peak) {
  scene::Scene scene = made_record().scene;
  scene.load.peak = peak;
  return scene;
}

TEST(ModelForm, ShiftIsTheLargestTowardsIgnitionOfModelsThatCount) {
  const ModelFormRecord record = made_record();
  EXPECT_DOUBLE_EQ(model_form_shift(record, at_pressure(450e6)).gap, 0.0);
  EXPECT_NEAR(model_form_shift(record, at_pressure(500e6)).gap, 0.5e-4, 1e-12);  // 4e-4 - 3.5e-4 m
  EXPECT_NEAR(model_form_shift(record, at_pressure(550e6)).gap, 2e-4, 1e-12);    // 3e-4 - 1e-4 m
  EXPECT_NEAR(model_form_shift(record, at_pressure(525e6)).gap, 2e-4, 1e-12);    // the larger one around it
}

TEST(ModelForm, IsNotKnownFarFromEveryRecordedPressure) {
  MadeModels made = made_models();
  made.pressures = {400e6, 500e6, 700e6};
  const auto form = made.form();
  ASSERT_TRUE(form) << form.error();
  EXPECT_TRUE(std::isfinite(model_form_shift(*form, at_pressure(500e6)).gap));
  EXPECT_TRUE(std::isnan(model_form_shift(*form, at_pressure(520e6)).gap));
}

TEST(ModelForm, IsNotKnownBesideAPressureAtWhichTheDefaultIgnitesWithoutAGap) {
  MadeModels made = made_models();
  for (ModelFormEntry& each : made.entries) each.critical_gap[2] = 0.0;
  const auto form = made.form();
  ASSERT_TRUE(form) << form.error();
  EXPECT_TRUE(std::isnan(model_form_shift(*form, at_pressure(525e6)).gap));
  EXPECT_TRUE(std::isnan(model_form_shift(*form, at_pressure(550e6)).gap));
}

TEST(ModelForm, IsNotKnownWhereNoAlternativeCounts) {
  MadeModels made = made_models();
  for (CalibrationRecord& each : made.calibrations)
    if (each.title != "own") each.stations.finer = 9.0;
  const auto form = made.form();
  ASSERT_TRUE(form) << form.error();
  EXPECT_TRUE(std::isnan(model_form_shift(*form, at_pressure(500e6)).gap));
}

// Any of the shipped models may be the one that ignites earliest of another shell.
TEST(ModelForm, RefusesAComparisonThatLeavesOutAKindOfModel) {
  for (const auto& [left_out, table] :
       {std::pair("early", "station"), {"late", "friction"}, {"cold", "charge"}, {"bonded", "interface"}}) {
    MadeModels made = made_models();
    std::erase_if(made.entries, [&](const ModelFormEntry& each) { return each.name == left_out; });
    const auto form = made.form();
    ASSERT_FALSE(form) << left_out;
    EXPECT_EQ(form.error(), fmt::format("no alternative is another model in [{}] alone", table));
  }
  MadeModels all_in_one = made_models();
  all_in_one.entries[1].scene.surface.friction = scene::FrictionClosure::inelastic;
  all_in_one.calibrations.front().calibration.scene = all_in_one.entries[0].scene;
  std::next(all_in_one.calibrations.begin())->calibration.scene = all_in_one.entries[1].scene;
  std::erase_if(all_in_one.entries, [](const ModelFormEntry& each) { return each.name == "late"; });
  const auto form = all_in_one.form();
  ASSERT_FALSE(form);
  EXPECT_EQ(form.error(), "no alternative is another model in [friction] alone, nor in [station] alone");
}

TEST(ModelForm, RefusesACopyOfTheDefault) {
  MadeModels made = made_models();
  made.entries.back().scene = made.entries.front().scene;
  made.calibrations.back() = made.calibrations.front();
  const auto form = made.form();
  EXPECT_FALSE(form);
  EXPECT_NE(form.error().find("same model"), std::string::npos) << form.error();
}

TEST(ModelForm, RefusesAModelOfAnotherLaunch) {
  MadeModels made = made_models();
  made.entries.back().scene.initial_temperature -= 20.0;
  made.calibrations.back().calibration.scene.initial_temperature -= 20.0;
  const auto form = made.form();
  EXPECT_FALSE(form);
  EXPECT_NE(form.error().find("initial_temperature"), std::string::npos) << form.error();
}

TEST(ModelForm, RefusesAModelCalibratedOnOtherRows) {
  MadeModels made = made_models();
  made.calibrations.back().references_digest = "other";
  const auto form = made.form();
  EXPECT_FALSE(form);
  EXPECT_NE(form.error().find("published rows"), std::string::npos) << form.error();
}

TEST(ModelForm, RefusesAModelWhoseStationsWereComparedWithNoFinerMesh) {
  MadeModels made = made_models();
  made.calibrations.front().stations = {0.5, 0.5};
  std::next(made.calibrations.begin())->stations = {not_a_number, 0.5};
  const auto form = made.form();
  EXPECT_FALSE(form);
  EXPECT_NE(form.error().find("finer mesh"), std::string::npos) << form.error();
}

TEST(ModelForm, SaysNothingOfAnotherLaunchOrPressure) {
  const ModelFormRecord record = made_record();
  EXPECT_TRUE(std::isnan(model_form_shift(record, at_pressure(449e6)).gap));
  EXPECT_TRUE(std::isnan(model_form_shift(record, at_pressure(551e6)).gap));
  scene::Scene cracked = at_pressure(500e6);
  cracked.charge().strength.initial_crack_radius *= 2.0;
  EXPECT_NE(model_form_shift(record, cracked).reason.find("crack radius"), std::string::npos);
  scene::Scene hotter = at_pressure(500e6);
  hotter.surface.localisation *= 1.5;
  EXPECT_TRUE(std::isnan(model_form_shift(record, hotter).gap));
  scene::Scene longer = at_pressure(500e6);
  longer.load.steepness = 1.2;
  EXPECT_TRUE(std::isnan(model_form_shift(record, longer).gap));
}

// Pressures in other units than pascal come with a round-off, on either side of those recorded.
TEST(ModelForm, KnowsItsOwnPressuresButForTheirRoundOff) {
  const ModelFormRecord record = made_record();
  for (const double pressure : record.peak_pressures)
    for (const double factor : {1.0 - 0.99e-9, 1.0 - 1e-15, 1.0 + 1e-15, 1.0 + 0.99e-9})
      EXPECT_NEAR(model_form_shift(record, at_pressure(factor * pressure)).gap,
                  model_form_shift(record, at_pressure(pressure)).gap, 1e-9)
          << pressure << " * " << factor;
  // At the very edge: this read before the first pressure once.
  const double edge = record.peak_pressures.front() * (1.0 - 1e-9);
  EXPECT_EQ(model_form_shift(record, at_pressure(edge)).gap,
            model_form_shift(record, at_pressure(record.peak_pressures.front())).gap);
}

TEST(ModelForm, IsNotKnownWhereTheDefaultHasABoundAlone) {
  MadeModels made = made_models();
  made.entries.front().critical_gap[1] = no_ignition;
  const auto form = made.form();
  ASSERT_TRUE(form) << form.error();
  EXPECT_TRUE(std::isnan(model_form_shift(*form, at_pressure(500e6)).gap));
}

TEST(ModelForm, NamesModelsThatCouldChangeAVerdict) {
  const ModelFormRecord record = made_record();
  const auto around = model_form_shift(record, at_pressure(500e6)).around;
  ASSERT_TRUE(around);
  using Titles = std::vector<std::string>;
  EXPECT_EQ(models_that_differ(record, *around, 4.5e-4, true), (Titles{"the model late", "the model cold"}));
  EXPECT_EQ(models_that_differ(record, *around, 2e-4, false), Titles{"the model rough"});
  EXPECT_EQ(models_that_differ(record, *around, 0.5e-4, false), Titles{});
}

TEST(ModelForm, RefusesADefaultThatHasNoLimitOfMeshes) {
  MadeModels made = made_models();
  made.calibrations.front().stations = {9.0, 9.0};
  EXPECT_FALSE(made.form());
}

TEST(ModelForm, RefusesASweepOfAnotherLaunchThanTheCalibration) {
  MadeModels made = made_models();
  made.entries.back().scene = made.entries.front().scene;
  auto second = std::next(made.entries.begin());
  second->scene.interfaces.clear();
  const auto form = made.form();
  EXPECT_FALSE(form);
  EXPECT_NE(form.error().find("early"), std::string::npos) << form.error();
}

TEST(ModelForm, ReadsBackWhatWasWrittenAndRefusesEdits) {
  const ModelFormRecord record = made_record();
  const std::string text = to_json_text(record);
  const auto read = parse_model_form(text, "model_form.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_json_text(*read), text);
  auto edited = nlohmann::ordered_json::parse(text);
  edited["alternatives"][0]["not_counted"] = "it is not liked";
  EXPECT_FALSE(parse_model_form(edited.dump(), "model_form.json"));
  edited = nlohmann::ordered_json::parse(text);
  edited["alternatives"].erase(0);
  EXPECT_FALSE(parse_model_form(edited.dump(), "model_form.json"));
  edited = nlohmann::ordered_json::parse(text);
  edited["critical_gap_m"][0] = 4e-4;
  EXPECT_FALSE(parse_model_form(edited.dump(), "model_form.json"));
}

/// The only verdict of a study on a gap (cm) with a model-form statement or record.
GapVerdict verdict_with(const std::string& gap, const std::string& statement, const ModelFormRecord* record) {
  StudyFile study =
      study_of(critical_kind +
               "fit_uncertainty = { value = \"1 K\", because = \"for a test\" }\ninput_uncertainty = { value "
               "= \"1 K\", because = \"for a test\" }\n" +
               "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\nconfirm = false\n" +
               statement + "gaps = \"" + gap + " cm\"\n" + synthetic_constants);
  if (record != nullptr) study.study.model_form = *record;
  return run_critical_gap(study, synthetic_options()).details.at(0).verdicts.at(0);
}

// Of the record that ships.
TEST(ModelForm, WithoutARecordThePressuresOfTheShippedOneCount) {
  std::ifstream file(LAUNCHSAFE_SOURCE_DIR "/studies/models/model_form.json");
  const auto pressures = nlohmann::json::parse(file).at("peak_pressures_Pa").get<std::vector<double>>();
  EXPECT_EQ(compared_pressures({}).lowest, pressures.front());
  EXPECT_EQ(compared_pressures({}).highest, pressures.back());
  EXPECT_EQ(compared_pressures(made_record()).lowest, 450e6);
}

TEST(ModelForm, IsAssumedWhereNothingIsSaid) {
  EXPECT_DOUBLE_EQ(verdict_with("0.01", "", nullptr).uncertainty.model_form, assumed_model_form);
  EXPECT_DOUBLE_EQ(
      verdict_with("0.01", "model_form_uncertainty = { value = \"7 K\", because = \"for a test\" }\n",
                   nullptr)
          .uncertainty.model_form,
      7.0);
}

TEST(ModelForm, AModelThatIgnitesEarlierTakesItsShiftFromTheMargin) {
  ModelFormRecord record = made_record();
  const GapVerdict calm = verdict_with("0.01", "", &record);
  EXPECT_EQ(calm.judgement.verdict, Verdict::safe) << reason_text(calm);
  // At 496 MPa, between 450 and 500 MPa: 0.05 mm, the larger shift of both, in kelvin of that much more air.
  const GapVerdict thicker = verdict_with("0.015", "", &record);
  EXPECT_NEAR(calm.uncertainty.model_form, thicker.maximum.temperature - calm.maximum.temperature, 0.05);
  for (ModelAlternative& each : record.alternatives)
    if (each.name == "early") each.critical_gap = {0.0, 0.0, 0.0};
  const GapVerdict worried = verdict_with("0.01", "", &record);
  EXPECT_EQ(worried.judgement.verdict, Verdict::indeterminate) << reason_text(worried);
}

TEST(ModelForm, AnUnsafeNamesTheModelsWithoutIgnition) {
  ModelFormRecord record = made_record();
  std::erase_if(record.alternatives, [](const auto& each) { return each.name == "early"; });
  const GapVerdict row = verdict_with("0.045", "", &record);
  ASSERT_EQ(row.judgement.verdict, Verdict::unsafe) << reason_text(row);
  EXPECT_NE(reason_text(row).find(R"(under "the model late", "the model cold")"), std::string::npos)
      << reason_text(row);
}

}  // namespace
