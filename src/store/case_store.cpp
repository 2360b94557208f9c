#include "launchsafe/store/case_store.hpp"

#include "case_store_content.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/sha256.hpp"
#include "plain_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace launchsafe::store {
namespace {

constexpr std::size_t hash_digits = 32;

MaybeError make_folder(const std::filesystem::path& folder) {
  std::error_code status;
  const bool is_new = std::filesystem::create_directories(folder, status);
  if (is_new) sync_folder((folder / "..").lexically_normal());
  if (!status) return {};
  return Error{Error::Kind::write_failed,
               fmt::format("cannot make the folder {}: {}", folder.string(), status.message())};
}

}  // namespace

bool is_case_hash(std::string_view text) {
  return text.size() == hash_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

CaseIdentity::CaseIdentity(std::string input)
    : input_(std::move(input)), hash_(sha256(input_).substr(0, hash_digits)) {}

Result<std::unique_ptr<CaseStore>> CaseStore::open(const std::filesystem::path& folder,
                                                   const StoreOptions& options) {
  StoreNames names{folder, options.part};
  if (const MaybeError error = obstacle_in(names)) return *error;
  for (const std::filesystem::path& each : {folder, names.cases()}) {
    if (const MaybeError error = make_folder(each)) return *error;
  }
  Result<Database> database = Database::open(names.results());
  if (!database) return told_who_writes(database.error(), names.results());
  std::vector<std::filesystem::path> others = results_files_in(folder);
  std::erase_if(others, [&](const std::filesystem::path& each) {
    return each == names.results() || (!options.part.empty() && each != StoreNames{folder, {}}.results());
  });
  auto content = std::make_unique<Content>(std::move(names), options, std::move(*database), true);
  if (const MaybeError error = content->take_over(others)) return *error;
  remove_leftovers_of(content->names);
  content->status.host = content->host;
  content->status.process = ::getpid();
  content->status.since = utc_now();
  content->write_status();
  return std::unique_ptr<CaseStore>(new CaseStore(std::move(content)));
}

Result<std::unique_ptr<CaseStore>> CaseStore::open_to_read(const std::filesystem::path& folder,
                                                           int model_version) {
  if (const MaybeError error = obstacle_of_older(folder)) return *error;
  std::error_code status;
  list_folder(folder, status);
  if (status)
    return Error{Error::Kind::unreadable,
                 fmt::format("cannot read {}: {}", folder.string(), status.message())};
  std::vector<std::filesystem::path> files = results_files_in(folder);
  Result<Database> database = files.empty() ? Database::in_memory(StoreNames{folder, {}}.results())
                                            : Database::copy_of(files.front());
  if (!database) return told_who_writes(database.error(), files.empty() ? folder : files.front());
  if (!files.empty()) files.erase(files.begin());
  auto content = std::make_unique<Content>(StoreNames{folder, {}}, StoreOptions{{}, model_version, {}},
                                           std::move(*database), false);
  if (const MaybeError error = content->take_over(files)) return *error;
  return std::unique_ptr<CaseStore>(new CaseStore(std::move(content)));
}

CaseStore::CaseStore(std::unique_ptr<Content> content) : content_(std::move(content)) {}

CaseStore::~CaseStore() {
  content_->flush();
  if (!content_->writes) return;
  content_->status.ended = true;
  content_->write_status();
}

std::optional<RunRecord> CaseStore::record_of(const std::string& hash) const {
  return content_->record_of(hash);
}

std::vector<RunRecord> CaseStore::records() const {
  const std::lock_guard lock(content_->using_);
  auto found = run_table().select(content_->database, {});
  return found ? std::move(*found) : std::vector<RunRecord>{};
}

bool CaseStore::holds(const std::string& hash) {
  struct stat file {};
  if (::stat(content_->names.case_file(hash).c_str(), &file) != 0 || content_->is_given_up(hash))
    return false;
  return content_->knows(hash, file) || content_->adopt(hash);
}

Result<run::CaseResult> CaseStore::load(const std::string& hash) {
  const std::filesystem::path path = content_->names.case_file(hash);
  Result<StoredCase> stored = read_case_file(path);
  if (stored && !belongs_to(stored->manifest, hash)) stored = of_another_case(path);
  if (!stored && stored.error().kind == Error::Kind::corrupt) return content_->give_up(hash, stored.error());
  if (!stored) return stored.error();
  const std::optional<RunRecord> record = content_->record_of(hash);
  if (record && record->state == CaseState::done) {
    stored->result.mechanics.wall_time = record->wall_time;
    stored->result.mechanics.processor_time = record->processor_time;
  }
  return std::move(stored->result);
}

Result<std::string> CaseStore::input_of(const std::string& hash) {
  Result<CheckedFile> file = read_checked(content_->names.case_file(hash), hash);
  if (file) return std::move(file->manifest.input_text);
  if (file.error().kind != Error::Kind::corrupt) return file.error();
  return content_->give_up(hash, file.error());
}

void CaseStore::save(const CaseIdentity& identity, const scene::Scene& scene, run::CaseResult result,
                     RunRecord record) {
  assert(content_->writes);
  record.hash = identity.hash();
  record.state = CaseState::done;
  content_->fill_in(record);
  Manifest manifest = content_->manifest;
  manifest.input_text = identity.input();
  manifest.input_sha256 = sha256(identity.input());
  manifest.model_version = record.model_version;
  if (record.wall_time == 0) {
    record.wall_time = result.mechanics.wall_time;
    record.processor_time = result.mechanics.processor_time;
  }
  result.mechanics.wall_time = 0;
  content_->keep(case_bytes(scene, result, manifest), std::move(record));
}

void CaseStore::note(RunRecord record) {
  assert(content_->writes);
  content_->fill_in(record);
  content_->put(record);
}

void CaseStore::write(const std::function<MaybeError(Database&)>& change) {
  content_->change(false, [&] { return change(content_->database); });
}

void CaseStore::read(const std::function<void(Database&)>& look) const {
  const std::lock_guard lock(content_->using_);
  look(content_->database);
}

void CaseStore::replace_tables(const std::vector<PlainTable>& tables) {
  content_->change(true, [&] {
    MaybeError error = drop_plain_tables(content_->database);
    for (const PlainTable& table : tables)
      if (!error) error = write_table(content_->database, table);
    return error;
  });
}

MaybeError CaseStore::flush() { return content_->flush(); }

void CaseStore::tell_progress(std::size_t done, std::size_t running, std::size_t total) {
  content_->tell_progress(done, running, total);
}

std::vector<std::string> CaseStore::remarks() const {
  const std::lock_guard lock(content_->using_);
  return content_->remarks;
}

const std::filesystem::path& CaseStore::folder() const { return content_->names.folder; }

Result<CaseStore::Imported> CaseStore::import_from(const std::filesystem::path& other) {
  Imported imported;
  std::error_code status;
  if (std::filesystem::equivalent(other, folder(), status)) return imported;
  if (const MaybeError error = obstacle_of_older(other)) return *error;
  const std::vector<std::filesystem::path> files = results_files_in(other);
  if (files.empty())
    return Error{Error::Kind::missing, fmt::format("{} holds no results of a study", other.string())};
  for (const std::filesystem::path& file : files)
    if (const MaybeError error = Database::obstacle(file)) return told_who_writes(*error, file);
  const StoreNames theirs{other, {}};
  std::vector<std::string> absent;
  for (const std::string& hash : stored_hashes(theirs, status)) {
    if (holds(hash))
      ++imported.already_there;
    else
      absent.push_back(hash);
  }
  std::vector<std::string> remarks;
  const auto whole = whole_ones(theirs, absent, content_->options.model_version, remarks);
  if (!whole) return whole.error();
  for (const std::string& remark : remarks) content_->remark(remark);
  for (const std::string& hash : *whole)
    if (const MaybeError error = content_->take_file(theirs.case_file(hash), hash)) return *error;
  imported.cases = whole->size();
  if (const MaybeError error = flush()) return *error;
  const std::lock_guard lock(content_->using_);
  if (const MaybeError error = content_->take_over(files)) return *error;
  return imported;
}

}  // namespace launchsafe::store
