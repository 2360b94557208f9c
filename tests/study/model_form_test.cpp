#include "facts_in_text.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/record_domain.hpp"
#include "study/synthetic_launch.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The default ignites from 0.5, 0.4 and 0.3 mm on. `early` moves towards ignition, `late` away from it,
/// `rough` has no limit of meshes, `cold` no calibration, `bonded` moves nothing.
ModelFormRecord made_record() {
  const auto model = [](const std::string& name, const std::string& not_counted,
                        std::vector<GapOrBound> gaps) {
    return ModelAlternative{name, "the model " + name, not_counted, std::move(gaps)};
  };
  return {study_of(critical_text + synthetic_constants).scene.scene,
          {450e6, 500e6, 550e6},
          {5e-4, 4e-4, 3e-4},
          {model("early", "", {5e-4, 3.5e-4, 1e-4}), model("late", "", {6e-4, 5e-4, 4e-4}),
           model("rough", "no limit of meshes", {1e-4, 1e-4, 1e-4}),
           model("cold", "no calibration", {no_ignition, no_ignition, no_ignition}),
           model("bonded", "", {5e-4, 4e-4, 3e-4})}};
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
  ModelFormRecord record = made_record();
  record.peak_pressures = {400e6, 500e6, 700e6};
  EXPECT_TRUE(std::isfinite(model_form_shift(record, at_pressure(500e6)).gap));
  EXPECT_TRUE(std::isnan(model_form_shift(record, at_pressure(520e6)).gap));
}

TEST(ModelForm, IsNotKnownWhereNoAlternativeCounts) {
  ModelFormRecord record = made_record();
  for (ModelAlternative& each : record.alternatives) each.not_counted = "no limit of meshes";
  EXPECT_TRUE(std::isnan(model_form_shift(record, at_pressure(500e6)).gap));
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

TEST(ModelForm, NamesModelsThatCouldChangeAVerdict) {
  const ModelFormRecord record = made_record();
  const auto around = model_form_shift(record, at_pressure(500e6)).around;
  ASSERT_TRUE(around);
  using Titles = std::vector<std::string>;
  EXPECT_EQ(models_that_differ(record, *around, 4.5e-4, true), (Titles{"the model late", "the model cold"}));
  EXPECT_EQ(models_that_differ(record, *around, 2e-4, false), Titles{"the model rough"});
  EXPECT_EQ(models_that_differ(record, *around, 0.5e-4, false), Titles{});
}

TEST(ModelForm, ReadsBackWhatWasWrittenAndRefusesEdits) {
  const ModelFormRecord record = made_record();
  const std::string text = to_json_text(record);
  const auto read = parse_model_form(text, "model_form.json");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_json_text(*read), text);
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
