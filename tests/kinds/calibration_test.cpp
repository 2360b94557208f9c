#include "launchsafe/kinds/calibration.hpp"

#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

double maximum_at(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

/// Rows as a shell with the given constants would have published them.
std::string published(const Constants& truth, const trace::BottomTrace& trace) {
  surface::SkinModel model = surface::skin_model(study_of(critical_text + synthetic_constants).scene.scene);
  model.surface.friction = scene::FrictionClosure::total_strain_rate;
  model.surface.localisation = truth.localisation;
  model.surface.exchange_time = truth.exchange_time;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  std::string rows;
  for (const double gap : {0.0, 1e-4, 2e-4, 3e-4, 4e-4}) {
    const auto history = surface::integrate_skin(model, trace, gap);
    rows += fmt::format(
        "{{ gap = \"{} m\", maximum_temperature = \"{} K\", early_temperature = \"{} K\"{}{} }},", gap,
        maximum_at(model, trace, gap), surface::maximum_at_time(history, trace, 10e-3).temperature,
        gap == 0.0 || gap == 2e-4 ? ", calibrated = true" : "",
        gap == 4e-4 ? ", ignition_time = \"17.7 ms\"" : "");
  }
  return "reference = [" + rows + "]\n";
}

const std::string calibration_text = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";

TEST(Calibration, RecoversTheConstantsOfASyntheticTruth) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  const Constants truth{951.0, 4.2e-4, not_a_number};
  const CalibrationResult result = run_calibration(
      study_of(calibration_text + published(truth, trace) + synthetic_constants), synthetic_options());
  ASSERT_EQ(result.rows.size(), 3u);  // total strain rate, inelastic, none
  const CalibrationRow& total = result.rows[0];
  ASSERT_TRUE(total.failure.empty()) << total.failure;
  EXPECT_NEAR(total.calibrated.constants.localisation, truth.localisation, 1e-5);
  EXPECT_NEAR(total.calibrated.constants.exchange_time, truth.exchange_time, 1e-11);
  EXPECT_LT(std::abs(total.calibrated.zero_gap_misfit), 1e-6);
  EXPECT_LT(std::abs(total.calibrated.wide_gap_misfit), 1e-6);
  EXPECT_GT(total.calibrated.constants.ignition_temperature, total.calibrated.ignition_lowest);
  EXPECT_LT(total.calibrated.constants.ignition_temperature, total.calibrated.ignition_highest);
  EXPECT_LT(total.root_mean_square, 1e-5);
  ASSERT_TRUE(result.recommendation.row.has_value()) << result.recommendation.reason;
  EXPECT_EQ(result.rows[*result.recommendation.row].closure, scene::FrictionClosure::total_strain_rate);
}

TEST(Calibration, FitsNothingButItsThreeRows) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  const std::string rows = published({951.0, 4.2e-4, not_a_number}, trace);
  std::string changed = rows;
  const std::string key = "{ gap = \"0.0001 m\", maximum_temperature = \"";
  changed.replace(changed.find(key) + key.size(), 1, "9");
  ASSERT_NE(rows, changed);
  const auto constants = [](const std::string& text) {
    return run_calibration(study_of(calibration_text + text + synthetic_constants), synthetic_options())
        .rows[0]
        .calibrated.constants;
  };
  const Constants a = constants(rows), b = constants(changed);
  EXPECT_EQ(a.localisation, b.localisation);
  EXPECT_EQ(a.exchange_time, b.exchange_time);
  EXPECT_EQ(a.ignition_temperature, b.ignition_temperature);
}

TEST(Calibration, WithoutFrictionThereIsOnlyAPrediction) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + published({951.0, 4.2e-4, 0}, trace) + synthetic_constants),
                      synthetic_options());
  const CalibrationRow& none = result.rows[2];
  EXPECT_FALSE(none.calibratable);
  EXPECT_TRUE(std::isnan(none.calibrated.constants.localisation));
  ASSERT_FALSE(none.hold_outs.empty());
  EXPECT_NEAR(none.hold_outs[0].predicted, 300.0, 1e-3);
  EXPECT_EQ(none.hold_outs[0].quantity, "T max");
}

