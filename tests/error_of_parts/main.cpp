// Error, order of convergence and processor time of the parts with exact solutions:
//   error_of_parts FOLDER
// writes parts.md, parts.csv and, where gnuplot is installed, parts.svg.
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
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
  const std::clock_t start = std::clock();  // of this process, whose one thread works
  for (long k = 0; k < repetitions; ++k) work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
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

/// One setting of a series.
struct SettingRow {
  const ErrorSeries* series;
  const Measured* setting;
};

/// What every setting gave: for people with units and to three digits, for programs exact.
report::Table settings_table(const std::vector<MeasuredSeries>& measured) {
  using keys::always, keys::fixed, keys::significant, keys::text, report::for_people, report::for_programs,
      report::Column;
  const auto of_series = [](auto member) {
    return [member](const SettingRow& row) { return std::invoke(member, *row.series); };
  };
  const auto of_setting = [](auto member) {
    return [member](const SettingRow& row) { return std::invoke(member, *row.setting); };
  };
  const auto number = [](std::string name, std::string heading, std::string meaning) {
    return for_programs(always(Column{std::move(name), std::move(heading), fixed(1), std::move(meaning)}));
  };
  const report::Quantities<SettingRow> quantities{
      {{"part", "part", text(), "Part of the program."}, of_series(&ErrorSeries::part)},
      {{"quantity", "error of", text(), "What is off."}, of_series(&ErrorSeries::quantity)},
      {{"setting", "setting", text(), "Step, cell or tolerance."}, of_setting(&Measured::text)},
      {number("size", "size", "Its size."), of_setting(&Measured::size)},
      {for_people(Column{"error_text", "error", text(), "The error."}),
       [](const SettingRow& row) { return amount(row.setting->error, row.series->error_unit); }},
      {number("error", "error", "The error."), of_setting(&Measured::error)},
      {for_programs(Column{"error_unit", "error unit", text(), "Its unit."}),
       of_series(&ErrorSeries::error_unit)},
      {for_people(Column{"order_text", "order", text(), "Order from one setting to the next."}),
       [](const SettingRow& row) {
         return std::isnan(row.setting->order) ? std::string() : report::fixed(row.setting->order, 2);
       }},
      {number("order", "order", "Order from one setting to the next."), of_setting(&Measured::order)},
      {number("order_expected", "order expected", "Order of the theory."), of_series(&ErrorSeries::order)},
      {always({"processor_time", "processor time", significant(3, keys::second), "Of one unit of work."}),
       of_setting(&Measured::processor_time)},
      {for_programs(Column{"work", "work", text(), "The unit of work."}), of_series(&ErrorSeries::work)},
      {for_programs(Column{"reference", "reference", text(), "What it is compared with."}),
       of_series(&ErrorSeries::reference)}};
  std::vector<SettingRow> rows;
  for (const MeasuredSeries& each : measured)
    for (const Measured& row : each.settings) rows.push_back({&each.series, &row});
  report::Table table = report::table_of("Settings", quantities, rows);
  table.notes = {
      "Errors without a unit are relative. The order is that of the error in the step, cell or tolerance, "
      "from one setting to the next; where the error is of round-off there is none.",
      "Processor time is that of one unit of work, named below: the least of three measurements."};
  return table;
}

report::Table series_table(const std::vector<MeasuredSeries>& measured) {
  using keys::text;
  const auto of_series = [](auto member) {
    return [member](const MeasuredSeries& row) { return std::invoke(member, row.series); };
  };
  return report::table_of<MeasuredSeries>(
      "What was measured",
      {{{"part", "part", text(), "Part of the program."}, of_series(&ErrorSeries::part)},
       {{"error_of", "error of", text(), "What is off."}, of_series(&ErrorSeries::quantity)},
       {{"against", "against", text(), "What it is compared with."}, of_series(&ErrorSeries::reference)},
       {{"processor_time_of", "processor time of", text(), "The unit of work."},
        of_series(&ErrorSeries::work)},
       {{"order_expected", "order expected", text(), "Order of the theory."}, of_series(expected_order)},
       {{"because", "because", text(), "The theory."}, of_series(&ErrorSeries::theory)}},
      measured);
}

bool is_exact(const MeasuredSeries& each) {
  return std::all_of(each.settings.begin(), each.settings.end(),
                     [&](const Measured& row) { return row.error <= each.series.round_off; });
}

/// Of the two finest settings that are not at round-off; NaN where there are none.
double finest_order(const MeasuredSeries& each) {
  double order = error_of_parts::no_order;
  for (const Measured& row : each.settings)
    if (std::isfinite(row.order)) order = row.order;
  return order;
}

/// A panel for each part. Exact ones are left out: round-off against time shows nothing.
report::Plot plot_of(const std::vector<MeasuredSeries>& measured) {
  report::Plot plot;
  int orders = 0;
  double farthest = 0.0;  // of a measured order from that of the theory
  const std::string* part = nullptr;
  for (const MeasuredSeries& each : measured) {
    if (is_exact(each)) continue;
    const bool has_order = std::isfinite(each.series.order);
    const std::string order = has_order ? report::fixed(finest_order(each), 1) : "none";
    if (has_order) {
      ++orders;
      farthest = std::max(farthest, std::abs(finest_order(each) - each.series.order));
    }
    if (part == nullptr || *part != each.series.part) {
      part = &each.series.part;
      report::Plot& panel = plot.panels.emplace_back();
      panel.title = *part + ": order " + order;
      panel.x = {.label = "processor time of one unit of work [s]", .scale = report::Scale::logarithmic};
      panel.y = {.label = "error [relative, or K where it says so]", .scale = report::Scale::logarithmic};
      panel.width = 760;
      panel.height = 400;
    } else {
      plot.panels.back().title += ", " + order;
    }
    const std::string unit = each.series.error_unit.empty() ? "" : " [" + each.series.error_unit + "]";
    report::Series& line = plot.panels.back().series.emplace_back();
    line.label = fmt::format("{}{}: {}", each.series.quantity, unit, order);
    for (const Measured& row : each.settings) line.add(row.processor_time, row.error);
  }
  // To whole powers of ten: a part whose time hardly depends on the setting has a tic too.
  for (report::Plot& panel : plot.panels) {
    double least = HUGE_VAL, most = 0.0;
    for (const report::Series& line : panel.series) {
      least = std::min(least, *std::min_element(line.x.begin(), line.x.end()));
      most = std::max(most, *std::max_element(line.x.begin(), line.x.end()));
    }
    panel.x.minimum = std::pow(10.0, std::floor(std::log10(least)));
    panel.x.maximum = std::pow(10.0, std::ceil(std::log10(most)));
  }
  plot.title = fmt::format("{} errors fall at their order of theory, to within {}", orders,
                           report::significant(farthest, 2));
  plot.subtitle = "behind each name the order measured between its two finest settings";
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
