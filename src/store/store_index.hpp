// What a store knows without opening a case file: the newest entry of every case, the answers, the remarks.
#pragma once

#include "journal.hpp"
#include "launchsafe/store/case_store.hpp"

#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
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
  /// Whether a result was taken that is not on disk yet.
  bool is_pending(const std::string& hash) const;

  /// Takes the newest entry of a case; `pending` when its file is still to be written.
  void take(const JournalEntry& entry, bool pending);
  /// What was pending is on disk, with the size and time that the entry says.
  void stored(const JournalEntry& entry);
  /// What was pending will not be written.
  void dropped(const JournalEntry& entry);

  std::optional<std::string> answer(const std::string& key) const;
  void take_answer(const std::string& key, const std::string& text);
  /// The texts live as long as the index.
  std::vector<AnswerLine> answers() const;

  std::vector<std::string> remarks() const;
  /// One that was made before is not repeated.
  void remark(const std::string& text);

 private:
  struct Record {
    JournalEntry entry;
    int pending = 0;  ///< files still to be written
  };

  void read_journal(const std::filesystem::path& file, std::string_view text);
  /// Needs all journals: an answer counts if one of them knows it as it is.
  void read_answers(const std::filesystem::path& file, std::string text);

  mutable std::mutex mutex_;
  std::unordered_map<std::string, Record> records_;
  std::deque<std::string> texts_;  ///< of which the keys and values of the answers are parts
  std::unordered_map<std::string_view, std::string_view> answers_;
  std::unordered_set<std::string> answer_marks_;  ///< of the answers that the journals know
  std::vector<std::string> remarks_;
};

}  // namespace launchsafe::store
