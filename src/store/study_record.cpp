#include "launchsafe/store/study_record.hpp"

#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/own_files.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

namespace launchsafe::store {
namespace {

std::filesystem::path manifest_path(const std::filesystem::path& folder) { return folder / "manifest.json"; }

nlohmann::ordered_json files_json(const std::vector<WrittenFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const WrittenFile& file : files) list.push_back({{"name", file.name}, {"sha256", file.sha256}});
  return list;
}

nlohmann::ordered_json json_of(const StudyRecord& record) {
  const Manifest& manifest = record.manifest;
  nlohmann::ordered_json libraries;
  for (const LibraryVersion& library : manifest.libraries) libraries[library.name] = library.version;
  return {{"input_sha256", manifest.input_sha256},
          {"model_version", manifest.model_version},
          {"program_version", manifest.program_version},
          {"commit", manifest.commit},
          {"compiler", manifest.compiler},
          {"compiler_flags", manifest.compiler_flags},
          {"build_type", manifest.build_type},
          {"libraries", libraries},
          {"host", manifest.host},
          {"threads", manifest.threads},
          {"start_time", manifest.start_time},
          {"wall_time_s", manifest.wall_time},
          {"study", record.study},
          {"complete", record.complete},
          {"files", files_json(record.files)},
          {"failures_sha256", record.failures},
          {"input", manifest.input_text}};
}

std::vector<WrittenFile> files_from(const nlohmann::json& list) {
  std::vector<WrittenFile> files;
  for (const auto& each : list) {
    // A name that leads out of the folder is none of ours.
    const std::string name = each.value("name", "");
    if (name.empty() || name == "." || name == ".." || name == "cases" ||
        std::filesystem::path(name).filename() != name)
      continue;
    files.push_back({name, each.value("sha256", "")});
  }
  return files;
}

/// Negative for what is no version; the first manifests had none, which is 0.
int version_in(const nlohmann::json& value) {
  const bool fits =
      value.is_number_integer() && value >= 0 && value <= std::int64_t{std::numeric_limits<int>::max()};
  return fits ? value.get<int>() : -1;
}

/// Whether it says of itself what only a manifest of ours says: its input and the SHA-256 of that.
bool is_sound(const Manifest& manifest) {
  return manifest.model_version >= 0 && manifest.input_sha256 == sha256(manifest.input_text);
}

/// Throws what the JSON library throws where a value is of another type, or where one is missing that every
/// manifest has.
StudyRecord record_from(const nlohmann::json& object) {
  StudyRecord record;
  record.manifest.input_sha256 = object.at("input_sha256").get<std::string>();
  record.manifest.input_text = object.at("input").get<std::string>();
  record.manifest.model_version = version_in(object.value("model_version", nlohmann::json(0)));
  record.manifest.program_version = object.value("program_version", "");
  record.manifest.commit = object.value("commit", "");
  record.manifest.compiler = object.value("compiler", "");
  record.manifest.compiler_flags = object.value("compiler_flags", "");
  record.manifest.build_type = object.value("build_type", "");
  record.manifest.host = object.value("host", "");
  record.manifest.threads = object.value("threads", 1);
  record.manifest.start_time = object.value("start_time", "");
  record.manifest.wall_time = object.value("wall_time_s", 0.0);
  const auto libraries = object.value("libraries", nlohmann::json::object());
  for (const auto& [name, version] : libraries.items())
    record.manifest.libraries.push_back({name, version.get<std::string>()});
  record.files = files_from(object.value("files", nlohmann::json::array()));
  record.study = object.value("study", "");
  record.complete = object.value("complete", true);
  record.failures = object.value("failures_sha256", "");
  return record;
}

std::optional<std::string> digest_of(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return std::nullopt;
  return sha256(*bytes);
}

}  // namespace

Result<StudyRecord> read_study_record(const std::filesystem::path& folder) {
  const auto text = read_file(manifest_path(folder));
  if (!text) return text.error();
  const Error corrupt{Error::Kind::corrupt,
                      fmt::format("{} is no manifest of a study", manifest_path(folder).string())};
  const auto object = nlohmann::json::parse(*text, nullptr, false);
  if (!object.is_object()) return corrupt;
  try {
    StudyRecord record = record_from(object);
    if (!is_sound(record.manifest)) return corrupt;
    return record;
  } catch (const nlohmann::json::exception&) {
    return corrupt;
  }
}

MaybeError write_study_record(const std::filesystem::path& folder, const StudyRecord& record) {
  return write_own_file(manifest_path(folder),
                        json_of(record).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::vector<WrittenFile> record_files(const std::filesystem::path& folder,
                                      const std::vector<std::string>& names) {
  std::vector<WrittenFile> files;
  for (const std::string& name : names)
    if (auto digest = digest_of(folder / name)) files.push_back({name, std::move(*digest)});
  return files;
}

bool files_unchanged(const std::filesystem::path& folder, const std::vector<WrittenFile>& files) {
  return std::all_of(files.begin(), files.end(),
                     [&](const WrittenFile& file) { return digest_of(folder / file.name) == file.sha256; });
}

}  // namespace launchsafe::store
