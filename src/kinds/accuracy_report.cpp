// The answer, the picture, the page and the files of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

std::string kelvins(double value) { return in_words(value, keys::significant(2, kelvin)); }
std::string in_cm(double length, int digits) {
  return in_words(length, keys::significant(digits, centimetre));
}
std::string seconds(double time, int digits = 3) { return in_words(time, keys::significant(digits, second)); }

const char* limit_text(bool unjustified) {
  return unjustified ? "that of the finest mesh (no extrapolation is justified)" : "the limit";
}

/// Where no error is known: what the reference meshes share and no setting varies.
std::string unvaried_text(const VariantAccuracy& variant) {
  const study::AccuracyRecord& record = variant.record;
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
std::string wrongness(const VariantAccuracy& variant, const AccuracyRow& own) {
  if (!variant.record.unvaried.empty()) return unvaried_text(variant);
  std::string text = fmt::format(
      "With the setting of the scene, T max is off by at most about {} over the compared gaps; its "
      "distance from {} is {}.",
      kelvins(own.setting.temperature_bound), limit_text(variant.any_indeterminate()),
      kelvins(own.largest_temperature_error));
  if (std::isfinite(own.setting.critical_gap_bound)) {
    text += fmt::format(" Its critical gap, {}, is off by at most about {}; {} is {} ({} {}).",
                        in_cm(own.setting.critical_gap, 4), in_cm(own.setting.critical_gap_bound, 2),
                        limit_text(!variant.reference->critical_gap.limit.justified),
                        in_cm(variant.reference->critical_gap.limit.value, 4),
                        own.critical_gap_error > 0 ? "smaller by" : "larger by",
                        in_cm(std::abs(own.critical_gap_error), 2));
  }
  return text;
}

std::string belief(const VariantAccuracy& variant) {
  double inexactness = 0, drift = 0;
  std::size_t justified = 0, sound = 0;
  const std::vector<ReferenceValue>& limits = variant.reference->temperature;
  for (const ReferenceValue& value : limits) {
    justified += value.limit.justified ? 1 : 0;
    inexactness = std::max(inexactness, value.inexactness);
  }
  for (const AccuracyRow& row : variant.rows) {
    if (!row.sound()) continue;
    ++sound;
    drift = std::max(drift, row.answer.run.energy_drift);
  }
  std::string text = fmt::format(
      "The reference is what {} grids tend to, all of which run along the charge. For T max that limit is "
      "justified at {} of {} gaps; elsewhere the finest grid stands for it, with a wider uncertainty "
      "(`reference.csv`). An uncertainty is a grid convergence index: of made series it holds the limit of "
      "smooth ones always, of those with 2 % noise in their errors in nine of ten or more. {} of {} settings "
      "ran soundly, with an energy drift of at most {}.",
      accuracy_settings(variant.study.study).reference_cell_sizes.size(), justified, limits.size(), sound,
      variant.rows.size(), in_words(drift, keys::significant(2, percent)));
  if (inexactness > 0)
    text += fmt::format(
        " The grids share numerics that are not exact; by what settings tell of that, it adds up to {} to "
        "every bound of T max.",
        kelvins(inexactness));
  return text + "\n";
}

std::string halving(const VariantAccuracy& variant, const AccuracyRow& own) {
  if (!variant.record.unvaried.empty()) return "No error is known that could be halved.";
  const double half = 0.5 * own.setting.temperature_bound;
  if (const RecordedSetting* setting = cheapest_within(variant.record, half)) {
    return fmt::format(
        "The cheapest setting here with half the bound is {}: {} for {} of processor time a run, {} "
        "times the {} of the scene's setting.",
        setting->label, kelvins(setting->temperature_bound), seconds(setting->processor_time),
        significant(setting->processor_time / own.setting.processor_time, 2),
        seconds(own.setting.processor_time));
  }
  return fmt::format(
      "No setting here halves the bound: {} of it are the uncertainty of the reference itself, which "
      "finer reference meshes would reduce; cells half as large cost 8 times the processor time in a "
      "run of two dimensions.",
      kelvins(variant.reference_uncertainty()));
}

std::string cheapest_text(const VariantAccuracy& variant) {
  std::string text;
  const RecordedSetting* last = nullptr;
  for (const double tolerance : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const RecordedSetting* setting = cheapest_within(variant.record, tolerance);
    if (setting == nullptr || setting == last) continue;
    last = setting;
    text += fmt::format("- T max within {:g} K: {} ({}, {})\n", tolerance, setting->label,
                        kelvins(setting->temperature_bound), seconds(setting->processor_time));
  }
  return text;
}

constexpr int grey = 7;

/// Marks at the bounds, with bars down to the distances.
Series bars(std::string label, int colour, Mark mark, const std::vector<const AccuracyRow*>& rows) {
  Series series{std::move(label), {}, {}, Style::vertical_bars};
  series.colour = colour;
  series.mark = mark;
  for (const AccuracyRow* row : rows) {
    series.x.push_back(row->setting.processor_time);
    series.y.push_back(row->error_to_go_by());
    series.lower.push_back(row->largest_temperature_error);
  }
  series.upper = series.y;
  return series;
}

/// The best error for every cost, from cheap to costly.
Series front_of(std::vector<const AccuracyRow*> rows) {
  std::ranges::sort(rows, {}, [](const AccuracyRow* row) {
    return std::pair(row->setting.processor_time, row->error_to_go_by());
  });
  const Series marks = bars({}, grey, {}, rows);
  Series front{"Pareto front", marks.x, marks.y, Style::steps};
  front.colour = grey;
  return front;
}

/// A panel for every variant.
Plot picture_of(const std::vector<const VariantAccuracy*>& variants) {
  if (variants.size() == 1) return error_plot(*variants.front());
  Plot plot;
  plot.title = "Error of T max against processor time";
  for (const VariantAccuracy* each : variants) plot.panels.push_back(error_plot(*each));
  return plot;
}

}  // namespace

