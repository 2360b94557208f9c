// launchsafe verify: numbers the program must reproduce.
#include "commands.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/verify/material_checks.hpp"
#include "launchsafe/verify/mechanics_checks.hpp"
#include "launchsafe/verify/surface_checks.hpp"
#include "progress.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <future>
#include <iterator>
#include <vector>

namespace launchsafe::app {
namespace {

using Checks = std::vector<verify::Check>;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

void append(Checks& checks, Checks more) {
  checks.insert(checks.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

Checks all_checks(Progress& progress) {
  Checks checks = verify::material_checks();
  append(checks, verify::surface_checks());
  for (const verify::Computation& computation : verify::mechanics_computations()) {
    if (stop_requested()) break;
    progress.show("computing: " + computation.name);
    append(checks, computation.run());
  }
  return checks;
}

/// Every check. Ends the program where the user wants it to stop.
Checks all_checks_unless_stopped(const Console& console) {
  Progress progress(progress_style(console.quiet()));
  auto checks = std::async(std::launch::async, [&progress] { return all_checks(progress); });
  while (checks.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (!stop_requested()) continue;
    progress.clear();
    console.error("interrupted; no check was printed, and there is nothing to keep");
    // A check that is being computed cannot be stopped and would be waited for.
    std::quick_exit(static_cast<int>(ExitCode::interrupted));
  }
  return checks.get();
}

Checks matching(const Checks& checks, const std::string& filter) {
  const std::string wanted = lower_case(filter);
  Checks found;
  std::copy_if(checks.begin(), checks.end(), std::back_inserter(found), [&](const verify::Check& check) {
    return lower_case(check.group + ": " + check.name).find(wanted) != std::string::npos;
  });
  return found;
}

std::string groups_of(const Checks& checks) {
  std::vector<std::string> groups;
  for (const verify::Check& check : checks) {
    if (std::find(groups.begin(), groups.end(), check.group) == groups.end()) groups.push_back(check.group);
  }
  return fmt::format("{}", fmt::join(groups, ", "));
}

/// Relative measures carry no unit.
std::string measure(double value, const verify::Check& check) {
  const std::string number = report::significant(value, 3);
  return check.absolute && !check.unit.empty() ? number + " " + check.unit : number;
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
                                {"absolute", check.absolute},
                                {"source", check.source},
                                {"pass", check.pass()}});
  }
  object["passed"] = static_cast<std::int64_t>(checks.size()) - failed;
  object["failed"] = failed;
  return object;
}

}  // namespace

ExitCode verify_command(const VerifyArguments& arguments, Console& console) {
  const Checks all = all_checks_unless_stopped(console);
  const Checks checks = matching(all, arguments.filter);
  if (checks.empty()) {
    console.error(fmt::format("--filter: found \"{}\", which no check has in its name; groups of checks: {}",
                              arguments.filter, groups_of(all)));
    return ExitCode::bad_input;
  }
  const std::int64_t failed =
      std::count_if(checks.begin(), checks.end(), [](const verify::Check& check) { return !check.pass(); });
  console.print_text(report::to_text(table_of(checks, failed)));
  console.print_json(json_of(checks, failed));
  return failed == 0 ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace launchsafe::app
