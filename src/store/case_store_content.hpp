// What a case store is made of.
#pragma once

#include "case_bytes.hpp"
#include "launchsafe/store/case_store.hpp"
#include "store_index.hpp"
#include "store_lock.hpp"
#include "store_writer.hpp"

#include <optional>
#include <string>

namespace launchsafe::store {

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
  /// Gives a damaged file another name, unless the store only reads. Returns the error to report.
  Error set_aside(const std::string& hash, const Error& damage);
  void put_case(std::string bytes, JournalEntry entry);
  void put_entry(JournalEntry entry);
  /// Waits for what is to be written.
  MaybeError flush();
  /// Where and when an attempt ended, and of which model it was.
  void fill_in(JournalEntry& entry) const;
  /// Takes over entries of attempts on cases that are done nowhere.
  void import_attempts(const StoreIndex& theirs);
  /// Deletes what writers that were killed left half written. Those of living parts are not ours to judge.
  void remove_leftovers();

  std::optional<StoreLock> lock;
  const StoreNames names;
  const StoreOptions options;
  const Manifest manifest;  ///< of every case, without its input
  const std::string host;
  Hdf5Molds molds;
  StoreIndex index;
  std::optional<StoreWriter> writer;  // ends first
};

}  // namespace launchsafe::store