Plot error_plot(const VariantAccuracy& variant) {
  const bool bounded = variant.record.unvaried.empty();
  Plot plot;
  plot.title = variant.name.empty() ? "Error of T max against processor time" : variant.name;
  plot.x = {headed("processor time of a run", quantity::processor_time()).label(), Scale::logarithmic};
  plot.y = {
      headed(bounded ? "error of T max" : "distance of T max from the reference", quantity::temperature_max())
          .label(),
      Scale::logarithmic};
  plot.width = 1100;
  plot.height = 640;
  plot.subtitle = bounded ? "marks: bound of the error; bars: down to the distance from the reference"
                          : "no bound of the error is known: the reference itself may be off";
  std::vector<const AccuracyRow*> front, meshes, settings;
  std::vector<Series> best;
  for (const AccuracyRow& row : variant.rows) {
    if (!row.computed() || row.other_model) continue;
    if (row.on_front) front.push_back(&row);
    if (row.on_front || row.baseline) {
      // A name of its own in the legend, where no label covers others. None of the first 56 looks like
      // another one.
      const int n = static_cast<int>(best.size());
      const auto mark = static_cast<Mark>((n % grey + n / grey) % 8);
      best.push_back(bars(row.baseline ? "as in the scene" : row.setting.label, n % grey, mark, {&row}));
    } else if (!row.setting.reference) {
      settings.push_back(&row);
    }
    if (row.setting.reference) meshes.push_back(&row);
  }
  plot.series = {front_of(front), bars("other settings", grey, Mark::circle, settings),
                 bars("reference meshes", grey, Mark::open_square, meshes)};
  plot.series.insert(plot.series.end(), best.begin(), best.end());
  std::erase_if(plot.series, [](const Series& each) { return each.x.empty(); });
  const double uncertainty = variant.reference_uncertainty();
  if (std::isfinite(uncertainty) && uncertainty > 0)
    plot.horizontal_lines = {{uncertainty, "reference uncertain by " + kelvins(uncertainty)}};
  return plot;
}

std::string answer(const AccuracyResult& result) {
  const VariantAccuracy& first = result.variants.front();
  const std::string of = first.name.empty() ? "" : fmt::format("Variant {}: ", first.name);
  if (!first.reference) return of + "There is no reference: " + first.no_reference + ".";
  const AccuracyRow* own = first.baseline();
  const std::string text = own != nullptr ? wrongness(first, *own) + "\n" + halving(first, *own)
                                          : "The scene's own setting did not run soundly.";
  const std::string settings = cheapest_text(first);
  return of + text + (settings.empty() ? "" : "\nCheapest settings:\n" + settings);
}

Report report_of(const AccuracyResult& result) {
  const VariantAccuracy& first = result.variants.front();
  const bool several = result.variants.size() > 1;
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  std::vector<const VariantAccuracy*> drawn;
  for (const VariantAccuracy& each : result.variants) {
    if (!each.reference) continue;
    drawn.push_back(&each);
    const std::string name = each.name.empty() ? "accuracy.json" : "accuracy_" + each.name + ".json";
    report.files.push_back({name, study::to_json_text(each.record)});
  }
  if (!drawn.empty())
    report.items.push_back(Picture{"error_against_time.svg", picture_of(drawn), "error against run time"});
  if (several) report.items.push_back(ReportTable{variant_table(result), "variants.csv", "variants"});
  const Shown settings = several ? Shown::file : Shown::page_and_terminal;
  report.items.push_back(ReportTable{setting_table(result), "accuracy.csv", "settings", settings});
  report.items.push_back(ReportTable{reference_table(result), "reference.csv", "reference", Shown::file});
  report.items.push_back(ReportTable{point_table(result), "points.csv", "points", Shown::file});
  report.items.push_back(Statement{
      "In files: cost and errors of every setting, over the launch too (`accuracy.csv`), what the grids "
      "tend to (`reference.csv`), and T max of the stations (`points.csv`).\n"});
  if (first.baseline() != nullptr)
    report.items.push_back(Statement{"## Why believe that?\n\n" + belief(first)});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(first.study)});
  report.items.push_back(Statement{timing_sentence(result.timing)});
  report.json = study_json(result.study, report, {{"timing", timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
