// What a store knows without opening a case file: the newest entry of every case, the answers, the remarks.
#pragma once

#include "journal.hpp"
#include "launchsafe/store/case_store.hpp"

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace launchsafe::store {

/// Any thread may call any member.
class StoreIndex {
 public:
  /// Reads the journals and answers of every part in a folder. Answers that no journal knows as they are were
  /// not written by this program: a remark says so, and they are ignored. Errors: unreadable.
  MaybeError read(const std::filesystem::path& folder);

  std::optional<JournalEntry> last_entry(const std::string& hash) const;
  /// In the order of their hashes.
  std::vector<JournalEntry> entries() const;
  /// Takes the newest entry of a case.
  void take(const JournalEntry& entry);

  std::optional<std::string> answer(const std::string& key) const;
  void take_answer(const std::string& key, const std::string& text);
  /// By their keys.
  std::map<std::string, std::string> answers() const;

  std::vector<std::string> remarks() const;
  /// One that was made before is not repeated.
  void remark(const std::string& text);

 private:
  void read_journal(const std::filesystem::path& file, std::string_view text);
  /// Needs all journals: an answer counts if one of them knows it as it is.
  void read_answers(const std::filesystem::path& file, std::string_view text);

  mutable std::mutex mutex_;
  std::map<std::string, JournalEntry> entries_;     ///< by the hashes of their cases
  std::map<std::string, std::string> answers_;      ///< by their keys
  std::unordered_set<std::string> answer_digests_;  ///< of the answers that the journals know
  std::vector<std::string> remarks_;
};

}  // namespace launchsafe::store
