#include "launchsafe/kinds/accuracy.hpp"

#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/study/answer_cases.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

/// One quantity on all meshes.
template <class Quantity>
ReferenceValue over_meshes(const std::vector<AccuracyMeasurement>& meshes, Quantity quantity) {
  std::vector<double> values, sizes;
  for (const AccuracyMeasurement& mesh : meshes) {
    values.push_back(quantity(mesh));
    sizes.push_back(mesh.cell);
  }
  return reference_value(std::move(values), sizes);
}

/// T max (K) as settings are compared at a gap: of a skin that does not react where `inert`.
double compared_temperature(const AccuracyMeasurement& measured, std::size_t gap, bool inert) {
  return inert ? measured.heated[gap] : measured.temperature[gap];
}

/// What the reference meshes, finest first, tend to. All of them must be sound.
AccuracyReference reference_of(const std::vector<AccuracyMeasurement>& meshes, std::size_t gaps,
                               const std::vector<bool>& inert) {
  AccuracyReference reference;
  reference.inert = inert;
  for (std::size_t gap = 0; gap < gaps; ++gap) {
    reference.temperature.push_back(over_meshes(meshes, [&](const AccuracyMeasurement& mesh) {
      return compared_temperature(mesh, gap, inert[gap]);
    }));
    reference.ignition_time.push_back(
        over_meshes(meshes, [&](const AccuracyMeasurement& mesh) { return mesh.ignition_time[gap]; }));
  }
  reference.critical_gap =
      over_meshes(meshes, [](const AccuracyMeasurement& mesh) { return value_of(mesh.critical); });
  reference.peak_pressure =
      over_meshes(meshes, [](const AccuracyMeasurement& mesh) { return mesh.peak_pressure; });
  for (std::size_t i = 0; i < meshes.front().at_times.size(); ++i) {
    reference.at_times.push_back(
        over_meshes(meshes, [i](const AccuracyMeasurement& mesh) { return mesh.at_times[i]; }));
  }
  for (std::size_t i = 0; i < meshes.front().points.size(); ++i) {
    reference.points.push_back(
        over_meshes(meshes, [i](const AccuracyMeasurement& mesh) { return mesh.points[i].temperature; }));
  }
  reference.bottom = meshes.front().bottom;
  return reference;
}

/// Errors of one measurement.
AccuracyRow row_against(const AccuracyReference& reference, const AccuracyMeasurement& measured) {
  AccuracyRow row;
  row.measured = measured;
  row.largest_temperature_error = row.temperature_bound = not_a_number;
  row.critical_gap_error = row.critical_gap_bound = not_a_number;
  row.pressure_error = row.peak_pressure_error = not_a_number;
  if (!measured.failure.empty()) return row;
  row.largest_temperature_error = row.temperature_bound = 0.0;
  for (std::size_t gap = 0; gap < reference.temperature.size(); ++gap) {
    const double value = compared_temperature(measured, gap, reference.inert[gap]);
    row.temperature_error.push_back(error_against(reference.temperature[gap], value));
    row.largest_temperature_error =
        larger_bound(row.largest_temperature_error, std::abs(row.temperature_error.back()));
    row.temperature_bound =
        larger_bound(row.temperature_bound, bound_against(reference.temperature[gap], value));
    row.ignition_time_error.push_back(
        error_against(reference.ignition_time[gap], measured.ignition_time[gap]));
  }
  if (measured.critical.kind == CriticalGapKind::value) {
    row.critical_gap_error = error_against(reference.critical_gap, measured.critical.value);
    row.critical_gap_bound = bound_against(reference.critical_gap, measured.critical.value);
  }
  row.pressure_error = relative_difference(measured.bottom, reference.bottom);
  row.peak_pressure_error = error_against(reference.peak_pressure, measured.peak_pressure) /
                            std::abs(reference.peak_pressure.limit.value);
  for (std::size_t i = 0; i < reference.at_times.size(); ++i)
    row.error_at_times.push_back(error_against(reference.at_times[i], measured.at_times[i]));
  return row;
}

