// The answer, the pages and the files of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

const AccuracyRow* baseline_of(const AccuracyResult& result) {
  const auto found = std::find_if(result.rows.begin(), result.rows.end(),
                                  [](const AccuracyRow& row) { return row.baseline && row.sound(); });
  return found == result.rows.end() ? nullptr : &*found;
}

std::string label_of(const AccuracyResult& result, const AccuracyRow& row) {
  return result.study.cases[row.index].label;
}

std::string kelvin(double value) { return significant(value, 2) + " K"; }
std::string in_cm(double length, int digits) { return significant(100.0 * length, digits) + " cm"; }

const char* limit_text(bool unjustified) {
  return unjustified ? "that of the finest mesh (no extrapolation is justified)" : "the limit";
}

/// Where no error is known: what the reference meshes share and no setting varies.
std::string unvaried_text(const AccuracyResult& result) {
  const study::AccuracyRecord& record = result.record;
  std::string keys;
  for (const std::string& key : record.unvaried)
    keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", key,
                        scene::format_value(*scene::find_key(scene::scene_keys(), key),
                                            record.settings.front().setting.at(key)));
  return fmt::format(
      "How wrong T max is, is not known: all reference meshes have {}, and no setting tells what the exact "
      "value changes. Run the meshes with the exact value, or add [[settings]] that differ from another "
      "setting in this key alone, at its exact value.",
      keys);
}

/// How wrong the critical gap of the scene as it is may be.
std::string wrongness(const AccuracyResult& result, const AccuracyRow& own) {
  if (!result.record.unvaried.empty()) return unvaried_text(result);
  std::string text = fmt::format(
      "With the setting of the scene, T max is off by at most about {} over the compared gaps; its "
      "distance from {} is {}.",
      kelvin(own.temperature_bound), limit_text(result.any_indeterminate()),
      kelvin(own.largest_temperature_error));
  if (std::isfinite(own.critical_gap_bound)) {
    text += fmt::format(" Its critical gap, {}, is off by at most about {}; {} is {} ({} {}).",
                        in_cm(own.measured.critical.value, 4), in_cm(own.critical_gap_bound, 2),
                        limit_text(!result.reference->critical_gap.limit.justified),
                        in_cm(result.reference->critical_gap.limit.value, 4),
                        own.critical_gap_error > 0 ? "smaller by" : "larger by",
                        in_cm(std::abs(own.critical_gap_error), 2));
  }
  return text;
}

/// "T max at 0.02 cm: order 1.32, limit 470.1 +- 0.4 K on meshes ...".
std::string order_text(const ReferenceValue& value, double scale, const std::string& name,
                       const std::string& unit) {
  const math::Extrapolation& limit = value.limit;
  if (!limit.justified)
    return fmt::format(
        "- {}: no extrapolation is justified ({}); the finest mesh gives {} {}, and the bound is "
        "widened to {} {}.\n",
        name, limit.reason, significant(scale * limit.value, 6), unit,
        significant(scale * limit.uncertainty, 2), unit);
  return fmt::format("- {}: observed order {}, limit {} {}, finest mesh within {} {} of it ({}).\n", name,
                     fixed(limit.order, 2), significant(scale * limit.value, 6), unit,
                     significant(scale * limit.uncertainty, 2), unit, limit.method);
}

/// Which stations converge, and which does T max rest on.
std::string points_text(const AccuracyResult& result) {
  const AccuracyMeasurement& finest = result.rows.front().measured;
  if (finest.points.empty()) return {};
  std::size_t hottest = 0, justified = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < finest.points.size(); ++i) {
    if (finest.points[i].temperature > finest.points[hottest].temperature) hottest = i;
    const math::Extrapolation& limit = result.reference->points[i].limit;
    if (!limit.justified) continue;
    ++justified;
    least = std::min(least, limit.uncertainty);
    most = std::max(most, limit.uncertainty);
  }
  std::string text = fmt::format("- T max is that of {}, the hottest of {} stations. ",
                                 finest.points[hottest].name, finest.points.size());
  if (justified == 0) return text + "None of them converges on these meshes.\n";
  return text + fmt::format("{} of them converge; there the finest mesh is within {} to {} of the limit{}.\n",
                            justified, kelvin(least), kelvin(most),
                            result.reference->points[hottest].limit.justified
                                ? ""
                                : fmt::format(", and {} is not among them", finest.points[hottest].name));
}

std::string belief(const AccuracyResult& result) {
  const study::Study& study = result.study.study;
  const AccuracyReference& reference = *result.reference;
  std::string sizes;
  for (const double size : accuracy_settings(study).reference_cell_sizes)
    sizes += fmt::format("{}{:.6g}", sizes.empty() ? "" : ", ", 1e3 * size);
  std::string text = fmt::format(
      "- The reference is what grids with cells of {} mm tend to, all of which run along the charge.\n",
      sizes);
  for (std::size_t gap = 0; gap < study.gaps.size(); ++gap) {
    text += order_text(
        reference.temperature[gap], 1.0,
        fmt::format("T max at {:.6g} cm{}", 100.0 * study.gaps[gap],
                    reference.inert[gap] ? " (without reaction, as some setting ignites there)" : ""),
        "K");
  }
  if (!reference.critical_gap.values.empty())
    text += order_text(reference.critical_gap, 100.0, "critical gap", "cm");
  text += order_text(reference.peak_pressure, 1e-6, "peak pressure of the charge bottom", "MPa");
  double inexactness = 0;
  for (const ReferenceValue& value : reference.temperature)
    inexactness = std::max(inexactness, value.inexactness);
  if (inexactness > 0)
    text += fmt::format(
        "- The reference meshes share numerics that are not exact; by what settings tell of that, it adds up "
        "to {} to every bound of T max.\n",
        kelvin(inexactness));
  text += points_text(result);
  double drift = 0;
  std::size_t sound = 0;
  for (const AccuracyRow& row : result.rows) {
    if (!row.sound()) continue;
    ++sound;
    drift = std::max(drift, row.measured.energy_drift);
  }
  return text + fmt::format("- {} of {} settings ran soundly; the largest energy drift among them is {} %.\n",
                            sound, result.rows.size(), significant(100.0 * drift, 2));
}

