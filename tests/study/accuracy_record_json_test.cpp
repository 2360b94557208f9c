// Records as text: what comes back, and what is refused. tests/fuzz/read_accuracy.cpp edits at random.
#include "study/made_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;
using nlohmann::ordered_json;

const std::string made_text() { return to_json_text(made_record()); }

/// Why a text is refused.
scene::InputError refusal_of(const std::string& text) {
  const auto record = parse_accuracy_record(text, "accuracy.json");
  EXPECT_FALSE(record) << text;
  return record ? scene::InputError{} : record.error();
}

TEST(AccuracyRecordText, IsReadBackAsItWasWritten) {
  AccuracyRecord made = made_record();
  made.title = "several\nlines, \"quotes\" and \xC3\xBC";
  made.settings[3].critical_gap = std::nan("");
  find_bounds(made);
  const auto record = parse_accuracy_record(to_json_text(made), "accuracy.json");
  ASSERT_TRUE(record) << record.error().message();
  EXPECT_EQ(to_json_text(*record), to_json_text(made));
  EXPECT_EQ(record->title, made.title);
  EXPECT_EQ(record->rise, made.rise);
  ASSERT_EQ(record->settings.size(), made.settings.size());
  EXPECT_TRUE(same_setting(record->settings[3].setting, setting_of(scaled(16))));
  EXPECT_EQ(record->settings[3].temperature_bound, made.settings[3].temperature_bound);
  EXPECT_TRUE(std::isnan(record->settings[3].critical_gap_bound));
}

TEST(AccuracyRecordText, MayBeLaidOutAnew) {
  const auto record = parse_accuracy_record(ordered_json::parse(made_text()).dump(), "accuracy.json");
  ASSERT_TRUE(record) << record.error().message();
  EXPECT_EQ(to_json_text(*record), made_text());
}

TEST(AccuracyRecordText, OfAnotherFormatSaysHowToMakeItAnew) {
  for (const char* text : {R"({"format": "launchsafe accuracy record 2", "title": "x"})",
                           R"({"format": "launchsafe accuracy record 4"})", R"({"format": 2})"}) {
    const scene::InputError error = refusal_of(text);
    EXPECT_EQ(error.file, "accuracy.json");
    EXPECT_EQ(error.key, "format");
    EXPECT_NE(error.allowed.find("anew"), std::string::npos) << error.message();
  }
  for (const char* text : {"", "{}", "[]", "null", "no json", "{\"format\"", "1e999"}) {
    const scene::InputError error = refusal_of(text);
    EXPECT_FALSE(error.allowed.empty()) << text;
  }
}

/// An edit of the text's content, and the key that the refusal names; the digest is computed anew.
struct Edit {
  std::string key;
  std::function<void(ordered_json&)> apply;
};

ordered_json& setting(ordered_json& record, std::size_t index) { return record["settings"][index]; }

/// Replaces some of the recorded scene.
void edit_scene(ordered_json& record, const std::string& from, const std::string& to) {
  std::string text = record["scene"];
  ASSERT_NE(text.find(from), std::string::npos) << text;
  record["scene"] = text.replace(text.find(from), from.size(), to);
}

Edit value_of(const std::string& path, const ordered_json& value) {
  std::string pointer = "/" + path;
  // The keys of a setting have dots of their own.
  const std::size_t inner = pointer.find("setting.");
  const std::size_t end = inner == std::string::npos ? pointer.size() : inner + 8;
  std::replace(pointer.begin(), pointer.begin() + static_cast<std::ptrdiff_t>(end), '.', '/');
  return {path,
          [pointer, value](ordered_json& record) { record.at(ordered_json::json_pointer(pointer)) = value; }};
}

