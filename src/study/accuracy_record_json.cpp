// Accuracy records as JSON, written and read with distrust.
#include "launchsafe/study/record_reader.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <set>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

constexpr RecordFormat accuracy_format{
    "launchsafe accuracy record 3", "accuracy.json", "a study of kind accuracy", {"format", "digest"}};
constexpr std::size_t fewest_reference_meshes = 3;
/// K. Skins are integrated to about this; no mesh study says less of a temperature.
constexpr double smallest_bound = 1e-4;
constexpr double longest_processor_time = 1e9;  ///< s, some thirty years
constexpr double widest_gap = 0.01;             ///< m, as in studies

/// Whether a key may have a value that no reader of scenes has checked.
bool may_take(const scene::KeyDescription& key, const scene::Value& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return key.kind == scene::KeyKind::word && std::ranges::find(key.words, *word) != key.words.end();
  if (std::holds_alternative<bool>(value)) return key.kind == scene::KeyKind::flag;
  if (std::holds_alternative<std::vector<double>>(value)) return key.kind == scene::KeyKind::list;
  const double number = std::get<double>(value);
  const bool whole = key.dimension != scene::Dimension::count || number == std::round(number);
  return key.kind == scene::KeyKind::number && std::isfinite(number) && whole && key.limits.contain(number);
}

/// The value of a key of scenes.
void describe_value(RecordObject& object, const std::string& key, scene::Value& value) {
  ordered_json& here = object[key];
  if (!object.reading()) return std::visit([&here](const auto& known) { here = known; }, value);
  const scene::KeyDescription& known = *scene::find_key(scene::scene_keys(), key);
  value = math::not_a_number;
  if (here.is_boolean()) value = here.get<bool>();
  if (here.is_number()) value = here.get<double>();
  if (here.is_string()) value = here.get<std::string>();
  constexpr std::size_t most_places = 1000;
  if (here.is_array())
    object.read(here, key, value.emplace<std::vector<double>>(), known.limits, 0, most_places);
  if (!may_take(known, value)) object.refuse(key, found_in(here), scene::allowed_text(known));
}

/// JSON writes what is not finite as null.
void describe_setting(RecordObject& object, RecordedSetting& each, const AccuracyRecord& record,
                      const Setting& own) {
  using scene::above_to, scene::between;
  const std::size_t gaps = record.scene.surface.gaps.size();
  object.value("label", each.label);
  object.value("temperature_bound_K", each.temperature_bound,
               OrNone{between(smallest_bound, 10 * highest_recorded_temperature)});
  object.value("critical_gap_bound_m", each.critical_gap_bound, OrNone{between(0, 10 * widest_gap)});
  object.value("processor_time_s", each.processor_time, above_to(0, longest_processor_time));
  object.value("reference", each.reference);
  object.value("cell_m", each.cell, above_to(0, 1));
  object.value("temperature_K", each.temperature,
               between(record.scene.initial_temperature - 1.0, highest_recorded_temperature), gaps, gaps);
  object.value("critical_gap_m", each.critical_gap, OrNone{between(0, widest_gap)});
  // Every key of a setting of the scene, none besides.
  object.part("setting", each.setting, [&own](RecordObject& part, Setting& setting) {
    for (const auto& [key, usual] : own) describe_value(part, key, setting[key]);
  });
}

/// What single values do not show.
void check_settings(const AccuracyRecord& record, const RecordObject& object) {
  std::size_t meshes = 0;
  for (std::size_t i = 0; i < record.settings.size(); ++i) {
    const RecordedSetting& each = record.settings[i];
    const std::string path = fmt::format("settings.{}", i);
    if (each.label.empty() || std::ranges::any_of(each.label, [](unsigned char c) { return c < 0x20; }))
      object.refuse(path + ".label", quoted(each.label), "a line of text");
    for (std::size_t j = 0; j < i; ++j) {
      if (same_setting(each.setting, record.settings[j].setting))
        object.refuse(path + ".setting", "the same as that of " + quoted(record.settings[j].label),
                      "each setting once");
    }
    const double nominal = std::get<double>(each.setting.at("numerics.cell_size"));
    if (each.cell > nominal * (1.0 + 1e-6))
      object.refuse(path + ".cell_m", fmt::format("{:g}", each.cell),
                    fmt::format("at most the cell size of the setting, {:g}", nominal));
    if (!each.reference) continue;
    if (meshes++ != i) object.refuse(path + ".reference", "true", "the reference meshes before all others");
    if (i == 0) continue;
    const RecordedSetting& finer = record.settings[i - 1];
    Setting same = finer.setting;
    same["numerics.cell_size"] = each.setting.at("numerics.cell_size");
    if (!same_setting(same, each.setting) || !(each.cell > finer.cell))
      object.refuse(path, "a reference mesh that is no coarser one of the same series",
                    "meshes that differ in the cell size alone, the finest first");
  }
  if (meshes < fewest_reference_meshes)
    object.refuse("settings", fmt::format("{} reference meshes", meshes),
                  fmt::format("at least {}", fewest_reference_meshes));
}

void check_bounds(const AccuracyRecord& record, const RecordObject& object) {
  AccuracyRecord found = record;
  find_bounds(found);
  if (!(found.rise > 0.0))
    object.refuse("settings.0.temperature_K", fmt::format("a rise by {:g} K", found.rise),
                  "a rise above 0 K");
  const auto text = [](double bound) { return std::isnan(bound) ? "null" : fmt::format("{:.9g}", bound); };
  for (std::size_t i = 0; i < record.settings.size(); ++i) {
    const RecordedSetting &given = record.settings[i], &right = found.settings[i];
    const auto compare = [&](const char* key, double a, double b) {
      // Equal but for round-off; two that are not known are equal.
      if (same_number(a, b) || (std::isnan(a) && std::isnan(b))) return;
      object.refuse(fmt::format("settings.{}.{}", i, key), text(a),
                    text(b) + ", which follows from what the settings gave");
    };
    compare("temperature_bound_K", given.temperature_bound, right.temperature_bound);
    compare("critical_gap_bound_m", given.critical_gap_bound, right.critical_gap_bound);
  }
}

void describe_accuracy(RecordObject& object, AccuracyRecord& record) {
  object.value("title", record.title);
  object.model_version("make it anew");
  object.scene(record.scene, "the scene of the accuracy study");
  const std::vector<double>& gaps = record.scene.surface.gaps;
  if (object.reading() && std::set<double>(gaps.begin(), gaps.end()).size() != gaps.size())
    object.refuse("scene", "a gap twice", "each gap once");
  const Setting setting = setting_of(record.scene);
  // More settings would take long to compare with each other.
  object.list(
      "settings", record.settings, 0, 3000, "an array of at most 3000 settings",
      [&](RecordObject& own, RecordedSetting& each) { describe_setting(own, each, record, setting); });
  if (!object.reading()) return;
  check_settings(record, object);
  check_bounds(record, object);
}

}  // namespace

std::string to_json_text(const AccuracyRecord& record) {
  return record_text(content_by(accuracy_format, describe_accuracy, record));
}

scene::Expected<AccuracyRecord> parse_accuracy_record(const std::string& text, const std::string& file) {
  auto record = parse_record<AccuracyRecord>(text, file, accuracy_format, describe_accuracy);
  if (record) find_bounds(*record);
  return record;
}

}  // namespace launchsafe::study
