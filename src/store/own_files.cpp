#include "launchsafe/store/own_files.hpp"

#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/sha256.hpp"
#include "posix_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <functional>
#include <optional>

namespace launchsafe::store {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view line_begin = R"({"file":)";

/// Calls `take` with every line that ends in a newline; a last one without was cut short.
void for_each_line(std::string_view text, const std::function<void(std::string_view)>& take) {
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    take(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
}

std::string line_of(const WrittenFile& file) {
  const nlohmann::ordered_json line{{"file", file.name}, {"sha256", file.sha256}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Whether a record's word is taken for a name: one in its folder, and none of the store's own.
bool may_be_recorded(const std::string& name) {
  if (name.empty() || name == "." || name == ".." || fs::path(name).filename() != name) return false;
  return name != "slurm" && name != own_files_name && !is_store_name(name);
}

std::optional<WrittenFile> written_file(std::string_view line) {
  if (!line.starts_with(line_begin)) return {};
  const auto object = nlohmann::json::parse(line, nullptr, false);
  if (!object.is_object()) return {};
  const auto text = [&object](const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  WrittenFile file{text("file"), text("sha256")};
  if (!may_be_recorded(file.name) || file.sha256.empty()) return {};
  return file;
}

/// Whether any line is one of ours; a single one that a kill cut short has no end.
bool is_journal_of_files(std::string_view content) {
  if (content.find('\n') == std::string_view::npos) return content.starts_with(line_begin);
  bool any = false;
  for_each_line(content, [&any](std::string_view line) { any = any || written_file(line); });
  return any;
}

MaybeError append(const fs::path& folder, const std::string& lines) {
  if (lines.empty()) return {};
  const fs::path path = folder / own_files_name;
  if (MaybeError error = obstacle_in_place(path, is_journal_of_files)) return error;
  Result<Descriptor> file = open_in_place(path, O_APPEND);
  if (!file) return file.error();
  struct stat status {};
  char last = '\n';
  if (::fstat(file->number(), &status) != 0 ||
      (status.st_size > 0 && ::pread(file->number(), &last, 1, status.st_size - 1) != 1) ||
      // A line that a kill cut short must not swallow the beginning of ours.
      !write_all(file->number(), (last == '\n' ? "" : "\n") + lines) || ::fdatasync(file->number()) != 0 ||
      !sync_folder(folder))
    return write_error(path, errno);
  return {};
}

Error not_ours(const fs::path& path, FileState state) {
  return refusal(path, state == FileState::edited ? "was edited since launchsafe wrote it" : foreign_file);
}

bool is_replaceable(FileState state) { return state == FileState::absent || state == FileState::ours; }

}  // namespace

Result<OwnFiles> OwnFiles::read(const fs::path& folder) {
  OwnFiles files;
  files.folder_ = folder;
  const fs::path path = folder / own_files_name;
  if (const MaybeError error = obstacle_in_place(path, is_journal_of_files)) return *error;
  const Result<std::string> text = read_file(path);
  if (!text && text.error().kind != Error::Kind::missing) return text.error();
  if (!text) return files;
  for_each_line(*text, [&files](std::string_view line) {
    if (const auto file = written_file(line)) files.add(*file);
  });
  return files;
}

FileState OwnFiles::state_of(const std::string& name) const {
  const fs::path path = folder_ / name;
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(path, failed);
  if (!fs::exists(status)) return FileState::absent;
  const auto known = digests_.find(name);
  const FileState otherwise = known == digests_.end() ? FileState::foreign : FileState::edited;
  if (!fs::is_regular_file(status)) return otherwise;
  if (path.extension() == ".h5" && read_manifest(path)) return FileState::ours;
  if (known == digests_.end()) return otherwise;
  const Result<std::string> content = read_file(path);
  return content && known->second.contains(sha256(*content)) ? FileState::ours : otherwise;
}

bool OwnFiles::knows(const WrittenFile& file) const {
  const auto found = digests_.find(file.name);
  return found != digests_.end() && found->second.contains(file.sha256);
}

std::vector<std::string> OwnFiles::present() const {
  std::vector<std::string> names;
  for (const auto& [name, digests] : digests_) {
    if (state_of(name) != FileState::absent) names.push_back(name);
  }
  return names;
}

MaybeError write_own_file(const fs::path& path, std::string_view content) {
  const WrittenFile file{path.filename(), sha256(content)};
  for (int attempt = 1;; ++attempt) {
    const Result<OwnFiles> own = OwnFiles::read(folder_of(path));
    if (!own) return own.error();
    const FileState state = own->state_of(file.name);
    if (const auto present = read_file(path); present && *present == content) return {};
    if (!is_replaceable(state)) return not_ours(path, state);
    if (!own->knows(file)) {
      if (MaybeError error = append(folder_of(path), line_of(file))) return error;
    }
    const IfExists if_exists = state == FileState::absent ? IfExists::refuse : IfExists::replace;
    MaybeError error = write_file_atomically(path, content, if_exists);
    // Another process of ours, a shard for example, may have written it meanwhile.
    constexpr int most_attempts = 10;
    if (!error || error->kind != Error::Kind::conflict || attempt == most_attempts) return error;
  }
}

MaybeError obstacle_to_own_file(const fs::path& path) {
  const Result<OwnFiles> own = OwnFiles::read(folder_of(path));
  if (!own) return own.error();
  const FileState state = own->state_of(path.filename());
  return is_replaceable(state) ? MaybeError() : not_ours(path, state);
}

MaybeError note_own_files(const fs::path& folder, const std::vector<WrittenFile>& files) {
  const Result<OwnFiles> own = OwnFiles::read(folder);
  if (!own) return own.error();
  std::string lines;
  for (const WrittenFile& file : files) {
    if (!own->knows(file)) lines += line_of(file);
  }
  return append(folder, lines);
}

Result<std::vector<std::string>> set_edited_aside(const fs::path& folder) {
  const Result<OwnFiles> own = OwnFiles::read(folder);
  if (!own) return own.error();
  std::vector<std::string> moved;
  for (const std::string& name : own->present()) {
    if (own->state_of(name) != FileState::edited) continue;
    const auto aside = move_to_numbered_name(folder / name, folder / (name + ".edited"));
    if (!aside) return aside.error();
    moved.push_back(aside->filename());
  }
  return moved;
}

}  // namespace launchsafe::store
