#include "launchsafe/store/study_record.hpp"

#include "launchsafe/store/case_store.hpp"
#include "posix_file.hpp"

namespace launchsafe::store {
namespace {

namespace fs = std::filesystem;

nlohmann::ordered_json files_json(const std::vector<WrittenFile>& files) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const WrittenFile& file : files) list.push_back({{"name", file.name}, {"sha256", file.sha256}});
  return list;
}

std::vector<WrittenFile> files_from(const nlohmann::json& list) {
  std::vector<WrittenFile> files;
  for (const auto& each : list) {
    // A name that leads out of the folder, or is one of the store's, is none of a report.
    const std::string name = each.value("name", "");
    if (name.empty() || name == "." || name == ".." || name == manifest_name || is_store_name(name) ||
        fs::path(name).filename() != name)
      continue;
    files.push_back({name, each.value("sha256", "")});
  }
  return files;
}

/// The names of texts about the program.
constexpr std::array texts_of_program{
    std::pair{"program_version", &Manifest::program_version}, std::pair{"commit", &Manifest::commit},
    std::pair{"compiler", &Manifest::compiler}, std::pair{"compiler_flags", &Manifest::compiler_flags},
    std::pair{"build_type", &Manifest::build_type}};

/// Negative for what is no version.
int version_in(const nlohmann::json& value) {
  const bool fits =
      value.is_number_integer() && value >= 0 && value <= std::int64_t{std::numeric_limits<int>::max()};
  return fits ? value.get<int>() : -1;
}

/// Throws what the JSON library throws where a value is of another type, or where one is missing that every
/// manifest has.
StudyRecord record_from(const nlohmann::json& object) {
  StudyRecord record;
  Manifest& manifest = record.manifest;
  manifest.input_sha256 = object.at("input_sha256").get<std::string>();
  manifest.input_text = object.at("input").get<std::string>();
  manifest.model_version = version_in(object.at("model_version"));
  for (const auto& [name, text] : texts_of_program) manifest.*text = object.value(name, "");
  manifest.host = object.value("host", "");
  manifest.threads = object.value("threads", 1);
  manifest.start_time = object.value("start_time", "");
  manifest.wall_time = object.value("wall_time_s", 0.0);
  const auto libraries = object.value("libraries", nlohmann::json::object());
  for (const auto& [name, version] : libraries.items())
    manifest.libraries.push_back({name, version.get<std::string>()});
  record.files = files_from(object.value("files", nlohmann::json::array()));
  record.unfinished = files_from(object.value("unfinished", nlohmann::json::array()));
  record.study = object.value("study", "");
  record.complete = object.value("complete", true);
  record.failures = object.value("failures_sha256", "");
  record.programs = object.value("programs", std::vector<std::string>{});
  return record;
}

bool is_there(const fs::path& path) {
  std::error_code failed;
  return fs::exists(fs::symlink_status(path, failed));
}

/// What both lists know.
std::vector<WrittenFile> known_files(const StudyRecord& record) {
  std::vector<WrittenFile> known = record.files;
  for (const WrittenFile& file : record.unfinished)
    if (std::ranges::find(known, file) == known.end()) known.push_back(file);
  return known;
}

}  // namespace

nlohmann::ordered_json to_json(const StudyRecord& record) {
  const Manifest& manifest = record.manifest;
  nlohmann::ordered_json object{{"input_sha256", manifest.input_sha256},
                                {"model_version", manifest.model_version}};
  for (const auto& [name, text] : texts_of_program) object[name] = manifest.*text;
  nlohmann::ordered_json& libraries = object["libraries"];
  for (const LibraryVersion& library : manifest.libraries) libraries[library.name] = library.version;
  object.update({{"host", manifest.host},
                 {"threads", manifest.threads},
                 {"start_time", manifest.start_time},
                 {"wall_time_s", manifest.wall_time},
                 {"programs", record.programs},
                 {"study", record.study},
                 {"complete", record.complete},
                 {"files", files_json(record.files)},
                 {"failures_sha256", record.failures},
                 {"input", manifest.input_text}});
  if (!record.unfinished.empty()) object["unfinished"] = files_json(record.unfinished);
  return object;
}

std::vector<std::string> StudyRecord::other_programs() const {
  return programs == std::vector{program_of(manifest)} ? std::vector<std::string>{} : programs;
}

std::vector<std::string> StudyRecord::names() const {
  std::set<std::string> all;
  for (const auto* list : {&files, &unfinished})
    for (const WrittenFile& file : *list) all.insert(file.name);
  return {all.begin(), all.end()};
}

FileState state_of(const fs::path& folder, const StudyRecord& record, const std::string& name) {
  const fs::path path = folder / name;
  if (!is_there(path)) return FileState::absent;
  const std::vector<WrittenFile> known = known_files(record);
  if (std::ranges::find(known, name, &WrittenFile::name) == known.end()) return FileState::foreign;
  std::error_code failed;
  if (!fs::is_regular_file(fs::symlink_status(path, failed))) return FileState::edited;
  const Result<std::string> content = read_file(path);
  if (!content) return FileState::edited;
  const WrittenFile present{name, sha256(*content)};
  return std::ranges::find(known, present) != known.end() ? FileState::ours : FileState::edited;
}

