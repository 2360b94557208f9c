#include "study_folder.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/own_files.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace launchsafe::app {

namespace {

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

/// Files that a study rests on: with another one its report is no longer true.
std::string records_of(const study::StudyFile& file) {
  if (file.records.empty()) return {};
  return fmt::format("\n\n# SHA-256 of the files that it rests on\n{}\n", fmt::join(file.records, "\n"));
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
      fmt::format("# model version {}\n{}\n\n# scene\n{}{}{}", run::model_version, values_of(file.file),
                  scene::to_toml(file.scene.scene), records_of(file), scenes_of_cases(file)),
      jobs);
}

bool same_study(const store::Manifest& one, const store::Manifest& other) {
  return one.input_sha256 == other.input_sha256;
}

namespace {

using std::filesystem::path;
using store::FileState;

constexpr std::string_view manifest_name = "manifest.json";

/// What is known of the files in the folder, from its own journal and from the record of its report, which
/// alone knows those of older programs.
store::Result<store::OwnFiles> own_files(const path& folder, const store::Result<StudyRecord>& record) {
  auto own = store::OwnFiles::read(folder);
  if (!own || !record) return own;
  for (const store::WrittenFile& file : record->files) own->add(file);
  return own;
}

/// In alphabetical order; none where there is no folder.
std::vector<std::string> names_in(const path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> names_of(const StudyRecord& record) {
  std::vector<std::string> names;
  for (const store::WrittenFile& file : record.files) names.push_back(file.name);
  return names;
}

path earlier_folder(const path& folder, int number) { return folder / fmt::format("earlier-{}", number); }

/// Whether files may go there: nobody made it yet, or a kill left it half filled with what is moved now. The
/// manifest goes there last.
bool is_free_for(const path& target, const std::vector<std::string>& names) {
  std::error_code failed;
  const auto status = std::filesystem::symlink_status(target, failed);
  if (!std::filesystem::exists(status)) return true;
  if (!std::filesystem::is_directory(status)) return false;
  const std::filesystem::directory_iterator entries(target, failed);
  return !failed && std::all_of(begin(entries), end(entries), [&](const auto& entry) {
    const std::string name = entry.path().filename();
    return name != manifest_name && std::find(names.begin(), names.end(), name) != names.end();
  });
}

path folder_for_earlier(const path& folder, const std::vector<std::string>& names) {
  int number = 1;
  while (!is_free_for(earlier_folder(folder, number), names)) ++number;
  return earlier_folder(folder, number);
}

store::MaybeError failed_to(const char* what, const path& target, const std::error_code& error) {
  return store::Error{store::Error::Kind::write_failed,
                      fmt::format("cannot {} {}: {}", what, target.string(), error.message())};
}

/// Moves files to where the earlier report goes. Returns where that is, empty where there was nothing to
/// move.
store::Result<path> set_earlier_aside(const path& folder, const std::vector<std::string>& names) {
  if (names.empty()) return path{};
  const path target = folder_for_earlier(folder, names);
  std::error_code failed;
  std::filesystem::create_directories(target, failed);
  if (failed) return *failed_to("make the folder", target, failed);
  for (const std::string& name : names) {
    failed = store::move_to_free_name(folder / name, target / name);
    // Another shard may be moving the same files.
    if (failed && failed != std::errc::no_such_file_or_directory)
      return *failed_to("move the earlier report to", target / name, failed);
  }
  return target;
}

/// What is moved when another study takes the folder: the files of the record, or, where a report was not
/// finished, all that is known to be ours.
std::vector<std::string> names_of_earlier(const store::OwnFiles& own,
                                          const store::Result<StudyRecord>& record) {
  std::vector<std::string> names = record ? names_of(*record) : std::vector<std::string>{};
  if (names.empty()) {
    names = own.present();
    std::erase_if(names, [](const std::string& name) { return !kinds::may_write(name); });
  }
  if (!names.empty() && record) names.emplace_back(manifest_name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  return names.front() + (names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "");
}

}  // namespace

bool holds_store(const path& folder) {
  if (!store::results_files_in(folder).empty()) return true;
  for (const path file : names_in(folder / "cases"))
    if (file.extension() == ".h5" && store::is_case_hash(file.stem().string())) return true;
  return false;
}

std::optional<std::string> obstacle_in_folder(const path& folder, const kinds::Kind& kind,
                                              const store::Manifest& manifest, bool update) {
  const auto record = store::read_study_record(folder);
  if (!record && record.error().kind != store::Error::Kind::missing) {
    return record.error().message + ", and nothing is overwritten; move it away or name another folder";
  }
  const auto own = own_files(folder, record);
  if (!own) return own.error().message;
  std::vector<std::string> foreign = names_in(folder);
  std::erase_if(foreign, [&](const std::string& name) {
    return !kinds::may_write(kind, name) || own->state_of(name) != FileState::foreign;
  });
  // A manifest that cannot be read and is there all the same is a link to nowhere.
  if (!record && std::filesystem::is_symlink(folder / manifest_name)) foreign.emplace_back(manifest_name);
  if (!foreign.empty()) {
    return fmt::format(
        "{} holds files that launchsafe did not write ({}), and nothing is overwritten; move them away or "
        "name another folder",
        folder.string(), listed(foreign));
  }
  const std::vector<std::string> earlier = names_of_earlier(*own, record);
  const bool of_this_study = record ? same_study(record->manifest, manifest) : earlier.empty();
  if (update || of_this_study) return std::nullopt;
  return fmt::format(
      "{} holds {}, and nothing is overwritten; with --update the report there moves to {} and stored cases "
      "are used where they fit; or name another folder",
      folder.string(),
      record ? "the results of a different study or model" : "a report without its manifest.json",
      folder_for_earlier(folder, earlier).string());
}

void remove_leftovers(const path& folder) {
  for (const std::string& name : names_in(folder)) store::remove_leftover(folder / name);
}

store::Result<path> take_folder(const path& folder, const StudyRecord& asked) {
  const auto record = store::read_study_record(folder);
  const auto own = own_files(folder, record);
  if (!own) return own.error();
  if (record) {
    // An older program kept no journal of files; its manifest knows them, and it is one.
    std::vector<store::WrittenFile> files = record->files;
    const std::string name(manifest_name);
    if (own->state_of(name) == FileState::foreign)
      for (store::WrittenFile& file : store::record_files(folder, {name})) files.push_back(std::move(file));
    if (auto error = store::note_own_files(folder, files)) return *error;
    if (same_study(record->manifest, asked.manifest)) return path{};
  }
  auto moved_to = set_earlier_aside(folder, names_of_earlier(*own, record));
  if (!moved_to) return moved_to;
  if (auto error = store::write_study_record(folder, asked)) return *error;
  return moved_to;
}

store::Result<path> set_stale_aside(const path& folder, const StudyRecord& earlier,
                                    const std::vector<std::string>& written) {
  std::vector<std::string> stale;
  for (const std::string& name : names_of(earlier)) {
    const bool is_new = std::find(written.begin(), written.end(), name) != written.end();
    if (!is_new && std::filesystem::exists(std::filesystem::symlink_status(folder / name)))
      stale.push_back(name);
  }
  return set_earlier_aside(folder, stale);
}

}  // namespace launchsafe::app
