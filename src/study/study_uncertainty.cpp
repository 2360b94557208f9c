#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <utility>

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

/// What a record says of a scene.
struct Recorded {
  std::string reason;           ///< why the bound of the record is not enough, a clause; empty where it is
  double bound = not_a_number;  ///< K, grown to this launch; NaN where the record has none
  double growth = 1.0;          ///< by which the bound was multiplied
  double largest_gap = 0;       ///< m, up to which it holds
};

Recorded recorded_for(const AccuracyRecord& record, const scene::Scene& scene) {
  Recorded recorded;
  recorded.reason = why_foreign(record, scene);
  if (!recorded.reason.empty()) return recorded;
  const RecordedSetting* found = recorded_setting(record, scene);
  if (found == nullptr) {
    recorded.reason = "it does not have these settings";
    return recorded;
  }
  const Coverage coverage = coverage_of(record, scene);
  recorded.reason = coverage.reason;
  recorded.largest_gap = coverage.largest_gap;
  recorded.growth = coverage.growth;
  recorded.bound = found->temperature_bound * coverage.growth;
  return recorded;
}

/// Every case has the bound of its own setting, grown to its own launch. Where the record says nothing of it,
/// it has the assumed one, or the grown bound if that is larger. Either grows with the rise of T max no later
/// than the recorded bound by itself would.
void complete_recorded(const AccuracyRecord& record, StudyCase& made) {
  const Recorded recorded = recorded_for(record, made.scene.scene);
  const bool known = std::isfinite(recorded.bound);
  const bool applies = known && recorded.reason.empty();
  made.numerical_uncertainty = applies ? recorded.bound : assumed_for(made.scene.scene);
  if (known) {
    made.numerical_uncertainty = std::max(made.numerical_uncertainty, recorded.bound);
    made.rise_of_uncertainty = record.rise * recorded.growth * made.numerical_uncertainty / recorded.bound;
    made.covered_gap = recorded.largest_gap;
  }
  made.numerical_uncertainty_assumed = !applies;
  if (!applies) made.why_assumed = recorded.reason;
}

std::string chosen_text(const RecordedSetting& chosen, double growth, double tolerance) {
  return fmt::format("{}: T max within {:.3g} K where {:.3g} K were asked, {:.3g} s of processor time a run",
                     chosen.label, growth * chosen.temperature_bound, tolerance, chosen.processor_time);
}

}  // namespace

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

scene::Expected<std::optional<AccuracyRecord>> read_record(StudyFile& study,
                                                           const std::filesystem::path& folder) {
  const std::string& name = study.study.accuracy;
  if (name.empty()) return std::optional<AccuracyRecord>{};
  if (std::isfinite(study.study.numerical_uncertainty)) {
    return fault_at(study, "numerical_uncertainty.value", "a stated uncertainty beside an accuracy record",
                    "either numerical_uncertainty or accuracy");
  }
  const auto text =
      read_named_file(study, folder, "accuracy", name, "the accuracy.json of an accuracy study");
  if (!text) return text.error();
  study.records.push_back(store::sha256(*text));
  auto record = parse_accuracy_record(*text, (folder / name).string());
  if (!record) return record.error();
  return std::optional<AccuracyRecord>(std::move(*record));
}

Fault choose_setting(StudyFile& study, const std::optional<AccuracyRecord>& record, double tolerance) {
  const std::string asked = fmt::format("a tolerance of {:g} K", tolerance);
  if (!record)
    return fault_at(study, "accuracy", asked + ", and no accuracy record", "accuracy = \"...accuracy.json\"");
  if (has_other_numerics(study)) {
    return fault_at(study, "set", asked + ", and numerics of the study's own",
                    "a tolerance, or numerics in [set] or [[vary]]");
  }
  const scene::Scene& own = study.scene.scene;
  const std::string foreign = why_foreign(*record, own);
  const Coverage coverage = coverage_of(*record, own);
  if (const std::string reason = foreign.empty() ? coverage.reason : foreign; !reason.empty())
    return fault_at(study, "accuracy", asked + ", and a record that does not apply: " + reason,
                    "the record of an accuracy study on this scene");
  const RecordedSetting* chosen = cheapest_within(*record, tolerance / coverage.growth);
  if (chosen == nullptr) {
    const RecordedSetting* best = most_accurate(*record);
    return fault_at(study, "accuracy", asked + ", which no recorded setting meets",
                    best == nullptr ? "a record with settings"
                                    : fmt::format("at least {:.3g} K, the bound of the most accurate one: {}",
                                                  best->temperature_bound * coverage.growth, best->label));
  }
  std::vector<Change> changes;
  for (const auto& [name, value] : chosen->setting) {
    // Reading let nothing else pass than the keys of a setting with values that scenes may have.
    const auto* key = scene::find_key(scene::scene_keys(), name);
    changes.push_back(
        {name, value, scene::format_value(*key, value), "accuracy", place_of_key(study, "accuracy")});
  }
  auto changed = with_changes(study.scene, changes);
  if (!changed) return changed.error();
  study.scene = std::move(*changed);
  study.chosen_setting = chosen_text(*chosen, coverage.growth, tolerance);
  return std::nullopt;
}

double numerical_share(const StudyCase& input, double gap, double rise) {
  constexpr double round_off = 1e-9;
  const bool covered = gap <= input.covered_gap * (1.0 + round_off);
  const double here = covered ? input.numerical_uncertainty
                              : std::max(input.numerical_uncertainty, assumed_for(input.scene.scene));
  const double hotter = rise / input.rise_of_uncertainty;
  return here * (hotter > 1.0 ? hotter : 1.0);
}

void settle_uncertainty(StudyFile& study, const std::optional<AccuracyRecord>& record) {
  if (!record) return study.cases.complete_with(with_stated(study));
  const auto shared = std::make_shared<const AccuracyRecord>(*record);
  study.cases.complete_with([shared](StudyCase& made) { complete_recorded(*shared, made); });
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
