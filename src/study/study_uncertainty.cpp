#include "study_uncertainty.hpp"

#include "changed_scene.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study::detail {
namespace {

/// Whether any case has other numerics than the scene as it was written.
bool has_other_numerics(const StudyFile& study) {
  const auto varies = [](const auto& each) { return belongs_to_setting(each.key.name); };
  const Study& s = study.study;
  return std::any_of(study.overrides.begin(), study.overrides.end(),
                     [](const auto& each) { return belongs_to_setting(each.first); }) ||
         std::any_of(s.axes.begin(), s.axes.end(), varies) ||
         std::any_of(s.inputs.begin(), s.inputs.end(), varies);
}

/// Where a study states a number itself. It belongs to the scene's own numerics on a grid that runs along the
/// charge's edges.
void settle_stated(StudyFile& study) {
  Study& s = study.study;
  const bool unstated = !std::isfinite(s.numerical_uncertainty);
  const bool applies =
      !unstated && !has_other_numerics(study) && scene::charge_edges_off_grid(study.scene.scene).empty();
  if (applies) {
    study.uncertainty_source = "as the study states";
  } else {
    s.numerical_uncertainty_assumed = unstated || s.numerical_uncertainty < assumed_numerical_uncertainty;
    if (s.numerical_uncertainty_assumed) s.numerical_uncertainty = assumed_numerical_uncertainty;
    study.uncertainty_source = s.numerical_uncertainty_assumed
                                   ? "assumed, as the study states none for these settings"
                                   : "as the study states";
  }
  for (StudyCase& each : study.cases) each.numerical_uncertainty = s.numerical_uncertainty;
}

/// Every case has the bound of its own setting; one that the record does not have, the assumed one.
void settle_recorded(StudyFile& study, const AccuracyRecord& record) {
  Study& s = study.study;
  s.numerical_uncertainty = 0.0;
  std::string why;
  for (StudyCase& each : study.cases) {
    const scene::Scene& scene = each.scene.scene;
    const std::string foreign = why_foreign(record, scene);
    const RecordedSetting* found = foreign.empty() ? recorded_setting(record, scene) : nullptr;
    if (found != nullptr && std::isfinite(found->temperature_bound)) {
      each.numerical_uncertainty = found->temperature_bound;
      each.rise_of_uncertainty = record.rise;
    } else {
      why = foreign.empty() ? "it does not have these settings" : foreign;
      s.numerical_uncertainty_assumed = true;
    }
    s.numerical_uncertainty = std::max(s.numerical_uncertainty, each.numerical_uncertainty);
  }
  study.uncertainty_source =
      s.numerical_uncertainty_assumed
          ? fmt::format("assumed where the accuracy record `{}` does not help: {}", s.accuracy, why)
          : fmt::format("from the accuracy record `{}`", s.accuracy);
}

/// Whether a key may have a value that no scene file's reader has checked.
bool may_take(const scene::KeyDescription& key, const scene::Value& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return std::find(key.words.begin(), key.words.end(), *word) != key.words.end();
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return true;
  const bool whole = key.dimension != scene::Dimension::count || *number == std::round(*number);
  return std::isfinite(*number) && whole && key.limits.contain(*number);
}

std::string chosen_text(const RecordedSetting& chosen, double tolerance) {
  return fmt::format("{}: T max within {:.3g} K where {:.3g} K were asked, {:.3g} s of processor time a run",
                     chosen.label, chosen.temperature_bound, tolerance, chosen.processor_time);
}

}  // namespace

scene::Expected<std::optional<AccuracyRecord>> read_record(const StudyFile& study,
                                                           const std::filesystem::path& folder) {
  const std::string& name = study.study.accuracy;
  if (name.empty()) return std::optional<AccuracyRecord>{};
  if (std::isfinite(study.study.numerical_uncertainty)) {
    return fault_at(study, "numerical_uncertainty", "a stated uncertainty beside an accuracy record",
                    "either numerical_uncertainty or accuracy");
  }
  const auto text = scene::read_text_file(folder / name);
  if (!text) {
    return fault_at(study, "accuracy", fmt::format("\"{}\", which cannot be read", name),
                    "the accuracy.json of an accuracy study, by its path from the study file's folder",
                    text.error().suggestion);
  }
  auto record = accuracy_record_from(*text);
  if (!record) {
    return fault_at(study, "accuracy", fmt::format("\"{}\", which is no accuracy record", name),
                    "the accuracy.json of an accuracy study");
  }
  return record;
}

Fault choose_setting(StudyFile& study, const std::optional<AccuracyRecord>& record, double tolerance) {
  const std::string asked = fmt::format("a tolerance of {:g} K", tolerance);
  if (!record)
    return fault_at(study, "accuracy", asked + ", and no accuracy record", "accuracy = \"...accuracy.json\"");
  if (has_other_numerics(study)) {
    return fault_at(study, "set", asked + ", and numerics of the study's own",
                    "a tolerance, or numerics in [set], [axes] or [[input]]");
  }
  if (const std::string foreign = why_foreign(*record, study.scene.scene); !foreign.empty())
    return fault_at(study, "accuracy", asked + ", and a record that does not apply: " + foreign,
                    "the record of an accuracy study on this scene");
  const RecordedSetting* chosen = cheapest_within(*record, tolerance);
  if (chosen == nullptr) {
    const RecordedSetting* best = most_accurate(*record);
    return fault_at(study, "accuracy", asked + ", which no recorded setting meets",
                    best == nullptr ? "a record with settings"
                                    : fmt::format("at least {:.3g} K, the bound of the most accurate one: {}",
                                                  best->temperature_bound, best->label));
  }
  ChangedScene scene(study.scene);
  for (const auto& [name, value] : chosen->setting) {
    const auto* key = scene::find_key(scene::scene_keys(), name);
    if (key == nullptr || !may_take(*key, value) || key->get(study.scene.scene).index() != value.index())
      return fault_at(study, "accuracy", fmt::format("the setting {}, which no scene has", name),
                      "a record of this version of the program");
    scene.apply({name, value, scene::format_value(*key, value), "accuracy", place_of_key(study, "accuracy")});
  }
  if (!scene.complete()) return scene.error();
  study.scene = scene.take();
  study.chosen_setting = chosen_text(*chosen, tolerance);
  return std::nullopt;
}

void settle_uncertainty(StudyFile& study, const std::optional<AccuracyRecord>& record) {
  if (record) {
    settle_recorded(study, *record);
  } else {
    settle_stated(study);
  }
}

}  // namespace launchsafe::study::detail
