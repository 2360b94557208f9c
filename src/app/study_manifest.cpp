#include "study_manifest.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace launchsafe::app {
namespace {

std::filesystem::path manifest_path(const std::filesystem::path& folder) { return folder / "manifest.json"; }

/// The study file's values; empty if the file has gone since it was read.
std::string values_of(const std::string& path) {
  const auto text = scene::read_text_file(path);
  if (!text) return {};
  const auto table = scene::parse_toml(*text, path);
  if (!table) return {};
  std::ostringstream values;
  values << *table;
  return values.str();
}

nlohmann::ordered_json files_json(const std::vector<store::WrittenFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const store::WrittenFile& file : files) list.push_back({{"name", file.name}, {"sha256", file.sha256}});
  return list;
}

nlohmann::ordered_json json_of(const StudyRecord& record) {
  const store::Manifest& manifest = record.manifest;
  nlohmann::ordered_json libraries;
  for (const store::LibraryVersion& library : manifest.libraries) libraries[library.name] = library.version;
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
          {"complete", record.complete},
          {"files", files_json(record.files)},
          {"failures_sha256", record.failures},
          {"input", manifest.input_text}};
}

std::vector<store::WrittenFile> files_from(const nlohmann::json& list) {
  std::vector<store::WrittenFile> files;
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
bool is_sound(const store::Manifest& manifest) {
  return manifest.model_version >= 0 && manifest.input_sha256 == store::sha256(manifest.input_text);
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
  record.manifest.start_time = object.value("start_time", "");
  record.files = files_from(object.value("files", nlohmann::json::array()));
  record.complete = object.value("complete", true);
  record.failures = object.value("failures_sha256", "");
  return record;
}

std::optional<std::string> digest_of(const std::filesystem::path& path) {
  const auto bytes = store::read_file(path);
  if (!bytes) return std::nullopt;
  return store::sha256(*bytes);
}

/// Files that a study rests on: with another one its report is no longer true.
std::string records_of(const study::StudyFile& file) {
  if (file.records.empty()) return {};
  return fmt::format("\n\n# SHA-256 of the files that it rests on\n{}\n", fmt::join(file.records, "\n"));
}

/// What a study took from its accuracy record: another record is another input.
std::string recorded_uncertainties(const study::StudyFile& file) {
  if (file.study.accuracy.empty()) return {};
  std::string text = "\n\n# numerical uncertainties from the accuracy record, K\n";
  for (const study::StudyCase& each : file.cases)
    text += fmt::format("{} at a rise of {}\n", each.numerical_uncertainty, each.rise_of_uncertainty);
  return text;
}

std::string scenes_of_cases(const study::StudyFile& file) {
  if (!file.study.kind.own_scenes) return {};
  std::string text;
  for (const study::StudyCase& each : file.cases) text += scene::to_toml(each.scene.scene);
  return "\n\n# SHA-256 of the scenes of all cases\n" + store::sha256(text) + "\n";
}

}  // namespace

store::Manifest study_manifest(const study::StudyFile& file, int jobs) {
  return store::make_manifest(
      fmt::format("# model version {}\n{}\n\n# scene\n{}{}{}{}", run::model_version, values_of(file.file),
                  scene::to_toml(file.scene.scene), recorded_uncertainties(file), records_of(file),
                  scenes_of_cases(file)),
      jobs);
}

bool same_study(const store::Manifest& one, const store::Manifest& other) {
  return one.input_sha256 == other.input_sha256;
}

store::Result<StudyRecord> read_study_record(const std::filesystem::path& folder) {
  const auto text = store::read_file(manifest_path(folder));
  if (!text) return text.error();
  const store::Error corrupt{store::Error::Kind::corrupt,
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

store::MaybeError write_study_record(const std::filesystem::path& folder, const StudyRecord& record) {
  return store::write_own_file(
      manifest_path(folder),
      {json_of(record).dump(2, ' ', false, nlohmann::json::error_handler_t::replace), "\n"});
}

std::optional<std::string> manifest_digest(const std::filesystem::path& folder) {
  return digest_of(manifest_path(folder));
}

std::vector<store::WrittenFile> record_files(const std::filesystem::path& folder,
                                             const std::vector<std::string>& names) {
  std::vector<store::WrittenFile> files;
  for (const std::string& name : names)
    if (auto digest = digest_of(folder / name)) files.push_back({name, std::move(*digest)});
  return files;
}

bool files_unchanged(const std::filesystem::path& folder, const std::vector<store::WrittenFile>& files) {
  return std::all_of(files.begin(), files.end(), [&](const store::WrittenFile& file) {
    return digest_of(folder / file.name) == file.sha256;
  });
}

}  // namespace launchsafe::app
