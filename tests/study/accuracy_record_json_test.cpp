// Records as text: what comes back, and what is refused.
#include "study/made_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

/// An edit of the text's content, and the key that the refusal names.
struct Edit {
  std::string key;
  std::function<void(ordered_json&)> apply;
};

TEST(AccuracyRecordText, OfAnotherModelOrWithoutAKeyIsRefused) {
  const std::vector<Edit> edits{
      {"scene", [](auto& r) { r.erase("scene"); }},
      {"scene", [](auto& r) { r["scene"] = "title = 3"; }},
      {"title", [](auto& r) { r["title"] = 3; }},
      {"model_version", [](auto& r) { r["model_version"] = 1; }},
      {"settings", [](auto& r) { r["settings"] = 5; }},
      {"temperature_K", [](auto& r) { r["settings"][2]["temperature_K"].erase(0); }},
      {"processor_time_s", [](auto& r) { r["settings"][2]["processor_time_s"] = "1 s"; }},
      {"numerics.formulation", [](auto& r) { r["settings"][2]["setting"].erase("numerics.formulation"); }}};
  for (const auto& [key, edit] : edits) {
    ordered_json record = ordered_json::parse(made_text());
    edit(record);
    const scene::InputError error = refusal_of(record.dump());
    EXPECT_TRUE(error.key.ends_with(key)) << error.message();
    EXPECT_FALSE(error.found.empty() || error.allowed.empty()) << error.message();
  }
}

}  // namespace
