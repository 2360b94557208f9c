#include "launchsafe/kinds/calibration.hpp"

#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

double maximum_at(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

const std::string own_launch = "scene = \"scene_155mm.toml\"";

/// Rows as a shell with the given constants would have published them.
std::string published(const SurfaceConstants& truth, const trace::BottomTrace& trace) {
  surface::SkinModel model = surface::skin_model(study_of(critical_text + synthetic_constants).scene.scene);
  model.surface.friction = scene::FrictionClosure::total_strain_rate;
  model.surface.localisation = truth.localisation;
  model.surface.exchange_time = truth.exchange_time;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  std::string rows;
  for (const double gap : {0.0, 1e-4, 2e-4, 3e-4, 4e-4}) {
    const auto history = surface::integrate_skin(model, trace, gap);
    rows += fmt::format(
        "{{ gap = \"{} m\", maximum_temperature = \"{} K\", early_temperature = \"{} K\"{}{}, {} }},", gap,
        maximum_at(model, trace, gap), surface::maximum_at_time(history, trace, 10e-3).temperature,
        gap == 0.0 || gap == 2e-4 ? ", calibrated = true" : "",
        gap == 4e-4 ? ", ignition_time = \"17.7 ms\"" : "", own_launch);
  }
  return "reference = [" + rows + "]\n";
}

const std::string calibration_text = "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n";

TEST(Calibration, RecoversTheConstantsOfASyntheticTruth) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  const SurfaceConstants truth{951.0, 4.2e-4, not_a_number};
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
  ASSERT_TRUE(result.recommended_row.has_value()) << result.reason;
  EXPECT_EQ(result.rows[*result.recommended_row].closure, scene::FrictionClosure::total_strain_rate);
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
  const SurfaceConstants a = constants(rows), b = constants(changed);
  EXPECT_EQ(a.localisation, b.localisation);
  EXPECT_EQ(a.exchange_time, b.exchange_time);
  EXPECT_EQ(a.ignition_temperature, b.ignition_temperature);
}

TEST(Calibration, WithoutFrictionNothingIsCalibrated) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + published({951.0, 4.2e-4, 0}, trace) + synthetic_constants),
                      synthetic_options());
  const CalibrationRow& none = result.rows[2];
  EXPECT_FALSE(none.calibratable);
  EXPECT_TRUE(std::isnan(none.calibrated.constants.localisation));
  ASSERT_FALSE(none.compared.empty());
  EXPECT_NEAR(none.compared[0].computed, 300.0, 1e-3);
  EXPECT_EQ(none.compared[0].quantity, "T max");
}

TEST(Calibration, ATraceWithoutFrictionSaysSoAndRecommendsNothing) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(0.0);
  const CalibrationResult result = run_calibration(
      study_of(calibration_text + published({951.0, 4.2e-4, 0}, trace) + synthetic_constants), options);
  EXPECT_NE(result.rows[0].failure.find("no localisation"), std::string::npos) << result.rows[0].failure;
  EXPECT_FALSE(result.recommended_row.has_value());
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
  EXPECT_FALSE(result.recommended_row.has_value());
}

TEST(Calibration, EveryClosureHasARow) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + published({951.0, 4.2e-4, 0}, trace) + synthetic_constants),
                      synthetic_options());
  std::vector<scene::FrictionClosure> closures;
  for (const CalibrationRow& row : result.rows) closures.push_back(row.closure);
  const auto& all = materials::all_closures;
  EXPECT_EQ(closures, std::vector<scene::FrictionClosure>(all.begin(), all.end()));
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
  EXPECT_FALSE(result.recommended_row.has_value());
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
  ASSERT_TRUE(result.recommended_row.has_value());
  EXPECT_EQ(result.rows[*result.recommended_row].cell_size, 1.25e-3);  // the scene's mesh
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
  ASSERT_TRUE(result.recommended_row.has_value()) << result.reason;
  EXPECT_EQ(result.rows[*result.recommended_row].closure, scene::FrictionClosure::total_strain_rate);
  EXPECT_NE(result.reason.find("does not separate them"), std::string::npos) << result.reason;
}

