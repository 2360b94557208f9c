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
  ASSERT_EQ(result.rows.size(), 1u);
  const CalibrationRow& total = result.rows[0];
  ASSERT_TRUE(total.failure.empty()) << total.failure;
  EXPECT_NEAR(total.calibrated.constants.localisation, truth.localisation, 1e-5);
  EXPECT_NEAR(total.calibrated.constants.exchange_time, truth.exchange_time, 1e-11);
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

TEST(Calibration, ATraceWithoutFrictionRecommendsNothing) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options();
  options.runners = synthetic_runners(0.0);
  const CalibrationResult result = run_calibration(
      study_of(calibration_text + published({951.0, 4.2e-4, 0}, trace) + synthetic_constants), options);
  EXPECT_FALSE(result.rows[0].failure.empty());
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
  EXPECT_FALSE(result.rows[0].failure.empty());
  EXPECT_FALSE(result.recommended_row.has_value());
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
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_TRUE(result.rows[0].failure.empty());
  EXPECT_FALSE(result.rows[1].failure.empty());
  EXPECT_FALSE(result.recommended_row.has_value());
}

TEST(Calibration, RecommendsTheRowOfTheScenesMesh) {
  const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  StudyOptions options = synthetic_options(2);
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    return synthetic_mechanics(scene, scene.numerics.cell_size < 1e-3 ? 145.125 : 116.1);
  };
  const CalibrationResult result =
      run_calibration(study_of(calibration_text + "meshes = \"1.25, 0.625 mm\"\n" +
                               published({951.0, 4.2e-4, 0}, trace) + synthetic_constants),
                      options);
  ASSERT_TRUE(result.recommended_row.has_value());
  EXPECT_EQ(result.rows[*result.recommended_row].cell_size, 1.25e-3);  // the scene's mesh
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

/// Mechanics that no load moves leaves the load undetermined.
TEST(CalibrationOfLoad, ASingularFitRecommendsNothing) {
  const CalibrationResult result =
      run_calibration(study_of(load_text + published_rows(synthetic_truth())), synthetic_options());
  ASSERT_TRUE(result.load);
  EXPECT_FALSE(result.load->failure.empty());
  EXPECT_FALSE(result.recommended());
}

TEST(CalibrationOfLoad, NeedsABellAndAsManyNumbersAsUnknowns) {
  const auto key_at_fault = [](const std::string& text) {
    const auto study = parse_here(text);
    return study ? std::string() : study.error().key;
  };
  EXPECT_EQ(key_at_fault(
                load_text +
                "reference = [ { gap = \"0 cm\", maximum_temperature = \"416 K\", calibrated = true },"
                "{ gap = \"0.02 cm\", maximum_temperature = \"468 K\", rise_ends = \"15 ms\", calibrated = "
                "true }, { gap = \"0.04 cm\", ignition_time = \"17 ms\" } ]\n"),
            "load_fitted");
  EXPECT_EQ(
      key_at_fault(load_text + "references = \"table8.toml\"\n[set]\nload.shape = \"power-exponential\"\n"),
      "load_fitted");
}

}  // namespace
