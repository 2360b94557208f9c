#include "launchsafe/store/case_store.hpp"

#include "case_store_content.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/sha256.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cerrno>

namespace launchsafe::store {
namespace {

constexpr std::size_t hash_digits = 32;

/// What every case of this program has in common; what differs between equal runs is left out.
Manifest common_manifest() {
  Manifest manifest = make_manifest("", 1);
  manifest.host.clear();
  manifest.start_time.clear();
  return manifest;
}

bool belongs_to(const Manifest& manifest, const std::string& hash) {
  return !hash.empty() && manifest.input_sha256.starts_with(hash);
}

Error of_file(const std::filesystem::path& path, const Error& error) {
  return {error.kind, fmt::format("{}: {}", path.string(), error.message)};
}

Error of_another_case(const std::filesystem::path& path) {
  return {Error::Kind::corrupt, fmt::format("{}: it is the result of another case", path.string())};
}

MaybeError make_folder(const std::filesystem::path& folder) {
  std::error_code status;
  const bool is_new = std::filesystem::create_directories(folder, status);
  if (is_new) sync_folder((folder / "..").lexically_normal());
  if (!status) return {};
  return Error{Error::Kind::write_failed,
               fmt::format("cannot make the folder {}: {}", folder.string(), status.message())};
}

/// Whatever has the name of a case but is no file.
MaybeError obstacle_among_cases(const StoreNames& names) {
  std::error_code ignored;
  for (const std::string& hash : stored_hashes(names, ignored)) {
    const std::filesystem::path path = names.case_file(hash);
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, ignored)))
      return refusal(path, "is no plain file");
  }
  return {};
}

/// A store makes its folder of cases before anything else: an empty file of a store's name beside none is not
/// its own.
MaybeError obstacle_before_first(const StoreNames& names) {
  std::error_code failed;
  if (std::filesystem::exists(names.cases(), failed)) return {};
  for (const std::filesystem::path& path : {names.journal(), names.answers(), names.folder / "lock"}) {
    if (std::filesystem::is_regular_file(path, failed) && std::filesystem::file_size(path, failed) == 0)
      return refusal(path, foreign_file);
  }
  return {};
}

/// What of a store's own names is taken by somebody else's files. Changes nothing.
MaybeError obstacle_in(const StoreNames& names) {
  struct stat status {};
  if (::lstat(names.cases().c_str(), &status) == 0 && !S_ISDIR(status.st_mode))
    return refusal(names.cases(), "is no folder");
  if (MaybeError error = obstacle_among_cases(names)) return error;
  if (MaybeError error = obstacle_before_first(names)) return error;
  if (MaybeError error = StoreLock::obstacle(names.folder, names.part)) return error;
  if (MaybeError error = obstacle_in_place(names.journal(), is_journal)) return error;
  return obstacle_in_place(names.answers(), is_answers);
}

}  // namespace

bool is_case_hash(std::string_view text) {
  return text.size() == hash_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

CaseIdentity::CaseIdentity(std::string input)
    : input_(std::move(input)), hash_(sha256(input_).substr(0, hash_digits)) {}

std::vector<std::string> stored_hashes(const StoreNames& names, std::error_code& status) {
  std::vector<std::string> hashes;
  for (const std::string& name : list_folder(names.cases(), status)) {
    const std::filesystem::path file(name);
    if (file.extension() == ".h5" && is_case_hash(file.stem().string())) hashes.push_back(file.stem());
  }
  return hashes;
}

Result<CheckedFile> read_checked(const std::filesystem::path& path, const std::string& hash) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  Result<Manifest> manifest = manifest_of(*bytes);
  if (!manifest) return of_file(path, manifest.error());
  if (!belongs_to(*manifest, hash)) return of_another_case(path);
  return CheckedFile{std::move(*bytes), std::move(*manifest)};
}

// --- the content ---

CaseStore::Content::Content(std::optional<StoreLock> taken, StoreNames all_names, const StoreOptions& chosen)
    : lock(std::move(taken)),
      names(std::move(all_names)),
      options(chosen),
      manifest(common_manifest()),
      host(host_name()),
      journal_(names.journal()),
      answers_(names.answers()) {}

bool CaseStore::Content::adopt(const std::string& hash) {
  const std::filesystem::path path = names.case_file(hash);
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return false;
  const Result<CheckedFile> file = read_checked(path, hash);
  if (!file) {
    if (file.error().kind == Error::Kind::corrupt) set_aside(hash, file.error());
    if (file.error().kind == Error::Kind::unreadable) index.remark(file.error().message);
    return false;
  }
  const auto journal = [&]() -> MaybeError {
    if (knows(hash, status)) return {};  // by now: another thread has just stored it
    const JournalEntry entry = entry_of_found(hash, file->manifest, status);
    if (!reads_only()) return write_entry(entry);
    index.take(entry);
    return {};
  };
  attempt(journal);
  return true;
}