/// Cheapest sound setting whose bound is at most so large.
const AccuracyRow* cheapest(const AccuracyResult& result, double bound) {
  const AccuracyRow* best = nullptr;
  for (const AccuracyRow& row : result.rows) {
    if (!row.sound() || row.other_model || !(row.temperature_bound <= bound)) continue;
    if (best == nullptr || row.measured.processor_time < best->measured.processor_time) best = &row;
  }
  return best;
}

std::string halving(const AccuracyResult& result, const AccuracyRow& own) {
  if (!result.record.unvaried.empty()) return "No error is known that could be halved.";
  const double half = 0.5 * own.temperature_bound;
  if (const AccuracyRow* row = cheapest(result, half)) {
    return fmt::format(
        "The cheapest setting here with half the bound is {}: {} for {} s of processor time a run, {} "
        "times the {} s of the scene's setting.",
        label_of(result, *row), kelvin(row->temperature_bound), significant(row->measured.processor_time, 3),
        significant(row->measured.processor_time / own.measured.processor_time, 2),
        significant(own.measured.processor_time, 3));
  }
  double least = 0;
  for (const ReferenceValue& value : result.reference->temperature)
    least = std::max(least, value.limit.uncertainty + value.inexactness);
  return fmt::format(
      "No setting here halves the bound: {} of it are the uncertainty of the reference itself, which "
      "finer reference meshes would reduce; cells half as large cost 8 times the processor time in a "
      "run of two dimensions.",
      kelvin(least));
}

std::string cheapest_text(const AccuracyResult& result) {
  std::string text;
  const AccuracyRow* last = nullptr;
  for (const double tolerance : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const AccuracyRow* row = cheapest(result, tolerance);
    if (row == nullptr || row == last) continue;
    last = row;
    text += fmt::format("- T max within {:g} K: {} ({}, {} s)\n", tolerance, label_of(result, *row),
                        kelvin(row->temperature_bound), significant(row->measured.processor_time, 3));
  }
  return text;
}

std::string unjudged(const AccuracyResult& result) {
  return result.no_reference.empty() ? "There is no reference: the study was not run as a whole."
                                     : "There is no reference: " + result.no_reference + ".";
}

}  // namespace

std::string answer(const AccuracyResult& result) {
  if (!result.reference) return unjudged(result);
  const AccuracyRow* own = baseline_of(result);
  std::string text = own != nullptr ? wrongness(result, *own) + "\n" + halving(result, *own)
                                    : std::string("The scene's own setting did not run soundly.");
  const std::string settings = cheapest_text(result);
  return text + (settings.empty() ? "" : "\nCheapest settings:\n" + settings);
}

std::string summary(const AccuracyResult& result) {
  std::string text = fmt::format("# How wrong is it? {}\n\n", result.study.study.title);
  text += fmt::format("    {}\n\n", remaking_command(result.study));
  const AccuracyRow* own = result.reference ? baseline_of(result) : nullptr;
  if (own == nullptr) return text + answer(result) + "\n";
  text +=
      "## How wrong is the critical gap?\n\n" + wrongness(result, *own) +
      " This is the error of the computation alone; that of the calibrated constants and of the inputs comes "
      "on top of it in every verdict.\n\n";
  text += "## Why believe that?\n\n" + belief(result) + "\n";
  text += "## What would it cost to halve the error?\n\n" + halving(result, *own) + "\n\n" +
          "Cheapest settings:\n\n" + cheapest_text(result);
  return text;
}

Report report_of(const AccuracyResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.files.push_back({"summary.md", summary(result)});
  if (result.reference) {
    report.files.push_back({"accuracy.json", study::to_json_text(result.record)});
    report.items = {Picture{"error_against_time.svg", error_plot(result), "error against run time"},
                    Picture{"error_against_mesh.svg", mesh_plot(result), "error against cell size"}};
  }
  if (result.reference && !accuracy_settings(result.study.study).times.empty())
    report.items.push_back(
        Picture{"error_over_launch.svg", launch_plot(result), "error against time in the launch"});
  for (ReportTable table : {ReportTable{setting_table(result), "accuracy.csv", "settings"},
                            ReportTable{reference_table(result), "reference.csv", "reference"},
                            ReportTable{time_table(result), "times.csv", "times"},
                            ReportTable{point_table(result), "points.csv", "points"}})
    report.items.push_back(std::move(table));
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  report.items.push_back(Statement{timing_sentence(result.timing)});
  report.json = study_json(result.study, report, {{"timing", timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