std::string validity_warnings_of(const StudyCase& input, const run::MechanicsResult& mechanics) {
  return fmt::format("{}", fmt::join(run::validity_warnings(input.scene.scene, mechanics), "; "));
}

/// What the skin of the first gap was in detail; without reaction, since after ignition all are alike.
void add_first_gap(const Study& study, const StudyCase& input, const trace::BottomTrace& trace,
                   AccuracyMeasurement& measured) {
  const auto skin = surface::integrate_skin(without_reaction(surface::skin_model(input.scene.scene)), trace,
                                            study.gaps.front());
  for (const double time : accuracy_settings(study).times)
    measured.at_times.push_back(surface::maximum_at_time(skin, trace, time).temperature);
  measured.points = station_temperatures(skin, trace);
}

AccuracyMeasurement measure(const Study& study, const StudyCase& input, const CaseAnswer& answer,
                            const run::MechanicsResult& mechanics) {
  AccuracyMeasurement measured;
  measured.failure = failure_of(mechanics);
  const scene::CellRange mesh = scene::cells_of_charge(input.scene.scene);
  measured.cell = std::sqrt(mesh.shortest_x * mesh.shortest_r);
  measured.wall_time = mechanics.wall_time;
  measured.processor_time = mechanics.processor_time > 0 ? mechanics.processor_time : mechanics.wall_time;
  measured.particle_steps = static_cast<double>(mechanics.particles) * static_cast<double>(mechanics.steps);
  measured.memory = run::cost_of(input.scene.scene).memory();
  measured.energy_drift = answer.run.energy_drift;
  if (!measured.failure.empty()) return measured;
  measured.validity_warnings = validity_warnings_of(input, mechanics);
  for (const GapVerdict& row : answer.verdicts) {
    measured.temperature.push_back(row.maximum.temperature);
    measured.ignites.push_back(row.ignition.has_value());
    measured.ignition_time.push_back(row.ignition ? row.ignition->time : not_a_number);
  }
  measured.heated = answer.heated_temperature;
  add_first_gap(study, input, mechanics.trace, measured);
  measured.critical = answer.critical;
  measured.bottom = {mechanics.trace.time, mechanics.trace.bottom_pressure};
  measured.peak_pressure =
      *std::max_element(measured.bottom.pressure.begin(), measured.bottom.pressure.end());
  return measured;
}

/// What was measured on the runs of all cases.
void run_settings(AccuracyResult& result, const StudyOptions& options) {
  std::vector<std::pair<VariantAccuracy*, std::size_t>> places;  // of every case of the study
  for (VariantAccuracy& variant : result.variants) {
    variant.measured.resize(variant.study.cases.size());
    for (std::size_t i = 0; i < variant.measured.size(); ++i) places.emplace_back(&variant, i);
  }
  result.answers.resize(places.size());
  run_every_case(result.study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
    const FinishedRun& run = runs.front();
    const auto& [variant, place] = places[i];
    const Study& study = variant->study.study;
    const StudyCase& input = variant->study.cases[place];
    CaseAnswer& answer = result.answers[i];
    AccuracyMeasurement& measured = variant->measured[place];
    if (!run.has_result()) {
      answer = failed_answer(study, input, run.outcome, run.failure);
      measured.failure = run.failure;
      return;
    }
    answer = answer_of(study, input, run.result.mechanics);
    answer.outcome = run.outcome;
    measured = measure(study, input, answer, run.result.mechanics);
  });
}

/// A gap at which any sound setting of the same model ignites is compared by a skin that does not react:
/// after ignition T max is that of the flame.
std::vector<bool> inert_gaps(const VariantAccuracy& result, const std::vector<bool>& other_model) {
  std::vector<bool> inert(result.study.study.gaps.size(), false);
  for (std::size_t i = 0; i < result.measured.size(); ++i) {
    const AccuracyMeasurement& measured = result.measured[i];
    if (other_model[i] || !measured.failure.empty() || !measured.validity_warnings.empty()) continue;
    for (std::size_t gap = 0; gap < inert.size(); ++gap) inert[gap] = inert[gap] || measured.ignites[gap];
  }
  return inert;
}

