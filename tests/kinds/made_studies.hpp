// Critical-gap and sensitivity studies of many cases made by hand, with every kind of row in them.
#pragma once

#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "report/report_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::kinds {

/// The shipped 155 mm scene as a study without cases.
inline study::StudyFile bare_study(const study::KindTraits& kind, std::vector<double> gaps) {
  study::StudyFile file;
  file.file = "studies/made.toml";
  file.study.kind = kind;
  file.study.title = "A made study";
  file.study.scene = "scene_155mm.toml";
  file.study.gaps = std::move(gaps);
  const auto scene = scene::caught([&] {
    return scene::read_scene(std::filesystem::path(LAUNCHSAFE_SOURCE_DIR) / "studies" / "scene_155mm.toml");
  });
  EXPECT_TRUE(scene);
  if (scene) file.scene = *scene;
  return file;
}

inline study::Axis axis(const study::StudyFile& file, const std::string& name, const std::string& key,
                        std::vector<double> values) {
  const auto description = scene::caught([&] { return scene::describe_key(file.scene, key, {}); });
  EXPECT_TRUE(description) << key;
  return {name, "vary.0.key", description ? *description : scene::KeyDescription{}, std::move(values)};
}

/// A gap that stays below ignition, or ignites where it is UNSAFE.
inline study::GapRow gap_row(double gap, study::Verdict verdict, double temperature) {
  study::GapRow row;
  row.gap = gap;
  row.maximum = {temperature, 18e-3, "G1"};
  row.early = {350.5, 10e-3, "G1"};
  row.margin = 521.52 - temperature;
  row.uncertainty = 1.2;
  row.judgement = {
      verdict, verdict == study::Verdict::safe ? study::ReasonCode::below_bound : study::ReasonCode::ignites};
  if (verdict == study::Verdict::unsafe)
    row.ignition = study::NamedIgnition{surface::IgnitionCause::trigger, 17.86e-3, "G1", 0.1};
  return row;
}

/// A case whose gaps are judged against the critical gap (m).
inline study::CaseRow row_with(const study::Study& study, double critical) {
  study::CaseRow row;
  row.run = {run::RunStatus::completed, 1000, 500, 2e-3, {}};
  for (const double gap : study.gaps) {
    const bool safe = gap < critical;
    row.gaps.push_back(gap_row(gap, safe ? study::Verdict::safe : study::Verdict::unsafe,
                               safe ? 416.1 + 2.7e5 * gap : 784.5));
    row.gaps.back().heated = 416.1 + 2.7e5 * gap;
  }
  return row;
}

inline study::CaseRow value_row(const study::Study& study, double critical) {
  study::CaseRow row = row_with(study, critical);
  row.critical = {study::CriticalGapKind::value, critical};
  row.causes = {{study::Cause::numerics, 4e-6, 4e-6}};
  row.bounds = study::bounds_of(row.critical, row.causes);
  return row;
}

/// Nothing ignites up to the end of the search, 0.1 cm.
inline study::CaseRow all_safe_row(const study::Study& study) {
  study::CaseRow row = row_with(study, 1.0);
  row.critical = {study::CriticalGapKind::all_safe, 1e-3};
  row.bounds = study::bounds_of(row.critical, {});
  return row;
}

inline study::CaseRow all_ignite_row(const study::Study& study) {
  study::CaseRow row = row_with(study, -1.0);
  row.critical = {study::CriticalGapKind::all_ignite, 0.0};
  row.bounds = study::bounds_of(row.critical, {});
  return row;
}

inline study::CaseRow broken_row(const study::Study& study, const std::string& why) {
  study::CaseRow row;
  row.failure = why;
  row.run.status = run::RunStatus::energy_drift;
  for (const double gap : study.gaps) {
    study::GapRow& each = row.gaps.emplace_back();
    each.gap = gap;
    each.judgement = {study::Verdict::indeterminate, study::ReasonCode::failed};
  }
  return row;
}

using RowMaker = std::function<study::CaseRow(const study::Study&, const std::vector<double>&)>;

/// The full factorial of the study's axes, the last fastest, with the row of each case by a function of
/// its coordinates.
inline kinds::CriticalGapResult swept(study::StudyFile file, const RowMaker& row_of) {
  std::vector<std::vector<double>> places{{}};
  for (const study::Axis& each : file.study.axes) {
    std::vector<std::vector<double>> longer;
    for (const auto& place : places) {
      for (const double value : each.values) {
        longer.push_back(place);
        longer.back().push_back(value);
      }
    }
    places = std::move(longer);
  }
  kinds::CriticalGapResult result;
  for (auto& place : places) {
    study::StudyCase input;
    input.coordinates = place;
    input.label = "case " + std::to_string(file.cases.size() + 1);
    input.scene = file.scene;
    file.cases.add(std::move(input));
    result.rows.push_back(row_of(file.study, place));
  }
  result.study = std::move(file);
  result.timing = {12.5, 3, 0, 2};
  return result;
}

