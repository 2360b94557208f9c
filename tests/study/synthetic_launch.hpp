// A launch in closed form in place of the mechanics, so that studies run in milliseconds.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/study/case_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::study {

inline const std::filesystem::path studies_folder = std::filesystem::path(LAUNCHSAFE_SOURCE_DIR) / "studies";

/// A study text as if it stood beside the shipped ones.
inline scene::Expected<StudyFile> parse_here(const std::string& text) {
  return kinds::parse_study(text, studies_folder / "some_study.toml");
}

inline StudyFile study_of(const std::string& text) {
  auto study = parse_here(text);
  EXPECT_TRUE(study) << (study ? "" : study.error().message());
  return study ? *study : StudyFile{};
}

/// Studies of the shipped scene in a folder of their own.
class FolderWithScene : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    std::filesystem::copy(studies_folder / "scene_155mm.toml", folder_ / "scene_155mm.toml",
                          std::filesystem::copy_options::overwrite_existing);
  }
  std::filesystem::path folder_;
};

/// What a study varies, in one line: keys and their values, "400, 496 MPa" or [1.4, 1.5].
inline std::string vary(const std::vector<std::pair<std::string, std::string>>& varied) {
  std::string text;
  for (const auto& [key, values] : varied) {
    const std::string written = values.starts_with('[') ? values : '"' + values + '"';
    text += (text.empty() ? "vary = [" : ", ") + ("{ key = \"" + key + "\", values = " + written + " }");
  }
  return text.empty() ? text : text + "]\n";
}

/// A study that is answered as one of many cases: without histories and confirmations.
inline StudyFile lean_study_of(const std::string& text) {
  StudyFile study = study_of(text);
  study.study.in_detail = false;
  study.confirmations_per_case = 0;
  return study;
}

inline const std::string critical_kind = "kind = \"critical-gap\"\nscene = \"scene_155mm.toml\"\n";
/// A study whose cases take no launch beside their own.
inline const std::string critical_text = critical_kind +
                                         "numerics = { value = \"1 K\", because = \"for a test\" }\n"
                                         "uncertainty.peak_pressure = \"0 %\"\n";

/// The bottom under a smooth load: pressure in proportion to the peak, as a charge bears that slides,
/// friction energy that grows with t^3, highest at the second station in the end.
inline trace::BottomTrace synthetic_trace(double peak, double friction) {
  constexpr int intervals = 240;
  trace::BottomTrace trace;
  trace.stations = {{"S1", 0.678, 0.0625, 1e-4, false},
                    {"S2", 0.678, 0.0575, 1e-4, false},
                    {"S3", 0.678, 0.0025, 1e-4, false},
                    {"G1", 0.6775, 0.0637, 0.0, true}};
  const double shares[4] = {0.95, 1.0, 0.7, 1.02};
  const auto pressure = [peak](double t) {
    return 101325.0 + 140.0 / 496.0 * peak * std::pow(t / 11e-3 * std::exp(1.0 - t / 11e-3), 12.0);
  };
  for (int sample = 0; sample <= intervals; ++sample) {
    const double dt = 18e-3 / intervals, t = dt * sample;
    double mean = 0.0;
    for (int k = 0; k < 16; ++k) mean += pressure(t - dt * (k + 0.5) / 16.0) / 16.0;
    if (sample == 0) mean = pressure(0.0);
    trace.time.push_back(t);
    trace.bottom_pressure.push_back(pressure(t));
    trace.mean_bottom_pressure.push_back(mean);
    trace.chamber_pressure.push_back(496.0 / 140.0 * pressure(t));
    for (const double share : shares) trace.friction.push_back(share * friction * std::pow(t / 18e-3, 3.0));
  }
  return trace;
}

/// Friction energy (J/m3, before localisation) that heats by `kelvin` under the shipped constants.
inline double friction_for(double kelvin) {
  return kelvin * 1717.0 * 1780.0 / scene::shipped_constants().front()->scene.surface.localisation;
}

inline run::MechanicsResult synthetic_mechanics(const scene::Scene& scene, double kelvin = 116.1) {
  run::MechanicsResult result;
  result.end_time = scene::end_time(scene.load);
  result.steps = 1000;
  result.particles = 10;
  result.wall_time = 1.0;
  result.monitor.resize(2);  // a run without a history has a validity warning
  result.monitor.back().time = result.end_time;
  result.monitor.back().energy.internal = result.monitor.back().energy.external = 1.0;
  result.trace = synthetic_trace(scene.load.peak, friction_for(kelvin));
  return result;
}

/// The bottom of a launch whose friction heats with the square of the pressure, in loading as in unloading.
inline run::MechanicsResult squared_pressure_mechanics(const scene::Scene& scene) {
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
      trace.friction[sample * stations + station] = friction_for(60.0) * work;
  }
  return result;
}

/// Runners on the synthetic trace; the one with skin agrees with it.
inline Runners synthetic_runners(double kelvin = 116.1) {
  return {[kelvin](const scene::Scene& scene, const run::RunOptions&) {
            return synthetic_mechanics(scene, kelvin);
          },
          [kelvin](const scene::Scene& scene, double gap, const run::RunOptions&) {
            run::CaseResult result;
            result.mechanics = synthetic_mechanics(scene, kelvin);
            result.gaps.push_back(run::evaluate_gap(scene, result.mechanics.trace, gap));
            return result;
          }};
}

/// Head of the table of what a study sets. The synthetic launch is made for the shipped constants.
inline const std::string synthetic_constants = "[set]\n";
/// With true inertia on a lattice of 2.5 mm whose cells do not grow, so that a study may vary each.
inline const std::string constants_on_even_lattice =
    synthetic_constants +
    "numerics.cell_size = \"2.5 mm\"\nnumerics.growth_x = 1\nnumerics.growth_r = 1\n"
    "numerics.selective_inertia = 1\n";

inline StudyOptions synthetic_options(int jobs = 1) {
  StudyOptions options;
  options.jobs = jobs;
  options.runners = synthetic_runners();
  return options;
}

/// The rows of all cases of a study.
inline std::vector<CaseRow> rows_of(const StudyFile& study,
                                    const StudyOptions& options = synthetic_options()) {
  Timing timing;
  ProgressTracker tracker({});
  return draw_rows(study, options, timing, tracker);
}

}  // namespace launchsafe::study