// --- the load ---

/// When the highest temperature rises at more than 15 % of its largest rate over half a millisecond: first
/// and last instant, found by stepping.
std::pair<double, double> steep_rise(const surface::SkinHistory& history, const trace::BottomTrace& trace) {
  constexpr double half = 0.25e-3, step = 1e-6;
  const auto rate = [&](double time) {
    return surface::maximum_at_time(history, trace, time + half).temperature -
           surface::maximum_at_time(history, trace, time - half).temperature;
  };
  double largest = 0.0, first = 0.0, last = 0.0;
  for (double time = half; time < 17.74e-3; time += 75e-6) largest = std::max(largest, rate(time));
  for (double time = half; time < 17.74e-3; time += step) {
    if (rate(time) <= 0.15 * largest) continue;
    if (first == 0.0) first = time;
    last = time;
  }
  return {first, last};
}

struct Truth {
  scene::Scene scene;
  double localisation, exchange_time;
};

Truth synthetic_truth() {
  Truth truth{study_of(critical_text).scene.scene, 1500.0, 3.3e-4};
  truth.scene.load.peak_time = 10.8e-3;
  truth.scene.load.width = 2.7e-3;
  truth.scene.load.steepness = 1.55;
  return truth;
}

/// Rows as a launch under a bell with these constants would have published them.
std::string published_rows(const Truth& truth) {
  const trace::BottomTrace trace = squared_pressure_mechanics(truth.scene).trace;
  surface::SkinModel model = surface::skin_model(truth.scene);
  model.surface.localisation = truth.localisation;
  model.surface.exchange_time = truth.exchange_time;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  std::string rows;
  for (const double gap : {0.0, 1e-4, 2e-4}) {
    const auto history = surface::integrate_skin(model, trace, gap);
    const auto [begins, ends] = steep_rise(history, trace);
    rows += fmt::format(
        "{{ gap = \"{} m\", maximum_temperature = \"{} K\", early_temperature = \"{} K\", rise_begins = \"{} "
        "s\", "
        "rise_ends = \"{} s\", calibrated = {}, {} }},",
        gap, maximum_at(model, trace, gap), surface::maximum_at_time(history, trace, 10e-3).temperature,
        begins, ends, gap != 1e-4, own_launch);
  }
  return "reference = [" + rows + "{ gap = \"0.3 mm\", ignition_time = \"17.7 ms\", " + own_launch + " }]\n";
}

const std::string load_text = calibration_text + "load_fitted = true\n";

TEST(CalibrationOfLoad, RecoversLoadAndConstantsOfASyntheticTruth) {
  const Truth truth = synthetic_truth();
  const CalibrationResult result =
      run_calibration(study_of(load_text + published_rows(truth)), squared_pressure_options());
  ASSERT_TRUE(result.load);
  ASSERT_TRUE(result.load->failure.empty()) << result.load->failure;
  EXPECT_EQ(result.load->numbers, 8u);
  EXPECT_LT(result.load->sum_of_squares, 1e-4);  // instants were found in steps of a microsecond
  EXPECT_NEAR(result.load->bell->peak_time, truth.scene.load.peak_time, 1e-3 * truth.scene.load.peak_time);
  EXPECT_NEAR(result.load->bell->width, truth.scene.load.width, 3e-3 * truth.scene.load.width);
  EXPECT_NEAR(result.load->bell->steepness, truth.scene.load.steepness, 3e-3 * truth.scene.load.steepness);
  ASSERT_TRUE(result.recommended()) << result.reason;
  const SurfaceConstants& constants = result.recommended()->calibrated.constants;
  EXPECT_NEAR(constants.localisation, truth.localisation, 1e-3 * truth.localisation);
  EXPECT_NEAR(constants.exchange_time, truth.exchange_time, 3e-3 * truth.exchange_time);
}

