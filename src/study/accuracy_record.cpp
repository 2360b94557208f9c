#include "launchsafe/study/accuracy_record.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

bool same_value(const scene::Value& a, const scene::Value& b) {
  const auto *first = std::get_if<double>(&a), *second = std::get_if<double>(&b);
  if (!first || !second) return a == b;
  return std::abs(*first - *second) <= 1e-9 * std::max(std::abs(*first), std::abs(*second));
}

}  // namespace

bool belongs_to_setting(const std::string& key) {
  if (key == "numerics.energy_drift_limit") return false;  // it judges and computes nothing
  return key.starts_with("numerics.") || key == "frame" || key == "output.trace_interval";
}

Setting setting_of(const scene::Scene& scene) {
  Setting setting;
  for (const auto& key : scene::scene_keys()) {
    if (belongs_to_setting(key.name)) setting[key.name] = key.get(scene);
  }
  return setting;
}

bool same_setting(const Setting& a, const Setting& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.first == y.first && same_value(x.second, y.second);
         });
}

std::string shell_of(const scene::Scene& scene) {
  scene::Scene shell = scene;
  const scene::Scene usual;
  scene::clear_remarks(shell);
  shell.accepted.clear();
  shell.interfaces = scene::sliding_interfaces(scene);
  shell.frame = usual.frame;
  shell.load = usual.load;
  shell.numerics = usual.numerics;
  shell.physics = usual.physics;
  shell.surface = usual.surface;
  shell.surface.friction = scene.surface.friction;
  shell.surface.air_pressure = scene.surface.air_pressure;
  shell.surface.air_model = scene.surface.air_model;
  shell.surface.exchange = scene.surface.exchange;
  shell.output.trace_interval = usual.output.trace_interval;
  shell.output.snapshot_times.clear();
  shell.charge().kinetics = usual.charge().kinetics;
  shell.charge().strength.initial_crack_radius = usual.charge().strength.initial_crack_radius;
  shell.charge().strength.flaw_size = usual.charge().strength.flaw_size;
  return store::sha256(scene::to_toml(shell));
}

std::string why_foreign(const AccuracyRecord& record, const scene::Scene& scene) {
  if (record.model_version != run::model_version)
    return fmt::format("it was made with model version {}, and this is {}", record.model_version,
                       run::model_version);
  if (record.shell != shell_of(scene) || record.initial_temperature != scene.initial_temperature)
    return "it was made of another shell, material, initial temperature, closure of friction or air, or of a "
           "charge "
           "that is held otherwise";
  if (record.unvaried.empty()) return {};
  const std::string& key = record.unvaried.front();
  const auto* description = scene::find_key(scene::scene_keys(), key);
  return fmt::format(
      "all its reference meshes have {} = {}, and no setting of it tells what the exact value changes", key,
      scene::format_value(*description, record.settings.front().setting.at(key)));
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
