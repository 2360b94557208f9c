// The bounds of an accuracy record, from what its settings gave.
#include "launchsafe/study/accuracy_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::study {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
/// Limits that two values point to are as far off as three times their difference (see math::Extrapolation).
constexpr double widening = 3.0;

/// The settings are equal but for `key`, where one has `first` and the other `second`.
bool differ_in(const std::string& key, const scene::Value& first, const scene::Value& second,
               const Setting& one, const Setting& other) {
  const auto matches = [&](const Setting& setting, const scene::Value& value) {
    const auto found = setting.find(key);
    return found != setting.end() && same_setting({*found}, {{key, value}});
  };
  if (!matches(one, first) || !matches(other, second)) return false;
  Setting same = one;
  same[key] = other.at(key);
  return same_setting(same, other);
}

/// A key at which the reference meshes are not exact, and the settings that tell what that changes.
struct InexactKey {
  std::string key;
  std::vector<std::pair<const RecordedSetting*, const RecordedSetting*>> pairs;
};

/// Settings that differ in `key` alone, one having the meshes' value and one the exact one.
InexactKey inexact_key(const AccuracyRecord& record, const std::string& key, const scene::Value& own,
                       const std::optional<scene::Value>& exact) {
  InexactKey inexact{key, {}};
  if (!exact) return inexact;
  for (const RecordedSetting& one : record.settings) {
    for (const RecordedSetting& other : record.settings) {
      if (differ_in(key, own, *exact, one.setting, other.setting)) inexact.pairs.push_back({&one, &other});
    }
  }
  return inexact;
}

std::vector<InexactKey> inexact_keys(const AccuracyRecord& record) {
  std::vector<InexactKey> inexact;
  if (record.settings.empty()) return inexact;
  for (const auto& [key, own] : record.settings.front().setting) {
    const Exactness exactness = exactness_of(key);
    if (exactness.kind != Exactness::Kind::at_a_value) continue;
    if (exactness.value && same_setting({{key, own}}, {{key, *exactness.value}})) continue;
    inexact.push_back(inexact_key(record, key, own, exactness.value));
  }
  return inexact;
}

/// In the unit of the quantity; NaN where nothing tells, or one of a pair has no such quantity.
template <class Quantity>
double inexactness_of(const std::vector<InexactKey>& inexact, Quantity quantity) {
  double sum = 0.0;
  for (const InexactKey& each : inexact) {
    double largest = each.pairs.empty() ? not_known : 0.0;
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
  double rise = std::numeric_limits<double>::infinity();
  for (const RecordedSetting& each : record.settings) {
    if (!each.reference || each.temperature.empty()) continue;
    const double hottest = *std::max_element(each.temperature.begin(), each.temperature.end());
    rise = std::min(rise, hottest - record.initial_temperature);
  }
  return std::isfinite(rise) ? rise : 0.0;
}

}  // namespace

Exactness exactness_of(const std::string& key) {
  using Kind = Exactness::Kind;
  for (const char* each : {"numerics.formulation", "numerics.cell_size", "numerics.particles_per_cell",
                           "numerics.time_step_factor", "numerics.hourglass_stiffness",
                           // Where cells do not grow, at growth_x and growth_r 1, these say nothing.
                           "numerics.largest_cell", "numerics.refined_x", "numerics.refined_r"})
    if (key == each) return {Kind::with_the_cell, {}};
  if (key == "numerics.growth_x" || key == "numerics.growth_r" || key == "numerics.steel_inertia")
    return {Kind::at_a_value, scene::Value(1.0)};
  if (key == "output.trace_interval") return {Kind::in_each_case, {}};
  if (key == "numerics.inertial_scaling") return {Kind::at_a_value, scene::Value(1.0)};
  if (key == "numerics.damping_time" || key == "numerics.pic_fraction")
    return {Kind::at_a_value, scene::Value(0.0)};
  if (key == "frame") return {Kind::at_a_value, scene::Value(std::string("co-moving"))};
  return {Kind::at_a_value, {}};
}

RecordedReference reference_of(const AccuracyRecord& record) {
  const std::vector<InexactKey> inexact = inexact_keys(record);
  RecordedReference reference;
  for (std::size_t gap = 0; gap < record.launch.gaps.size(); ++gap) {
    reference.temperature.push_back(reference_value_of(
        record, inexact, [gap](const RecordedSetting& each) { return each.temperature[gap]; }));
  }
  reference.critical_gap =
      reference_value_of(record, inexact, [](const RecordedSetting& each) { return each.critical_gap; });
  return reference;
}

void find_bounds(AccuracyRecord& record) {
  record.rise = rise_of(record);
  record.unvaried.clear();
  for (const InexactKey& each : inexact_keys(record)) {
    if (each.pairs.empty()) record.unvaried.push_back(each.key);
  }
  const RecordedReference reference = reference_of(record);
  for (RecordedSetting& each : record.settings) {
    each.critical_gap_bound = bound_against(reference.critical_gap, each.critical_gap);
    each.temperature_bound = 0.0;
    for (std::size_t gap = 0; gap < reference.temperature.size(); ++gap) {
      const double bound = bound_against(reference.temperature[gap], each.temperature[gap]);
      each.temperature_bound = larger_bound(each.temperature_bound, bound);
    }
  }
}

}  // namespace launchsafe::study