std::vector<Edit> impossible_edits() {
  const std::string bound = "settings.2.temperature_bound_K";
  const std::uint64_t wraps_to_one = (std::uint64_t{1} << 32) + 1;
  return {
      value_of(bound, 0.0),
      value_of(bound, nullptr),
      value_of(bound, -1.0),
      value_of(bound, 1e300),
      value_of(bound, 1.0),
      value_of(bound, "1"),
      value_of("settings.3.critical_gap_bound_m", 0.0),
      value_of("settings.3.critical_gap_bound_m", nullptr),
      value_of("settings.2.processor_time_s", 0.0),
      value_of("settings.2.processor_time_s", -1.0),
      value_of("settings.2.processor_time_s", 1e300),
      value_of("settings.2.processor_time_s", nullptr),
      value_of("settings.2.cell_m", 0.0),
      value_of("settings.2.cell_m", 1.0),
      value_of("settings.2.reference", 1),
      value_of("settings.2.label", ""),
      value_of("settings.2.label", "two\nlines"),
      value_of("settings.2.temperature_K", ordered_json::array({416.0, 466.0})),
      {"settings.2.temperature_K.0", [](auto& r) { setting(r, 2)["temperature_K"][0] = 1e300; }},
      {"settings.2.temperature_K.0", [](auto& r) { setting(r, 2)["temperature_K"][0] = nullptr; }},
      {"settings.2.temperature_K.0", [](auto& r) { setting(r, 2)["temperature_K"][0] = 250.0; }},
      value_of("settings.2.critical_gap_m", -1e-4),
      value_of("model_version", wraps_to_one),
      value_of("model_version", 1.0),
      value_of("model_version", -1),
      value_of("model_version", 0),
      value_of("model_version", true),
      value_of("scene", 3),
      value_of("scene", "title = 3"),
      value_of("title", nullptr),
      {"scene", [](auto& r) { edit_scene(r, "gap.thickness = \"0,", "gap.thickness = \"0, 0,"); }},
      value_of("settings", ordered_json::object()),
      value_of("settings.3", 5),
      // A record sets numerics and nothing else.
      {"settings.3.setting.load.peak", [](auto& r) { setting(r, 3)["setting"]["load.peak"] = 1e6; }},
      {"settings.3.setting.gap.exchange_time",
       [](auto& r) { setting(r, 3)["setting"]["gap.exchange_time"] = 100.0; }},
      {"settings.3.setting.kinetics.ignition_temperature",
       [](auto& r) { setting(r, 3)["setting"]["kinetics.ignition_temperature"] = 1e6; }},
      {"settings.3.setting.numerics.energy_drift_limit",
       [](auto& r) { setting(r, 3)["setting"]["numerics.energy_drift_limit"] = 100.0; }},
      {"settings.3.setting.frame", [](auto& r) { setting(r, 3)["setting"].erase("frame"); }},
      value_of("settings.3.setting.frame", "sideways"),
      value_of("settings.3.setting.frame", 1.0),
      value_of("settings.3.setting.numerics.cell_size", -1e-3),
      value_of("settings.3.setting.numerics.cell_size", "1 mm"),
      value_of("settings.3.setting.numerics.particles_per_cell", 1.5),
      value_of("settings.3.setting.numerics.inertial_scaling", true),
      // Meshes that are none.
      {"settings.3.setting", [](auto& r) { setting(r, 3)["setting"] = setting(r, 2)["setting"]; }},
      {"settings.3", [](auto& r) { setting(r, 3)["reference"] = true; }},
      {"settings.1.reference", [](auto& r) { setting(r, 0)["reference"] = false; }},
      {"settings.1", [](auto& r) { std::swap(setting(r, 0), setting(r, 1)); }},
      {"settings.1", [](auto& r) { setting(r, 1)["setting"]["numerics.pic_fraction"] = 0.5; }},
      {"settings", [](auto& r) { r["settings"].erase(1); }},
      {"settings", [](auto& r) { r["settings"] = ordered_json::array(); }},
      // Other keys than a record has.
      {"rise_K", [](auto& r) { r["rise_K"] = 1e9; }},
      {"settings.0.extra", [](auto& r) { setting(r, 0)["extra"] = 1; }},
      {"scene", [](auto& r) { r.erase("scene"); }},
  };
}

TEST(AccuracyRecordText, IsRefusedWhereItIsImpossibleEvenIfItsDigestIsRight) {
  ASSERT_TRUE(parse_accuracy_record(rehashed(ordered_json::parse(made_text())), "accuracy.json"))
      << "the digest is that of the content, so the edits below are refused for themselves";
  for (const Edit& edit : impossible_edits()) {
    ordered_json record = ordered_json::parse(made_text());
    edit.apply(record);
    const scene::InputError error = refusal_of(rehashed(record));
    EXPECT_EQ(error.key, edit.key) << error.message();
    EXPECT_FALSE(error.found.empty() || error.allowed.empty()) << error.message();
  }
}

/// Temperatures that make the bounds they stand beside wrong.
TEST(AccuracyRecordText, IsRefusedWhereItsBoundsDoNotFollowFromItsTemperatures) {
  ordered_json record = ordered_json::parse(made_text());
  for (auto& temperature : setting(record, 3)["temperature_K"]) temperature = temperature.get<double>() - 3.0;
  EXPECT_EQ(refusal_of(rehashed(record)).key, "settings.3.temperature_bound_K");
}

TEST(AccuracyRecordText, IsRefusedWhereNothingHeats) {
  AccuracyRecord record = made_record();
  for (RecordedSetting& each : record.settings) each.temperature.assign(3, 300.0);
  find_bounds(record);
  const scene::InputError error = refusal_of(to_json_text(record));
  EXPECT_EQ(error.key, "settings.0.temperature_bound_K") << "equal meshes: a bound of round-off";
  for (RecordedSetting& each : record.settings)
    each.temperature.assign(3, 300.0 - 1e3 * each.cell * each.cell);
  find_bounds(record);
  EXPECT_EQ(refusal_of(to_json_text(record)).key, "settings.0.temperature_K");
}

TEST(AccuracyRecordText, IsRefusedWithAKeyGivenTwice) {
  std::string text = made_text();
  text.insert(text.find("\"scene\""), "\"scene\": \"\", ");
  EXPECT_EQ(refusal_of(text).key, "scene");
}

TEST(AccuracyRecordText, ThatIsNoJsonIsRefusedWithItsPlace) {
  std::string text = made_text();
  text.insert(text.find("\"scene\""), ", ");
  EXPECT_EQ(
      parse_accuracy_record(text, "accuracy.json").error().line,
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("\"scene\"")), '\n'));
}

TEST(AccuracyRecordText, IsRefusedWithAnEditThatItsDigestDoesNotKnow) {
  const std::vector<Edit> edits{{"peak", [](auto& r) { edit_scene(r, "496000000 Pa", "900000000 Pa"); }},
                                value_of("settings.2.processor_time_s", 1e-3),
                                value_of("settings.3.label", "exact"),
                                value_of("title", "another"),
                                value_of("digest", std::string(64, '0')),
                                value_of("digest", nullptr)};
  for (const Edit& edit : edits) {
    ordered_json record = ordered_json::parse(made_text());
    edit.apply(record);
    EXPECT_EQ(refusal_of(record.dump()).key, "digest") << edit.key;
  }
}

}  // namespace
