// The pictures of an accuracy study: bounds of the error of T max against cost, mesh and time.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// Series that a legend can name and eyes can tell apart.
constexpr std::size_t most_named = 8;

bool is_drawn(const AccuracyRow& row) { return row.computed() && !row.other_model; }

const std::string& label_of_row(const AccuracyResult& result, const AccuracyRow& row) {
  return result.study.cases[row.index].label;
}

/// A mark at the bound, and a bar down to the distance.
void add_row(const AccuracyRow& row, double x, Series& series) {
  const double distance = row.largest_temperature_error;
  const double error = row.error_to_go_by();
  series.x.push_back(x);
  series.y.push_back(error);
  series.lower.push_back(distance);
  series.upper.push_back(error);
}

constexpr int grey = 7;

/// The look of the named series of a number: none has the colour and the mark of another of the first 56.
void give_look(int number, Series& series) {
  series.colour = number % grey;
  series.mark = static_cast<Mark>((number % grey + number / grey) % 8);
}

Series bars(std::string label, int colour, Mark mark) {
  Series series{std::move(label), {}, {}, Style::vertical_bars};
  series.colour = colour;
  series.mark = mark;
  return series;
}

Plot plot_of_errors(const AccuracyResult& result, std::string title, PlotAxis x) {
  Plot plot;
  plot.title = std::move(title);
  plot.x = std::move(x);
  plot.width = 1100;
  plot.height = 640;
  const bool bounded = result.record.unvaried.empty();
  plot.y = {bounded ? "error of T max [K]" : "distance of T max from the reference [K]", Scale::logarithmic};
  plot.subtitle = bounded ? "marks: bound of the error; bars: down to the distance from the reference"
                          : "no bound of the error is known: the reference itself may be off";
  return plot;
}

/// K, by which the reference of T max itself may be off: no setting can be shown to be nearer to the truth.
void add_reference(const AccuracyResult& result, Plot& plot) {
  if (!result.reference) return;
  double uncertainty = 0;
  for (const ReferenceValue& value : result.reference->temperature)
    uncertainty = larger_bound(uncertainty, value.limit.uncertainty + value.inexactness);
  if (std::isfinite(uncertainty) && uncertainty > 0)
    plot.horizontal_lines = {
        {uncertainty, fmt::format("uncertainty of the reference: {} K", significant(uncertainty, 2))}};
}

void add_drawn(std::vector<Series> all, Plot& plot) {
  for (Series& each : all) {
    if (!each.x.empty()) plot.series.push_back(std::move(each));
  }
}

// --- against mesh ---

/// What a setting has otherwise than the scene, apart from its mesh: "frame lab", "" for nothing.
std::string without_mesh(const std::string& label, bool reference) {
  std::string rest;
  for (std::size_t begin = 0; !reference && begin < label.size();) {
    const std::size_t end = std::min(label.find(", ", begin), label.size());
    const std::string part = label.substr(begin, end - begin);
    if (!part.starts_with("cell_size ")) rest += (rest.empty() ? "" : ", ") + part;
    begin = end + 2;
  }
  return rest;
}

/// The rows that differ in their mesh alone, from fine to coarse, by what they have in common.
std::map<std::string, std::vector<const AccuracyRow*>> mesh_series(const AccuracyResult& result) {
  std::map<std::string, std::vector<const AccuracyRow*>> series;
  for (const AccuracyRow& row : result.rows) {
    if (is_drawn(row))
      series[without_mesh(label_of_row(result, row), row.reference || row.baseline)].push_back(&row);
  }
  for (auto& [name, rows] : series)
    std::sort(rows.begin(), rows.end(),
              [](const AccuracyRow* a, const AccuracyRow* b) { return a->measured.cell < b->measured.cell; });
  return series;
}

/// The cell sizes (mm) that stand far enough apart to be read.
std::vector<Tic> mesh_tics(const AccuracyResult& result) {
  constexpr double apart = 1.08;
  std::vector<double> sizes;
  for (const AccuracyRow& row : result.rows)
    if (is_drawn(row)) sizes.push_back(1e3 * row.measured.cell);
  std::sort(sizes.begin(), sizes.end());
  std::vector<Tic> tics;
  for (const double size : sizes)
    if (tics.empty() || size > apart * tics.back().at) tics.push_back({size, significant(size, 3)});
  return tics;
}

