// Records that studies write for other studies, as JSON with a digest, read with distrust.
#pragma once

#include "launchsafe/scene/read_scene.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::study {

/// A text for a message, shortened.
std::string quoted(const std::string& text);
/// A value for a message.
std::string found_in(const nlohmann::ordered_json& value);

/// A number within these limits, or null, which is NaN.
struct OrNone {
  scene::Limits limits;
};

/// An object of a record. One description of its keys, in their order, serves writing and reading. What is
/// wrong with one that is read is thrown, an InputError.
class RecordObject {
 public:
  using Json = nlohmann::ordered_json;

  /// To be written.
  RecordObject() = default;
  /// To be read.
  RecordObject(Json& given, std::string path) : json_(&given), path_(std::move(path)) {}
  RecordObject(const RecordObject&) = delete;

  bool reading() const { return json_ != &written_; }
  [[noreturn]] void refuse(const std::string& key, std::string found, std::string allowed) const;
  Json& operator[](const std::string& key) { return (*json_)[key]; }

  /// A value, with what `read` has to know to take it.
  template <class Value, class... Allowed>
  void value(const std::string& key, Value& value, const Allowed&... allowed) {
    if (reading())
      read((*this)[key], key, value, allowed...);
    else
      (*this)[key] = value;
  }
  /// Parts by their own descriptions; of a list `allowed` says how many there may be.
  template <class Part, class Describe>
  void part(const std::string& key, Part& part, const Describe& describe) {
    if (reading())
      read_object((*this)[key], path_of(key), part, describe);
    else
      (*this)[key] = written(describe, part);
  }
  template <class Part, class Describe>
  void list(const std::string& key, std::vector<Part>& parts, std::size_t fewest, std::size_t most,
            const char* allowed, const Describe& describe) {
    Json& list = (*this)[key];
    if (!reading()) {
      list = Json::array();
      for (const Part& part : parts) list.push_back(written(describe, part));
      return;
    }
    if (!list.is_array() || list.size() < fewest || list.size() > most) refuse(key, found_in(list), allowed);
    for (std::size_t i = 0; i < list.size(); ++i)
      read_object(list[i], path_of(key) + "." + std::to_string(i), parts.emplace_back(), describe);
  }

  /// "model_version", which must be this program's. `anew`: how to get a record of it.
  void model_version(const char* anew);
  /// "scene", as text; `what` says which it should be.
  void scene(scene::Scene& scene, const char* what);

  // What stands at a key, with what is allowed of it.
  void read(const Json& given, const std::string& key, double& number, const scene::Limits& limits);
  void read(const Json& given, const std::string& key, double& number, const OrNone& allowed);
  template <class Allowed>
  void read(const Json& given, const std::string& key, std::vector<double>& numbers, const Allowed& allowed,
            std::size_t fewest, std::size_t most) {
    check_list(given, key, fewest, most);
    numbers.resize(given.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      read(given[i], key + "." + std::to_string(i), numbers[i], allowed);
  }
  void read(const Json& given, const std::string& key, int& whole, int lowest, int highest);
  void read(const Json& given, const std::string& key, bool& flag);
  void read(const Json& given, const std::string& key, std::string& text);

  template <class Value, class Describe>
  static Json written(const Describe& describe, Value value) {
    RecordObject object;
    describe(object, value);
    return object.written_;
  }
  /// Takes an object with the keys of its description, those of `head` before them, and no others.
  template <class Value, class Describe>
  static void read_object(Json& given, const std::string& path, Value& value, const Describe& describe,
                          std::vector<std::string> head = {}) {
    const Json known = written(describe, Value{});
    for (const auto& [key, unused] : known.items()) head.push_back(key);
    RecordObject object(given, path);
    object.check_keys(head);
    describe(object, value);
  }

 private:
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  void check_keys(const std::vector<std::string>& keys) const;
  void check_list(const Json& given, const std::string& key, std::size_t fewest, std::size_t most) const;

  Json written_ = Json::object();
  Json* json_ = &written_;
  std::string path_;
};

/// A kind of record.
struct RecordFormat {
  const char *name, *file, *study;  ///< format and version; what its file is called; which study writes it
  std::array<const char*, 2> head{"digest", "format"};  ///< as messages list them
};

/// The text as JSON of that format without a key given twice in one object, of which the parser would keep
/// the last. Throws an InputError where it is none.
nlohmann::ordered_json json_of(const std::string& text, const RecordFormat& format);
/// Throws one where the digest of a file is not that of its content as it was understood.
void check_digest(const nlohmann::ordered_json& object, const nlohmann::ordered_json& content);
/// The record as a file: its content and the SHA-256 of it.
std::string record_text(nlohmann::ordered_json content);

template <class Record, class Describe>
nlohmann::ordered_json content_by(const RecordFormat& format, const Describe& describe,
                                  const Record& record) {
  nlohmann::ordered_json content{{"format", format.name}};
  content.update(RecordObject::written(describe, record));
  return content;
}

/// The record of a file. Refused are a text that is not its description's, and one that was edited.
template <class Record, class Describe>
scene::Expected<Record> parse_record(const std::string& text, const std::string& file,
                                     const RecordFormat& format, const Describe& describe) {
  try {
    nlohmann::ordered_json object = json_of(text, format);
    Record record;
    RecordObject::read_object(object, "", record, describe, {format.head[0], format.head[1]});
    check_digest(object, content_by(format, describe, record));
    return record;
  } catch (scene::InputError& fault) {
    fault.file = file;
    return fault;
  }
}

}  // namespace launchsafe::study