TEST(CalibrationOfLoad, SaysWhatEachPublishedNumberIsUsedFor) {
  const CalibrationResult result =
      run_calibration(study_of(load_text + "references = \"table8.toml\"\n"), squared_pressure_options());
  ASSERT_TRUE(result.recommended()) << result.reason;
  const CalibrationRow& row = *result.recommended();
  std::map<Use, std::size_t> uses;
  for (const ComparedNumber& each : row.compared) {
    ++uses[each.use];
    EXPECT_EQ(each.use == Use::fitted,
              each.quantity.find("spread") == std::string::npos && (each.gap == 0.0 || each.gap == 2e-4))
        << each.quantity << " at " << each.gap;
  }
  EXPECT_EQ(uses[Use::fitted], 8u);     // two temperatures and two instants at 0 and at 0.02 cm
  EXPECT_EQ(uses[Use::held_out], 0u);   // all rows were in view when the forms of the model were picked
  EXPECT_EQ(row.selection.size(), 9u);  // five temperatures, two spreads, two places
}

// Between 416.1 K without a gap and 467.7 K at 0.02 cm: 441.9 at 0.01 cm, 516.72 at 0.039 cm.
TEST(CalibrationOfLoad, PutsAStraightLineBesideTheModel) {
  const CalibrationResult result =
      run_calibration(study_of(load_text + "references = \"table8.toml\"\n"), squared_pressure_options());
  ASSERT_TRUE(result.recommended()) << result.reason;
  int compared = 0;
  for (const ComparedNumber& each : result.recommended()->compared) {
    if (each.quantity != "T max" || each.use == Use::fitted) continue;
    if (each.gap == 1e-4) compared += std::abs(each.line - 441.9) < 1e-9;
    if (each.gap == 3.9e-4) compared += std::abs(each.line - 516.72) < 1e-9;
  }
  EXPECT_EQ(compared, 2);
}

/// Mechanics that no load moves leaves the load undetermined.
TEST(CalibrationOfLoad, ASingularFitRecommendsNothing) {
  const CalibrationResult result =
      run_calibration(study_of(load_text + published_rows(synthetic_truth())), synthetic_options());
  ASSERT_TRUE(result.load);
  EXPECT_NE(result.load->failure.find("do not determine"), std::string::npos) << result.load->failure;
  EXPECT_FALSE(result.recommended());
  EXPECT_NE(result.reason.find("no load is recommended"), std::string::npos);
}

TEST(CalibrationOfLoad, NeedsABellAndAsManyNumbersAsUnknowns) {
  const auto message_of = [](const std::string& text) {
    const auto study = parse_here(text);
    EXPECT_FALSE(study);
    return study ? std::string{} : study.error().message();
  };
  const std::string few = message_of(
      load_text +
      "reference = [ { gap = \"0 cm\", maximum_temperature = \"416 K\", calibrated = true },"
      "{ gap = \"0.02 cm\", maximum_temperature = \"468 K\", rise_ends = \"15 ms\", calibrated = true },"
      "{ gap = \"0.04 cm\", ignition_time = \"17 ms\" } ]\n");
  EXPECT_NE(few.find("load_fitted"), std::string::npos) << few;
  EXPECT_NE(few.find("3 numbers in the calibrated rows for 5 unknowns"), std::string::npos) << few;
  const std::string rows = load_text + "references = \"table8.toml\"\n[set]\n";
  const std::string shape = message_of(rows + "load.shape = \"power-exponential\"\n");
  EXPECT_NE(shape.find("load.shape = \"bell\""), std::string::npos) << shape;
  const std::string curve =
      message_of(rows + "load.curve_time = \"0, 9, 18 ms\"\nload.curve_pressure = \"0, 496, 9 MPa\"\n");
  EXPECT_NE(curve.find("measured curve"), std::string::npos) << curve;
}

}  // namespace
