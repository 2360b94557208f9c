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

std::size_t count_failed(const std::vector<CaseRow>& rows) {
  return rows.size() - static_cast<std::size_t>(std::ranges::count_if(rows, &CaseRow::completed));
}

std::string status_of(const CaseRow& row) {
  if (row.completed()) return "completed";
  return row.run.status == run::RunStatus::completed ? "failed" : run::to_string(row.run.status);
}

std::string name_of(const std::vector<ShownKey>& keys, const StudyCase& input) {
  std::string place = place_text(keys, input.coordinates);
  return place.empty() ? input.label : place;
}

std::string failures_list(const std::vector<ShownKey>& keys, const StudyFile& study,
                          const std::vector<CaseRow>& rows) {
  constexpr std::size_t named = 3;
  std::vector<std::string> list;
  for (std::size_t i = 0; i < rows.size() && list.size() < named; ++i)
    if (!rows[i].completed())
      list.push_back(fmt::format("{} ({})", name_of(keys, study.cases[i]), rows[i].failure));
  if (const std::size_t failed = count_failed(rows); failed > named)
    list.push_back(fmt::format("and {} more", failed - named));
  return fmt::format("{}", fmt::join(list, "; "));
}

std::string limited_text(const std::vector<CaseRow>& rows, const std::string& noun) {
  std::int64_t limited = 0;
  run::LimiterCounts all;
  for (const CaseRow& row : rows) {
    limited += row.run.limiters.acted() ? 1 : 0;
    all += row.run.limiters;
  }
  if (limited == 0) return {};
  return fmt::format("Limiters acted in {} ({} particle steps in all), whose results rest on them too.",
                     report::counted(limited, noun), report::limiters_text(all));
}

std::string joined_lines(std::vector<std::string> lines) {
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<PlacedCase> placed(const StudyFile& study, const std::vector<CaseRow>& rows) {
  return of_each(rows, [&](const CaseRow& row) {
    return PlacedCase{&study, static_cast<std::size_t>(&row - rows.data()), &row};
  });
}

Quantities<PlacedCase> placed_axes(const Study& study) {
  return of_part<PlacedCase>(report::axis_quantities(study), &PlacedCase::coordinates);
}

}  // namespace launchsafe::kinds
