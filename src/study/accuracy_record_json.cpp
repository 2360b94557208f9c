// Accuracy records as JSON, written and read with distrust.
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/accuracy_record.hpp"
#include "launchsafe/study/record_reader.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;
using scene::Limits;

constexpr const char* format_name = "launchsafe accuracy record 2";
constexpr std::size_t fewest_reference_meshes = 3;
/// More would take long to compare with each other.
constexpr std::size_t most_settings = 3000;
/// K. Skins are integrated to about this; no mesh study says less of a temperature.
constexpr double smallest_bound = 1e-4;
constexpr double longest_processor_time = 1e9;  ///< s, some thirty years
constexpr double widest_gap = 0.01;             ///< m, as in studies

// --- writing ---

ordered_json json_of(const Setting& setting) {
  ordered_json object = ordered_json::object();
  for (const auto& [key, value] : setting) {
    if (const auto* number = std::get_if<double>(&value)) object[key] = *number;
    if (const auto* flag = std::get_if<bool>(&value)) object[key] = *flag;
    if (const auto* word = std::get_if<std::string>(&value)) object[key] = *word;
    if (const auto* places = std::get_if<std::vector<double>>(&value)) object[key] = *places;
  }
  return object;
}

ordered_json json_of(const RecordedLaunch& launch) {
  return {{"peak_pressure_Pa", launch.peak_pressure},
          {"duration_s", launch.duration},
          {"rise_time_s", launch.rise_time},
          {"roughness", launch.roughness},
          {"crack_radius_m", launch.crack_radius},
          {"flaw_size_m", launch.flaw_size},
          {"gaps_m", launch.gaps},
          {"localisation", launch.localisation},
          {"air_heating_K_per_s_m", launch.air_heating},
          {"shape", launch.shape}};
}

/// JSON writes what is not finite as null.
ordered_json json_of(const RecordedSetting& each) {
  return {{"label", each.label},
          {"temperature_bound_K", each.temperature_bound},
          {"critical_gap_bound_m", each.critical_gap_bound},
          {"processor_time_s", each.processor_time},
          {"reference", each.reference},
          {"cell_m", each.cell},
          {"temperature_K", each.temperature},
          {"critical_gap_m", each.critical_gap},
          {"setting", json_of(each.setting)}};
}

/// All but the digest.
ordered_json content_of(const AccuracyRecord& record) {
  ordered_json settings = ordered_json::array();
  for (const RecordedSetting& each : record.settings) settings.push_back(json_of(each));
  return {{"format", format_name},
          {"title", record.title},
          {"model_version", record.model_version},
          {"shell", record.shell},
          {"initial_temperature_K", record.initial_temperature},
          {"launch", json_of(record.launch)},
          {"settings", std::move(settings)}};
}

// --- reading ---

/// Whether a key may have a value that no reader of scenes has checked.
bool may_take(const scene::KeyDescription& key, const scene::Value& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return key.kind == scene::KeyKind::word &&
           std::find(key.words.begin(), key.words.end(), *word) != key.words.end();
  if (std::holds_alternative<bool>(value)) return key.kind == scene::KeyKind::flag;
  if (std::holds_alternative<std::vector<double>>(value)) return key.kind == scene::KeyKind::list;
  const double number = std::get<double>(value);
  const bool whole = key.dimension != scene::Dimension::count || number == std::round(number);
  return key.kind == scene::KeyKind::number && std::isfinite(number) && whole && key.limits.contain(number);
}

/// Every key of a setting, none besides, each with a value that a scene may have.
Setting setting_from(const ordered_json& object, const std::string& path, RecordReader& reader) {
  Setting setting;
  std::vector<std::string> keys;
  for (const auto& key : scene::scene_keys()) {
    if (belongs_to_setting(key.name)) keys.push_back(key.name);
  }
  if (!reader.has_keys(object, path, keys)) return setting;
  for (const std::string& key : keys) {
    const ordered_json& given = object[key];
    scene::Value value = std::numeric_limits<double>::quiet_NaN();
    if (given.is_boolean()) value = given.get<bool>();
    if (given.is_number()) value = given.get<double>();
    if (given.is_string()) value = given.get<std::string>();
    const auto& description = *scene::find_key(scene::scene_keys(), key);
    if (given.is_array()) {
      constexpr std::size_t most_places = 1000;
      value = reader.numbers(given, path + "." + key, description.limits, 0, most_places);
    }
    if (!may_take(description, value))
      reader.refuse(path + "." + key, found_in(given), scene::allowed_text(description));
    setting[key] = std::move(value);
  }
  return setting;
}