/// Whether a case differs from the study's scene in more than a setting.
bool is_other_model(const scene::Scene& scene, const scene::Scene& own) {
  scene::Scene same = scene, all = own;
  for (scene::Scene* each : {&same, &all}) scene::clear_remarks(*each);
  for (const auto& key : scene::scene_keys()) {
    if (belongs_to_setting(key.name)) key.set(same, key.get(own));
  }
  return scene::to_toml(same) != scene::to_toml(all);
}

/// A setting for the record; nothing where it did not run soundly or has temperatures that nothing has.
std::optional<RecordedSetting> recorded(const StudyCase& input, const AccuracyMeasurement& measured,
                                        const std::vector<bool>& inert) {
  if (!measured.failure.empty() || !measured.validity_warnings.empty()) return std::nullopt;
  RecordedSetting setting;
  setting.label = input.label;
  setting.setting = setting_of(input.scene.scene);
  setting.cell = measured.cell;
  for (std::size_t gap = 0; gap < inert.size(); ++gap) {
    setting.temperature.push_back(compared_temperature(measured, gap, inert[gap]));
    if (!(setting.temperature.back() <= highest_recorded_temperature)) return std::nullopt;
  }
  if (measured.critical.kind == CriticalGapKind::value) setting.critical_gap = measured.critical.value;
  setting.processor_time = measured.processor_time;
  return setting;
}

AccuracyRecord record_of(const VariantAccuracy& result, const std::vector<bool>& inert,
                         const std::vector<bool>& other_model) {
  const scene::Scene& scene = result.study.scene.scene;
  AccuracyRecord record;
  record.title = result.study.study.title;
  record.model_version = run::model_version;
  record.shell = shell_of(scene);
  record.initial_temperature = scene.initial_temperature;
  record.launch = launch_of(scene, result.study.study.gaps);
  for (std::size_t i = 0; i < result.measured.size(); ++i) {
    if (other_model[i]) continue;
    auto setting = recorded(result.study.cases[i], result.measured[i], inert);
    // 0.25 cm is not always 2.5 mm to the last digit.
    if (!setting || recorded_setting(record, result.study.cases[i].scene.scene) != nullptr) continue;
    setting->reference = i < accuracy_settings(result.study.study).reference_cell_sizes.size();
    record.settings.push_back(std::move(*setting));
  }
  find_bounds(record);
  return record;
}

/// The reference of the rows is that of the record: the limit may be off by what no mesh has exact.
void add_inexactness(const AccuracyRecord& record, AccuracyReference& reference) {
  const RecordedReference recorded = reference_of(record);
  for (std::size_t gap = 0; gap < recorded.temperature.size(); ++gap)
    reference.temperature[gap].inexactness = recorded.temperature[gap].inexactness;
  reference.critical_gap.inexactness = recorded.critical_gap.inexactness;
}

void compare(VariantAccuracy& result) {
  const StudyFile& study = result.study;
  const std::size_t meshes = accuracy_settings(study.study).reference_cell_sizes.size();
  for (std::size_t i = 0; i < meshes; ++i) {
    const AccuracyMeasurement& mesh = result.measured[i];
    if (mesh.failure.empty() && mesh.validity_warnings.empty()) continue;
    result.no_reference = fmt::format(
        "the reference mesh {} {}", study.cases[i].label,
        mesh.failure.empty() ? "has a validity warning: " + mesh.validity_warnings : mesh.failure);
    return;
  }
  std::vector<bool> other_model;
  for (const StudyCase& each : study.cases)
    other_model.push_back(is_other_model(each.scene.scene, study.scene.scene));
  const auto first = result.measured.begin();
  const std::vector<bool> inert = inert_gaps(result, other_model);
  result.reference = reference_of({first, first + static_cast<std::ptrdiff_t>(meshes)}, inert.size(), inert);
  result.record = record_of(result, inert, other_model);
  add_inexactness(result.record, *result.reference);
  const Setting own = setting_of(study.scene.scene);
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    AccuracyRow row = row_against(*result.reference, result.measured[i]);
    row.index = i;
    row.reference = i < meshes;
    row.other_model = other_model[i];
    row.baseline = !row.other_model && same_setting(setting_of(study.cases[i].scene.scene), own);
    result.rows.push_back(std::move(row));
  }
  mark_front(result.rows);
}

}  // namespace

