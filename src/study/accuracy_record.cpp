#include "launchsafe/study/accuracy_record.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

constexpr const char* format_name = "launchsafe accuracy record 1";

ordered_json json_of(const Setting& setting) {
  ordered_json object = ordered_json::object();
  for (const auto& [key, value] : setting) {
    if (const auto* number = std::get_if<double>(&value)) object[key] = *number;
    if (const auto* flag = std::get_if<bool>(&value)) object[key] = *flag;
    if (const auto* word = std::get_if<std::string>(&value)) object[key] = *word;
  }
  return object;
}

Setting setting_from(const ordered_json& object) {
  Setting setting;
  for (const auto& [key, value] : object.items()) {
    if (value.is_boolean()) {
      setting[key] = value.get<bool>();
    } else if (value.is_number()) {
      setting[key] = value.get<double>();
    } else {
      setting[key] = value.get<std::string>();
    }
  }
  return setting;
}

/// JSON writes what is not finite as null.
double number_from(const ordered_json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

/// A bound or a cost; what is below 0 would make verdicts safer than they are.
bool is_plausible(const RecordedSetting& each) {
  return !(each.temperature_bound < 0.0 || each.critical_gap_bound < 0.0 || each.processor_time < 0.0);
}

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
  shell.title.clear();
  shell.accepted.clear();
  shell.frame = usual.frame;
  shell.load = usual.load;
  shell.numerics = usual.numerics;
  shell.physics = usual.physics;
  shell.surface = usual.surface;
  shell.surface.friction = scene.surface.friction;
  shell.output.trace_interval = usual.output.trace_interval;
  shell.output.snapshot_times.clear();
  shell.charge.kinetics = usual.charge.kinetics;
  shell.charge.cracks.initial_crack_radius = usual.charge.cracks.initial_crack_radius;
  shell.charge.cracks.flaw_size = usual.charge.cracks.flaw_size;
  return store::sha256(scene::to_toml(shell));
}

std::string to_json_text(const AccuracyRecord& record) {
  ordered_json settings = ordered_json::array();
  for (const RecordedSetting& each : record.settings) {
    settings.push_back({{"label", each.label},
                        {"temperature_bound_K", each.temperature_bound},
                        {"critical_gap_bound_m", each.critical_gap_bound},
                        {"processor_time_s", each.processor_time},
                        {"setting", json_of(each.setting)}});
  }
  const ordered_json object{{"format", format_name},
                            {"title", record.title},
                            {"model_version", record.model_version},
                            {"shell", record.shell},
                            {"peak_pressure_Pa", record.peak_pressure},
                            {"rise_K", record.rise},
                            {"settings", std::move(settings)}};
  return object.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::optional<AccuracyRecord> accuracy_record_from(const std::string& text) {
  try {
    const ordered_json object = ordered_json::parse(text);
    if (object.at("format").get<std::string>() != format_name) return std::nullopt;
    AccuracyRecord record;
    record.title = object.at("title").get<std::string>();
    if (!object.at("model_version").is_number_integer()) return std::nullopt;
    record.model_version = object.at("model_version").get<int>();
    record.shell = object.at("shell").get<std::string>();
    record.peak_pressure = number_from(object.at("peak_pressure_Pa"));
    record.rise = number_from(object.at("rise_K"));
    for (const ordered_json& each : object.at("settings")) {
      record.settings.push_back({each.at("label").get<std::string>(), setting_from(each.at("setting")),
                                 number_from(each.at("temperature_bound_K")),
                                 number_from(each.at("critical_gap_bound_m")),
                                 number_from(each.at("processor_time_s"))});
      if (!is_plausible(record.settings.back())) return std::nullopt;
    }
    return record;
  } catch (const ordered_json::exception&) {
    return std::nullopt;
  }
}

std::string why_foreign(const AccuracyRecord& record, const scene::Scene& scene) {
  if (record.model_version != run::model_version)
    return fmt::format("it was made with model version {}, and this is {}", record.model_version,
                       run::model_version);
  if (record.shell != shell_of(scene)) return "it was made of another shell, material or friction closure";
  return {};
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
  const auto best = std::min_element(
      record.settings.begin(), record.settings.end(),
      [](const auto& a, const auto& b) { return a.temperature_bound < b.temperature_bound; });
  return best == record.settings.end() ? nullptr : &*best;
}

}  // namespace launchsafe::study