bool CaseStore::Content::knows(const std::string& hash, const struct stat& status) const {
  const std::optional<JournalEntry> entry = index.last_entry(hash);
  return entry && entry->state == CaseState::done && entry->file_size == size_of(status) &&
         entry->file_time == time_of(status);
}

JournalEntry CaseStore::Content::entry_of_found(const std::string& hash, const Manifest& found,
                                                const struct stat& status) const {
  JournalEntry entry = index.last_entry(hash).value_or(JournalEntry{});
  if (entry.state != CaseState::done || entry.hash.empty()) {
    entry.hash = hash;
    entry.state = CaseState::done;
    entry.reason.clear();
    entry.wall_time = entry.processor_time = 0;  // whatever took them was another attempt
    entry.host = host;
    entry.end_time = utc_now();
  }
  entry.model_version = found.model_version;
  entry.file_size = size_of(status);
  entry.file_time = time_of(status);
  return entry;
}

Error CaseStore::Content::set_aside(const std::string& hash, const Error& damage) {
  const std::filesystem::path path = names.case_file(hash);
  if (reads_only()) {
    index.remark(damage.message + "; it would be set aside and computed again");
    return damage;
  }
  // While no file gets its name, the one that is there now is looked at once more: it may be a new one.
  const std::lock_guard lock_of_names(writing_);
  const Result<CheckedFile> again = read_checked(path, hash);
  if (again || again.error().kind != Error::Kind::corrupt) return damage;
  const auto aside = move_to_numbered_name(path, names.cases() / (hash + ".damaged"));
  index.remark(
      aside ? fmt::format("{}; it was set aside as {}", damage.message, aside->filename().string())
            : fmt::format("{}, and it cannot be set aside: {}", damage.message, aside.error().message));
  return damage;
}

void CaseStore::Content::fill_in(JournalEntry& entry) const {
  if (entry.model_version == 0) entry.model_version = options.model_version;
  entry.host = host;
  entry.end_time = utc_now();
}

void CaseStore::Content::remove_leftovers() {
  if (!lock->enforced()) return;
  std::error_code status;
  for (const std::string& temporary : list_folder(names.cases(), status)) {
    const std::optional<std::string> name = name_behind(temporary);
    if (!name || !is_case_hash(name->substr(0, name->find('.')))) continue;
    // A part excludes whole studies and others of its own name.
    const bool ours = options.part.empty() || name->ends_with("." + names.mark()) ||
                      name->ends_with("." + StoreNames{}.mark());
    if (ours) remove_leftover(names.cases() / temporary);
  }
}

// --- writing ---

void CaseStore::Content::attempt(const std::function<MaybeError()>& write) {
  MaybeError failure;
  {
    const std::lock_guard one_at_a_time(writing_);
    if (failure_) return;
    failure = failure_ = write();
  }
  if (failure && options.on_failure) options.on_failure(*failure);
}

MaybeError CaseStore::Content::flush() {
  attempt([&] {
    MaybeError error = journal_.sync();
    return error ? error : answers_.sync();
  });
  const std::lock_guard lock_of_failure(writing_);
  return failure_;
}

MaybeError CaseStore::Content::write_case(std::string_view bytes, JournalEntry entry) {
  const std::filesystem::path path = names.case_file(entry.hash);
  const MaybeError error =
      write_file_atomically(path, bytes, IfExists::refuse, entry.hash + "." + names.mark());
  // Another thread may have stored the same result meanwhile, or another process where nothing keeps it out.
  const bool there_already = error && error->kind == Error::Kind::conflict && read_checked(path, entry.hash);
  if (error && !there_already) return Error{Error::Kind::write_failed, error->message};
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return write_error(path, errno);
  entry.file_size = size_of(status);
  entry.file_time = time_of(status);
  if (MaybeError failure = write_entry(entry)) return failure;
  return journal_.sync();
}

MaybeError CaseStore::Content::write_entry(const JournalEntry& entry) {
  if (MaybeError error = journal_.append(journal_line(entry))) return error;
  index.take(entry);
  return {};
}

MaybeError CaseStore::Content::write_answer(const std::string& key, const std::string& text) {
  if (text.find('\n') != std::string::npos)
    return Error{Error::Kind::failed, fmt::format("the answer {} is not one line", key)};
  // The journal first: an answer that it does not know would be remarked on.
  if (MaybeError error = journal_.append(answer_entry_line(key, text))) return error;
  if (MaybeError error = answers_.append(answer_line(key, text))) return error;
  index.take_answer(key, text);
  return {};
}

