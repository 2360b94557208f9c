#include "launchsafe/study/accuracy_record.hpp"

#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/changed_scene.hpp"
#include "launchsafe/study/record_domain.hpp"

#include <fmt/format.h>

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
    return found != setting.end() && same_value(found->second, value);
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
    const keys::Exactness exactness = scene::role_of(key).exactness;
    if (exactness.vanishes) continue;
    if (exactness.value && same_value(own, *exactness.value)) continue;
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
    rise = std::min(rise, hottest - record.scene.initial_temperature);
  }
  return std::isfinite(rise) ? rise : 0.0;
}

}  // namespace

bool belongs_to_setting(const scene::KeyDescription& key) {
  return key.role().part == keys::Part::setting || key.role().part == keys::Part::minor_setting;
}

Setting setting_of(const scene::Scene& scene) {
  Setting setting;
  for (const auto& key : scene::scene_keys()) {
    if (belongs_to_setting(key)) setting[key.name] = key.get(scene);
  }
  return setting;
}

bool same_setting(const Setting& a, const Setting& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.first == y.first && same_value(x.second, y.second);
         });
}

RecordedReference reference_of(const AccuracyRecord& record) {
  const std::vector<InexactKey> inexact = inexact_keys(record);
  RecordedReference reference;
  for (std::size_t gap = 0; gap < record.scene.surface.gaps.size(); ++gap) {
    reference.temperature.push_back(reference_value_of(
        record, inexact, [gap](const RecordedSetting& each) { return each.temperature[gap]; }));
  }
  reference.critical_gap =
      reference_value_of(record, inexact, [](const RecordedSetting& each) { return each.critical_gap; });
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
  record.launch = launch_of(record.scene, record.scene.surface.gaps);
  record.rise = rise_of(record);
  record.unvaried.clear();
  for (const InexactKey& each : inexact_keys(record)) {
    if (each.pairs.empty()) record.unvaried.push_back(each.key);
  }
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
  constexpr double hottest = 1.2, round_off = 1e-9;
  Coverage coverage = coverage_of(record.launch, launch_of(scene, {}));
  const double ratio = scene.initial_temperature / record.scene.initial_temperature;
  coverage.growth *= std::pow(std::max(1.0, ratio), 2);
  if (coverage.reason.empty() && !(ratio <= hottest * (1.0 + round_off)))
    coverage.reason = fmt::format("it was made at {:.4g} K, and {:.4g} K are hotter by more than a fifth",
                                  record.scene.initial_temperature, scene.initial_temperature);
  return coverage;
}

const RecordedSetting* recorded_setting(const AccuracyRecord& record, const scene::Scene& scene) {
  const Setting setting = setting_of(scene);
  const auto found = std::find_if(record.settings.begin(), record.settings.end(),
                                  [&](const auto& each) { return same_setting(each.setting, setting); });
  return found == record.settings.end() ? nullptr : &*found;
}

const RecordedSetting* cheapest_within(const AccuracyRecord& record, double tolerance) {
  const RecordedSetting* best = nullptr;
  for (const RecordedSetting& each : record.settings) {
    if (!(each.temperature_bound <= tolerance)) continue;
    if (best == nullptr || each.processor_time < best->processor_time) best = &each;
  }
  return best;
}

const RecordedSetting* most_accurate(const AccuracyRecord& record) {
  const RecordedSetting* best = nullptr;
  for (const RecordedSetting& each : record.settings) {
    if (std::isnan(each.temperature_bound)) continue;
    if (best == nullptr || each.temperature_bound < best->temperature_bound) best = &each;
  }
  return best;
}

}  // namespace launchsafe::study
