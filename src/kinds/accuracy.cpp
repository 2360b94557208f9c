#include "launchsafe/kinds/accuracy.hpp"

#include "launchsafe/scene/plan.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::RecordedSetting, study::ReferenceValue;

namespace {

std::vector<double> errors_against(const std::vector<ReferenceValue>& references,
                                   const std::vector<double>& values) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < references.size(); ++i)
    errors.push_back(error_against(references[i], values[i]));
  return errors;
}

void find_errors(const AccuracyReference& reference, AccuracyRow& row) {
  row.temperature_error = errors_against(reference.temperature, row.setting.temperature);
  row.largest_temperature_error = 0.0;
  for (const double error : row.temperature_error)
    row.largest_temperature_error = study::larger_bound(row.largest_temperature_error, std::abs(error));
  row.critical_gap_error = error_against(reference.critical_gap, row.setting.critical_gap);
}

/// What a run came to and what it cost, without comparing it.
AccuracyRow measure(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  const Scene& scene = input.scene.scene;
  AccuracyRow row;
  row.setting.label = input.label;
  row.setting.setting = study::setting_of(scene);
  row.answer = answer_from(study, input, runs);
  if (!runs.front().has_result()) return row;
  const MechanicsResult& mechanics = runs.front().result.mechanics;
  const scene::CellRange mesh = scene::cells_of_charge(scene);
  row.setting.cell = std::sqrt(mesh.shortest_x * mesh.shortest_r);
  row.setting.processor_time = mechanics.work_time();
  if (!row.computed()) return row;
  for (const FinishedRun& run : runs)
    if (row.validity_warnings.empty())
      row.validity_warnings =
          fmt::format("{}", fmt::join(run::validity_warnings(scene, run.result.mechanics), "; "));
  return row;
}

void run_settings(AccuracyResult& result, const StudyOptions& options) {
  std::vector<std::pair<VariantAccuracy*, std::size_t>> places;  // of every case of the study
  for (VariantAccuracy& variant : result.variants) {
    variant.rows.resize(variant.study.cases.size());
    for (std::size_t i = 0; i < variant.rows.size(); ++i) places.emplace_back(&variant, i);
  }
  run_every_case(result.study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
    const auto& [variant, place] = places[i];
    variant->rows[place] = measure(variant->study.study, variant->study.cases[place], runs);
  });
}

/// A gap at which any sound setting of the same model ignites is compared by a skin that does not react:
/// after ignition T max is that of the flame.
std::vector<bool> inert_gaps(const VariantAccuracy& variant) {
  std::vector<bool> inert(variant.study.study.gaps.size(), false);
  for (const AccuracyRow& row : variant.rows) {
    if (row.other_model || !row.sound()) continue;
    for (std::size_t gap = 0; gap < inert.size(); ++gap)
      inert[gap] = inert[gap] || row.answer.verdicts[gap].ignition;
  }
  return inert;
}

void tell_apart(VariantAccuracy& variant, std::size_t meshes) {
  const StudyFile& study = variant.study;
  const study::Setting own = study::setting_of(study.scene.scene);
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    AccuracyRow& row = variant.rows[i];
    row.setting.reference = i < meshes;
    // Where it differs from the study's scene in more than a setting.
    row.other_model = std::ranges::any_of(
        study::differences(study.cases[i].scene.scene, study.scene.scene),
        [](const study::Difference& each) { return !study::belongs_to_setting(each.key); });
    row.baseline = !row.other_model && study::same_setting(row.setting.setting, own);
  }
}

/// What is compared of every row: T max, at inert gaps of a skin that does not react, and the critical gap.
/// The temperature of a flame is none: how far that is off says nothing.
void fill_settings(const std::vector<bool>& inert, std::vector<AccuracyRow>& rows) {
  for (AccuracyRow& row : rows) {
    if (!row.computed()) continue;
    row.setting.critical_gap = row.answer.critical.value;
    for (std::size_t gap = 0; gap < inert.size(); ++gap) {
      const bool burns = !inert[gap] && row.answer.verdicts[gap].ignition;
      row.setting.temperature.push_back(burns ? not_a_number : temperature_of(row.answer, gap, inert[gap]));
    }
  }
}

