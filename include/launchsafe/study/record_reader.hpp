// Records that studies write for other studies, as JSON with a digest, read with distrust.
#pragma once

#include "launchsafe/scene/scene_keys.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// The record as a file: `content` and the SHA-256 of it.
std::string record_text(nlohmann::ordered_json content);

/// A text for a message, shortened.
std::string quoted(const std::string& text);
/// A value for a message.
std::string found_in(const nlohmann::ordered_json& value);

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
  double number(const nlohmann::ordered_json& value, const std::string& path, const scene::Limits& limits);
  /// NaN for null.
  double number_or_none(const nlohmann::ordered_json& value, const std::string& path,
                        const scene::Limits& limits);
  std::vector<double> numbers(const nlohmann::ordered_json& values, const std::string& path,
                              const scene::Limits& limits, std::size_t fewest, std::size_t most);
  int whole(const nlohmann::ordered_json& value, const std::string& path, int lowest, int highest);
  bool flag(const nlohmann::ordered_json& value, const std::string& path);
  std::string text(const nlohmann::ordered_json& value, const std::string& path);

 private:
  std::string file_;
  std::optional<scene::InputError> fault_;
};

}  // namespace launchsafe::study