RecordedLaunch launch_from(const ordered_json& object, RecordReader& reader) {
  using scene::above_to, scene::between;
  RecordedLaunch launch;
  const std::vector<std::string> keys{"peak_pressure_Pa",      "duration_s",  "rise_time_s", "roughness",
                                      "crack_radius_m",        "flaw_size_m", "gaps_m",      "localisation",
                                      "air_heating_K_per_s_m", "shape"};
  if (!reader.has_keys(object, "launch", keys)) return launch;
  const auto number = [&](const char* key, const Limits& limits) {
    return reader.number(object[key], fmt::format("launch.{}", key), limits);
  };
  launch.peak_pressure = number("peak_pressure_Pa", above_to(0, 10e9));
  launch.duration = number("duration_s", above_to(0, 1));
  launch.rise_time = number("rise_time_s", above_to(0, 1e6));
  launch.roughness = number("roughness", between(0, 1e3));
  launch.crack_radius = number("crack_radius_m", between(0, 1));
  launch.flaw_size = number("flaw_size_m", between(0, 1));
  launch.localisation = number("localisation", between(0, 1e6));
  launch.air_heating = number("air_heating_K_per_s_m", between(0, 1e15));
  constexpr std::size_t most_gaps = 100'000;
  launch.gaps = reader.numbers(object["gaps_m"], "launch.gaps_m", between(0, widest_gap), 1, most_gaps);
  const std::set<double> different(launch.gaps.begin(), launch.gaps.end());
  if (different.size() != launch.gaps.size()) reader.refuse("launch.gaps_m", "a gap twice", "each gap once");
  launch.shape =
      reader.numbers(object["shape"], "launch.shape", between(0, 1), shape_instants, shape_instants);
  return launch;
}

RecordedSetting recorded_from(const ordered_json& object, const std::string& path,
                              const AccuracyRecord& record, RecordReader& reader) {
  using scene::above_to, scene::between;
  RecordedSetting each;
  if (!reader.has_keys(object, path,
                       {"label", "temperature_bound_K", "critical_gap_bound_m", "processor_time_s",
                        "reference", "cell_m", "temperature_K", "critical_gap_m", "setting"}))
    return each;
  const auto inside = [&](const char* key) { return path + "." + key; };
  each.label = reader.text(object["label"], inside("label"));
  each.temperature_bound = reader.number_or_none(object["temperature_bound_K"], inside("temperature_bound_K"),
                                                 between(smallest_bound, 10 * highest_recorded_temperature));
  each.critical_gap_bound = reader.number_or_none(
      object["critical_gap_bound_m"], inside("critical_gap_bound_m"), between(0, 10 * widest_gap));
  each.processor_time = reader.number(object["processor_time_s"], inside("processor_time_s"),
                                      above_to(0, longest_processor_time));
  each.reference = reader.flag(object["reference"], inside("reference"));
  each.cell = reader.number(object["cell_m"], inside("cell_m"), above_to(0, 1));
  const std::size_t gaps = record.launch.gaps.size();
  each.temperature =
      reader.numbers(object["temperature_K"], inside("temperature_K"),
                     between(record.initial_temperature - 1.0, highest_recorded_temperature), gaps, gaps);
  each.critical_gap =
      reader.number_or_none(object["critical_gap_m"], inside("critical_gap_m"), between(0, widest_gap));
  each.setting = setting_from(object["setting"], inside("setting"), reader);
  return each;
}

