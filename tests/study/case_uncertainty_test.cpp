// The shares of a verdict's uncertainty, and the validity warnings of a calibration outside its domain, on a
// launch in closed form.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/record_domain.hpp"
#include "launchsafe/study/verdict.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The friction energy that heats by `kelvin` with the calibrated localisation.
double calibrated_friction(double kelvin) {
  return kelvin * 1717.0 * 1780.0 / shipped_calibration().scene.surface.localisation;
}

/// A launch that heats by friction in proportion to the square of its peak, 116.1 K at 496 MPa; the air of a
/// gap comes on top.
run::MechanicsResult quadratic_launch(const scene::Scene& scene) {
  const double ratio = scene::PressureHistory(scene.load).stated_peak() / 496e6;
  run::MechanicsResult result = synthetic_mechanics(scene);
  result.trace = synthetic_trace(scene.load.peak, calibrated_friction(116.1 * ratio * ratio));
  // The corner is no hotter than the points here: ignition off the points has a test of its own.
  for (auto& friction : result.trace.friction) {
    for (std::size_t i = 3; i < friction.size(); i += 4) friction[i] = friction[i - 2];
  }
  return result;
}

StudyOptions quadratic_options() {
  StudyOptions options = synthetic_options();
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    return quadratic_launch(scene);
  };
  options.runners.with_skin = [](const scene::Scene& scene, double gap, const run::RunOptions&) {
    run::CaseResult result;
    result.mechanics = quadratic_launch(scene);
    result.gaps.push_back(run::evaluate_gap(scene, result.mechanics.trace, gap));
    return result;
  };
  return options;
}

/// Accepts what the first case has to have accepted.
void accept_all(StudyFile& study) {
  change_case(study, 0, [&](StudyCase& input) {
    for (const auto& each : statements_of(study.study, input).to_be_accepted())
      input.scene.scene.accepted.push_back({each.key, each.value, "our own trials agree"});
  });
}

const std::string no_confirmation = "confirm = false\ngaps = \"0, 0.02 cm\"\n";
const std::string stated =
    "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\nfit_uncertainty = { value = \"2 "
    "K\", because = \"for a test\" }\ninput_uncertainty = { value = \"3 K\", because = \"for a test\" }\n";

GapVerdict first_row(const std::string& text) {
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_kind + no_confirmation + text), quadratic_options());
  return result.details.at(0).verdicts.at(0);
}

TEST(CaseUncertainty, StatedSharesAreTakenOnTheRowsOfTheCalibration) {
  const GapVerdict row = first_row(stated);
  EXPECT_NEAR(row.uncertainty.numerical, 1.0, 1e-9);
  EXPECT_NEAR(row.uncertainty.fit, 2.0, 2e-3);
  EXPECT_EQ(row.uncertainty.input, 3.0);
  EXPECT_EQ(row.judgement.verdict, Verdict::safe) << reason_text(row);
  EXPECT_EQ(reason_text(row).find("extrapolated"), std::string::npos) << reason_text(row);
}

GapVerdict row_with(const std::vector<run::InterfaceResult>& interfaces, std::size_t row = 0) {
  StudyOptions options = quadratic_options();
  options.runners.mechanics = [&](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = quadratic_launch(scene);
    result.interfaces = interfaces;
    return result;
  };
  return run_critical_gap(study_of(critical_kind + no_confirmation + stated), options)
      .details.at(0)
      .verdicts.at(row);
}

run::InterfaceResult face_at(double place, bool along_x, std::vector<double> heat, double opening = 0.0) {
  run::InterfaceResult faces;
  faces.face = place;
  faces.along_x = along_x;
  faces.friction_heat = std::move(heat);
  faces.largest_gap = {opening};
  return faces;
}

