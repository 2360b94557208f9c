// The picture of an accuracy study: bounds of the error of T max against cost.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::kinds {

using namespace report;
namespace {

constexpr int grey = 7;

/// A mark at the bound, and a bar down to the distance.
void add_row(const AccuracyRow& row, Series& series) {
  series.x.push_back(row.measured.processor_time);
  series.y.push_back(row.error_to_go_by());
  series.lower.push_back(row.largest_temperature_error);
  series.upper.push_back(row.error_to_go_by());
}

Series bars(std::string label, int colour, Mark mark) {
  Series series{std::move(label), {}, {}, Style::vertical_bars};
  series.colour = colour;
  series.mark = mark;
  return series;
}

/// The row under a name of its own, so that the legend names it and no label covers others. None of the first
/// 56 looks like another one.
Series named(const std::string& label, const AccuracyRow& row, std::size_t number) {
  const int n = static_cast<int>(number);
  Series series = bars(label, n % grey, static_cast<Mark>((n % grey + n / grey) % 8));
  add_row(row, series);
  return series;
}

/// The best error for every cost, from cheap to costly.
Series front_of(const std::vector<AccuracyRow>& rows) {
  std::vector<std::pair<double, double>> best;
  for (const AccuracyRow& row : rows)
    if (row.on_front) best.emplace_back(row.measured.processor_time, row.error_to_go_by());
  std::sort(best.begin(), best.end());
  Series front{"Pareto front", {}, {}, Style::steps};
  front.colour = grey;
  for (const auto& [time, error] : best) {
    front.x.push_back(time);
    front.y.push_back(error);
  }
  return front;
}

}  // namespace

Plot error_plot(const VariantAccuracy& variant) {
  const bool bounded = variant.record.unvaried.empty();
  Plot plot;
  plot.title = variant.name.empty() ? "Error of T max against processor time" : variant.name;
  plot.x = {"processor time of a run [s]", Scale::logarithmic};
  plot.y = {bounded ? "error of T max [K]" : "distance of T max from the reference [K]", Scale::logarithmic};
  plot.width = 1100;
  plot.height = 640;
  plot.subtitle = bounded ? "marks: bound of the error; bars: down to the distance from the reference"
                          : "no bound of the error is known: the reference itself may be off";
  Series meshes = bars("reference meshes", grey, Mark::open_square);
  Series settings = bars("other settings", grey, Mark::circle);
  std::vector<Series> best;
  for (const AccuracyRow& row : variant.rows) {
    if (!row.computed() || row.other_model) continue;
    const bool is_named = row.on_front || row.baseline;
    if (is_named)
      best.push_back(named(row.baseline ? "as in the scene" : variant.label_of(row), row, best.size()));
    if (row.reference)
      add_row(row, meshes);
    else if (!is_named)
      add_row(row, settings);
  }
  plot.series = {front_of(variant.rows), std::move(settings), std::move(meshes)};
  plot.series.insert(plot.series.end(), best.begin(), best.end());
  std::erase_if(plot.series, [](const Series& each) { return each.x.empty(); });
  const double uncertainty = variant.reference_uncertainty();
  if (std::isfinite(uncertainty) && uncertainty > 0)
    plot.horizontal_lines = {
        {uncertainty, fmt::format("reference uncertain by {} K", significant(uncertainty, 2))}};
  return plot;
}

}  // namespace launchsafe::kinds
