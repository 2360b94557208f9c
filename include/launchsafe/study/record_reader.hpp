// Records that studies write for other studies, as JSON.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::study {

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
  Json& operator[](const std::string& key) {
    if (reading() && !(json_->is_object() && json_->contains(key)))
      refuse(key, "nothing; the key is missing", "a value");
    return (*json_)[key];
  }

  /// A value; a number that is none is null.
  template <class Value>
  void value(const std::string& key, Value& value) {
    Json& given = (*this)[key];
    if (!reading()) {
      given = value;
      return;
    }
    try {
      if constexpr (std::is_same_v<Value, double>)
        value = given.is_null() ? math::not_a_number : given.get<double>();
      else
        given.get_to(value);
    } catch (const Json::exception&) {
      refuse(key, "a value of another type", "that of a record");
    }
  }
  /// Parts by their own descriptions.
  template <class Part, class Describe>
  void part(const std::string& key, Part& part, const Describe& describe) {
    if (reading())
      read_object((*this)[key], path_of(key), part, describe);
    else
      (*this)[key] = written(describe, part);
  }
  template <class Part, class Describe>
  void list(const std::string& key, std::vector<Part>& parts, const Describe& describe) {
    Json& list = (*this)[key];
    if (!reading()) {
      list = Json::array();
      for (const Part& part : parts) list.push_back(written(describe, part));
      return;
    }
    if (!list.is_array()) refuse(key, "a value of another type", "an array");
    for (std::size_t i = 0; i < list.size(); ++i)
      read_object(list[i], path_of(key) + "." + std::to_string(i), parts.emplace_back(), describe);
  }

  /// "model_version", which must be this program's. `anew`: how to get a record of it.
  void model_version(const char* anew);
  /// "scene", as text; `what` says which it should be.
  void scene(scene::Scene& scene, const char* what);

  template <class Value, class Describe>
  static Json written(const Describe& describe, Value value) {
    RecordObject object;
    describe(object, value);
    return object.written_;
  }
  template <class Value, class Describe>
  static void read_object(Json& given, const std::string& path, Value& value, const Describe& describe) {
    RecordObject object(given, path);
    describe(object, value);
  }

 private:
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  Json written_ = Json::object();
  Json* json_ = &written_;
  std::string path_;
};

/// A kind of record.
struct RecordFormat {
  const char *name, *file, *study;  ///< format and version; what its file is called; which study writes it
};

/// The text as JSON of that format. Throws an InputError where it is none.
nlohmann::ordered_json json_of(const std::string& text, const RecordFormat& format);

/// The record as a file.
template <class Record, class Describe>
std::string record_text(const RecordFormat& format, const Describe& describe, const Record& record) {
  nlohmann::ordered_json content{{"format", format.name}};
  content.update(RecordObject::written(describe, record));
  return content.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The record of a file. Refused is a text that is not its description's.
template <class Record, class Describe>
scene::Expected<Record> parse_record(const std::string& text, const std::string& file,
                                     const RecordFormat& format, const Describe& describe) {
  try {
    nlohmann::ordered_json object = json_of(text, format);
    Record record;
    RecordObject::read_object(object, "", record, describe);
    return record;
  } catch (scene::InputError& fault) {
    fault.file = file;
    return fault;
  }
}

}  // namespace launchsafe::study
