// The answer, the page and the files of a stability study.
#include "launchsafe/kinds/stability_report.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_text.hpp"
#include "stability_text.hpp"
#include "sweep_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using verify::Outcome;

std::string counts_text(const StabilityResult& result) {
  return fmt::format("{}: {} held, {} degraded with a reason, {} caught, {} WRONG.",
                     counted(result.rows.size(), "stress case"), result.count(Outcome::held),
                     result.count(Outcome::degraded), result.count(Outcome::caught), result.wrong());
}

/// Rows of one sort by name and finding, a line each.
template <class Belongs>
std::string list_of(const StabilityResult& result, const std::string& heading, Belongs belongs) {
  std::string text;
  for (const StressCaseRow& row : result.rows) {
    if (!belongs(row)) continue;
    if (text.empty()) text = heading;
    text += fmt::format("\n- {}: {}: {}", row.group, row.name, finding_text(row));
  }
  return text;
}

std::string wrong_text(const StabilityResult& result) {
  if (result.wrong() == 0) return result.failed() == 0 ? "No broken computation passes for a sound one." : "";
  return list_of(result,
                 fmt::format("WRONG: {} in which a broken computation gave a plausible verdict.",
                             counted(result.wrong(), "case")),
                 [](const StressCaseRow& row) { return row.is_wrong(); });
}

std::string unexpected_text(const StabilityResult& result) {
  return list_of(result, "Not as the study expects:", [](const StressCaseRow& row) {
    return row.computed() && !row.is_wrong() && !row.is_as_expected();
  });
}

std::string failed_text(const StabilityResult& result) {
  return list_of(result, "Not computed:", [](const StressCaseRow& row) { return !row.computed(); });
}

std::string legend() {
  return "- **held**: what must hold held.\n"
         "- **degraded**: it did not, or a limiter acted or a validity warning holds, and the result says so "
         "itself: "
         "the verdict is indeterminate, or names the limiter.\n"
         "- **caught**: the run was stopped and flagged, or the reader refused the scene.\n"
         "- **WRONG**: an invariant is violated, or T max is further from a safe computation of the same "
         "launch "
         "than its stated uncertainty, and yet a verdict says SAFE or UNSAFE.\n\n"
         "Invariants of every completed launch: all numbers finite; masses of the particles to 1e-12; "
         "momentum "
         "relative to the co-moving frame below 1e-6 of the load's impulse, or equal to it in the lab's "
         "frame; "
         "energy drift within the scene's limit; plastic, viscous and crack dissipation and friction heat "
         "that "
         "never fall; no skin colder than at first.\n";
}

std::string uncertainty_text(const study::Study& study) {
  return fmt::format(
      "Verdicts of the launches are judged with a numerical uncertainty of {} K unless their "
      "case states its own; with a large one assumed, nothing could be WRONG.\n",
      significant(study.numerical_uncertainty, 3));
}

nlohmann::ordered_json counts_json(const StabilityResult& result) {
  return {{"cases", result.rows.size()},
          {"held", result.count(Outcome::held)},
          {"degraded", result.count(Outcome::degraded)},
          {"caught", result.count(Outcome::caught)},
          {"WRONG", result.wrong()},
          {"not_as_expected", result.unexpected()},
          {"not_computed", result.failed()}};
}

}  // namespace

std::string answer(const StabilityResult& result) {
  std::vector<std::string> lines{counts_text(result), wrong_text(result), unexpected_text(result),
                                 failed_text(result)};
  if (result.interrupted) lines.emplace_back("The study was interrupted: some cases were not computed.");
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Report report_of(const StabilityResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.items = {
      ReportTable{.table = stability_summary(result), .shown = Shown::terminal},
      ReportTable{stability_table(result), "stability.csv", "cases", Shown::page},
      Statement{"## What the outcomes mean\n\n" + legend()},
      Statement{uncertainty_text(result.study.study)},
      ReportTable{launch_table(result), "launches.csv", "launches", Shown::page},
      Statement{"## Setup\n\n" + setup_text(result.study)},
  };
  report.json = study_json(result.study, report, {{"counts", counts_json(result)}});
  return report;
}

}  // namespace launchsafe::kinds
