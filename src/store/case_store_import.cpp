#include "case_store_content.hpp"

#include <fmt/format.h>

namespace launchsafe::store {
namespace {

/// Those of the hashes whose files are whole. Damaged ones are remarked. Errors: conflict, unreadable.
Result<std::vector<std::string>> whole_ones(const StoreNames& names, const std::vector<std::string>& hashes,
                                            int model_version, StoreIndex& index) {
  std::vector<std::string> whole;
  for (const std::string& hash : hashes) {
    const Result<CheckedFile> file = read_checked(names.case_file(hash), hash);
    if (!file && file.error().kind != Error::Kind::corrupt) return file.error();
    if (!file) {
      index.remark(file.error().message + "; it was left there");
    } else if (file->manifest.model_version != model_version) {
      return Error{Error::Kind::conflict,
                   fmt::format("{} is a result of model version {}, this program's is {}; nothing was copied",
                               names.case_file(hash).string(), file->manifest.model_version, model_version)};
    } else {
      whole.push_back(hash);
    }
  }
  return whole;
}

/// The journal's entry of a result that came from elsewhere.
JournalEntry entry_of(const StoreIndex& theirs, const std::string& hash, int model_version) {
  JournalEntry entry = theirs.last_entry(hash).value_or(JournalEntry{});
  entry.hash = hash;
  entry.state = CaseState::done;
  entry.reason.clear();
  entry.model_version = model_version;
  return entry;
}

}  // namespace

Result<CaseStore::Imported> CaseStore::import_from(const std::filesystem::path& other) {
  Imported imported;
  std::error_code status;
  if (std::filesystem::equivalent(other, folder(), status)) return imported;
  const StoreNames names{other, {}};
  const std::vector<std::string> hashes = stored_hashes(names, status);
  if (status)
    return Error{Error::Kind::missing,
                 fmt::format("{} holds no results of a study: {}", other.string(), status.message())};
  StoreIndex theirs;
  if (const MaybeError error = theirs.read(other)) return *error;

  std::vector<std::string> absent;
  for (const std::string& hash : hashes) {
    if (holds(hash))
      ++imported.already_there;
    else
      absent.push_back(hash);
  }
  const int model_version = content_->options.model_version;
  const auto whole = whole_ones(names, absent, model_version, content_->index);
  if (!whole) return whole.error();

  for (const std::string& hash : *whole) {
    Result<CheckedFile> file = read_checked(names.case_file(hash), hash);
    if (!file) return file.error();
    content_->attempt(
        [&] { return content_->write_case(file->bytes, entry_of(theirs, hash, model_version)); });
    ++imported.cases;
  }
  content_->import_attempts(theirs);
  for (const auto& [key, text] : theirs.answers()) {
    if (answer(key)) continue;
    save_answer(key, text);
    ++imported.answers;
  }
  for (const std::string& remark : theirs.remarks()) content_->index.remark(remark);
  if (const MaybeError error = flush()) return *error;
  return imported;
}

void CaseStore::Content::import_attempts(const StoreIndex& theirs) {
  for (const JournalEntry& entry : theirs.entries()) {
    if (entry.state == CaseState::done) continue;
    const std::optional<JournalEntry> ours = index.last_entry(entry.hash);
    if (ours && (ours->state == CaseState::done || ours->end_time >= entry.end_time)) continue;
    attempt([&] { return write_entry(entry); });
  }
}

}  // namespace launchsafe::store
