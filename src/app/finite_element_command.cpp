// launchsafe verify --finite-elements: static stresses held against another program's.
#include "finite_element_command.hpp"

#include "finite_element_table.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "shell_words.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace launchsafe::app {
namespace {

constexpr const char* tube_name = "thick tube";

bool contains(const std::string& text, const std::string& part) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

/// What was asked for.
struct Wanted {
  std::vector<verify::StaticCase> cases;
  bool tube = false;
};

Wanted wanted_by(const std::string& filter) {
  Wanted wanted;
  for (verify::StaticCase& each : verify::static_cases())
    if (contains(each.name, filter)) wanted.cases.push_back(std::move(each));
  wanted.tube = contains(tube_name, filter);
  return wanted;
}

/// Why nothing can be begun.
std::optional<std::string> obstacle(const VerifyArguments& arguments, const Wanted& wanted) {
  if (wanted.cases.empty() && !wanted.tube) {
    std::string names;
    for (const verify::StaticCase& each : verify::static_cases()) names += "\"" + each.name + "\", ";
    return fmt::format("--filter: found \"{}\", which no case has in its name; cases: {}\"{}\"",
                       arguments.filter, names, tube_name);
  }
  if (!arguments.output) return std::nullopt;
  return obstacle_to_report(*arguments.output, finite_element_files);
}

store::MaybeError compare(const Wanted& wanted, Progress& progress, FiniteElementComparison& comparison) {
  verify::ComparisonOptions options;
  options.stop = &stop_requested();
  options.progress = [&](const std::string& what) { progress.show("computing: " + what); };
  for (const verify::StaticCase& each : wanted.cases) {
    auto result = verify::compare_static_stresses(each, options);
    if (!result) return result.error();
    comparison.cases.push_back(std::move(*result));
  }
  if (!wanted.tube) return std::nullopt;
  const auto tube = verify::compare_tube(options);
  if (!tube) return tube.error();
  comparison.tube = *tube;
  return std::nullopt;
}

std::string stress_command(const VerifyArguments& arguments) {
  return std::string("launchsafe verify --finite-elements") +
         (arguments.filter.empty() ? "" : " --filter " + shell_quoted(arguments.filter)) +
         (arguments.output ? " -o DIR" : "");
}

bool misses_a_target(const FiniteElementComparison& comparison) {
  return std::any_of(
      comparison.cases.begin(), comparison.cases.end(),
      [](const verify::StaticComparison& each) { return !verify::missed_targets(each).empty(); });
}

ExitCode present(const FiniteElementComparison& comparison, const VerifyArguments& arguments,
                 Console& console) {
  const std::string command = stress_command(arguments);
  console.print_text(finite_element_text(comparison, command));
  console.print_json(finite_element_json(comparison, command));
  if (arguments.output) {
    const auto written = write_finite_element_files(comparison, command, *arguments.output);
    if (const ExitCode code = present_report(written, *arguments.output, console); code != ExitCode::done)
      return code;
  }
  return misses_a_target(comparison) ? ExitCode::cases_failed : ExitCode::done;
}

}  // namespace

ExitCode compare_with_finite_elements(const VerifyArguments& arguments, Console& console) {
  FiniteElementComparison comparison;
  const auto version = verify::finite_element_version();
  if (!version) {
    return console.refuse(version.error().kind == store::Error::Kind::missing
                              ? "--finite-elements: found no program ccx (CalculiX; Debian: calculix-ccx); "
                                "allowed: where it is installed"
                              : "--finite-elements: " + version.error().message);
  }
  comparison.version = *version;
  const Wanted wanted = wanted_by(arguments.filter);
  if (const auto reason = obstacle(arguments, wanted)) return console.refuse(*reason);
  // Everything below looks at the wish to stop often enough to be waited for, and ends what it called.
  Progress progress(progress_style(console.quiet()));
  const store::MaybeError error = compare(wanted, progress, comparison);
  progress.clear();
  if (stop_requested()) {
    console.error("interrupted; no stress was printed, and there is nothing to keep");
    return ExitCode::interrupted;
  }
  if (error) return console.fail("--finite-elements: " + error->message);
  return present(comparison, arguments, console);
}

}  // namespace launchsafe::app