/// A constant flux heats the surface of a half space by 2 q sqrt(t/(pi k rho c)): 0.3 kJ/m2 in 18 ms by 2.9
/// K. The heat at wall and nose is none of the bottom's.
TEST(CaseUncertainty, HeatOfFrictionOnTheBottomCountsWhole) {
  const Uncertainty shares = row_with({face_at(0.678, false, {100.0, 300.0}), face_at(0.065, true, {5000.0}),
                                       face_at(0.118, false, {4000.0})})
                                 .uncertainty;
  const materials::Charge& charge = shipped_calibration().scene.charge();
  const double flux = 300.0 / 18e-3;
  EXPECT_NEAR(
      shares.sliding,
      2.0 * flux *
          std::sqrt(18e-3 / (std::numbers::pi * charge.conductivity * charge.density * charge.specific_heat)),
      1e-9);
  EXPECT_GT(shares.sliding, 2.0);
  EXPECT_EQ(first_row(stated).uncertainty.sliding, 0.0);
  EXPECT_NEAR(shares.computed() - first_row(stated).uncertainty.computed(), shares.sliding, 1e-9);
}

/// A base that parts by 0.02 cm makes of no gap one of 0.02 cm; parted by 0.03 cm beside 0.02 cm, the gap
/// ignites.
TEST(CaseUncertainty, ABaseThatOpensThickensTheGap) {
  const auto opens = [](double opening) { return std::vector{face_at(0.678, false, {0.0}, opening)}; };
  const GapVerdict closed = row_with({}), open = row_with(opens(2e-4));
  EXPECT_NEAR(open.uncertainty.sliding, row_with({}, 1).maximum.temperature - closed.maximum.temperature,
              1e-6);
  EXPECT_GT(open.uncertainty.sliding, 40.0);
  const GapVerdict ignites = row_with(opens(3e-4), 1);
  EXPECT_GE(ignites.uncertainty.sliding, ignites.margin);
  EXPECT_NE(ignites.judgement.verdict, Verdict::safe);
}

TEST(CaseUncertainty, SilenceAboutTheFitCostsTheBoundOfTheMisfits) {
  const GapVerdict row = first_row(
      "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\ninput_uncertainty = { value = "
      "\"3 K\", because = \"for a test\" }\n");
  EXPECT_NEAR(row.uncertainty.fit, shipped_calibration().evidence.fit_uncertainty, 0.01);
}

/// 4 % of pressure are 8.16 % of the friction heat of 116.1 K; 12 K of initial temperature are 12 K; without
/// a gap a longer pulse heats no more. They are independent.
TEST(CaseUncertainty, SilenceAboutTheInputsPropagatesAnAssumedSpread) {
  std::vector<double> peaks;
  StudyOptions options = quadratic_options();
  options.runners.mechanics = [&peaks](const scene::Scene& scene, const run::RunOptions&) {
    peaks.push_back(scene.load.peak);
    return quadratic_launch(scene);
  };
  const CriticalGapResult result =
      run_critical_gap(study_of(critical_kind + no_confirmation +
                                "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" "
                                "}\nfit_uncertainty = { value = \"2 K\", because = \"for a test\" }\n"),
                       options);
  std::ranges::sort(peaks);  // the launch, and raised
  EXPECT_EQ(peaks, (std::vector<double>{496e6, 1.04 * 496e6}));
  EXPECT_EQ(result.timing.runs, 2u);
  const GapVerdict& row = result.details.at(0).verdicts.at(0);
  EXPECT_NEAR(row.uncertainty.input, std::hypot(0.0816 * 116.1, 12.0), 1e-2);
  EXPECT_GT(result.details[0].verdicts[1].uncertainty.input, row.uncertainty.input);  // hotter air too
}

TEST(CaseUncertainty, ARaisedLoadThatCannotBeComputedLeavesNothingSafe) {
  StudyOptions options = quadratic_options();
  options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = quadratic_launch(scene);
    if (scene.load.peak > 500e6) result.status = run::RunStatus::energy_drift;
    return result;
  };
  const CriticalGapResult result = run_critical_gap(study_of(critical_kind + no_confirmation), options);
  for (const GapVerdict& row : result.details.at(0).verdicts) {
    EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate);
    EXPECT_NE(reason_text(row).find("energy drift"), std::string::npos) << reason_text(row);
  }
}