/// What single values do not show.
void check_settings(const AccuracyRecord& record, RecordReader& reader) {
  std::size_t meshes = 0;
  for (std::size_t i = 0; i < record.settings.size(); ++i) {
    const RecordedSetting& each = record.settings[i];
    const std::string path = fmt::format("settings.{}", i);
    if (each.label.empty() ||
        std::any_of(each.label.begin(), each.label.end(), [](unsigned char c) { return c < 0x20; }))
      reader.refuse(path + ".label", quoted(each.label), "a line of text");
    for (std::size_t j = 0; j < i; ++j) {
      if (same_setting(each.setting, record.settings[j].setting))
        reader.refuse(path + ".setting", "the same as that of " + quoted(record.settings[j].label),
                      "each setting once");
    }
    const double nominal = std::get<double>(each.setting.at("numerics.cell_size"));
    if (each.cell > nominal * (1.0 + 1e-6))
      reader.refuse(path + ".cell_m", fmt::format("{:g}", each.cell),
                    fmt::format("at most the cell size of the setting, {:g}", nominal));
    if (!each.reference) continue;
    if (meshes++ != i) reader.refuse(path + ".reference", "true", "the reference meshes before all others");
    if (i == 0) continue;
    const RecordedSetting& finer = record.settings[i - 1];
    Setting same = finer.setting;
    same["numerics.cell_size"] = each.setting.at("numerics.cell_size");
    if (!same_setting(same, each.setting) || !(each.cell > finer.cell))
      reader.refuse(path, "a reference mesh that is no coarser one of the same series",
                    "meshes that differ in the cell size alone, the finest first");
  }
  if (meshes < fewest_reference_meshes)
    reader.refuse("settings", fmt::format("{} reference meshes", meshes),
                  fmt::format("at least {}", fewest_reference_meshes));
}

/// Equal but for round-off; two that are not known are equal.
bool same_bound(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

void check_bounds(const AccuracyRecord& record, RecordReader& reader) {
  AccuracyRecord found = record;
  find_bounds(found);
  if (!(found.rise > 0.0))
    reader.refuse("settings.0.temperature_K", fmt::format("a rise by {:g} K", found.rise),
                  "a rise above 0 K");
  const auto text = [](double bound) { return std::isnan(bound) ? "null" : fmt::format("{:.9g}", bound); };
  for (std::size_t i = 0; i < record.settings.size(); ++i) {
    const RecordedSetting &given = record.settings[i], &right = found.settings[i];
    const auto compare = [&](const char* key, double a, double b) {
      if (same_bound(a, b)) return;
      reader.refuse(fmt::format("settings.{}.{}", i, key), text(a),
                    text(b) + ", which follows from what the settings gave");
    };
    compare("temperature_bound_K", given.temperature_bound, right.temperature_bound);
    compare("critical_gap_bound_m", given.critical_gap_bound, right.critical_gap_bound);
  }
}

AccuracyRecord record_from(const ordered_json& object, RecordReader& reader) {
  AccuracyRecord record;
  if (!reader.has_keys(object, "",
                       {"format", "digest", "title", "model_version", "shell", "initial_temperature_K",
                        "launch", "settings"}))
    return record;
  record.title = reader.text(object["title"], "title");
  record.model_version =
      reader.whole(object["model_version"], "model_version", 1, std::numeric_limits<int>::max());
  record.shell = reader.text(object["shell"], "shell");
  record.initial_temperature =
      reader.number(object["initial_temperature_K"], "initial_temperature_K", scene::between(200, 500));
  record.launch = launch_from(object["launch"], reader);
  if (!object["settings"].is_array() || object["settings"].size() > most_settings)
    reader.refuse("settings", found_in(object["settings"]),
                  fmt::format("an array of at most {} settings", most_settings));
  if (reader.fault()) return record;
  for (const ordered_json& each : object["settings"]) {
    record.settings.push_back(
        recorded_from(each, fmt::format("settings.{}", record.settings.size()), record, reader));
    if (reader.fault()) return record;
  }
  check_settings(record, reader);
  return record;
}

}  // namespace

std::string to_json_text(const AccuracyRecord& record) {
  ordered_json object = content_of(record);
  return record_text(std::move(object));
}

scene::Expected<AccuracyRecord> parse_accuracy_record(const std::string& text, const std::string& file) {
  RecordReader reader(file);
  const auto object = reader.parse(text, format_name, "accuracy.json", "a study of kind accuracy");
  if (!object) return *reader.fault();
  AccuracyRecord record = record_from(*object, reader);
  if (!reader.fault()) check_bounds(record, reader);
  if (!reader.fault()) reader.check_digest(*object, content_of(record));
  if (reader.fault()) return *reader.fault();
  find_bounds(record);
  return record;
}

}  // namespace launchsafe::study
