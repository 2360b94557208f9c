#include "launchsafe/study/accuracy_record.hpp"

#include "launchsafe/scene/load.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {
namespace {

/// Limits that two values point to are as far off as three times their difference (see math::Extrapolation).
constexpr double widening = 3.0;

/// The settings are equal but for `key`, where one has `own`.
bool differ_in(const std::string& key, const scene::Value& own, const Setting& one, const Setting& other) {
  const auto found = one.find(key), there = other.find(key);
  if (found == one.end() || there == other.end() || !same_value(found->second, own)) return false;
  Setting same = one;
  same[key] = there->second;
  return same_setting(same, other);
}

/// A key at which the reference meshes are not exact, and the settings that tell what that changes: two that
/// differ in it alone, one having the meshes' value and one the exact one.
struct InexactKey {
  std::string key;
  std::vector<std::pair<const RecordedSetting*, const RecordedSetting*>> pairs;
};

std::vector<InexactKey> inexact_keys(const AccuracyRecord& record) {
  std::vector<InexactKey> inexact;
  if (record.settings.empty()) return inexact;
  for (const auto& [key, own] : record.settings.front().setting) {
    const keys::Exactness exactness = scene::role_of(key).exactness;
    if (exactness.vanishes || (exactness.value && same_value(own, *exactness.value))) continue;
    inexact.push_back({key, {}});
    for (const RecordedSetting& one : record.settings)
      for (const RecordedSetting& other : record.settings)
        if (exactness.value && differ_in(key, own, one.setting, other.setting) &&
            same_value(other.setting.at(key), *exactness.value))
          inexact.back().pairs.push_back({&one, &other});
  }
  return inexact;
}

/// In the unit of the quantity; NaN where nothing tells, or one of a pair has no such quantity.
template <class Quantity>
double inexactness_of(const std::vector<InexactKey>& inexact, Quantity quantity) {
  double sum = 0.0;
  for (const InexactKey& each : inexact) {
    double largest = each.pairs.empty() ? math::not_a_number : 0.0;
    for (const auto& [one, other] : each.pairs)
      largest = larger_bound(largest, std::abs(quantity(*one) - quantity(*other)));
    sum += widening * largest;
  }
  return sum;
}

template <class Quantity>
ReferenceValue reference_value_of(const AccuracyRecord& record, const std::vector<InexactKey>& inexact,
                                  Quantity quantity) {
  std::vector<double> values, sizes;
  for (const RecordedSetting& each : record.settings) {
    if (!each.reference) continue;
    values.push_back(quantity(each));
    sizes.push_back(each.cell);
  }
  ReferenceValue reference = reference_value(std::move(values), sizes);
  reference.inexactness = inexactness_of(inexact, quantity);
  return reference;
}

/// The least of the reference meshes: errors that belong to it grow the soonest.
double rise_of(const AccuracyRecord& record) {
  double rise = math::infinity;
  for (const RecordedSetting& each : record.settings)
    if (each.reference && !each.temperature.empty())
      rise = std::min(rise, std::ranges::max(each.temperature) - record.scene.initial_temperature);
  return std::isfinite(rise) ? rise : 0.0;
}

// How far a record is carried; argued in the header.
constexpr double most_pressure = 1.25, most_cracks = 3.0, most_heating = 3.0, hottest = 1.2;
constexpr double longest = 1.1, steepest = 1.25, most_off_shape = 0.1;
/// What is no difference: round-off of units.
constexpr double launch_round_off = 1e-9;

/// s, over even instants alone: what is shorter is noise.
double rise_time_of(const scene::PressureHistory& history, double duration, double peak) {
  constexpr int parts = 4 * (static_cast<int>(shape_instants) - 1);
  const double step = duration / parts;
  double largest = 0.0;
  for (int i = 0; i < parts; ++i)
    largest = std::max(largest, history.at(step * (i + 1)) - history.at(step * i));
  return largest > 0.0 ? std::min(step * peak / largest, duration) : duration;
}

/// K/(s m).
double air_heating_of(const scene::Scene& scene, double peak) {
  const scene::Surface& surface = scene.surface;
  const scene::Charge& charge = scene.charge();
  const double share = surface.air.density * surface.air.specific_heat /
                       (charge.density * charge.specific_heat * surface.skin_thickness);
  const double rise =
      materials::adiabatic_temperature(surface.air, std::max(peak, surface.air.initial_pressure)) -
      surface.air.initial_temperature;
  return share * rise / surface.exchange_time;
}

/// Case over record; 1 where both are 0, infinite where the record alone is.
double ratio_of(double value, double recorded) {
  if (value <= 0.0) return value == recorded ? 1.0 : 0.0;
  return recorded > 0.0 ? value / recorded : math::infinity;
}

bool has_cracks(const materials::ViscoScramParameters& strength) {
  return strength.initial_crack_radius > 0.0 && strength.flaw_size > 0.0;
}

/// In crack radii and in crack radii over flaw sizes, whichever is larger.
double crack_ratio(const materials::ViscoScramParameters& own,
                   const materials::ViscoScramParameters& recorded) {
  if (!has_cracks(own)) return 0.0;
  if (!has_cracks(recorded)) return math::infinity;
  const double radii = own.initial_crack_radius / recorded.initial_crack_radius;
  return std::max(radii, radii * recorded.flaw_size / own.flaw_size);
}

/// Largest difference of two shapes at equal times while both last.
double shape_difference(const RecordedLaunch& launch, const RecordedLaunch& recorded) {
  double largest = 0.0;
  for (std::size_t i = 0; i < launch.shape.size(); ++i) {
    const double time = launch.duration * static_cast<double>(i) / (shape_instants - 1);
    const double place = std::min(time / recorded.duration, 1.0) * (shape_instants - 1);
    const std::size_t left = std::min(static_cast<std::size_t>(place), shape_instants - 2);
    const double share = place - static_cast<double>(left);
    const double there = (1.0 - share) * recorded.shape[left] + share * recorded.shape[left + 1];
    largest = std::max(largest, std::abs(launch.shape[i] - there));
  }
  return largest;
}

/// "it was made at 496 MPa, and 700 MPa are more than 1.25 times that".
std::string beyond(double recorded, double value, const char* unit, const char* what, double most) {
  return fmt::format("it was made {} {:.4g}{}, and {:.4g}{} is more than {:g} times that", what, recorded,
                     unit, value, unit, most);
}

/// A launch over the recorded one.
struct Ratios {
  double pressure, cracks, localisation, temperature;
};

/// Why a record is not carried to a scene with its launch; empty where it is.
std::string why_not_carried(const AccuracyRecord& record, const scene::Scene& scene,
                            const RecordedLaunch& launch, const Ratios& over) {
  constexpr double allowed = 1.0 + launch_round_off;
  const RecordedLaunch& recorded = record.launch;
  if (!(over.pressure <= most_pressure * allowed))
    return beyond(1e-6 * recorded.peak_pressure, 1e-6 * launch.peak_pressure, " MPa", "at a peak pressure of",
                  most_pressure);
  const auto &there = record.scene.charge().strength, &here = scene.charge().strength;
  if (!(over.cracks <= most_cracks * allowed))
    return has_cracks(there)
               ? fmt::format(
                     "it was made with cracks of {:.4g} µm in flaws of {:.4g} mm, and {:.4g} µm in {:.4g} "
                     "mm is more than {:g} times as much",
                     1e6 * there.initial_crack_radius, 1e3 * there.flaw_size, 1e6 * here.initial_crack_radius,
                     1e3 * here.flaw_size, most_cracks)
               : "it was made without cracks";
  if (!(over.localisation <= most_heating * allowed))
    return beyond(record.scene.surface.localisation, scene.surface.localisation, "",
                  "with a localisation of the friction of", most_heating);
  if (launch.duration > longest * recorded.duration)
    return fmt::format("its launch lasts {:.4g} ms, and {:.4g} ms are more than {:g} times that",
                       1e3 * recorded.duration, 1e3 * launch.duration, longest);
  const double off = shape_difference(launch, recorded);
  if (!(off <= most_off_shape))
    return fmt::format("its load differs in shape by {:.2g} of the peak, more than {:g}", off,
                       most_off_shape);
  if (launch.rise_time * steepest < recorded.rise_time * (1.0 - launch_round_off))
    return fmt::format("its load rises in {:.3g} ms, and {:.3g} ms are less than a part in {:g} of that",
                       1e3 * recorded.rise_time, 1e3 * launch.rise_time, steepest);
  if (!(over.temperature <= hottest * allowed))
    return fmt::format("it was made at {:.4g} K, and {:.4g} K are hotter by more than a fifth",
                       record.scene.initial_temperature, scene.initial_temperature);
  return {};
}

/// How far `value` may be from the truth: it is so far from the finest mesh's, that within the reference's
/// uncertainty of the limit, and that within its inexactness of the truth. NaN where one of them is not
/// known.
double bound_against(const ReferenceValue& reference, double value) {
  if (reference.values.empty()) return math::not_a_number;
  return std::abs(value - reference.values.front()) + reference.limit.uncertainty + reference.inexactness;
}

}  // namespace

