// launchsafe verify --error-against-time: error, order and processor time of the parts with exact solutions.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/verify/error_against_time.hpp"
#include "output_folder.hpp"
#include "signals.hpp"
#include "verify_command.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::app {
namespace {

using verify::ErrorSeries, verify::MeasuredSetting;

const char* const errors_title = "Error against processor time of the parts with exact solutions";
const std::vector<std::string> error_files{"parts.csv", "parts.md", "parts.svg"};

/// A series and what it gave.
struct MeasuredSeries {
  ErrorSeries series;
  std::vector<MeasuredSetting> settings;
};

report::Column significant_column(std::string name, std::string unit, int digits) {
  return {.name = std::move(name),
          .unit = std::move(unit),
          .decimals = digits,
          .notation = report::Notation::significant};
}

/// "1", "exact", or nothing where no order is to be expected.
report::Cell expected_order(const ErrorSeries& series) {
  if (std::isnan(series.order)) return std::string("none");
  if (std::isinf(series.order)) return std::string("exact");
  return report::significant(series.order, 3);
}

report::Cell order_cell(double order) {
  return std::isnan(order) ? report::Cell{} : report::Cell{report::fixed(order, 2)};
}

std::string amount(double value, const std::string& unit) {
  const std::string number = report::significant(value, 3);
  return unit.empty() ? number : number + " " + unit;
}

report::Table settings_table(const std::vector<MeasuredSeries>& measured) {
  report::Table table;
  table.title = errors_title;
  table.columns = {report::text_column("part"),    report::text_column("error of"),
                   report::text_column("setting"), {.name = "error", .unit = ""},
                   {.name = "order", .unit = ""},  significant_column("processor time", "s", 3)};
  for (const MeasuredSeries& each : measured) {
    for (const MeasuredSetting& row : each.settings) {
      table.rows.push_back({each.series.part, each.series.quantity, row.text,
                            amount(row.error, each.series.error_unit), order_cell(row.order),
                            row.processor_time});
    }
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

/// Everything in one table, for programs.
report::Table whole_table(const std::vector<MeasuredSeries>& measured) {
  report::Table table;
  table.columns = {report::text_column("part"),
                   report::text_column("quantity"),
                   report::text_column("setting"),
                   significant_column("size", "", 9),
                   significant_column("error", "", 9),
                   report::text_column("error unit"),
                   significant_column("order", "", 9),
                   significant_column("order expected", "", 9),
                   significant_column("processor time", "s", 9),
                   report::text_column("work"),
                   report::text_column("reference")};
  for (const MeasuredSeries& each : measured) {
    for (const MeasuredSetting& row : each.settings) {
      table.rows.push_back({each.series.part, each.series.quantity, row.text, row.size, row.error,
                            each.series.error_unit, row.order, each.series.order, row.processor_time,
                            each.series.work, each.series.reference});
    }
  }
  return table;
}

bool is_exact(const MeasuredSeries& each) {
  return std::all_of(each.settings.begin(), each.settings.end(),
                     [&](const MeasuredSetting& row) { return row.error <= each.series.round_off; });
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
    for (const MeasuredSetting& row : each.settings) {
      line.x.push_back(row.processor_time);
      line.y.push_back(row.error);
    }
    plot.series.push_back(std::move(line));
  }
  return plot;
}

std::string page_of(const std::vector<MeasuredSeries>& measured, const std::string& command,
                    const std::string& picture) {
  std::string page =
      fmt::format("# {}\n\nMade by `{}`. Times are of the machine that ran it.\n\n", errors_title, command);
  if (!picture.empty()) page += fmt::format("![Error against processor time]({})\n\n", picture);
  report::Table settings = settings_table(measured), series = series_table(measured);
  settings.title = "Settings";
  if (!picture.empty()) series.notes.push_back("The picture leaves out what is exact at every setting.");
  return page + report::to_markdown(settings) + "\n" + report::to_markdown(series);
}

std::string errors_text(const std::vector<MeasuredSeries>& measured, const std::string& command) {
  return report::to_text(settings_table(measured)) + "\n" + report::to_text(series_table(measured)) +
         "\nmade by: " + command + "\n";
}

nlohmann::ordered_json errors_json(const std::vector<MeasuredSeries>& measured, const std::string& command) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  };
  nlohmann::ordered_json object{{"command", command}, {"series", nlohmann::ordered_json::array()}};
  for (const MeasuredSeries& each : measured) {
    const ErrorSeries& series = each.series;
    nlohmann::ordered_json settings = nlohmann::ordered_json::array();
    for (const MeasuredSetting& row : each.settings) {
      settings.push_back({{"setting", row.text},
                          {"size", row.size},
                          {"error", number(row.error)},
                          {"order", number(row.order)},
                          {"processor_time_s", row.processor_time}});
    }
    object["series"].push_back({{"part", series.part},
                                {"quantity", series.quantity},
                                {"error_unit", series.error_unit},
                                {"work", series.work},
                                {"reference", series.reference},
                                {"theory", series.theory},
                                {"order_expected", number(series.order)},
                                {"exact", std::isinf(series.order)},
                                {"round_off", series.round_off},
                                {"settings", settings}});
  }
  return object;
}

