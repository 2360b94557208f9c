// launchsafe verify: numbers that an installed program must reproduce.
#include "commands.hpp"
#include "launchsafe/report/table.hpp"
#include "self_test.hpp"
#include "signals.hpp"
#include "terminal_width.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace launchsafe::app {
namespace {

/// A number that was computed.
struct Check {
  SelfTest test;
  double computed = 0;

  double error() const { return std::abs(computed - test.expected); }
  /// False for anything that is not a number.
  bool pass() const { return error() <= test.tolerance; }
};

report::Table check_table(const std::vector<Check>& checks, std::size_t failed) {
  using keys::text, keys::significant;
  const report::Quantities<Check> quantities{
      {{"check", "check", text(), "What is checked."},
       [](const Check& check) { return check.test.group + ": " + check.test.name; }},
      {{"computed", "computed", significant(9), "What the program computed."}, &Check::computed},
      {{"expected", "expected", significant(9), "What it must compute."}, &Check::test, &SelfTest::expected},
      {{"error", "error", significant(3), "Their difference."}, &Check::error},
      {{"tolerance", "tolerance", significant(3), "The largest allowed."},
       &Check::test,
       &SelfTest::tolerance},
      {{"unit", "unit", text(), "Unit of the numbers."}, &Check::test, &SelfTest::unit},
      {{"result", "result", text(), "pass or FAIL."},
       [](const Check& check) { return check.pass() ? "pass" : "FAIL"; }}};
  report::Table table = report::table_of({}, quantities, checks);
  table.notes = {fmt::format("{} of {} checks pass.", checks.size() - failed, checks.size())};
  return table;
}

nlohmann::ordered_json json_of(const std::vector<Check>& checks, std::size_t failed) {
  nlohmann::ordered_json object{{"checks", nlohmann::ordered_json::array()}};
  for (const Check& check : checks)
    object["checks"].push_back({{"group", check.test.group},
                                {"name", check.test.name},
                                {"computed", check.computed},
                                {"expected", check.test.expected},
                                {"unit", check.test.unit},
                                {"error", check.error()},
                                {"tolerance", check.test.tolerance},
                                {"source", check.test.source},
                                {"pass", check.pass()}});
  object["passed"] = checks.size() - failed;
  object["failed"] = failed;
  return object;
}

/// Whether the name has the filter in it, case ignored.
bool has_in_its_name(const SelfTest& test, const std::string& filter) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  const std::string name = test.group + ": " + test.name;
  return std::search(name.begin(), name.end(), filter.begin(), filter.end(), same) != name.end();
}

}  // namespace

ExitCode perform(const VerifyArguments& arguments, Console& console) {
  std::vector<Check> checks;
  std::set<std::string> groups;
  for (const SelfTest& test : self_tests()) {
    if (stop_requested()) {
      console.error("interrupted; no check was printed, and there is nothing to keep");
      return ExitCode::interrupted;
    }
    groups.insert(test.group);
    if (has_in_its_name(test, arguments.filter)) checks.push_back({test, test.compute()});
  }
  if (checks.empty())
    return console.refuse(
        fmt::format("--filter: found \"{}\", which no check has in its name; groups of checks: {}",
                    arguments.filter, fmt::join(groups, ", ")));
  const auto failed = static_cast<std::size_t>(
      std::count_if(checks.begin(), checks.end(), [](const Check& check) { return !check.pass(); }));
  console.print_text(report::to_text(check_table(checks, failed), width_of_output()));
  console.print_json(json_of(checks, failed));
  return failed == 0 ? ExitCode::done : ExitCode::cases_failed;
}

}  // namespace launchsafe::app