/// Twice the heating has twice the error: the relative errors of the constants are carried to the case.
TEST(CaseUncertainty, TheErrorOfTheConstantsGrowsWithTheHeat) {
  const double pressure = 496.0 * std::sqrt(1.5);
  const GapVerdict row = first_row(stated + vary({{"peak_pressure", fmt::format("{} MPa", pressure)}}));
  EXPECT_NEAR(row.uncertainty.fit, 1.5 * 2.0, 5e-3);
  EXPECT_NEAR(row.uncertainty.input, 1.5 * 1.5 * 3.0, 1e-6);  // the fourth power of the pressure
  EXPECT_NE(reason_text(row).find("extrapolated: peak pressure"), std::string::npos) << reason_text(row);
  // and never falls below what was stated
  EXPECT_EQ(first_row(stated + vary({{"peak_pressure", "250 MPa"}})).uncertainty.fit, 2.0);
}

TEST(CaseUncertainty, OtherNumericsBringTheMeshErrorOfTheCalibration) {
  const GapVerdict row = first_row(stated + "[set]\nnumerics.inertial_scaling = 16\n");
  EXPECT_NEAR(row.uncertainty.fit, std::hypot(2.0, assumed_numerical_uncertainty), 1e-2);
  EXPECT_NE(reason_text(row).find("extrapolated: numerics"), std::string::npos) << reason_text(row);
}

TEST(CaseUncertainty, AnotherLoadShapeCountsWhatAnotherFamilyOfLoadsMissed) {
  const GapVerdict row = first_row(stated + "[set]\nload.steepness = 1.4\n");
  EXPECT_NEAR(row.uncertainty.fit, assumed_other_load_shape, 0.1);
  EXPECT_NE(reason_text(row).find("load shape"), std::string::npos) << reason_text(row);
}

/// What smoothing takes from the peak counts as the square of it in heat, and the window is named.
TEST(CaseUncertainty, WhatSmoothingTakesFromThePeakCounts) {
  StudyFile study = study_of(critical_kind + no_confirmation + stated);
  scene::Load load = study.cases[0].scene.scene.load;
  const scene::PressureHistory analytic(load);
  for (int i = 0; i <= 1000; ++i) {  // until the load is over
    load.curve_time.push_back(20e-3 * i / 1000.0);
    load.curve_pressure.push_back(analytic.at(load.curve_time.back()));
  }
  const auto under_load = [&] {
    change_case(study, 0, [&](StudyCase& input) {
      input.scene.scene.load = load;
      input.scene.scene.numerics.selective_inertia = 1.0;  // as every measured curve has
    });
    return run_critical_gap(study, quadratic_options()).details.at(0).verdicts.at(0);
  };
  EXPECT_LT(under_load().uncertainty.load_curve, 0.5);
  const double between_points = load_curve_share(load);
  load.smoothing = 0.5e-3;
  const double kept = scene::PressureHistory(load).peak() / std::ranges::max(load.curve_pressure);
  EXPECT_NEAR(load_curve_share(load), (1.0 + between_points) * std::pow(kept, -heat_exponent) - 1.0, 1e-3);
  EXPECT_GT(under_load().uncertainty.load_curve, 2.0);
}

/// The constants of the 155 mm shell say nothing of another one, however small its own errors are.
TEST(CaseUncertainty, AnotherShellIsIndeterminateUnlessItsSceneSaysWhyNot) {
  for (const std::string change :
       {"body.charge.x = \"12 to 67.8 cm\"\nbody.wall.x = \"12 to 67.8 cm\"\nbody.nose.x = \"0 to 12 cm\"\n",
        "charge.density = \"1.65 g/cm3\"\n", "friction.localisation = 1200\n"}) {
    for (const bool accepted : {false, true}) {
      StudyFile study = study_of(critical_kind + no_confirmation + stated + "[set]\n" + change);
      ASSERT_EQ(study.cases.size(), 1u);
      if (accepted) {
        accept_all(study);
      }
      const CriticalGapResult result = run_critical_gap(study, quadratic_options());
      const GapVerdict& row = result.details.at(0).verdicts.at(0);
      EXPECT_NE(reason_text(row).find("extrapolated"), std::string::npos) << reason_text(row);
      EXPECT_EQ(row.judgement.verdict, accepted ? Verdict::safe : Verdict::indeterminate)
          << change << reason_text(row);
      EXPECT_EQ(reason_text(row).find("our own trials agree") != std::string::npos, accepted);
    }
  }
}

