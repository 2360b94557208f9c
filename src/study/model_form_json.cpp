// The record of model form as JSON, read with distrust.
#include "launchsafe/study/model_form.hpp"
#include "launchsafe/study/record_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

constexpr RecordFormat model_form_format{
    "launchsafe model form 1", "model_form.json", "a study of kind comparison", {"digest", "format"}};
constexpr const char* no_ignition_text = "none";
constexpr double widest_critical_gap = 0.01;  ///< m
constexpr std::size_t most_pressures = 1000;
constexpr std::size_t most_alternatives = 1000;

/// One for every pressure; null where it is not a number.
void describe_gaps(RecordObject& object, std::vector<GapOrBound>& gaps, std::size_t pressures) {
  const std::string key = "critical_gap_m";
  ordered_json& list = object[key];
  if (!object.reading()) {
    list = ordered_json::array();
    for (const GapOrBound gap : gaps)
      list.push_back(gap == no_ignition ? ordered_json(no_ignition_text) : ordered_json(gap));
    return;
  }
  if (!list.is_array() || list.size() != pressures) {
    return object.reader().refuse(object.path_of(key), found_in(list),
                                  fmt::format("{} critical gaps", pressures));
  }
  for (const ordered_json& each : list) {
    double& gap = gaps.emplace_back(no_ignition);
    if (each != no_ignition_text)
      object.reader().read(each, object.path_of(key), gap, OrNone{scene::between(0, widest_critical_gap)});
  }
}

void describe_alternative(RecordObject& object, ModelAlternative& each, std::size_t pressures) {
  object.value("name", each.name);
  object.value("title", each.title);
  object.value("not_counted", each.not_counted);
  describe_gaps(object, each.critical_gap, pressures);
  const bool known = std::none_of(each.critical_gap.begin(), each.critical_gap.end(),
                                  [](double gap) { return std::isnan(gap); });
  if (object.reading() && !known && each.not_counted.empty()) {
    object.reader().refuse(object.path_of("critical_gap_m"), "null",
                           "known critical gaps of a model that counts");
  }
}

void describe_model_form(RecordObject& object, ModelFormRecord& record) {
  object.model_version(record.model_version, "make it anew");
  object.scene(record.scene, "a scene");
  std::vector<double>& pressures = record.peak_pressures;
  object.value("peak_pressures_Pa", pressures, scene::above_to(0, 10e9), 1, most_pressures);
  for (std::size_t i = 1; object.reading() && i < pressures.size(); ++i) {
    if (!(pressures[i] > pressures[i - 1]))
      object.reader().refuse("peak_pressures_Pa",
                             fmt::format("{:g} after {:g}", pressures[i], pressures[i - 1]),
                             "increasing pressures");
  }
  describe_gaps(object, record.critical_gap, pressures.size());
  object.list(
      "alternatives", record.alternatives, 1, most_alternatives, "1 to 1000 alternatives",
      [&](RecordObject& own, ModelAlternative& each) { describe_alternative(own, each, pressures.size()); });
}

}  // namespace

std::string to_json_text(const ModelFormRecord& record) {
  return record_text(content_by(model_form_format, describe_model_form, record));
}

scene::Expected<ModelFormRecord> parse_model_form(const std::string& text, const std::string& file) {
  return parse_record<ModelFormRecord>(text, file, model_form_format, describe_model_form);
}

}  // namespace launchsafe::study