std::string warned(const std::vector<const AccuracyRow*>& rows, const std::string& name) {
  const bool sound =
      std::all_of(rows.begin(), rows.end(), [](const AccuracyRow* row) { return row->sound(); });
  return sound ? name : name + " (validity warning)";
}

}  // namespace

Plot error_plot(const AccuracyResult& result) {
  Plot plot = plot_of_errors(result, "Error of T max against processor time",
                             {"processor time of a run [s]", Scale::logarithmic});
  Series front{"Pareto front", {}, {}, Style::steps};
  front.colour = grey;
  Series meshes = bars("reference meshes", grey, Mark::open_square);
  Series settings = bars("other settings", grey, Mark::circle);
  std::vector<Series> named;  // one point each, so that the legend names them and no label covers others
  std::vector<std::pair<double, double>> best;
  for (const AccuracyRow& row : result.rows) {
    if (!is_drawn(row)) continue;
    const double time = row.measured.processor_time;
    if (row.on_front) best.emplace_back(time, row.error_to_go_by());
    if (row.on_front || row.baseline) {
      named.push_back(
          {row.baseline ? "as in the scene" : label_of_row(result, row), {}, {}, Style::vertical_bars});
      give_look(static_cast<int>(named.size()) - 1, named.back());
      add_row(row, time, named.back());
      if (!row.reference) continue;
    }
    add_row(row, time, row.reference ? meshes : settings);
  }
  std::sort(best.begin(), best.end());
  for (const auto& [time, error] : best) {
    front.x.push_back(time);
    front.y.push_back(error);
  }
  add_drawn({std::move(front), std::move(settings), std::move(meshes)}, plot);
  add_drawn(std::move(named), plot);
  add_reference(result, plot);
  return plot;
}

Plot mesh_plot(const AccuracyResult& result) {
  Plot plot =
      plot_of_errors(result, "Error of T max against the mesh", {"cell size [mm]", Scale::logarithmic});
  plot.x.tics = mesh_tics(result);
  const auto series = mesh_series(result);
  Series others = bars("other settings", grey, Mark::circle);
  int look = 0;
  for (const auto& [name, rows] : series) {
    const bool is_named = rows.size() > 1 || series.size() <= most_named;
    Series line{"", {}, {}, Style::line},
        marks{warned(rows, name.empty() ? "as in the scene" : name), {}, {}, Style::vertical_bars};
    give_look(look, marks);
    line.colour = marks.colour;
    for (const AccuracyRow* row : rows) add_row(*row, 1e3 * row->measured.cell, is_named ? marks : others);
    if (!is_named) continue;
    line.x = marks.x;
    line.y = marks.y;
    if (rows.size() > 1) plot.series.push_back(std::move(line));
    plot.series.push_back(std::move(marks));
    ++look;
  }
  add_drawn({std::move(others)}, plot);
  add_reference(result, plot);
  return plot;
}

Plot launch_plot(const AccuracyResult& result) {
  constexpr double least = 1e-3;  // K: what is below does not matter
  Plot plot = plot_of_errors(result, "Error of the highest temperature over the launch, without reaction",
                             {"time [ms]"});
  plot.y.label = "error of T [K]";
  plot.y.minimum = least;
  plot.subtitle = result.record.unvaried.empty() ? "bound of the error at each time" : plot.subtitle;
  const std::vector<double>& times = accuracy_settings(result.study.study).times;
  const auto drawn =
      static_cast<std::size_t>(std::count_if(result.rows.begin(), result.rows.end(), is_drawn));
  int look = 0;
  bool said = false;
  for (const AccuracyRow& row : result.rows) {
    if (!is_drawn(row)) continue;
    const bool is_named = drawn <= most_named || row.on_front || row.baseline;
    Series line{is_named ? warned({&row}, row.baseline ? "as in the scene" : label_of_row(result, row))
                : std::exchange(said, true) ? ""
                                            : "other settings",
                {},
                {},
                is_named ? Style::line_and_points : Style::line};
    line.colour = grey;
    if (is_named) give_look(look++, line);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double bound = bound_against(result.reference->at_times[i], row.measured.at_times[i]);
      line.x.push_back(1e3 * times[i]);
      line.y.push_back(std::isfinite(bound) ? bound : std::abs(row.error_at_times[i]));
    }
    // What is named lies on top.
    plot.series.insert(is_named ? plot.series.end() : plot.series.begin(), std::move(line));
  }
  return plot;
}

}  // namespace launchsafe::kinds
