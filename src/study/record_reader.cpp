#include "launchsafe/study/record_reader.hpp"

#include "launchsafe/run/case_result.hpp"

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

[[noreturn]] void throw_fault(std::string key, std::string found, std::string allowed) {
  throw scene::error_at({}, key, std::move(found), std::move(allowed));
}

}  // namespace

ordered_json json_of(const std::string& text, const RecordFormat& format) {
  const std::string wanted = fmt::format("the {} that `launchsafe` writes for {}", format.file, format.study);
  const ordered_json object = ordered_json::parse(text, nullptr, false);
  if (!object.is_object() || object.value("format", ordered_json()) != format.name)
    throw_fault("format", fmt::format("another one than \"{}\", of this version", format.name),
                wanted + "; make the record anew");
  return object;
}

void RecordObject::refuse(const std::string& key, std::string found, std::string allowed) const {
  throw_fault(path_of(key), std::move(found), std::move(allowed));
}

void RecordObject::model_version(const char* anew) {
  int version = run::model_version;
  value("model_version", version);
  if (reading() && version != run::model_version)
    refuse("model_version", fmt::format("{}", version),
           fmt::format("{}, the version of this program; {}", run::model_version, anew));
}

void RecordObject::scene(scene::Scene& scene, const char* what) {
  std::string text = reading() ? std::string{} : scene::to_toml(scene);
  value("scene", text);
  if (!reading()) return;
  auto read = scene::parse_scene(text, "scene of the record");
  if (!read) refuse("scene", "a scene that cannot be read: " + read.error().message(), what);
  scene = std::move(read->scene);
}

}  // namespace launchsafe::study
