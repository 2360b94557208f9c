// Accuracy records as JSON.
#include "launchsafe/study/record_reader.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {
namespace {

constexpr RecordFormat accuracy_format{"launchsafe accuracy record 3", "accuracy.json",
                                       "a study of kind accuracy"};
/// JSON writes what is not finite as null.
void describe_setting(RecordObject& object, RecordedSetting& each, const AccuracyRecord& record,
                      const Setting& own) {
  object.value("label", each.label);
  object.value("temperature_bound_K", each.temperature_bound);
  object.value("critical_gap_bound_m", each.critical_gap_bound);
  object.value("processor_time_s", each.processor_time);
  object.value("reference", each.reference);
  object.value("cell_m", each.cell);
  object.value("temperature_K", each.temperature);
  const std::size_t gaps = record.scene.surface.gaps.size();
  if (object.reading() && each.temperature.size() != gaps)
    object.refuse("temperature_K", "another number of values", fmt::format("{} numbers", gaps));
  object.value("critical_gap_m", each.critical_gap);
  // Every key of a setting of the scene, none besides, with a value of its type.
  object.part("setting", each.setting, [&](RecordObject& part, Setting& setting) {
    if (part.reading()) setting = own;
    for (auto& [key, value] : setting)
      std::visit([&, &name = key](auto& known) { part.value(name, known); }, value);
  });
}

void describe_accuracy(RecordObject& object, AccuracyRecord& record) {
  object.value("title", record.title);
  object.model_version("make it anew");
  object.scene(record.scene, "the scene of the accuracy study");
  const Setting setting = setting_of(record.scene);
  object.list("settings", record.settings, [&](RecordObject& own, RecordedSetting& each) {
    describe_setting(own, each, record, setting);
  });
}

}  // namespace

std::string to_json_text(const AccuracyRecord& record) {
  return record_text(accuracy_format, describe_accuracy, record);
}

scene::Expected<AccuracyRecord> parse_accuracy_record(const std::string& text, const std::string& file) {
  auto record = parse_record<AccuracyRecord>(text, file, accuracy_format, describe_accuracy);
  if (record) find_bounds(*record);
  return record;
}

}  // namespace launchsafe::study
