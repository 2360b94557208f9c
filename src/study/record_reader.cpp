#include "launchsafe/study/record_reader.hpp"

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/file.hpp"

#include <set>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;
using scene::Limits;

constexpr auto replace_invalid = ordered_json::error_handler_t::replace;

std::string digest_of(const ordered_json& content) {
  return store::sha256(content.dump(-1, ' ', false, replace_invalid));
}

std::string allowed_by(const Limits& limits) {
  return fmt::format("a number {} {:g}{}", limits.lowest_allowed ? "from" : "above", limits.lowest,
                     std::isfinite(limits.highest) ? fmt::format(" to {:g}", limits.highest) : "");
}

[[noreturn]] void throw_fault(std::string key, std::string found, std::string allowed) {
  throw scene::error_at({}, key, std::move(found), std::move(allowed));
}

}  // namespace

std::string record_text(ordered_json content) {
  content["digest"] = digest_of(content);
  return content.dump(2, ' ', false, replace_invalid) + "\n";
}

std::string quoted(const std::string& text) {
  constexpr std::size_t longest = 60;
  return '"' + (text.size() > longest ? text.substr(0, longest) + "..." : text) + '"';
}

std::string found_in(const ordered_json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("{} values", value.size());
  if (value.is_string()) return quoted(value.get<std::string>());
  return value.dump(-1, ' ', false, replace_invalid);
}

ordered_json json_of(const std::string& text, const RecordFormat& format) {
  const std::string wanted = fmt::format("the {} that `launchsafe` writes for {}", format.file, format.study);
  std::vector<std::set<std::string>> open;
  const auto watch = [&](int, ordered_json::parse_event_t event, ordered_json& parsed) {
    using Event = ordered_json::parse_event_t;
    if (event == Event::object_start) open.emplace_back();
    if (event == Event::object_end) open.pop_back();
    if (event == Event::key && !open.back().insert(parsed.get<std::string>()).second)
      throw_fault(parsed.get<std::string>(), "the key twice", "each key once");
    return true;
  };
  ordered_json object;
  try {
    object = ordered_json::parse(text, watch);
  } catch (const ordered_json::parse_error& error) {
    const auto fault = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), fault, '\n');
    throw scene::error_at({{}, static_cast<int>(line), 1}, "", "no JSON", wanted);
  } catch (const ordered_json::exception&) {  // a number that none can be
    throw_fault("", "no JSON", wanted);
  }
  if (!object.is_object() || !object.contains("format"))
    throw_fault("format", fmt::format("nothing; this is no {}", format.file), wanted);
  if (object["format"] != format.name)
    throw_fault("format", found_in(object["format"]),
                fmt::format("\"{}\", which `launchsafe` of this version writes for {}; make the record anew",
                            format.name, format.study));
  return object;
}

void check_digest(const ordered_json& object, const ordered_json& content) {
  const auto given = object.find("digest");
  if (given == object.end() || *given != digest_of(content))
    throw_fault("digest", given == object.end() ? "nothing" : found_in(*given),
                "the SHA-256 of the content, which was edited; make the record anew");
}

void RecordObject::refuse(const std::string& key, std::string found, std::string allowed) const {
  throw_fault(path_of(key), std::move(found), std::move(allowed));
}

void RecordObject::check_keys(const std::vector<std::string>& keys) const {
  if (!json_->is_object()) throw_fault(path_, found_in(*json_), "an object");
  for (const auto& [key, value] : json_->items())
    if (std::ranges::find(keys, key) == keys.end())
      refuse(key, "a key that no record has", "only " + scene::quoted_list(keys));
  for (const std::string& key : keys)
    if (!json_->contains(key)) refuse(key, "nothing; the key is missing", "a value");
}

void RecordObject::check_list(const Json& given, const std::string& key, std::size_t fewest,
                              std::size_t most) const {
  if (!given.is_array() || given.size() < fewest || given.size() > most)
    refuse(key, found_in(given),
           fewest == most ? fmt::format("{} numbers", most) : fmt::format("{} to {} numbers", fewest, most));
}

void RecordObject::read(const Json& given, const std::string& key, double& number, const Limits& limits) {
  number = given.is_number() ? given.get<double>() : math::not_a_number;
  if (!std::isfinite(number) || !limits.contain(number)) refuse(key, found_in(given), allowed_by(limits));
}

void RecordObject::read(const Json& given, const std::string& key, double& number, const OrNone& allowed) {
  number = math::not_a_number;
  if (!given.is_null()) read(given, key, number, allowed.limits);
}

void RecordObject::read(const Json& given, const std::string& key, int& whole, int lowest, int highest) {
  // A larger number would be cut to another one by get<int>.
  if (!given.is_number_integer() || given < lowest || given > highest)
    refuse(key, found_in(given), fmt::format("a whole number from {} to {}", lowest, highest));
  whole = given.get<int>();
}

void RecordObject::read(const Json& given, const std::string& key, bool& flag) {
  if (!given.is_boolean()) refuse(key, found_in(given), "true or false");
  flag = given.get<bool>();
}

void RecordObject::read(const Json& given, const std::string& key, std::string& text) {
  if (!given.is_string()) refuse(key, found_in(given), "a text");
  text = given.get<std::string>();
}

void RecordObject::model_version(const char* anew) {
  int version = run::model_version;
  value("model_version", version, 1, 1'000'000);
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