TEST(Calibration, ATraceWithoutFrictionSaysSoAndRecommendsNothing) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(0.0);
  const CalibrationResult result = run_calibration(
      study_of(calibration_text + published({951.0, 4.2e-4, 0}, trace) + synthetic_constants), options);
  EXPECT_NE(result.rows[0].failure.find("no localisation"), std::string::npos) << result.rows[0].failure;
  EXPECT_FALSE(result.recommendation.row.has_value());
}

/// Where the reaction runs away by itself, the middle of a safe and a burning temperature is none to ignite
/// at.
TEST(Calibration, ARunawayGivesNoIgnitionTemperature) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  std::string rows = published({951.0, 4.2e-4, 0}, trace);
  const std::string igniting = "{ gap = \"0.0004 m\"";
  rows.replace(rows.find(igniting), igniting.size(), "{ gap = \"0.002 m\"");
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + rows + synthetic_constants), synthetic_options());
  EXPECT_NE(result.rows[0].failure.find("runs away by itself"), std::string::npos) << result.rows[0].failure;
  EXPECT_FALSE(result.recommendation.row.has_value());
}

TEST(Calibration, AFailedMeshIsItsOwnFailure) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options(2);
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = synthetic_mechanics(scene);
    if (scene.numerics.cell_size < 2e-3) result.status = run::RunStatus::non_finite;
    return result;
  };
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + "meshes = \"2.5, 1.25 mm\"\n" +
                               published({951.0, 4.2e-4, 0}, trace) + synthetic_constants),
                      options);
  EXPECT_FALSE(result.runs[1].failure.empty());
  ASSERT_EQ(result.rows.size(), 6u);
  EXPECT_TRUE(result.rows[0].failure.empty());
  EXPECT_NE(result.rows[3].failure.find("non-finite"), std::string::npos);
  EXPECT_FALSE(result.recommendation.row.has_value());
}

TEST(Calibration, MeasuresTheChangeBetweenMeshes) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options(2);
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    return synthetic_mechanics(scene, scene.numerics.cell_size < 1e-3 ? 145.125 : 116.1);
  };
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + "meshes = \"1.25, 0.625 mm\"\n" +
                               published({951.0, 4.2e-4, 0}, trace) + synthetic_constants),
                      options);
  ASSERT_EQ(result.convergence.size(), 2u);
  EXPECT_NEAR(result.convergence[0].localisation_change, -0.25, 1e-6);
  ASSERT_TRUE(result.recommendation.row.has_value());
  EXPECT_EQ(result.rows[*result.recommendation.row].cell_size, 1.25e-3);  // the scene's mesh
}

TEST(Calibration, SaysWhenTheEvidenceDoesNotTellTheClosuresApart) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options();
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = synthetic_mechanics(scene, 150.0);
    // The same shape with a different factor: calibration takes the factor out again.
    for (double& energy : result.trace.friction[0]) energy *= 0.9;
    result.trace.friction[1] = result.trace.friction[0];
    for (double& energy : result.trace.friction[1]) energy *= 0.5;
    return result;
  };
  std::string rows = published({951.0, 4.2e-4, 0}, trace);
  const std::string key = "{ gap = \"0.0001 m\", maximum_temperature = \"";
  ASSERT_NE(rows.find(key), std::string::npos);
  rows.replace(rows.find(key) + key.size(), 1, "9");  // a misfit that both share
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + rows + synthetic_constants), options);
  ASSERT_TRUE(result.recommendation.row.has_value()) << result.recommendation.reason;
  EXPECT_EQ(result.rows[*result.recommendation.row].closure, scene::FrictionClosure::total_strain_rate);
  EXPECT_NE(result.recommendation.reason.find("does not separate them"), std::string::npos)
      << result.recommendation.reason;
}

}  // namespace
