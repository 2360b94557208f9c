#include "launchsafe/kinds/accuracy.hpp"

#include "launchsafe/scene/plan.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {
namespace {

// --- settings ---

/// The keys that make a computation finer or coarser, with their values.
using Setting = std::map<std::string, Value>;

bool belongs_to_setting(const std::string& key) {
  return (key.starts_with("numerics.") && key != "numerics.energy_drift_limit") ||
         key == "output.trace_interval";
}

Setting setting_of(const Scene& scene) {
  Setting setting;
  for (const auto& key : scene::scene_keys())
    if (belongs_to_setting(key.name)) setting[key.name] = key.get(scene);
  return setting;
}

/// Equal but for the round-off of units: 0.25 cm is not always 2.5 mm to the last digit.
bool same_setting(const Setting& a, const Setting& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.first == y.first && study::same_value(x.second, y.second);
  });
}

/// Whether two scenes differ in more than their settings.
bool differ_in_model(Scene scene, const Scene& own) {
  for (const auto& key : scene::scene_keys())
    if (belongs_to_setting(key.name)) key.set(scene, key.get(own));
  return scene::to_toml(scene) != scene::to_toml(own);
}

// --- numerics that are not exact ---

/// Numerics that make no error at one value. All others leave none in the limit of ever finer cells.
const Setting exact_values{{"numerics.damping_time", 0.0}, {"numerics.growth_r", 1.0},
                           {"numerics.growth_x", 1.0},     {"numerics.inertial_scaling", 1.0},
                           {"numerics.pic_fraction", 0.0}, {"numerics.selective_inertia", 1.0}};

/// Limits that two values point to are as far off as three times their difference (see math::Extrapolation).
constexpr double widening = 3.0;

using RowPair = std::pair<const AccuracyRow*, const AccuracyRow*>;

/// A key at which the reference meshes are not exact, and the settings that differ in it alone, one having
/// the meshes' value and one the exact one.
struct InexactKey {
  std::string key;
  std::vector<RowPair> pairs;
};

std::vector<InexactKey> inexact_keys(const AccuracyResult& result) {
  std::vector<Setting> settings;
  for (const StudyCase& each : result.study.cases) settings.push_back(setting_of(each.scene.scene));
  const std::vector<AccuracyRow>& rows = result.rows;
  std::vector<InexactKey> inexact;
  for (const auto& [key, exact] : exact_values) {
    const Value& own = settings.front().at(key);
    if (study::same_value(own, exact)) continue;
    inexact.push_back({key, {}});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!rows[i].comparable() || !study::same_value(settings[i].at(key), own)) continue;
      Setting wanted = settings[i];
      wanted[key] = exact;
      for (std::size_t j = 0; j < rows.size(); ++j)
        if (rows[j].comparable() && same_setting(settings[j], wanted))
          inexact.back().pairs.emplace_back(&rows[i], &rows[j]);
    }
  }
  return inexact;
}

double larger_bound(double a, double b) {  // NaN, which is no bound, wins
  return std::isnan(a) || std::isnan(b) ? not_a_number : std::max(a, b);
}

// --- the reference ---

/// Of a quantity of the reference meshes, which are the first rows, finest first.
template <class Quantity>
ReferenceValue reference_value(std::span<const AccuracyRow> meshes, const std::vector<InexactKey>& inexact,
                               Quantity quantity) {
  ReferenceValue reference;
  reference.values = of_each(meshes, quantity);
  reference.limit = math::extrapolate(reference.values, of_each(meshes, &AccuracyRow::cell));
  if (!math::all_finite(reference.values)) reference.values.clear();
  for (const InexactKey& each : inexact) {
    double largest = each.pairs.empty() ? not_a_number : 0.0;
    for (const auto& [one, other] : each.pairs)
      largest = larger_bound(largest, std::abs(std::invoke(quantity, *one) - std::invoke(quantity, *other)));
    reference.inexactness += widening * largest;
  }
  return reference;
}

AccuracyReference reference_of(const AccuracyResult& result, std::size_t meshes,
                               const std::vector<bool>& inert) {
  const std::span<const AccuracyRow> finest_first(result.rows.data(), meshes);
  const std::vector<InexactKey> inexact = inexact_keys(result);
  AccuracyReference reference;
  for (std::size_t gap = 0; gap < inert.size(); ++gap)
    reference.temperature.push_back(reference_value(
        finest_first, inexact, [gap](const AccuracyRow& row) { return row.temperature[gap]; }));
  reference.critical_gap = reference_value(finest_first, inexact, &AccuracyRow::critical_gap);
  reference.inert = inert;
  for (const InexactKey& each : inexact)
    if (each.pairs.empty()) reference.unvaried.push_back(each.key);
  return reference;
}

double error_against(const ReferenceValue& reference, double value) {
  return reference.values.empty() ? not_a_number : value - reference.limit.value;
}

double bound_against(const ReferenceValue& reference, double value) {
  if (reference.values.empty()) return not_a_number;
  return std::abs(value - reference.values.front()) + reference.limit.uncertainty + reference.inexactness;
}

