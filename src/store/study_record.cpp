#include "launchsafe/store/study_record.hpp"

#include "launchsafe/scene/toml_reader.hpp"

namespace launchsafe::store {

namespace fs = std::filesystem;

nlohmann::ordered_json to_json(const StudyRecord& record) {
  nlohmann::ordered_json object{{"study", record.study},
                                {"complete", record.complete},
                                {"programs", record.programs},
                                {"files", record.files}};
  std::apply([&](const auto&... each) { ((object[each.name] = record.manifest.*each.member), ...); },
             manifest_members);
  return object;
}

std::vector<std::string> StudyRecord::other_programs() const {
  return programs == std::vector{program_of(manifest)} ? std::vector<std::string>{} : programs;
}

StudyRecord read_study_record(const fs::path& folder) {
  const std::string text = read_file(folder / manifest_name);
  try {
    const nlohmann::json object = nlohmann::json::parse(text);
    StudyRecord record{.files = object.at("files"),
                       .complete = object.at("complete"),
                       .study = object.at("study"),
                       .programs = object.at("programs")};
    std::apply([&](const auto&... each) { (object.at(each.name).get_to(record.manifest.*each.member), ...); },
               manifest_members);
    return record;
  } catch (const nlohmann::json::exception&) {  // no manifest either
  }
  throw Error{Error::Kind::corrupt, fmt::format("{} is no manifest of a study of this version of launchsafe",
                                                (folder / manifest_name).string())};
}

StudyRecord record_of_folder(const fs::path& folder) try {
  return read_study_record(folder);
} catch (const Error& error) {
  if (error.kind == Error::Kind::unreadable) throw;
  if (error.kind == Error::Kind::corrupt)
    throw refusal(folder / manifest_name, "is no manifest of a study of this version of launchsafe");
  std::vector<std::string> names = scene::list_folder(folder);
  std::erase_if(names, is_temporary);
  if (names.empty()) return {};
  throw refusal(folder, fmt::format("holds files ({}) and no manifest.json of launchsafe", names.front()));
}

void write_study_record(const fs::path& folder, const StudyRecord& record) {
  const std::string text =
      to_json(record).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  write_file_atomically(folder / manifest_name, text, IfExists::replace);
}

void write_report_files(const fs::path& folder, StudyRecord record, const std::vector<TextFile>& files) {
  const StudyRecord before = record_of_folder(folder);
  write_study_record(folder, record);  // without files until all are there
  for (const TextFile& file : files) {
    write_file_atomically(folder / file.name, file.text, IfExists::replace);
    record.files.push_back(file.name);
  }
  std::error_code failed;
  for (const std::string& name : before.files)
    if (std::ranges::find(record.files, name) == record.files.end()) fs::remove(folder / name, failed);
  write_study_record(folder, record);
}

}  // namespace launchsafe::store