ReferenceValue reference_value(std::vector<double> values, const std::vector<double>& sizes) {
  ReferenceValue reference;
  if (!math::all_finite(values)) values.clear();
  reference.values = std::move(values);
  if (!reference.values.empty()) reference.limit = math::extrapolate(reference.values, sizes);
  return reference;
}

double error_against(const ReferenceValue& reference, double value) {
  return reference.values.empty() ? math::not_a_number : value - reference.limit.value;
}

double larger_bound(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? math::not_a_number : std::max(a, b);
}

bool belongs_to_setting(const scene::KeyDescription& key) {
  return key.role().part == keys::Part::setting || key.role().part == keys::Part::minor_setting;
}

Setting setting_of(const scene::Scene& scene) {
  Setting setting;
  for (const auto& key : scene::scene_keys())
    if (belongs_to_setting(key)) setting[key.name] = key.get(scene);
  return setting;
}

bool same_setting(const Setting& a, const Setting& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.first == y.first && same_value(x.second, y.second);
  });
}

RecordedReference reference_of(const AccuracyRecord& record) {
  const std::vector<InexactKey> inexact = inexact_keys(record);
  RecordedReference reference;
  for (std::size_t gap = 0; gap < record.scene.surface.gaps.size(); ++gap)
    reference.temperature.push_back(reference_value_of(
        record, inexact, [gap](const RecordedSetting& each) { return each.temperature[gap]; }));
  reference.critical_gap = reference_value_of(record, inexact, std::mem_fn(&RecordedSetting::critical_gap));
  return reference;
}

