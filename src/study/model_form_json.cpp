// The record of model form as JSON, read with distrust.
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/study/model_form.hpp"
#include "launchsafe/study/record_reader.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

constexpr const char* model_form_format = "launchsafe model form 1";
constexpr const char* no_ignition_text = "none";
constexpr double widest_critical_gap = 0.01;  ///< m
constexpr std::size_t most_pressures = 1000;
constexpr std::size_t most_alternatives = 1000;

ordered_json json_of_gaps(const std::vector<GapOrBound>& gaps) {
  ordered_json list = ordered_json::array();
  for (const GapOrBound gap : gaps) {
    if (gap == no_ignition) {
      list.push_back(no_ignition_text);
    } else {
      list.push_back(gap);  // null where it is not a number
    }
  }
  return list;
}

ordered_json content_of(const ModelFormRecord& record) {
  ordered_json alternatives = ordered_json::array();
  for (const ModelAlternative& each : record.alternatives) {
    alternatives.push_back({{"name", each.name},
                            {"title", each.title},
                            {"not_counted", each.not_counted},
                            {"critical_gap_m", json_of_gaps(each.critical_gap)}});
  }
  return {{"format", model_form_format},
          {"model_version", record.model_version},
          {"scene", scene::to_toml(record.scene)},
          {"peak_pressures_Pa", record.peak_pressures},
          {"critical_gap_m", json_of_gaps(record.critical_gap)},
          {"alternatives", std::move(alternatives)}};
}

std::vector<std::string> keys_of_record() {
  std::vector<std::string> keys{"digest"};
  const ordered_json content = content_of(ModelFormRecord{});
  for (const auto& [key, value] : content.items()) keys.push_back(key);
  return keys;
}

int version_from(const ordered_json& object, RecordReader& reader) {
  const int version = reader.whole(object["model_version"], "model_version", 1, 1'000'000);
  if (!reader.fault() && version != run::model_version) {
    reader.refuse("model_version", fmt::format("{}", version),
                  fmt::format("{}, the version of this program; make it anew", run::model_version));
  }
  return version;
}

scene::Scene scene_from(const ordered_json& object, RecordReader& reader) {
  const std::string text = reader.text(object["scene"], "scene");
  if (reader.fault()) return {};
  auto read = scene::parse_scene(text, "scene of the record");
  if (!read) {
    reader.refuse("scene", "a scene that cannot be read: " + read.error().message(), "a scene");
    return {};
  }
  return std::move(read->scene);
}

std::vector<double> pressures_from(const ordered_json& object, RecordReader& reader) {
  auto pressures = reader.numbers(object["peak_pressures_Pa"], "peak_pressures_Pa", scene::above_to(0, 10e9),
                                  1, most_pressures);
  for (std::size_t i = 1; i < pressures.size(); ++i) {
    if (!(pressures[i] > pressures[i - 1]))
      reader.refuse("peak_pressures_Pa", fmt::format("{:g} after {:g}", pressures[i], pressures[i - 1]),
                    "increasing pressures");
  }
  return pressures;
}

std::vector<GapOrBound> gaps_from(const ordered_json& list, const std::string& path, std::size_t count,
                                  RecordReader& reader) {
  std::vector<GapOrBound> gaps;
  if (!list.is_array() || list.size() != count) {
    reader.refuse(path, found_in(list), fmt::format("{} critical gaps", count));
    return gaps;
  }
  for (const ordered_json& each : list) {
    const bool none = each.is_string() && each.get<std::string>() == no_ignition_text;
    gaps.push_back(none ? no_ignition
                        : reader.number_or_none(each, path, scene::between(0, widest_critical_gap)));
  }
  return gaps;
}

ModelAlternative alternative_from(const ordered_json& object, const std::string& path, std::size_t pressures,
                                  RecordReader& reader) {
  ModelAlternative each;
  if (!reader.has_keys(object, path, {"name", "title", "not_counted", "critical_gap_m"})) return each;
  each.name = reader.text(object["name"], path + ".name");
  each.title = reader.text(object["title"], path + ".title");
  each.not_counted = reader.text(object["not_counted"], path + ".not_counted");
  each.critical_gap = gaps_from(object["critical_gap_m"], path + ".critical_gap_m", pressures, reader);
  for (const GapOrBound gap : each.critical_gap) {
    if (std::isnan(gap) && each.not_counted.empty())
      reader.refuse(path + ".critical_gap_m", "null", "known critical gaps of a model that counts");
  }
  return each;
}

}  // namespace

std::string to_json_text(const ModelFormRecord& record) { return record_text(content_of(record)); }

scene::Expected<ModelFormRecord> parse_model_form(const std::string& text, const std::string& file) {
  RecordReader reader(file);
  const auto object = reader.parse(text, model_form_format, "model_form.json", "a study of kind comparison");
  if (!object) return *reader.fault();
  ModelFormRecord record;
  if (reader.has_keys(*object, "", keys_of_record())) {
    record.model_version = version_from(*object, reader);
    record.scene = scene_from(*object, reader);
    record.peak_pressures = pressures_from(*object, reader);
    const std::size_t pressures = record.peak_pressures.size();
    record.critical_gap = gaps_from((*object)["critical_gap_m"], "critical_gap_m", pressures, reader);
    const ordered_json& alternatives = (*object)["alternatives"];
    if (!alternatives.is_array() || alternatives.empty() || alternatives.size() > most_alternatives)
      reader.refuse("alternatives", found_in(alternatives), "1 to 1000 alternatives");
    for (std::size_t i = 0; !reader.fault() && i < alternatives.size(); ++i)
      record.alternatives.push_back(
          alternative_from(alternatives[i], fmt::format("alternatives.{}", i), pressures, reader));
  }
  if (!reader.fault()) reader.check_digest(*object, content_of(record));
  if (reader.fault()) return *reader.fault();
  return record;
}

}  // namespace launchsafe::study