/// Whether its temperatures are such as explosives have.
bool is_usual(const RecordedSetting& setting) {
  return std::ranges::all_of(setting.temperature,
                             [](double kelvin) { return kelvin <= study::highest_recorded_temperature; });
}

/// Of the sound settings of the same model; none that has temperatures which nothing has.
study::AccuracyRecord record_of(const VariantAccuracy& variant) {
  const Scene& scene = variant.study.scene.scene;
  study::AccuracyRecord record;
  record.title = variant.study.study.title;
  record.scene = scene;
  scene::clear_remarks(record.scene);
  record.scene.accepted.clear();
  record.scene.surface.gaps = variant.study.study.gaps;
  for (const AccuracyRow& row : variant.rows) {
    const RecordedSetting& setting = row.setting;
    // 0.25 cm is not always 2.5 mm to the last digit.
    const bool known = std::ranges::any_of(record.settings, [&](const RecordedSetting& each) {
      return study::same_setting(each.setting, setting.setting);
    });
    if (row.sound() && !row.other_model && is_usual(setting) && !known) record.settings.push_back(setting);
  }
  find_bounds(record);
  return record;
}

void compare(VariantAccuracy& variant) {
  const std::size_t meshes = settings_of<AccuracySettings>(variant.study).reference_cell_sizes.size();
  const std::span<const AccuracyRow> finest_first(variant.rows.data(), meshes);
  for (const AccuracyRow& mesh : finest_first) {
    if (mesh.sound()) continue;
    variant.no_reference = fmt::format(
        "the reference mesh {} {}", mesh.setting.label,
        mesh.computed() ? "has a validity warning: " + mesh.validity_warnings : mesh.answer.failure);
    return;
  }
  tell_apart(variant, meshes);
  const std::vector<bool> inert = inert_gaps(variant);
  fill_settings(inert, variant.rows);
  for (const AccuracyRow& mesh : finest_first) {
    if (is_usual(mesh.setting)) continue;
    variant.no_reference = fmt::format("the reference mesh {} has no temperature, or one above {:.0f} K",
                                       mesh.setting.label, study::highest_recorded_temperature);
    return;
  }
  variant.record = record_of(variant);
  variant.reference = AccuracyReference{study::reference_of(variant.record), inert};
  for (AccuracyRow& row : variant.rows) {
    if (!row.computed()) continue;
    find_bounds(*variant.reference, row.setting);
    find_errors(*variant.reference, row);
  }
}

}  // namespace

bool VariantAccuracy::any_indeterminate() const {
  return !reference || std::ranges::any_of(reference->temperature, [](const ReferenceValue& value) {
    return !value.limit.justified;
  });
}

const AccuracyRow* VariantAccuracy::baseline() const {
  for (const AccuracyRow& row : rows)
    if (row.baseline && row.sound()) return &row;
  return nullptr;
}

double VariantAccuracy::reference_uncertainty() const {
  double largest = reference ? 0.0 : not_a_number;
  if (reference)
    for (const ReferenceValue& value : reference->temperature)
      largest = study::larger_bound(largest, value.limit.uncertainty + value.inexactness);
  return largest;
}

bool AccuracyResult::any_indeterminate() const {
  return std::ranges::any_of(variants, [](const VariantAccuracy& each) { return each.any_indeterminate(); });
}

AccuracyResult run_accuracy(const StudyFile& study, const StudyOptions& options) {
  return run_timed<AccuracyResult>(
      study, options,
      [&](AccuracyResult& result) {
        for (const AccuracyVariant& each : settings_of<AccuracySettings>(study).variants)
          result.variants.push_back({each.name, each.study});
        if (result.variants.empty()) result.variants.push_back({{}, study});
        run_settings(result, options);
      },
      [&](AccuracyResult& result) {
        if (options.shard.whole()) std::ranges::for_each(result.variants, compare);
      });
}

}  // namespace launchsafe::kinds
