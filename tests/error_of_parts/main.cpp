// Error, order of convergence and processor time of the parts with exact solutions:
//   error_of_parts FOLDER
// writes parts.md, parts.csv and, where gnuplot is installed, parts.svg.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/run/processor_time.hpp"
#include "series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

namespace {

using namespace launchsafe;
using error_of_parts::ErrorSeries;

const char* const errors_title = "Error against processor time of the parts with exact solutions";

/// What one setting gave.
struct Measured {
  std::string text;
  double size = 0, error = 0;  ///< as of the setting and its series; the error is >= 0
  double processor_time = 0;   ///< s, of one unit of work, the least of several
  double order = 0;            ///< to the setting before; NaN for the first and where round-off is reached
};

/// A series and what it gave.
struct MeasuredSeries {
  ErrorSeries series;
  std::vector<Measured> settings;
};

double time_of(const std::function<void()>& work, long repetitions) {
  const double start = run::thread_processor_time();
  for (long k = 0; k < repetitions; ++k) work();
  return run::thread_processor_time() - start;
}

/// Least processor time (s) that one call takes. Short work is repeated until a clock can see it.
double least_processor_time(const std::function<void()>& work) {
  constexpr double shortest_batch = 2e-3;  // s: a thousand ticks of a clock of microseconds
  constexpr int batches = 3;
  long repetitions = 1;
  double batch = time_of(work, repetitions);
  while (batch < shortest_batch) batch = time_of(work, repetitions *= 2);
  for (int k = 1; k < batches; ++k) batch = std::min(batch, time_of(work, repetitions));
  return batch / static_cast<double>(repetitions);
}

MeasuredSeries measured(const ErrorSeries& series) {
  MeasuredSeries result{series, {}};
  double size = series.settings.front().size, error = error_of_parts::no_order;  // of the setting before
  for (const error_of_parts::Setting& setting : series.settings) {
    Measured row{setting.text, setting.size};
    row.processor_time = least_processor_time([&] { row.error = std::abs(setting.work()); });
    row.order = error_of_parts::order_between(size, error, row.size, row.error, series.round_off);
    size = row.size;
    error = row.error;
    result.settings.push_back(std::move(row));
  }
  return result;
}

/// "1", "exact", or nothing where no order is to be expected.
report::Cell expected_order(const ErrorSeries& series) {
  if (std::isnan(series.order)) return std::string("none");
  if (std::isinf(series.order)) return std::string("exact");
  return report::significant(series.order, 3);
}

std::string amount(double value, const std::string& unit) {
  const std::string number = report::significant(value, 3);
  return unit.empty() ? number : number + " " + unit;
}

/// What every setting gave: for people with units and to three digits, for programs exact.
report::Table settings_table(const std::vector<MeasuredSeries>& measured) {
  using enum report::Audience;
  report::Table table;
  table.title = "Settings";
  table.columns = {
      report::text_column("part"),
      report::text_column("error of"),
      report::text_column("setting"),
      {.name = "size", .unit = "", .audience = programs},
      {.name = "error", .unit = "", .key = "error_text", .audience = people},
      {.name = "error", .unit = "", .audience = programs},
      {.name = "error unit", .unit = "", .audience = programs},
      {.name = "order", .unit = "", .key = "order_text", .audience = people},
      {.name = "order", .unit = "", .audience = programs},
      {.name = "order expected", .unit = "", .audience = programs},
      {.name = "processor time", .unit = "s", .decimals = 3, .notation = report::Notation::significant},
      {.name = "work", .unit = "", .audience = programs},
      {.name = "reference", .unit = "", .audience = programs}};
  table.columns[1].key = "quantity";
  for (const MeasuredSeries& each : measured)
    for (const Measured& row : each.settings) {
      const ErrorSeries& series = each.series;
      table.rows.push_back(
          {series.part, series.quantity, row.text, row.size, amount(row.error, series.error_unit), row.error,
           series.error_unit,
           std::isnan(row.order) ? report::Cell{} : report::Cell{report::fixed(row.order, 2)}, row.order,
           series.order, row.processor_time, series.work, series.reference});
    }
  table.notes = {
      "Errors without a unit are relative. The order is that of the error in the step, cell or tolerance, "
      "from one setting to the next; where the error is of round-off there is none.",
      "Processor time is that of one unit of work, named below: the least of three measurements."};
  return table;
}

report::Table series_table(const std::vector<MeasuredSeries>& measured) {
  report::Table table;
  table.title = "What was measured";
  table.columns = {report::text_column("part"),           report::text_column("error of"),
                   report::text_column("against"),        report::text_column("processor time of"),
                   report::text_column("order expected"), report::text_column("because")};
  for (const MeasuredSeries& each : measured) {
    const ErrorSeries& series = each.series;
    table.rows.push_back(
        {series.part, series.quantity, series.reference, series.work, expected_order(series), series.theory});
  }
  return table;
}

bool is_exact(const MeasuredSeries& each) {
  return std::all_of(each.settings.begin(), each.settings.end(),
                     [&](const Measured& row) { return row.error <= each.series.round_off; });
}

/// Exact parts are left out: round-off against time shows nothing. One colour a part, one mark a quantity of
/// it.
report::Plot plot_of(const std::vector<MeasuredSeries>& measured) {
  report::Plot plot;
  plot.title = errors_title;
  plot.x = {.label = "processor time of one unit of work [s]", .scale = report::Scale::logarithmic};
  plot.y = {.label = "error [relative, or K where it says so]", .scale = report::Scale::logarithmic};
  plot.width = 1200;
  plot.height = 640;
  constexpr report::Mark marks[] = {report::Mark::circle, report::Mark::square, report::Mark::up_triangle,
                                    report::Mark::diamond};
  std::string part;
  int colour = -1;
  std::size_t mark = 0;
  for (const MeasuredSeries& each : measured) {
    if (is_exact(each)) continue;
    mark = each.series.part == part ? mark + 1 : 0;
    if (each.series.part != part) ++colour;
    part = each.series.part;
    const std::string unit = each.series.error_unit.empty() ? "" : " [" + each.series.error_unit + "]";
    report::Series line{part + ": " + each.series.quantity + unit, {}, {}};
    line.colour = colour;
    line.mark = marks[mark % std::size(marks)];
    for (const Measured& row : each.settings) {
      line.x.push_back(row.processor_time);
      line.y.push_back(row.error);
    }
    plot.series.push_back(std::move(line));
  }
  return plot;
}

/// Writes the files; false, with a word on stderr, where one cannot be written.
bool write_report(const std::vector<MeasuredSeries>& measured, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const report::Table settings = settings_table(measured);
  report::Table series = series_table(measured);
  std::string page = fmt::format(
      "# {}\n\nMade by `build/release/tests/error_of_parts reports/error_of_parts`. Times are of the machine "
      "that ran it.\n\n",
      errors_title);
  if (const auto svg = report::to_svg(plot_of(measured))) {
    std::ofstream(folder / "parts.svg") << *svg;
    page += "![Error against processor time](parts.svg)\n\n";
    series.notes.push_back("The picture leaves out what is exact at every setting.");
  } else {
    fmt::print(stderr, "no picture: {}\n", svg.error().message);
  }
  page += report::to_markdown(settings) + "\n" + report::to_markdown(series);
  std::ofstream(folder / "parts.csv", std::ios::binary) << report::to_csv(settings);
  std::ofstream file(folder / "parts.md");
  file << page << std::flush;
  if (!file) fmt::print(stderr, "{} cannot be written\n", (folder / "parts.md").string());
  return static_cast<bool>(file);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    fmt::print(stderr, "usage: error_of_parts FOLDER\n");
    return 2;
  }
  std::vector<MeasuredSeries> all;
  for (const ErrorSeries& series : error_of_parts::error_series()) all.push_back(measured(series));
  return write_report(all, arguments[1]) ? 0 : 1;
}
