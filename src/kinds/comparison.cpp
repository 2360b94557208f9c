#include "launchsafe/kinds/comparison.hpp"

#include "launchsafe/study/answer_cases.hpp"
#include "study_outcome.hpp"

#include <algorithm>
#include <utility>

namespace launchsafe::kinds {

using namespace study;

bool ComparisonResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), [](const ComparedCase& each) {
    return each.critical.kind == CriticalGapKind::indeterminate;
  });
}

namespace {

void judge(const Variant& variant, const StudyCase& input, std::vector<FinishedRun>& runs, ComparedCase& of) {
  static_cast<CaseAnswer&>(of) = answer_from(variant.judged, input, runs);
  if (run_without_result(runs) != nullptr || was_cut_off(runs.front())) return;
  const run::MechanicsResult& mechanics = runs.front().result.mechanics;
  of.processor_time = mechanics.processor_time > 0 ? mechanics.processor_time : mechanics.wall_time;
  if (!of.completed()) return;
  const surface::SkinModel model = without_reaction(surface::skin_model(input.scene.scene));
  for (const double gap : variant.judged.gaps)
    of.stations.push_back(
        station_temperatures(surface::integrate_skin(model, mechanics.trace, gap), mechanics.trace));
}

}  // namespace

ComparisonResult run_comparison(const StudyFile& study, const StudyOptions& options) {
  return run_timed<ComparisonResult>(
      study, options,
      [&](ComparisonResult& result) {
        result.answers.resize(study.cases.size());
        run_every_case(study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
          ComparedCase& of = result.answers[i];
          of.variant = i / result.cases_per_variant();
          judge(result.variants()[of.variant], study.cases[i], runs, of);
        });
      },
      [](ComparisonResult&) {});
}

}  // namespace launchsafe::kinds
