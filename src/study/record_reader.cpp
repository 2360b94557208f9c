#include "launchsafe/study/record_reader.hpp"

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;
using scene::InputError, scene::Limits;

constexpr auto replace_invalid = ordered_json::error_handler_t::replace;

std::string digest_of(const ordered_json& content) {
  return store::sha256(content.dump(-1, ' ', false, replace_invalid));
}

std::string allowed_by(const Limits& limits) {
  return fmt::format("a number {} {:g}{}", limits.lowest_allowed ? "from" : "above", limits.lowest,
                     std::isfinite(limits.highest) ? fmt::format(" to {:g}", limits.highest) : "");
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

void RecordReader::refuse(const std::string& key, std::string found, std::string allowed) {
  if (!fault_) fault_ = InputError{file_, 0, 0, key, std::move(found), std::move(allowed), {}};
}

std::optional<ordered_json> RecordReader::parse(const std::string& text, const std::string& format,
                                                const std::string& record, const std::string& kind) {
  const std::string wanted = fmt::format("the {} that `launchsafe` writes for {}", record, kind);
  std::vector<std::set<std::string>> open;
  const auto watch = [&](int, ordered_json::parse_event_t event, ordered_json& parsed) {
    using Event = ordered_json::parse_event_t;
    if (event == Event::object_start) open.emplace_back();
    if (event == Event::object_end) open.pop_back();
    if (event == Event::key && !open.back().insert(parsed.get<std::string>()).second)
      refuse(parsed.get<std::string>(), "the key twice", "each key once");
    return true;
  };
  ordered_json object;
  try {
    object = ordered_json::parse(text, watch);
  } catch (const ordered_json::exception&) {
    refuse("", "no JSON", wanted);
  }
  if (fault_) return std::nullopt;
  if (!object.is_object() || !object.contains("format")) {
    refuse("format", fmt::format("nothing; this is no {}", record), wanted);
  } else if (object["format"] != format) {
    refuse("format", found_in(object["format"]),
           fmt::format("\"{}\", which `launchsafe` of this version writes for {}; make the record anew",
                       format, kind));
  }
  if (fault_) return std::nullopt;
  return object;
}

void RecordReader::check_digest(const ordered_json& object, const ordered_json& content) {
  if (!object.contains("digest") || object["digest"] != digest_of(content))
    refuse("digest", object.contains("digest") ? found_in(object["digest"]) : "nothing",
           "the SHA-256 of the content, which was edited; make the record anew");
}

bool RecordReader::has_keys(const ordered_json& object, const std::string& path,
                            const std::vector<std::string>& keys) {
  if (!object.is_object()) {
    refuse(path, found_in(object), "an object");
    return false;
  }
  const std::string inside = path.empty() ? "" : path + ".";
  for (const auto& [key, value] : object.items()) {
    if (std::ranges::find(keys, key) == keys.end())
      refuse(inside + key, "a key that no record has", "only " + scene::quoted_list(keys));
  }
  for (const std::string& key : keys) {
    if (!object.contains(key)) refuse(inside + key, "nothing; the key is missing", "a value");
  }
  return !fault_;
}

void RecordReader::read(const ordered_json& value, const std::string& path, double& number,
                        const Limits& limits) {
  number = value.is_number() ? value.get<double>() : math::not_a_number;
  if (!std::isfinite(number) || !limits.contain(number)) refuse(path, found_in(value), allowed_by(limits));
}

void RecordReader::read(const ordered_json& value, const std::string& path, double& number,
                        const OrNone& allowed) {
  number = math::not_a_number;
  if (!value.is_null()) read(value, path, number, allowed.limits);
}

void RecordReader::read(const ordered_json& values, const std::string& path, std::vector<double>& numbers,
                        const Limits& limits, std::size_t fewest, std::size_t most) {
  if (!values.is_array() || values.size() < fewest || values.size() > most) {
    return refuse(
        path, found_in(values),
        fewest == most ? fmt::format("{} numbers", most) : fmt::format("{} to {} numbers", fewest, most));
  }
  numbers.resize(values.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    read(values[i], fmt::format("{}.{}", path, i), numbers[i], limits);
}

void RecordReader::read(const ordered_json& value, const std::string& path, int& whole, int lowest,
                        int highest) {
  // A larger number would be cut to another one by get<int>.
  const bool fits = value.is_number_integer() && value >= lowest && value <= highest;
  if (!fits) refuse(path, found_in(value), fmt::format("a whole number from {} to {}", lowest, highest));
  whole = fits ? value.get<int>() : lowest;
}

void RecordReader::read(const ordered_json& value, const std::string& path, bool& flag) {
  if (!value.is_boolean()) return refuse(path, found_in(value), "true or false");
  flag = value.get<bool>();
}

void RecordReader::read(const ordered_json& value, const std::string& path, std::string& text) {
  if (!value.is_string()) return refuse(path, found_in(value), "a text");
  text = value.get<std::string>();
}

void RecordObject::numbers(const std::string& key, std::vector<double>& numbers, std::size_t count,
                           const std::string& allowed, const Limits& limits) {
  ordered_json& list = (*this)[key];
  if (!reading()) {
    list = numbers;
    return;
  }
  if (!list.is_array() || list.size() != count) return reader_->refuse(path_of(key), found_in(list), allowed);
  for (const ordered_json& each : list)
    reader_->read(each, path_of(key), numbers.emplace_back(), OrNone{limits});
}

void RecordObject::model_version(const char* anew) {
  int version = run::model_version;
  value("model_version", version, 1, 1'000'000);
  if (reading() && version != run::model_version) {
    reader_->refuse("model_version", fmt::format("{}", version),
                    fmt::format("{}, the version of this program; {}", run::model_version, anew));
  }
}

void RecordObject::scene(scene::Scene& scene, const char* what) {
  std::string text = reading() ? std::string{} : scene::to_toml(scene);
  value("scene", text);
  if (!reading() || reader_->fault()) return;
  auto read = scene::parse_scene(text, "scene of the record");
  if (!read) return reader_->refuse("scene", "a scene that cannot be read: " + read.error().message(), what);
  scene = std::move(read->scene);
}

}  // namespace launchsafe::study
