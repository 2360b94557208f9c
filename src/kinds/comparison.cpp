#include "launchsafe/kinds/comparison.hpp"

#include "launchsafe/study/case_answer.hpp"
#include "study_outcome.hpp"

#include <algorithm>

namespace launchsafe::kinds {

bool ComparisonResult::any_indeterminate() const {
  return std::ranges::any_of(answers, [](const ComparedCase& each) {
    return each.critical.kind == study::CriticalGapKind::indeterminate;
  });
}

namespace {

void judge(const Variant& variant, const study::StudyCase& input, std::vector<study::FinishedRun>& runs,
           ComparedCase& of) {
  static_cast<study::CaseAnswer&>(of) = answer_from(variant.judged, input, runs);
  if (run_without_result(runs) != nullptr || was_cut_off(runs.front())) return;
  const run::MechanicsResult& mechanics = runs.front().result.mechanics;
  of.processor_time = mechanics.work_time();
  if (!of.completed()) return;
  const surface::SkinModel model = study::without_reaction(surface::skin_model(input.scene.scene));
  for (const double gap : variant.judged.gaps)
    of.stations.push_back(
        study::station_temperatures(surface::integrate_skin(model, mechanics.trace, gap), mechanics.trace));
}

}  // namespace

ComparisonResult run_comparison(const study::StudyFile& study, const study::StudyOptions& options) {
  return run_timed<ComparisonResult>(
      study, options,
      [&](ComparisonResult& result) {
        result.answers.resize(study.cases.size());
        run_every_case(study, options, result.timing,
                       [&](std::size_t i, std::vector<study::FinishedRun>& runs) {
                         ComparedCase& of = result.answers[i];
                         of.variant = i / result.cases_per_variant();
                         judge(result.variants()[of.variant], study.cases[i], runs, of);
                       });
      },
      [](ComparisonResult&) {});
}

}  // namespace launchsafe::kinds