void find_bounds(const RecordedReference& reference, RecordedSetting& setting) {
  setting.critical_gap_bound = bound_against(reference.critical_gap, setting.critical_gap);
  setting.temperature_bound = 0.0;
  for (std::size_t gap = 0; gap < reference.temperature.size(); ++gap) {
    const double bound = bound_against(reference.temperature[gap], setting.temperature[gap]);
    setting.temperature_bound = larger_bound(setting.temperature_bound, bound);
  }
}

void find_bounds(AccuracyRecord& record) {
  record.launch = launch_of(record.scene);
  record.rise = rise_of(record);
  record.unvaried.clear();
  for (const InexactKey& each : inexact_keys(record))
    if (each.pairs.empty()) record.unvaried.push_back(each.key);
  const RecordedReference reference = reference_of(record);
  for (RecordedSetting& each : record.settings) find_bounds(reference, each);
}

std::string why_foreign(const AccuracyRecord& record, const scene::Scene& scene) {
  const auto other = distance_to_record(RecordKind::accuracy, scene, record.scene).names();
  if (!other.empty())
    return fmt::format("it was made of another shell or model ({})", fmt::join(other, ", "));
  if (record.unvaried.empty()) return {};
  const std::string& key = record.unvaried.front();
  const auto* description = scene::find_key(scene::scene_keys(), key);
  return fmt::format(
      "all its reference meshes have {} = {}, and no setting of it tells what the exact value changes", key,
      scene::format_value(*description, record.settings.front().setting.at(key)));
}

Coverage coverage_of(const AccuracyRecord& record, const scene::Scene& scene) {
  const RecordedLaunch &recorded = record.launch, launch = launch_of(scene);
  const Ratios over{ratio_of(launch.peak_pressure, recorded.peak_pressure),
                    crack_ratio(scene.charge().strength, record.scene.charge().strength),
                    ratio_of(scene.surface.localisation, record.scene.surface.localisation),
                    scene.initial_temperature / record.scene.initial_temperature};
  Coverage coverage;
  const std::vector<double>& gaps = record.scene.surface.gaps;
  const double heating = most_heating * (gaps.empty() ? 0.0 : std::ranges::max(gaps)) * recorded.air_heating;
  coverage.largest_gap = launch.air_heating > 0.0 ? heating / launch.air_heating : math::infinity;
  const double growth = std::pow(std::max(1.0, over.pressure), 2) * std::sqrt(std::max(1.0, over.cracks)) *
                        std::max(1.0, over.localisation);
  // What grows without bound is not known: the reason says so.
  if (std::isfinite(growth)) coverage.growth = growth;
  coverage.growth *= std::pow(std::max(1.0, over.temperature), 2);
  coverage.reason = why_not_carried(record, scene, launch, over);
  return coverage;
}

const RecordedSetting* recorded_setting(const AccuracyRecord& record, const scene::Scene& scene) {
  const Setting setting = setting_of(scene);
  const auto found = std::ranges::find_if(
      record.settings, [&](const auto& each) { return same_setting(each.setting, setting); });
  return found == record.settings.end() ? nullptr : &*found;
}

const RecordedSetting* cheapest_within(const AccuracyRecord& record, double tolerance) {
  const RecordedSetting* best = nullptr;
  for (const RecordedSetting& each : record.settings)
    if (each.temperature_bound <= tolerance && !(best && best->processor_time <= each.processor_time))
      best = &each;
  return best;
}

const RecordedSetting* most_accurate(const AccuracyRecord& record) {
  const RecordedSetting* best = nullptr;
  for (const RecordedSetting& each : record.settings)
    if (!std::isnan(each.temperature_bound) && !(best && best->temperature_bound <= each.temperature_bound))
      best = &each;
  return best;
}

RecordedLaunch launch_of(const scene::Scene& scene) {
  const scene::PressureHistory history(scene.load);
  RecordedLaunch launch;
  launch.peak_pressure = history.peak();
  launch.duration = scene::end_time(scene.load);
  for (std::size_t i = 0; i < shape_instants; ++i) {
    const double time = launch.duration * static_cast<double>(i) / (shape_instants - 1);
    const double pressure = history.at(time);
    launch.shape.push_back(launch.peak_pressure > 0.0 ? std::min(pressure / launch.peak_pressure, 1.0) : 0.0);
  }
  launch.rise_time = rise_time_of(history, launch.duration, launch.peak_pressure);
  launch.air_heating = air_heating_of(scene, launch.peak_pressure);
  return launch;
}

}  // namespace launchsafe::study
