#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/constants_of_study.hpp"

#include <ranges>

namespace launchsafe::study {
namespace {

/// Whether any case has an input of a kind otherwise than the scene as it was written.
bool has_other(const StudyFile& study, bool (*is_of_the_kind)(const scene::KeyDescription& key)) {
  const auto varies = [=](const Axis& each) { return is_of_the_kind(each.key); };
  const auto overrides = [&](const auto& each) {
    const auto key = scene::describe_key(study.scene, each.first, {});
    return !key || is_of_the_kind(*key);
  };
  return std::ranges::any_of(study.overrides, overrides) || std::ranges::any_of(study.study.axes, varies);
}

bool has_other_numerics(const StudyFile& study) { return has_other(study, belongs_to_setting); }

/// The mesh has another error in another model of the mechanics: where the charge is held otherwise, say.
bool has_other_model(const StudyFile& study) {
  return has_other(study, [](const scene::KeyDescription& key) {
    return key.role().part == keys::Part::model && key.role().acts_on == keys::ActsOn::mechanics;
  });
}

/// K; 0 where nothing is stated.
double stated_of(const Study& study) {
  return std::isfinite(study.numerical_uncertainty) ? study.numerical_uncertainty : 0.0;
}

/// K, where nothing is known of the numerics of a scene.
double assumed_for(const scene::Scene& scene) {
  const bool as_calibrated =
      scene.numerics.particles_per_cell == 1 && scene::charge_edges_off_grid(scene).empty();
  return as_calibrated ? assumed_numerical_uncertainty : assumed_uncertainty_off_grid;
}

/// Where a study states a number itself. It belongs to the scene's own numerics and model on a grid that
/// runs along the charge's edges.
Cases::Complete with_stated(const StudyFile& study) {
  const double stated = stated_of(study.study);
  const bool own = stated > 0.0 && !has_other_numerics(study) && !has_other_model(study) &&
                   scene::charge_edges_off_grid(study.scene.scene).empty();
  return [stated, own](StudyCase& made) {
    made.numerical_uncertainty_assumed = !own;
    made.numerical_uncertainty = own ? stated : std::max(stated, assumed_for(made.scene.scene));
  };
}

/// The first that is of the scene's shell and model; where none is, the first.
const AccuracyRecord& record_for(const AccuracyRecords& records, const scene::Scene& scene) {
  const auto found = std::ranges::find_if(
      records, [&](const AccuracyRecord& each) { return why_foreign(each, scene).empty(); });
  return found == records.end() ? records.front() : *found;
}

/// Every case has the bound of its own setting, grown to its own launch. Where the record says nothing of it,
/// it has the assumed one, or the grown bound if that is larger. Either grows with the rise of T max no later
/// than the recorded bound by itself would.
void complete_recorded(const std::shared_ptr<const AccuracyRecords>& records, StudyCase& made) {
  const scene::Scene& scene = made.scene.scene;
  const AccuracyRecord& record = record_for(*records, scene);
  made.numerical_uncertainty = assumed_for(scene);
  made.numerical_uncertainty_assumed = true;
  made.why_assumed = why_foreign(record, scene);
  if (!made.why_assumed.empty()) return;
  made.why_assumed = "it does not have these settings";
  const RecordedSetting* found = recorded_setting(record, scene);
  if (found == nullptr) return;
  const Coverage coverage = coverage_of(record, scene);
  made.why_assumed = coverage.reason;
  const double bound = found->temperature_bound * coverage.growth;
  if (!std::isfinite(bound)) return;
  made.numerical_uncertainty_assumed = !coverage.reason.empty();
  made.numerical_uncertainty = coverage.reason.empty() ? bound : std::max(made.numerical_uncertainty, bound);
  made.rise_of_uncertainty = record.rise * coverage.growth * made.numerical_uncertainty / bound;
  made.covered_gap = coverage.largest_gap;
}

}  // namespace

double fit_share(const Study& study, const RecordDistance& distance, const Rises& rises) {
  if (!study.kind.gives_verdicts) return 0.0;
  const CalibrationEvidence& evidence = study.calibration.evidence;
  double fit = std::isfinite(study.fit_uncertainty) ? study.fit_uncertainty : evidence.fit_uncertainty;
  if (distance.other_load_shape) fit = std::max(fit, assumed_other_load_shape);
  const double growth = std::hypot(rises.friction / evidence.friction_rise, rises.air / evidence.air_rise);
  fit *= growth <= 1.0 ? 1.0 : growth;
  return distance.other_numerics ? std::hypot(fit, assumed_numerical_uncertainty) : fit;
}

double stated_input_share(const Study& study, const StudyCase& input) {
  if (!std::isfinite(study.input_uncertainty)) return 0.0;
  const double growth = std::pow(input.pressure_ratio, heat_exponent);
  return study.input_uncertainty * (growth <= 1.0 ? 1.0 : growth);
}

bool assumes_computation(const StudyCase& input, double critical_gap) {
  return input.numerical_uncertainty_assumed || critical_gap > input.covered_gap * (1.0 + 1e-9);
}

double load_curve_share(const scene::Load& load) {
  const double kept = 1.0 - scene::peak_lost_to_smoothing(load);
  return std::pow((1.0 + scene::peak_missed_between_points(load)) / kept, heat_exponent) - 1.0;
}

AcceptancesOfStudy acceptances_of(const StudyFile& study) {
  AcceptancesOfStudy all;
  // Cases that bring constants of their own are held against those, one by one.
  if (!study.study.kind.gives_verdicts || study.study.kind.own_scenes) return all;
  std::set<std::string> seen;
  const auto is_new = [&seen](const std::string& said) { return seen.insert(said).second; };
  for (const StudyCase& input : study.cases) {
    CaseStatements statements = statements_of(study.study, input);
    std::vector<scene::Implausible> to_be_accepted = statements.to_be_accepted();
    const std::vector<double>& gaps = study.study.gaps;
    if (!gaps.empty() && statements.is_beyond(std::ranges::max(gaps)))
      statements.extrapolated.emplace_back("gap");
    for (scene::Implausible& each : to_be_accepted) {
      const std::string& value = each.accepted() ? each.accepted_value : each.value;
      if (is_new(fmt::format("{} = {} {}", each.key, value, each.accepted())))
        (each.accepted() ? all.accepted : all.missing).push_back(std::move(each));
    }
    for (std::string& each : statements.extrapolated)
      if (is_new(each)) all.extrapolated.push_back(std::move(each));
  }
  for (const auto* accepted : {&study.study.accepted, &study.scene.scene.accepted})
    for (const auto& [key, value, because] : *accepted)
      if (is_new(fmt::format("{} = {} {}", key, value, true)))
        all.unneeded.push_back(fmt::format("{} = {}", key, value));
  return all;
}

std::string commonest_first(const std::map<std::string, std::size_t>& reasons, std::size_t cases) {
  constexpr std::size_t most_named = 3;
  std::vector<std::pair<std::string, std::size_t>> ordered(reasons.begin(), reasons.end());
  std::ranges::stable_sort(ordered, std::ranges::greater{}, &std::pair<std::string, std::size_t>::second);
  std::string text;
  std::size_t named = 0;
  for (const auto& [reason, count] : ordered) {
    if (named++ == most_named) return text + "; and so on";
    if (named > 1) text += "; ";
    text += cases == 1 ? reason : fmt::format("{} ({} of {} cases)", reason, count, cases);
  }
  return text;
}

AccuracyRecords read_records(StudyFile& study, const std::filesystem::path& folder) {
  AccuracyRecords records;
  const std::string& names = study.study.accuracy;
  if (!names.empty() && std::isfinite(study.study.numerical_uncertainty))
    refuse_at(study, "numerical_uncertainty.value", "a stated uncertainty beside an accuracy record",
              "either numerical_uncertainty or accuracy");
  for (const auto part : std::views::split(names, std::string_view(", "))) {
    const std::string name(part.begin(), part.end());
    records.push_back(read_named_record(study, folder, "accuracy", name,
                                        "the accuracy.json of an accuracy study", parse_accuracy_record));
  }
  return records;
}

void choose_setting(StudyFile& study, const AccuracyRecords& records, double tolerance) {
  const std::string asked = fmt::format("a tolerance of {:g} K", tolerance);
  if (records.empty())
    refuse_at(study, "accuracy", asked + ", and no accuracy record", "accuracy = \"...accuracy.json\"");
  if (has_other_numerics(study))
    refuse_at(study, "set", asked + ", and numerics of the study's own",
              "a tolerance, or numerics in [set] or [[vary]]");
  const scene::Scene& own = study.scene.scene;
  const AccuracyRecord& record = record_for(records, own);
  const std::string foreign = why_foreign(record, own);
  const Coverage coverage = coverage_of(record, own);
  if (const std::string reason = foreign.empty() ? coverage.reason : foreign; !reason.empty())
    refuse_at(study, "accuracy", asked + ", and a record that does not apply: " + reason,
              "the record of an accuracy study on this scene");
  const RecordedSetting* chosen = cheapest_within(record, tolerance / coverage.growth);
  if (chosen == nullptr) {
    const RecordedSetting* best = most_accurate(record);
    refuse_at(study, "accuracy", asked + ", which no recorded setting meets",
              best == nullptr ? "a record with settings"
                              : fmt::format("at least {:.3g} K, the bound of the most accurate one: {}",
                                            best->temperature_bound * coverage.growth, best->label));
  }
  // Reading let nothing else pass than the keys of a setting with values that scenes may have.
  set_keys(study, chosen->setting, "accuracy");
  study.chosen_setting = fmt::format(
      "{}: T max within {:.3g} K where {:.3g} K were asked, {:.3g} s of processor time a run", chosen->label,
      coverage.growth * chosen->temperature_bound, tolerance, chosen->processor_time);
}

double numerical_share(const StudyCase& input, double gap, double rise) {
  constexpr double round_off = 1e-9;
  const bool covered = gap <= input.covered_gap * (1.0 + round_off);
  const double here = covered ? input.numerical_uncertainty
                              : std::max(input.numerical_uncertainty, assumed_for(input.scene.scene));
  const double hotter = rise / input.rise_of_uncertainty;
  return here * (hotter > 1.0 ? hotter : 1.0);
}

void settle_uncertainty(StudyFile& study, const AccuracyRecords& records) {
  if (records.empty()) return study.cases.complete_with(with_stated(study));
  const auto shared = std::make_shared<const AccuracyRecords>(records);
  study.cases.complete_with([shared](StudyCase& made) { complete_recorded(shared, made); });
}

NumericalUncertainty numerical_uncertainty_of(const StudyFile& study) {
  NumericalUncertainty all{stated_of(study.study), false, {}};
  std::map<std::string, std::size_t> reasons;
  for (const StudyCase& each : study.cases) {
    all.largest = std::max(all.largest, each.numerical_uncertainty);
    if (each.numerical_uncertainty_assumed) ++reasons[each.why_assumed];
  }
  const std::string& record = study.study.accuracy;
  if (record.empty()) {
    all.assumed = all.largest > stated_of(study.study);
    all.source = all.assumed ? "assumed, as the study states none for these settings" : "as the study states";
    return all;
  }
  all.assumed = !reasons.empty();
  all.source = all.assumed ? fmt::format("assumed where the accuracy record `{}` does not help: {}", record,
                                         commonest_first(reasons, study.cases.size()))
                           : fmt::format("from the accuracy record `{}`", record);
  return all;
}

}  // namespace launchsafe::study