// --- the store ---

Result<std::unique_ptr<CaseStore>> CaseStore::open(const std::filesystem::path& folder,
                                                   const StoreOptions& options) {
  StoreNames names{folder, options.part};
  if (const MaybeError error = obstacle_in(names)) return *error;
  for (const std::filesystem::path& each : {folder, names.cases()}) {
    if (const MaybeError error = make_folder(each)) return *error;
  }
  Result<StoreLock> lock = StoreLock::take(folder, options.part);
  if (!lock) return lock.error();
  auto content = std::make_unique<Content>(std::move(*lock), std::move(names), options);
  if (!content->lock->enforced())
    content->index.remark(
        fmt::format("the file system of {} knows no locks: make sure that no second process writes there",
                    folder.string()));
  if (const MaybeError error = content->index.read(folder)) return *error;
  content->remove_leftovers();
  return std::unique_ptr<CaseStore>(new CaseStore(std::move(content)));
}

Result<std::unique_ptr<CaseStore>> CaseStore::open_to_read(const std::filesystem::path& folder,
                                                           int model_version) {
  auto content =
      std::make_unique<Content>(std::nullopt, StoreNames{folder, {}}, StoreOptions{{}, model_version, {}});
  if (const MaybeError error = content->index.read(folder)) return *error;
  return std::unique_ptr<CaseStore>(new CaseStore(std::move(content)));
}

CaseStore::CaseStore(std::unique_ptr<Content> content) : content_(std::move(content)) {}
CaseStore::~CaseStore() { content_->flush(); }

std::optional<JournalEntry> CaseStore::last_entry(const std::string& hash) const {
  return content_->index.last_entry(hash);
}

std::vector<JournalEntry> CaseStore::entries() const { return content_->index.entries(); }

bool CaseStore::holds(const std::string& hash) {
  struct stat status {};
  if (::stat(content_->names.case_file(hash).c_str(), &status) != 0) return false;
  return content_->knows(hash, status) || content_->adopt(hash);
}

Result<run::CaseResult> CaseStore::load(const std::string& hash) {
  const std::filesystem::path path = content_->names.case_file(hash);
  Result<StoredCase> stored = read_case_file(path);
  if (!stored && stored.error().kind != Error::Kind::corrupt) return stored.error();
  if (!stored) return content_->set_aside(hash, stored.error());
  if (!belongs_to(stored->manifest, hash)) return content_->set_aside(hash, of_another_case(path));
  const std::optional<JournalEntry> entry = content_->index.last_entry(hash);
  if (entry && entry->state == CaseState::done) {
    stored->result.mechanics.wall_time = entry->wall_time;
    stored->result.mechanics.processor_time = entry->processor_time;
  }
  return std::move(stored->result);
}

Result<std::string> CaseStore::input_of(const std::string& hash) const {
  Result<CheckedFile> file = read_checked(content_->names.case_file(hash), hash);
  if (file) return std::move(file->manifest.input_text);
  if (file.error().kind != Error::Kind::corrupt) return file.error();
  return content_->set_aside(hash, file.error());
}

void CaseStore::save(const CaseIdentity& identity, const scene::Scene& scene, run::CaseResult result,
                     JournalEntry entry) {
  assert(!content_->reads_only());
  entry.hash = identity.hash();
  entry.state = CaseState::done;
  content_->fill_in(entry);
  Manifest manifest = content_->manifest;
  manifest.input_text = identity.input();
  manifest.input_sha256 = sha256(identity.input());
  manifest.model_version = entry.model_version;
  if (entry.wall_time == 0) {
    entry.wall_time = result.mechanics.wall_time;
    entry.processor_time = result.mechanics.processor_time;
  }
  result.mechanics.wall_time = 0;
  const Result<std::string> bytes = case_bytes(scene, result, manifest);
  content_->attempt([&]() -> MaybeError {
    if (!bytes) return of_file(content_->names.case_file(entry.hash), bytes.error());
    return content_->write_case(*bytes, std::move(entry));
  });
}

void CaseStore::note(JournalEntry entry) {
  assert(!content_->reads_only());
  content_->fill_in(entry);
  content_->attempt([&] { return content_->write_entry(entry); });
}

std::optional<std::string> CaseStore::answer(const std::string& key) const {
  return content_->index.answer(key);
}

void CaseStore::save_answer(const std::string& key, const std::string& text) {
  assert(!content_->reads_only());
  content_->attempt([&] { return content_->write_answer(key, text); });
}

MaybeError CaseStore::flush() { return content_->flush(); }

std::vector<std::string> CaseStore::remarks() const { return content_->index.remarks(); }

const std::filesystem::path& CaseStore::folder() const { return content_->names.folder; }

}  // namespace launchsafe::store
