#include "launchsafe/store/study_record.hpp"

#include "launchsafe/scene/toml_reader.hpp"
#include "posix_file.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::store {
namespace {

namespace fs = std::filesystem;

/// The names of texts about the program.
constexpr std::array texts_of_program{
    std::pair{"program_version", &Manifest::program_version}, std::pair{"commit", &Manifest::commit},
    std::pair{"compiler", &Manifest::compiler}, std::pair{"compiler_flags", &Manifest::compiler_flags},
    std::pair{"build_type", &Manifest::build_type}};

/// Throws what the JSON library throws where a value is of another type, or where one is missing that every
/// manifest has.
StudyRecord record_from(const nlohmann::json& object) {
  StudyRecord record;
  Manifest& manifest = record.manifest;
  manifest.input_sha256 = object.at("input_sha256").get<std::string>();
  manifest.input_text = object.at("input").get<std::string>();
  manifest.model_version = object.at("model_version").get<int>();
  for (const auto& [name, text] : texts_of_program) manifest.*text = object.value(name, "");
  manifest.host = object.value("host", "");
  manifest.threads = object.value("threads", 1);
  manifest.start_time = object.value("start_time", "");
  manifest.wall_time = object.value("wall_time_s", 0.0);
  record.files = object.value("files", std::vector<std::string>{});
  record.study = object.value("study", "");
  record.complete = object.value("complete", true);
  record.programs = object.value("programs", std::vector<std::string>{});
  return record;
}

}  // namespace

nlohmann::ordered_json to_json(const StudyRecord& record) {
  const Manifest& manifest = record.manifest;
  nlohmann::ordered_json object{{"input_sha256", manifest.input_sha256},
                                {"model_version", manifest.model_version}};
  for (const auto& [name, text] : texts_of_program) object[name] = manifest.*text;
  object.update({{"host", manifest.host},
                 {"threads", manifest.threads},
                 {"start_time", manifest.start_time},
                 {"wall_time_s", manifest.wall_time},
                 {"programs", record.programs},
                 {"study", record.study},
                 {"complete", record.complete},
                 {"files", record.files},
                 {"input", manifest.input_text}});
  return object;
}

std::vector<std::string> StudyRecord::other_programs() const {
  return programs == std::vector{program_of(manifest)} ? std::vector<std::string>{} : programs;
}

Result<StudyRecord> read_study_record(const fs::path& folder) {
  const auto text = read_file(folder / manifest_name);
  if (!text) return text.error();
  try {
    return record_from(nlohmann::json::parse(*text));
  } catch (const nlohmann::json::exception&) {  // no manifest either
  }
  return Error{Error::Kind::corrupt,
               fmt::format("{} is no manifest of a study", (folder / manifest_name).string())};
}

Result<StudyRecord> record_of_folder(const fs::path& folder) {
  Result<StudyRecord> record = read_study_record(folder);
  if (record || record.error().kind == Error::Kind::unreadable) return record;
  if (record.error().kind == Error::Kind::corrupt)
    return refusal(folder / manifest_name, "is no manifest of a study");
  std::vector<std::string> names = scene::list_folder(folder);
  std::erase_if(names, is_temporary);
  if (names.empty()) return StudyRecord{};
  return refusal(
      folder, fmt::format("holds files ({}) and no manifest.json of launchsafe", scene::first_of(names, 1)));
}

MaybeError write_study_record(const fs::path& folder, const StudyRecord& record, bool replace) {
  const std::string text =
      to_json(record).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return write_file_atomically(folder / manifest_name, text, replace ? IfExists::replace : IfExists::refuse);
}

MaybeError write_report_files(const fs::path& folder, StudyRecord record,
                              const std::vector<TextFile>& files) {
  const Result<StudyRecord> before = record_of_folder(folder);
  if (!before) return before.error();
  // Without files until all are there.
  if (MaybeError error = write_study_record(folder, record, !before->manifest.input_sha256.empty()))
    return error;
  for (const TextFile& file : files) {
    if (MaybeError error = write_file_atomically(folder / file.name, file.text, IfExists::replace))
      return error;
    record.files.push_back(file.name);
  }
  std::error_code failed;
  for (const std::string& name : before->files)
    if (std::ranges::find(record.files, name) == record.files.end()) fs::remove(folder / name, failed);
  return write_study_record(folder, record, true);
}

Result<fs::path> set_aside(const fs::path& folder, const StudyRecord& record) {
  fs::path target;
  std::error_code failed;
  for (int number = 1; target.empty() || fs::exists(target, failed); ++number)
    target = folder / fmt::format("earlier-{}", number);
  if (!fs::create_directory(target, failed)) return write_error(target, failed.value());
  for (const std::string& name : record.files) {
    fs::rename(folder / name, target / name, failed);
    if (failed && failed != std::errc::no_such_file_or_directory)
      return write_error(target / name, failed.value());
  }
  fs::copy_file(folder / manifest_name, target / manifest_name, failed);
  if (failed) return write_error(target / manifest_name, failed.value());
  return target;
}

}  // namespace launchsafe::store
