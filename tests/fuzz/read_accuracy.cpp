// Accuracy records from any bytes, as they are and with the digest of what they became. Whatever is read must
// be what the program writes, claim nothing that does not follow from it, and set numerics only; whatever is
// not must say why.
#include "fuzz_input.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/accuracy_record.hpp"
#include "record_text.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace {

using namespace launchsafe;

void check_record(const study::AccuracyRecord& record) {
  const std::string written = study::to_json_text(record);
  const auto again = study::parse_accuracy_record(written, "accuracy.json");
  fuzz::require(again.has_value(), "a record can be written and read", written);
  fuzz::require(study::to_json_text(*again) == written, "what was written is the same record", written);
  fuzz::require(record.rise > 0.0 && !record.launch.shape.empty(), "a record is of a launch", written);
  const study::RecordedSetting* nearest = study::most_accurate(record);
  for (const study::RecordedSetting& each : record.settings) {
    const double least = 1e-5, most = 10.0 * study::highest_recorded_temperature;
    fuzz::require(std::isnan(each.temperature_bound) == !record.unvaried.empty(),
                  "a bound is known unless a key is unvaried", written);
    fuzz::require(!(each.temperature_bound < least) && !(each.temperature_bound > most),
                  "a bound is plausible", written);
    for (const auto& [key, value] : each.setting)
      fuzz::require(study::belongs_to_setting(*scene::find_key(scene::scene_keys(), key)),
                    "a setting sets numerics", written);
    fuzz::require(!nearest || each.temperature_bound >= nearest->temperature_bound,
                  "the most accurate setting is so", written);
  }
}

void read(const std::string& text) {
  const auto record = study::parse_accuracy_record(text, "accuracy.json");
  record ? check_record(*record) : fuzz::require_told(record.error());
}

const std::string& small_scene() {
  static const std::string text = [] {
    std::ifstream stream(LAUNCHSAFE_FUZZ_SCENE, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }();
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  read(fuzz::with_digest(text));
  read(fuzz::with_scene(text, small_scene()));
  return 0;
}