/// Critical gap in closed form: falls with pressure (Pa) and crack radius (m).
inline double closed_form(double pressure, double crack_radius) {
  return 3.95e-4 * std::pow(496e6 / pressure, 2.5) * std::pow(30e-6 / crack_radius, 0.5);
}

/// Pressure x crack radius with values, both bounds, and a failure in the middle.
inline kinds::CriticalGapResult made_sweep(std::vector<double> more = {}, const std::string& more_key = {}) {
  study::StudyFile file = bare_study(kinds::traits_of("critical-gap"), {0, 1e-4, 2e-4, 3.9e-4, 4e-4});
  file.study.axes = {
      axis(file, "peak_pressure", "load.peak", {350e6, 400e6, 450e6, 496e6, 550e6, 600e6}),
      axis(file, "crack_radius", "charge.crack_radius", {10e-6, 20e-6, 30e-6, 50e-6, 100e-6, 200e-6})};
  if (!more.empty()) file.study.axes.push_back(axis(file, more_key, more_key, std::move(more)));
  return swept(std::move(file), [](const study::Study& study, const std::vector<double>& place) {
    const double critical = closed_form(place[0], place[1]);
    if (place[0] == 450e6 && place[1] == 100e-6) return broken_row(study, "energy drift 0.2 at 3 ms");
    if (critical > 1e-3) return all_safe_row(study);
    if (critical < 1.1e-4) return all_ignite_row(study);
    study::CaseRow row = value_row(study, critical);
    if (place[0] == 600e6) row.run.limiters.crack_at_bound = 12;
    return row;
  });
}

// --- sensitivity ---

inline math::Estimate estimate(double value, double half) { return {value, value - half, value + half}; }

/// Three inputs, 20 launches.
inline kinds::SensitivityResult made_sensitivity() {
  study::StudyFile file = bare_study(kinds::traits_of("sensitivity"), {2e-4});
  kinds::settings_of<kinds::SensitivitySettings>(file.study).samples = 20;
  const auto input = [&](const std::string& name, const std::string& key, math::Distribution distribution) {
    return study::Axis{name, "vary.0.key", axis(file, name, key, {}).key, {}, distribution};
  };
  file.study.axes = {
      input("peak_pressure", "load.peak", math::Distribution::uniform(400e6, 600e6)),
      input("charge.crack_radius", "charge.crack_radius", math::Distribution::log_uniform(10e-6, 100e-6)),
      input("flaw_size", "charge.flaw_size", math::Distribution::normal(1e-3, 0.1e-3, 0.5e-3, 1.5e-3))};
  kinds::SensitivityResult result;
  for (std::size_t i = 0; i < 20; ++i) {
    study::StudyCase each;
    each.label = "sample " + std::to_string(i + 1);
    each.coordinates = {400e6 + 10e6 * static_cast<double>(i), 30e-6, 1e-3};
    each.scene = file.scene;
    file.cases.add(std::move(each));
    result.rows.push_back(value_row(file.study, 4e-4 - 1e-6 * static_cast<double>(i)));
  }
  for (const auto which : {kinds::SensitivityOutput::maximum_temperature,
                           kinds::SensitivityOutput::critical_gap, kinds::SensitivityOutput::margin}) {
    kinds::OutputSensitivity output;
    output.output = which;
    const bool is_gap = which == kinds::SensitivityOutput::critical_gap;
    for (std::size_t i = 0; i < result.rows.size(); ++i)
      output.values.push_back(is_gap ? result.rows[i].critical.value : result.rows[i].gaps.front().heated);
    output.mean = is_gap ? 3.9e-4 : 470.0;
    output.deviation = is_gap ? 5e-6 : 12.0;
    output.sobol.inputs = {{estimate(0.6, 0.1), estimate(0.7, 0.1)},
                           {estimate(0.2, 0.1), estimate(0.3, 0.1)},
                           {estimate(0.0, 0.01), estimate(0.02, 0.01)}};
    result.outputs.push_back(std::move(output));
  }
  result.study = std::move(file);
  return result;
}

}  // namespace launchsafe::kinds