/// Writes the files, parts.svg only where gnuplot is installed.
store::Result<report::WrittenFiles> write_errors(const std::vector<MeasuredSeries>& measured,
                                                 const std::string& command,
                                                 const std::filesystem::path& folder,
                                                 const report::DrawingLimits& limits) {
  report::WrittenFiles written;
  std::string picture = "parts.svg";
  const report::Plot plot = plot_of(measured);
  if (plot.series.empty()) {
    written.remarks.push_back("no picture: every part asked for is exact at every setting");
    picture.clear();
  } else if (auto error = report::write_svg(plot, folder / picture, limits)) {
    if (!report::is_of_drawing(*error)) return *error;
    written.remarks.push_back("no picture: " + error->message);
    ++written.pictures_missing;
    picture.clear();
  } else {
    written.files.push_back(picture);
  }
  if (auto error = write_texts(folder,
                               {{"parts.csv", report::to_csv(whole_table(measured))},
                                {"parts.md", page_of(measured, command, picture)}},
                               written))
    return *error;
  return written;
}

std::string name_of(const ErrorSeries& series) { return series.part + ": " + series.quantity; }

/// The settings whose computation failed.
std::vector<kinds::Failure> failures_of(const std::vector<MeasuredSeries>& measured) {
  std::vector<kinds::Failure> failures;
  for (const MeasuredSeries& each : measured)
    for (const MeasuredSetting& row : each.settings)
      if (!std::isfinite(row.error))
        failures.push_back({fmt::format("{}, {}", name_of(each.series), row.text), "the computation failed"});
  return failures;
}

}  // namespace

ExitCode tabulate_errors(const VerifyArguments& arguments, Console& console) {
  std::vector<ErrorSeries> wanted;
  std::vector<std::string> parts;
  for (const ErrorSeries& series : verify::error_series()) {
    parts.push_back(series.part);
    if (has_in_its_name(name_of(series), arguments.filter)) wanted.push_back(series);
  }
  if (wanted.empty()) return refuse_filter(arguments.filter, parts, console);
  if (arguments.output) {
    if (const auto obstacle = obstacle_to_report(*arguments.output, error_files))
      return console.refuse(*obstacle);
  }
  std::vector<MeasuredSeries> measured;
  compute_unless_stopped(console, "error", [&](Progress& progress) {
    for (const ErrorSeries& series : wanted) {
      if (stop_requested()) break;
      progress.show("measuring: " + name_of(series));
      measured.push_back({series, verify::measured(series)});
    }
  });
  const std::string command = verify_command("--error-against-time", arguments);
  console.print_text(errors_text(measured, command));
  console.print_json(errors_json(measured, command));
  const std::vector<kinds::Failure> failures = failures_of(measured);
  console.failures(failures);
  if (arguments.output) {
    const auto written = write_errors(measured, command, *arguments.output, {.stop = &stop_requested()});
    if (const ExitCode code = present_report(written, *arguments.output, console); code != ExitCode::done)
      return code;
  }
  return failures.empty() ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace launchsafe::app
