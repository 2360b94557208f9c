// launchsafe verify: numbers the program must reproduce.
#include "commands.hpp"
#include "error_table.hpp"
#include "finite_element_command.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/verify/check.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "shell_words.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <future>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace launchsafe::app {
namespace {

using Checks = std::vector<verify::Check>;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

Checks all_checks(Progress& progress) {
  Checks checks;
  for (const verify::Computation& computation : verify::computations()) {
    if (stop_requested()) break;
    progress.show("computing: " + computation.group);
    for (verify::Check& check : computation.run()) checks.push_back(std::move(check));
  }
  return checks;
}

/// What `compute(progress)` gives. Ends the program where the user wants it to stop.
template <class Compute>
std::invoke_result_t<Compute, Progress&> unless_stopped(Console& console, const char* lost,
                                                        const Compute& compute) {
  Progress progress(progress_style(console.quiet()));
  auto result = std::async(std::launch::async, [&] { return compute(progress); });
  for (bool ready = false; !ready;) {
    ready = result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
    if (!stop_requested()) continue;
    // Whatever is ready now may have been cut short by the same wish.
    progress.clear();
    console.error(fmt::format("interrupted; no {} was printed, and there is nothing to keep", lost));
    // What is being computed cannot be stopped and would be waited for.
    std::quick_exit(static_cast<int>(console.finish(ExitCode::interrupted)));
  }
  return result.get();
}

std::string group_of(const verify::Check& check) { return check.group; }
std::string group_of(const verify::ErrorSeries& series) { return series.part; }
std::string name_of(const verify::Check& check) { return check.group + ": " + check.name; }
std::string name_of(const verify::ErrorSeries& series) { return series.part + ": " + series.quantity; }

template <class Item>
std::vector<Item> matching(const std::vector<Item>& items, const std::string& filter) {
  const std::string wanted = lower_case(filter);
  std::vector<Item> found;
  std::copy_if(items.begin(), items.end(), std::back_inserter(found),
               [&](const Item& item) { return lower_case(name_of(item)).find(wanted) != std::string::npos; });
  return found;
}

template <class Item>
ExitCode refuse_filter(const std::vector<Item>& items, const std::string& filter, Console& console) {
  std::vector<std::string> groups;
  for (const Item& item : items) {
    if (std::find(groups.begin(), groups.end(), group_of(item)) == groups.end())
      groups.push_back(group_of(item));
  }
  return console.refuse(
      fmt::format("--filter: found \"{}\", which no check has in its name; groups of checks: {}", filter,
                  fmt::join(groups, ", ")));
}

/// Relative measures carry no unit.
std::string measure(double value, const verify::Check& check) {
  const std::string number = report::significant(value, 3);
  return check.absolute() && !check.unit.empty() ? number + " " + check.unit : number;
}

report::Table table_of(const Checks& checks, std::int64_t failed) {
  report::Table table;
  table.columns = {report::text_column("check"),
                   {.name = "computed", .unit = "", .decimals = 9, .notation = report::Notation::significant},
                   {.name = "expected", .unit = "", .decimals = 9, .notation = report::Notation::significant},
                   report::text_column("unit"),
                   {.name = "error", .unit = ""},
                   {.name = "tolerance", .unit = ""},
                   report::text_column("result")};
  for (const verify::Check& check : checks) {
    table.rows.push_back({check.group + ": " + check.name, check.computed, check.expected, check.unit,
                          measure(check.error(), check), measure(check.tolerance, check),
                          std::string(check.pass() ? "pass" : "FAIL")});
  }
  table.notes.push_back(fmt::format("{} of {} checks pass. Errors without a unit are relative.",
                                    static_cast<std::int64_t>(checks.size()) - failed, checks.size()));
  return table;
}

nlohmann::ordered_json json_of(const Checks& checks, std::int64_t failed) {
  nlohmann::ordered_json object{{"checks", nlohmann::ordered_json::array()}};
  for (const verify::Check& check : checks) {
    object["checks"].push_back({{"group", check.group},
                                {"name", check.name},
                                {"computed", check.computed},
                                {"expected", check.expected},
                                {"unit", check.unit},
                                {"error", check.error()},
                                {"tolerance", check.tolerance},
                                {"absolute", check.absolute()},
                                {"source", check.source},
                                {"pass", check.pass()}});
  }
  object["passed"] = static_cast<std::int64_t>(checks.size()) - failed;
  object["failed"] = failed;
  return object;
}

ExitCode compare_with_expected(const VerifyArguments& arguments, Console& console) {
  const Checks all = unless_stopped(console, "check", all_checks);
  const Checks checks = matching(all, arguments.filter);
  if (checks.empty()) return refuse_filter(all, arguments.filter, console);
  const std::int64_t failed =
      std::count_if(checks.begin(), checks.end(), [](const verify::Check& check) { return !check.pass(); });
  console.print_text(report::to_text(table_of(checks, failed)));
  console.print_json(json_of(checks, failed));
  return failed == 0 ? ExitCode::done : ExitCode::cases_failed;
}

std::vector<MeasuredSeries> measured(const std::vector<verify::ErrorSeries>& all, Progress& progress) {
  std::vector<MeasuredSeries> results;
  for (const verify::ErrorSeries& series : all) {
    if (stop_requested()) break;
    progress.show("measuring: " + name_of(series));
    results.push_back({series, verify::measured(series)});
  }
  return results;
}

/// The settings whose computation failed.
std::vector<kinds::Failure> failures_of(const std::vector<MeasuredSeries>& results) {
  std::vector<kinds::Failure> failures;
  for (const MeasuredSeries& each : results) {
    for (const verify::MeasuredSetting& row : each.settings) {
      if (std::isfinite(row.error)) continue;
      failures.push_back({fmt::format("{}, {}", name_of(each.series), row.text), "the computation failed"});
    }
  }
  return failures;
}

/// The command that makes the table again, on any machine.
std::string errors_command(const VerifyArguments& arguments) {
  return std::string("launchsafe verify --error-against-time") +
         (arguments.filter.empty() ? "" : " --filter " + shell_quoted(arguments.filter)) +
         (arguments.output ? " -o DIR" : "");
}

ExitCode tabulate_errors(const VerifyArguments& arguments, Console& console) {
  const std::vector<verify::ErrorSeries> all = verify::error_series();
  const std::vector<verify::ErrorSeries> wanted = matching(all, arguments.filter);
  if (wanted.empty()) return refuse_filter(all, arguments.filter, console);
  if (arguments.output) {
    if (const auto obstacle = obstacle_to_report(*arguments.output, error_table_files))
      return console.refuse(*obstacle);
  }
  const auto results =
      unless_stopped(console, "error", [&](Progress& progress) { return measured(wanted, progress); });
  const std::string command = errors_command(arguments);
  console.print_text(error_table_text(results, command));
  console.print_json(error_table_json(results, command));
  const std::vector<kinds::Failure> failures = failures_of(results);
  console.failures(failures);
  if (arguments.output) {
    const auto written = write_error_table(results, command, *arguments.output, {.stop = &stop_requested()});
    if (const ExitCode code = present_report(written, *arguments.output, console); code != ExitCode::done)
      return code;
  }
  return failures.empty() ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace

ExitCode perform(const VerifyArguments& arguments, Console& console) {
  if (arguments.finite_elements) return compare_with_finite_elements(arguments, console);
  return arguments.error_against_time ? tabulate_errors(arguments, console)
                                      : compare_with_expected(arguments, console);
}

}  // namespace launchsafe::app