void find_errors(const AccuracyReference& reference, AccuracyRow& row) {
  row.largest_temperature_error = row.temperature_bound = 0.0;
  for (std::size_t gap = 0; gap < reference.temperature.size(); ++gap) {
    const double value = row.temperature[gap];
    row.temperature_error.push_back(error_against(reference.temperature[gap], value));
    row.largest_temperature_error =
        larger_bound(row.largest_temperature_error, std::abs(row.temperature_error.back()));
    row.temperature_bound =
        larger_bound(row.temperature_bound, bound_against(reference.temperature[gap], value));
  }
  row.critical_gap_error = error_against(reference.critical_gap, row.critical_gap);
  row.critical_gap_bound = bound_against(reference.critical_gap, row.critical_gap);
}

// --- the rows ---

/// The result of a run and its cost, without comparing it.
AccuracyRow measure(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs) {
  AccuracyRow row;
  row.label = input.label;
  row.result = study::draw_row(study, input, runs);
  if (!runs.front().has_result()) return row;
  const scene::CellRange mesh = scene::cells_of_charge(input.scene.scene);
  row.cell = std::sqrt(mesh.shortest_x * mesh.shortest_r);
  row.processor_time = runs.front().result.mechanics.work_time();
  return row;
}

void run_settings(AccuracyResult& result, const StudyOptions& options) {
  result.rows.resize(result.study.cases.size());
  run_every_case(result.study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
    result.rows[i] = measure(result.study.study, result.study.cases[i], runs);
  });
}

/// A gap at which any sound setting of the same model ignites is compared by a skin that does not react:
/// after ignition T max is that of the flame.
std::vector<bool> inert_gaps(const AccuracyResult& result) {
  std::vector<bool> inert(result.study.study.gaps.size(), false);
  for (const AccuracyRow& row : result.rows) {
    if (!row.comparable()) continue;
    for (std::size_t gap = 0; gap < inert.size(); ++gap)
      inert[gap] = inert[gap] || row.result.gaps[gap].ignition;
  }
  return inert;
}

void tell_apart(AccuracyResult& result, std::size_t meshes) {
  const Scene& own = result.study.scene.scene;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    AccuracyRow& row = result.rows[i];
    const Scene scene = result.study.cases[i].scene.scene;
    row.reference_mesh = i < meshes;
    row.other_model = differ_in_model(scene, own);
    row.baseline = !row.other_model && same_setting(setting_of(scene), setting_of(own));
  }
}

/// What is compared of every row: T max, at inert gaps of a skin that does not react, and the critical gap.
/// The temperature of a flame is none: how far that is off says nothing.
void fill_values(const std::vector<bool>& inert, std::vector<AccuracyRow>& rows) {
  for (AccuracyRow& row : rows) {
    if (!row.computed()) continue;
    const CriticalGap& critical = row.result.critical;
    if (critical.kind == CriticalGapKind::value) row.critical_gap = critical.value;
    for (std::size_t gap = 0; gap < inert.size(); ++gap) {
      const GapRow& of_gap = row.result.gaps[gap];
      row.temperature.push_back(inert[gap]        ? of_gap.heated
                                : of_gap.ignition ? not_a_number
                                                  : of_gap.maximum.temperature);
    }
  }
}

void compare(AccuracyResult& result) {
  const std::size_t meshes = settings_of<AccuracySettings>(result.study).reference_cell_sizes.size();
  for (std::size_t i = 0; i < meshes; ++i) {
    const AccuracyRow& mesh = result.rows[i];
    if (mesh.sound()) continue;
    result.no_reference =
        fmt::format("the reference mesh {} {}", mesh.label,
                    mesh.computed() ? "has a validity warning: " + mesh.warnings() : mesh.result.failure);
    return;
  }
  tell_apart(result, meshes);
  const std::vector<bool> inert = inert_gaps(result);
  fill_values(inert, result.rows);
  result.reference = reference_of(result, meshes, inert);
  for (AccuracyRow& row : result.rows)
    if (row.computed()) find_errors(*result.reference, row);
}

}  // namespace

std::string AccuracyRow::warnings() const {
  std::vector<std::string> texts;
  for (const study::Remark& each : result.warnings)
    if (!each.acceptable) texts.push_back(each.text);
  return fmt::format("{}", fmt::join(texts, "; "));
}

const AccuracyRow* AccuracyResult::baseline() const {
  for (const AccuracyRow& row : rows)
    if (row.baseline && row.sound()) return &row;
  return nullptr;
}

double AccuracyResult::reference_uncertainty() const {
  double largest = reference ? 0.0 : not_a_number;
  if (reference)
    for (const ReferenceValue& value : reference->temperature)
      largest = larger_bound(largest, value.limit.uncertainty + value.inexactness);
  return largest;
}

AccuracyResult run_accuracy(const StudyFile& study, const StudyOptions& options) {
  return run_timed<AccuracyResult>(
      study, options, [&](AccuracyResult& result) { run_settings(result, options); },
      [&](AccuracyResult& result) {
        if (options.shard.whole()) compare(result);
      });
}

}  // namespace launchsafe::kinds
