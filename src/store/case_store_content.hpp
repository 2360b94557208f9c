// What a case store is made of.
#pragma once

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/case_store.hpp"
#include "store_index.hpp"
#include "store_lock.hpp"

#include <mutex>
#include <optional>
#include <string>

namespace launchsafe::store {

/// The names of a store's files.
struct StoreNames {
  std::filesystem::path folder;
  std::string part;

  std::filesystem::path cases() const { return folder / "cases"; }
  std::filesystem::path case_file(const std::string& hash) const { return cases() / (hash + ".h5"); }
  std::filesystem::path journal() const { return folder / ("journal" + suffix() + ".jsonl"); }
  std::filesystem::path answers() const { return folder / ("answers" + suffix() + ".jsonl"); }
  /// Ends the names of files that this part is writing.
  std::string mark() const { return part.empty() ? "whole" : part; }

 private:
  std::string suffix() const { return part.empty() ? "" : "." + part; }
};

/// The hashes of what has the name of a case file in a store, in order.
std::vector<std::string> stored_hashes(const StoreNames& names, std::error_code& status);

/// The bytes of the case file at `path`, and what they are. Errors: missing, unreadable, corrupt (also when
/// it is the result of another case than `hash` says).
struct CheckedFile {
  std::string bytes;
  Manifest manifest;
};
Result<CheckedFile> read_checked(const std::filesystem::path& path, const std::string& hash);

struct CaseStore::Content {
  /// Without a lock nothing is written.
  Content(std::optional<StoreLock> taken, StoreNames all_names, const StoreOptions& chosen);
  bool reads_only() const { return !lock; }

  /// Reads and checks a file of another size or time than the journal knows; journals it if it is whole.
  bool adopt(const std::string& hash);
  /// Whether the journal states a file of this size and time.
  bool knows(const std::string& hash, const struct stat& status) const;
  /// What to journal about a whole file that the journal does not know as it is.
  JournalEntry entry_of_found(const std::string& hash, const Manifest& found,
                              const struct stat& status) const;
  /// Gives a damaged file another name, unless the store only reads. Returns the error to report.
  Error set_aside(const std::string& hash, const Error& damage);
  /// Where and when an attempt ended, and of which model it was.
  void fill_in(JournalEntry& entry) const;
  /// Takes over entries of attempts on cases that are done nowhere.
  void import_attempts(const StoreIndex& theirs);
  /// Deletes what writers that were killed left half written. Those of living parts are not ours to judge.
  void remove_leftovers();

  /// Runs `write`, alone among the threads, unless something failed before. The first failure is kept and
  /// told.
  void attempt(const std::function<MaybeError()>& write);
  /// The first failure, if any, after all lines are on disk.
  MaybeError flush();

  // To be attempted:

  /// The file, synced and under its name; then the journal's line, synced.
  MaybeError write_case(std::string_view bytes, JournalEntry entry);
  // Whether lines of these outlive a power cut too is for `flush`: an attempt that left no result can be made
  // again, an answer drawn again, and there may be thousands.
  MaybeError write_entry(const JournalEntry& entry);
  MaybeError write_answer(const std::string& key, const std::string& text);

  const std::optional<StoreLock> lock;
  const StoreNames names;
  const StoreOptions options;
  const Manifest manifest;  ///< of every case, without its input
  const std::string host;
  StoreIndex index;

 private:
  std::mutex writing_;  ///< held while files get their names and lines are appended
  AppendedFile journal_, answers_;
  MaybeError failure_;
};

}  // namespace launchsafe::store
