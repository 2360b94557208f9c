// The table of kinds, and what several kinds share.
#include "study_keys.hpp"

namespace launchsafe::kinds {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      critical_gap_kind(), calibration_kind(), sensitivity_kind(), accuracy_kind(), stability_kind(),
  };
  return all;
}

const Kind& kind_named(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, [](const Kind& kind) { return kind.traits.name; });
  assert(found != kinds().end());
  return *found;
}

const Kind& kind_of(const Study& study) { return kind_named(study.kind.name); }

StudyOutcome run_study(const StudyFile& study, const StudyOptions& options) {
  return kind_of(study.study).run(study, options);
}

std::size_t count_failed(const std::vector<CaseAnswer>& answers) {
  return answers.size() - static_cast<std::size_t>(std::ranges::count_if(answers, &CaseAnswer::completed));
}

std::string status_of(const CaseAnswer& answer) {
  if (answer.completed()) return "completed";
  return answer.run.status == run::RunStatus::completed ? "failed" : run::to_string(answer.run.status);
}

std::string name_of(const std::vector<ShownKey>& keys, const StudyCase& input) {
  std::string place = place_text(keys, input.coordinates);
  return place.empty() ? input.label : place;
}

std::string failures_list(const std::vector<ShownKey>& keys, const StudyFile& study,
                          const std::vector<CaseAnswer>& answers) {
  constexpr std::size_t named = 3;
  std::vector<std::string> list;
  for (std::size_t i = 0; i < answers.size() && list.size() < named; ++i)
    if (!answers[i].completed())
      list.push_back(fmt::format("{} ({})", name_of(keys, study.cases[i]), answers[i].failure));
  if (const std::size_t failed = count_failed(answers); failed > named)
    list.push_back(fmt::format("and {} more", failed - named));
  return fmt::format("{}", fmt::join(list, "; "));
}

std::string limited_text(const std::vector<CaseAnswer>& answers, const std::string& noun) {
  std::int64_t limited = 0;
  run::LimiterCounts all;
  for (const CaseAnswer& answer : answers) {
    limited += answer.run.limiters.acted() ? 1 : 0;
    all += answer.run.limiters;
  }
  if (limited == 0) return {};
  return fmt::format("Limiters acted in {} ({} particle steps in all), whose results rest on them too.",
                     report::counted(limited, noun), report::limiters_text(all));
}

std::string answer_of(std::vector<std::string> lines, const StudyFile& study) {
  for (std::string& note : report::mesh_notes(study)) lines.push_back(std::move(note));
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<AnsweredCase> answered(const StudyFile& study, const std::vector<CaseAnswer>& answers) {
  return of_each(answers, [&](const CaseAnswer& answer) {
    return AnsweredCase{&study, static_cast<std::size_t>(&answer - answers.data()), &answer};
  });
}

Quantities<AnsweredCase> answered_axes(const Study& study) {
  return of_part<AnsweredCase>(report::axis_quantities(study), &AnsweredCase::coordinates);
}

}  // namespace launchsafe::kinds