/// Issue 31, point 9: accepted or not.
TEST(CaseUncertainty, WhatOnlyAveragesOrRemovesHeatIsNeverSafe) {
  for (const std::string change : {"station.depth = \"11 mm\"\n", "station.width = \"25 mm\"\n",
                                   "gap.skin_thickness = \"0.31 mm\"\n", "friction.closure = \"none\"\n",
                                   "friction.localisation = 600\n", "gap.exchange_time = \"0.6 ms\"\n"}) {
    StudyFile study = study_of(critical_kind + no_confirmation + stated + "[set]\n" + change);
    accept_all(study);
    const CriticalGapResult result = run_critical_gap(study, quadratic_options());
    const GapVerdict& row = result.details.at(0).verdicts.at(0);
    EXPECT_EQ(row.judgement.verdict, Verdict::indeterminate) << change << reason_text(row);
    EXPECT_EQ(row.judgement.code, ReasonCode::optimistic) << change << reason_text(row);
  }
}

/// The constants that are calibrated decide too where colder ones are accepted, and their T max is told.
TEST(CaseUncertainty, ColderConstantsOfTheSurfaceMakeNothingSafeThatTheCalibratedOnesDoNot) {
  const auto rows_with = [](const std::string& change) {
    StudyFile study = study_of(critical_kind + no_confirmation + stated + "[set]\n" + change);
    accept_all(study);
    return run_critical_gap(study, quadratic_options()).details.at(0).verdicts;
  };
  const std::vector<GapVerdict> own = rows_with("");
  for (const std::string change : {"friction.localisation = 700", "charge.specific_heat = \"4000 J/(kg K)\"",
                                   // Two constants of materials are accepted as one property.
                                   "charge.specific_heat = \"2000 J/(kg K)\"\nsteel.density = \"8 g/cm3\""}) {
    const std::vector<GapVerdict> colder = rows_with(change + "\n");
    ASSERT_EQ(own.size(), colder.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_TRUE(own[i].as_calibrated.empty());
      ASSERT_GE(colder[i].as_calibrated.size(), 2u) << change;
      EXPECT_TRUE(change.starts_with(colder[i].as_calibrated[1].key)) << change;
      EXPECT_EQ(colder[i].as_calibrated[0].ignites, own[i].ignition.has_value()) << change;
      EXPECT_NEAR(colder[i].as_calibrated[0].temperature, own[i].maximum.temperature, 1e-9) << change;
      if (own[i].margin < colder[i].uncertainty.total()) {
        EXPECT_NE(colder[i].judgement.verdict, Verdict::safe) << reason_text(colder[i]);
      }
    }
  }
}

/// The trace holds the heat of half the sliding friction.
TEST(CaseUncertainty, TheLocalisationMakesUpForTheSlidingFrictionOfATrace) {
  const scene::Scene calibrated = shipped_calibration().scene;
  scene::Scene own = calibrated;
  own.charge().sliding_friction *= 0.5;
  const scene::Scene changed = with_calibrated(own, calibrated, {"charge.sliding_friction"});
  EXPECT_EQ(changed.charge().sliding_friction, calibrated.charge().sliding_friction);
  EXPECT_DOUBLE_EQ(changed.surface.localisation, 2.0 * calibrated.surface.localisation);
}

/// Issue 31, point 10.
TEST(CaseUncertainty, AGapThatIgnitesIsUnsafeWhateverNobodyAccepts) {
  const StudyFile study = study_of(critical_kind + "confirm = false\ngaps = \"0, 0.1 cm\"\n" + stated +
                                   "[set]\nstation.width = \"7 mm\"\n");
  const CaseOutcome outcome = run_critical_gap(study, quadratic_options()).details.at(0);
  ASSERT_TRUE(outcome.verdicts.at(1).ignition);
  EXPECT_EQ(outcome.verdicts[0].judgement.verdict, Verdict::indeterminate);
  EXPECT_EQ(outcome.verdicts[1].judgement.verdict, Verdict::unsafe);
  EXPECT_NE(reason_text(outcome.verdicts[1]).find("station.width = 0.7 cm"), std::string::npos);
  EXPECT_EQ(outcome.critical.kind, CriticalGapKind::indeterminate);
  EXPECT_GT(outcome.critical.indicative, 0.0);
  EXPECT_LT(outcome.critical.indicative, 1e-3);
}

}  // namespace
