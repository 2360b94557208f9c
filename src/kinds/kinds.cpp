// The table of kinds, and what several kinds share.
#include "answer_tables.hpp"
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/comparison.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/kinds/stability.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <cassert>

namespace launchsafe::kinds {

using study::CaseAnswer, study::StudyFile;

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      critical_gap_kind(), calibration_kind(), sensitivity_kind(),
      accuracy_kind(),     stability_kind(),   comparison_kind(),
  };
  return all;
}

const Kind& kind_named(std::string_view name) {
  const auto found =
      std::ranges::find_if(kinds(), [name](const Kind& kind) { return kind.traits.name == name; });
  assert(found != kinds().end());
  return *found;
}

const Kind& kind_of(const study::Study& study) { return kind_named(study.kind.name); }

StudyOutcome run_study(const study::StudyFile& study, const study::StudyOptions& options) {
  return kind_of(study.study).run(study, options);
}

bool may_write(const Kind& kind, std::string_view name) {
  return name == "report.md" || name == "study.json" ||
         std::ranges::any_of(
             kind.files,
             [&](const char* each) { return ::fnmatch(each, std::string(name).c_str(), 0) == 0; }) ||
         std::ranges::any_of(kind.results(),
                             [name](const report::ReportTable& table) { return table.csv == name; });
}

SweepCounts counts_of(const std::vector<CaseAnswer>& answers) {
  SweepCounts counts;
  counts.cases = answers.size();
  for (const CaseAnswer& answer : answers) {
    if (!answer.completed()) ++counts.failed;
    if (report::acted(answer.run.limiters)) ++counts.limited;
    counts.limiters.crack_at_bound += answer.run.limiters.crack_at_bound;
    counts.limiters.tension_cutoff += answer.run.limiters.tension_cutoff;
    counts.limiters.hugoniot_guard += answer.run.limiters.hugoniot_guard;
    ++counts.critical_gaps.at(answer.critical.kind);
    for (const study::GapVerdict& row : answer.verdicts) ++counts.verdicts.at(row.judgement.verdict);
  }
  return counts;
}

std::string status_of(const CaseAnswer& answer) {
  if (answer.completed()) return "completed";
  return answer.run.status == run::RunStatus::completed ? "failed" : run::to_string(answer.run.status);
}

std::string name_of(const std::vector<report::ShownKey>& keys, const study::StudyCase& input) {
  std::string place = place_text(keys, input.coordinates);
  return place.empty() ? input.label : place;
}

std::string failures_list(const std::vector<report::ShownKey>& keys, const StudyFile& study,
                          const std::vector<CaseAnswer>& answers) {
  constexpr std::size_t named = 3;
  std::size_t failed = 0;
  std::string list;
  for (std::size_t i = 0; i < std::min(answers.size(), study.cases.size()); ++i) {
    if (answers[i].completed()) continue;
    if (++failed > named) continue;
    list +=
        fmt::format("{}{} ({})", list.empty() ? "" : "; ", name_of(keys, study.cases[i]), answers[i].failure);
  }
  if (failed > named) list += fmt::format("; and {} more", failed - named);
  return list;
}

std::string limited_text(const SweepCounts& counts, const std::string& noun) {
  if (counts.limited == 0) return {};
  return fmt::format("Limiters acted in {} ({} particle steps in all), whose results rest on them too.",
                     report::counted(counts.limited, noun), report::limiters_text(counts.limiters));
}

std::string answer_of(std::vector<std::string> lines, const StudyFile& study) {
  for (std::string& note : report::mesh_notes(study)) lines.push_back(std::move(note));
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<AnsweredCase> answered(const StudyFile& study, const std::vector<CaseAnswer>& answers) {
  std::vector<AnsweredCase> cases;
  for (std::size_t i = 0; i < answers.size(); ++i) cases.push_back({&study, i, &answers[i]});
  return cases;
}

report::Quantities<AnsweredCase> answered_axes(const study::Study& study) {
  return of_part<AnsweredCase>(report::axis_quantities(study), &AnsweredCase::coordinates);
}

}  // namespace launchsafe::kinds