Result<StudyRecord> read_study_record(const fs::path& folder) {
  const auto text = read_file(folder / manifest_name);
  if (!text) return text.error();
  try {
    StudyRecord record = record_from(nlohmann::json::parse(*text));
    // What only a manifest of ours says of itself: its input and the SHA-256 of that.
    const Manifest& manifest = record.manifest;
    if (manifest.model_version >= 0 && manifest.input_sha256 == sha256(manifest.input_text)) return record;
  } catch (const nlohmann::json::exception&) {  // no manifest either
  }
  return Error{Error::Kind::corrupt,
               fmt::format("{} is no manifest of a study", (folder / manifest_name).string())};
}

Result<StudyRecord> record_of_report(const fs::path& folder) {
  Result<StudyRecord> record = read_study_record(folder);
  if (record || record.error().kind == Error::Kind::unreadable) return record;
  if (record.error().kind == Error::Kind::corrupt)
    return refusal(folder / manifest_name, "is no manifest of a study");
  // A link that leads nowhere is there, and somebody's.
  if (is_there(folder / manifest_name)) return refusal(folder / manifest_name, foreign_file);
  return StudyRecord{};
}

MaybeError write_study_record(const fs::path& folder, const StudyRecord& record) {
  const fs::path path = folder / manifest_name;
  const std::string text =
      to_json(record).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  const MaybeError error = write_file_atomically(path, text, IfExists::refuse);
  if (!error || error->kind != Error::Kind::conflict) return error;
  // Ours of before, or another shard's of a moment ago.
  if (const auto present = record_of_report(folder); !present) return present.error();
  return write_file_atomically(path, text, IfExists::replace);
}

Result<fs::path> set_aside(const fs::path& folder, const std::vector<std::string>& names) {
  if (names.empty()) return fs::path{};
  fs::path target;
  std::error_code failed;
  for (int number = 1; target.empty() || is_there(target); ++number)
    target = folder / fmt::format("earlier-{}", number);
  if (!fs::create_directory(target, failed) && failed) return write_error(target, failed.value());
  for (const std::string& name : names) {
    failed = move_to_free_name(folder / name, target / name);
    // Another shard may be moving the same files.
    if (failed && failed != std::errc::no_such_file_or_directory)
      return write_error(target / name, failed.value());
  }
  return target;
}

Result<std::vector<std::string>> write_report_files(const fs::path& folder, StudyRecord record,
                                                    const std::vector<TextFile>& files) try {
  const StudyRecord before = record_of_report(folder).or_throw();
  std::set<std::string> stays;
  for (const TextFile& file : files) {
    if (const auto present = read_file(folder / file.name); present && *present == file.text)
      stays.insert(file.name);
    else if (state_of(folder, before, file.name) == FileState::foreign)
      return refusal(folder / file.name, foreign_file);
  }
  std::vector<std::string> remarks, stale;
  for (const std::string& name : before.names()) {
    const FileState state = state_of(folder, before, name);
    if (state == FileState::edited && !stays.contains(name)) {
      const fs::path aside = move_to_numbered_name(folder / name, folder / (name + ".edited")).or_throw();
      remarks.push_back("a file was edited since it was written; it is kept as " + aside.string());
    } else if (state == FileState::ours && std::ranges::find(files, name, &TextFile::name) == files.end()) {
      stale.push_back(name);
    }
  }
  std::vector<WrittenFile> written;
  for (const TextFile& file : files) written.push_back({file.name, sha256(file.text)});
  record.unfinished = known_files({.manifest = {}, .files = written, .unfinished = known_files(before)});
  record.files.clear();
  if (MaybeError error = write_study_record(folder, record)) return *error;
  for (const TextFile& file : files) {
    if (stays.contains(file.name)) continue;
    const IfExists if_exists = is_there(folder / file.name) ? IfExists::replace : IfExists::refuse;
    if (MaybeError error = write_file_atomically(folder / file.name, file.text, if_exists)) return *error;
  }
  if (const fs::path aside = set_aside(folder, stale).or_throw(); !aside.empty())
    remarks.push_back("files of the earlier report that the new one lacks moved to " + aside.string());
  record.files = std::move(written);
  record.unfinished.clear();
  if (MaybeError error = write_study_record(folder, record)) return *error;
  return remarks;
} catch (const Error& error) {
  return error;
}

Result<std::vector<TextFile>> read_as_written(const fs::path& folder, const std::vector<WrittenFile>& files) {
  std::vector<TextFile> read;
  for (const WrittenFile& file : files) {
    Result<std::string> content = read_file(folder / file.name);
    const char* fault = !content ? "the manifest lists this file, and it cannot be read"
                        : sha256(*content) != file.sha256 ? "this is not what was written, its checksum "
                                                            "differs from that of the manifest"
                                                          : nullptr;
    if (fault != nullptr)
      return Error{Error::Kind::corrupt, fmt::format("{}: {}", (folder / file.name).string(), fault)};
    read.push_back({file.name, std::move(*content)});
  }
  return read;
}

}  // namespace launchsafe::store
