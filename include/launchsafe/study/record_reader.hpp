// Records that studies write for other studies, as JSON with a digest, read with distrust.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/scene/scene_keys.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::study {

/// A text for a message, shortened.
std::string quoted(const std::string& text);
/// A value for a message.
std::string found_in(const nlohmann::ordered_json& value);

/// A number within these limits, or null.
struct OrNone {
  scene::Limits limits;
};

/// Takes the values of a record one by one. The first fault stays; what is read after it means nothing.
class RecordReader {
 public:
  explicit RecordReader(std::string file) : file_(std::move(file)) {}

  const std::optional<scene::InputError>& fault() const { return fault_; }
  void refuse(const std::string& key, std::string found, std::string allowed);

  /// The text as JSON of that format without a key given twice in one object, of which the parser would keep
  /// the last. `record` says what it should be, `kind` which study writes it.
  std::optional<nlohmann::ordered_json> parse(const std::string& text, const std::string& format,
                                              const std::string& record, const std::string& kind);
  /// Whether the digest of a file is that of its content as it was understood.
  void check_digest(const nlohmann::ordered_json& object, const nlohmann::ordered_json& content);

  /// Whether it is an object with these keys and no others.
  bool has_keys(const nlohmann::ordered_json& object, const std::string& path,
                const std::vector<std::string>& keys);

  // Values at a path, with what is allowed of them.
  void read(const nlohmann::ordered_json& value, const std::string& path, double& number,
            const scene::Limits& limits);
  /// NaN for null.
  void read(const nlohmann::ordered_json& value, const std::string& path, double& number,
            const OrNone& allowed);
  void read(const nlohmann::ordered_json& values, const std::string& path, std::vector<double>& numbers,
            const scene::Limits& limits, std::size_t fewest, std::size_t most);
  void read(const nlohmann::ordered_json& value, const std::string& path, int& whole, int lowest,
            int highest);
  void read(const nlohmann::ordered_json& value, const std::string& path, bool& flag);
  void read(const nlohmann::ordered_json& value, const std::string& path, std::string& text);

 private:
  std::string file_;
  std::optional<scene::InputError> fault_;
};

/// An object of a record. One description of its keys, in their order, serves writing and reading.
class RecordObject {
 public:
  /// To be written.
  RecordObject() = default;
  /// To be read.
  RecordObject(nlohmann::ordered_json& given, std::string path, RecordReader& reader)
      : json_(&given), path_(std::move(path)), reader_(&reader) {}
  RecordObject(const RecordObject&) = delete;

  bool reading() const { return reader_ != nullptr; }
  RecordReader& reader() const { return *reader_; }
  nlohmann::ordered_json& operator[](const std::string& key) { return (*json_)[key]; }
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  /// A value, with what `RecordReader::read` has to know to take it.
  template <class Value, class... Allowed>
  void value(const std::string& key, Value& value, const Allowed&... allowed) {
    if (reading())
      reader_->read((*this)[key], path_of(key), value, allowed...);
    else
      (*this)[key] = value;
  }
  /// Parts by their own descriptions; of a list `allowed` says how many there may be.
  template <class Part, class Describe>
  void part(const std::string& key, Part& part, const Describe& describe) {
    if (reading())
      read((*this)[key], path_of(key), *reader_, part, describe);
    else
      (*this)[key] = written(describe, part);
  }
  template <class Part, class Describe>
  void list(const std::string& key, std::vector<Part>& parts, std::size_t fewest, std::size_t most,
            const char* allowed, const Describe& describe) {
    nlohmann::ordered_json& list = (*this)[key];
    if (!reading()) {
      list = nlohmann::ordered_json::array();
      for (const Part& part : parts) list.push_back(written(describe, part));
      return;
    }
    if (!list.is_array() || list.size() < fewest || list.size() > most)
      reader_->refuse(path_of(key), found_in(list), allowed);
    for (std::size_t i = 0; !reader_->fault() && i < list.size(); ++i)
      read(list[i], path_of(key) + "." + std::to_string(i), *reader_, parts.emplace_back(), describe);
  }
  /// Numbers, one for each of so many; null where one is not a number. `allowed` says how many there are.
  void numbers(const std::string& key, std::vector<double>& numbers, std::size_t count,
               const std::string& allowed, const scene::Limits& limits);

  /// "model_version", which must be this program's. `anew`: how to get a record of it.
  void model_version(const char* anew);
  /// "scene", as text; `what` says which it should be.
  void scene(scene::Scene& scene, const char* what);

  template <class Value, class Describe>
  static nlohmann::ordered_json written(const Describe& describe, Value value) {
    RecordObject object;
    describe(object, value);
    return object.written_;
  }
  /// Takes an object with the keys of its description, those of `head` before them, and no others.
  template <class Value, class Describe>
  static void read(nlohmann::ordered_json& given, const std::string& path, RecordReader& reader, Value& value,
                   const Describe& describe, std::vector<std::string> head = {}) {
    const nlohmann::ordered_json known = written(describe, Value{});
    for (const auto& [key, unused] : known.items()) head.push_back(key);
    if (!reader.has_keys(given, path, head)) return;
    RecordObject object(given, path, reader);
    describe(object, value);
  }

 private:
  nlohmann::ordered_json written_ = nlohmann::ordered_json::object();
  nlohmann::ordered_json* json_ = &written_;
  std::string path_;
  RecordReader* reader_ = nullptr;
};

/// A kind of record.
struct RecordFormat {
  const char *name, *file, *study;  ///< format and version; what its file is called; which study writes it
  std::array<const char*, 2> head{"digest", "format"};  ///< as messages list them
};

template <class Record, class Describe>
nlohmann::ordered_json content_by(const RecordFormat& format, const Describe& describe,
                                  const Record& record) {
  nlohmann::ordered_json content{{"format", format.name}};
  content.update(RecordObject::written(describe, record));
  return content;
}

/// The record as a file: its content and the SHA-256 of it.
std::string record_text(nlohmann::ordered_json content);

/// The record of a file. Refused are a text that is not its description's, and one that was edited.
template <class Record, class Describe>
scene::Expected<Record> parse_record(const std::string& text, const std::string& file,
                                     const RecordFormat& format, const Describe& describe) {
  RecordReader reader(file);
  auto object = reader.parse(text, format.name, format.file, format.study);
  Record record;
  if (object) RecordObject::read(*object, "", reader, record, describe, {format.head[0], format.head[1]});
  if (!reader.fault()) reader.check_digest(*object, content_by(format, describe, record));
  if (reader.fault()) return *reader.fault();
  return record;
}

}  // namespace launchsafe::study
