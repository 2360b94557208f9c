// launchsafe verify: numbers the program must reproduce.
#include "verify_command.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/verify/check.hpp"
#include "shell_words.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <future>
#include <utility>

namespace launchsafe::app {
namespace {

using Checks = std::vector<verify::Check>;

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
  Checks checks;
  std::vector<std::string> groups;
  compute_unless_stopped(console, "check", [&](Progress& progress) {
    for (const verify::Computation& computation : verify::computations()) {
      if (stop_requested()) break;
      progress.show("computing: " + computation.group);
      groups.push_back(computation.group);
      for (verify::Check& check : computation.run())
        if (has_in_its_name(check.group + ": " + check.name, arguments.filter))
          checks.push_back(std::move(check));
    }
  });
  if (checks.empty()) return refuse_filter(arguments.filter, groups, console);
  const std::int64_t failed =
      std::count_if(checks.begin(), checks.end(), [](const verify::Check& check) { return !check.pass(); });
  console.print_text(report::to_text(table_of(checks, failed)));
  console.print_json(json_of(checks, failed));
  return failed == 0 ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace

bool has_in_its_name(std::string_view name, std::string_view filter) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(name.begin(), name.end(), filter.begin(), filter.end(), same) != name.end();
}

ExitCode refuse_filter(const std::string& filter, const std::vector<std::string>& groups, Console& console) {
  std::vector<std::string> once;
  for (const std::string& group : groups)
    if (std::find(once.begin(), once.end(), group) == once.end()) once.push_back(group);
  return console.refuse(
      fmt::format("--filter: found \"{}\", which no check has in its name; groups of checks: {}", filter,
                  fmt::join(once, ", ")));
}

void compute_unless_stopped(Console& console, const char* lost,
                            const std::function<void(Progress&)>& compute) {
  Progress progress(progress_style(console.quiet()));
  auto computed = std::async(std::launch::async, [&] { compute(progress); });
  for (bool ready = false; !ready;) {
    ready = computed.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
    if (!stop_requested()) continue;
    // Whatever is ready now may have been cut short by the same wish.
    progress.clear();
    console.error(fmt::format("interrupted; no {} was printed, and there is nothing to keep", lost));
    // What is being computed cannot be stopped and would be waited for.
    std::quick_exit(static_cast<int>(console.finish(ExitCode::interrupted)));
  }
  computed.get();
}

std::string verify_command(const char* form, const VerifyArguments& arguments) {
  return std::string("launchsafe verify ") + form +
         (arguments.filter.empty() ? "" : " --filter " + shell_quoted(arguments.filter)) +
         (arguments.output ? " -o DIR" : "");
}

ExitCode perform(const VerifyArguments& arguments, Console& console) {
  return arguments.error_against_time ? tabulate_errors(arguments, console)
                                      : compare_with_expected(arguments, console);
}

}  // namespace launchsafe::app