double relative_difference(const PressureTrace& p, const PressureTrace& q) {
  if (p.time.size() < 2 || q.time.size() < 2) return not_a_number;
  const double end = std::min(p.time.back(), q.time.back());
  double difference = 0.0, whole = 0.0;
  for (std::size_t i = 1; i < q.time.size() && q.time[i] <= end * (1.0 + 1e-12); ++i) {
    // The trapezoidal rule over the samples of q.
    for (const std::size_t k : {i - 1, i}) {
      const double half = 0.5 * (q.time[i] - q.time[i - 1]);
      const double off = trace::interpolate(p.time, p.pressure, q.time[k]) - q.pressure[k];
      difference += half * off * off;
      whole += half * q.pressure[k] * q.pressure[k];
    }
  }
  return std::sqrt(difference / whole);
}

void mark_front(std::vector<AccuracyRow>& rows) {
  const auto counts = [](const AccuracyRow& row) {
    return row.sound() && !row.other_model && std::isfinite(row.error_to_go_by());
  };
  for (AccuracyRow& row : rows) {
    row.on_front = counts(row) && std::none_of(rows.begin(), rows.end(), [&](const AccuracyRow& other) {
                     return counts(other) && other.measured.processor_time < row.measured.processor_time &&
                            other.error_to_go_by() <= row.error_to_go_by();
                   });
  }
}

bool VariantAccuracy::any_indeterminate() const {
  return !reference || std::any_of(reference->temperature.begin(), reference->temperature.end(),
                                   [](const ReferenceValue& value) { return !value.limit.justified; });
}

const AccuracyRow* VariantAccuracy::baseline() const {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [](const AccuracyRow& row) { return row.baseline && row.sound(); });
  return found == rows.end() ? nullptr : &*found;
}

const AccuracyRow* VariantAccuracy::cheapest(double bound) const {
  const AccuracyRow* best = nullptr;
  for (const AccuracyRow& row : rows) {
    if (!row.sound() || row.other_model || !(row.temperature_bound <= bound)) continue;
    if (best == nullptr || row.measured.processor_time < best->measured.processor_time) best = &row;
  }
  return best;
}

double VariantAccuracy::reference_uncertainty() const {
  double largest = reference ? 0.0 : not_a_number;
  if (reference)
    for (const ReferenceValue& value : reference->temperature)
      largest = larger_bound(largest, value.limit.uncertainty + value.inexactness);
  return largest;
}

bool AccuracyResult::any_indeterminate() const {
  return std::any_of(variants.begin(), variants.end(),
                     [](const VariantAccuracy& each) { return each.any_indeterminate(); });
}

AccuracyResult run_accuracy(const StudyFile& study, const StudyOptions& options) {
  return run_timed<AccuracyResult>(
      study, options,
      [&](AccuracyResult& result) {
        for (const AccuracyVariant& each : accuracy_settings(study.study).variants)
          result.variants.push_back({each.name, each.study});
        if (result.variants.empty()) result.variants.push_back({{}, study});
        run_settings(result, options);
      },
      [&](AccuracyResult& result) {
        if (options.shard.whole()) std::for_each(result.variants.begin(), result.variants.end(), compare);
      });
}

}  // namespace launchsafe::kinds
