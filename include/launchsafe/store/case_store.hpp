// The folder of a study: one file a case, a journal of what became of every attempt, the answers drawn from
// the cases, and a lock. Killing the process at any instant loses at most what was in flight.
//
//   DIR/cases/HASH.h5          the result of one case, named by what determines it, whole or not there
//   DIR/cases/HASH.damaged-1   a file that was truncated or damaged, set aside
//   DIR/journal[.PART].jsonl   one line an attempt and one an answer, only ever appended to
//   DIR/answers[.PART].jsonl   small texts derived from cases, each with its checksum; what the journal
//                              does not know as it is counts for nothing
//   DIR/lock[.PART]            held by the process that writes; names host and process
//
// PART is "1-of-4" for a shard and absent for a whole study; whoever reads, reads the files of every part.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/scene/scene.hpp"
#include "launchsafe/store/result.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::store {

/// All that determines a result, as canonical text, and the name that follows from it.
class CaseIdentity {
 public:
  explicit CaseIdentity(std::string input);
  const std::string& input() const { return input_; }
  /// The first 32 hexadecimal digits of the SHA-256 of the input.
  const std::string& hash() const { return hash_; }

 private:
  std::string input_, hash_;
};

/// Whether a text has the form of `CaseIdentity::hash`.
bool is_case_hash(std::string_view text);

/// What became of an attempt. A run that ended by itself is done, also when its energy drifted away: computed
/// again it would do the same. Failed: it threw (memory, for example), and may succeed another time.
enum class CaseState { done, failed, timed_out, interrupted };
std::string to_string(CaseState state);

/// One line of the journal.
struct JournalEntry {
  std::string hash;
  CaseState state = CaseState::done;
  std::string label;   ///< of the case, for people
  std::string reason;  ///< why it is not done
  int model_version = 0;
  double wall_time = 0;          ///< s, of the run
  double processor_time = 0;     ///< s, of the run; 0 where an older program did not note it
  double predicted_updates = 0;  ///< particle updates that the plan foresaw, from which cost models learn
  double time_limit = 0;         ///< s, of a case that was timed out
  std::string host;
  std::string end_time;         ///< ISO 8601, UTC
  std::uint64_t file_size = 0;  ///< bytes, of a case that is done
  std::int64_t file_time = 0;   ///< ns since the epoch, modification time of the file
};

struct StoreOptions {
  std::string part;       ///< "1-of-4" of a shard; empty for a whole study
  int model_version = 0;  ///< goes into the journal
  /// Called once, from any thread, when something cannot be written: the study has to end.
  std::function<void(const Error&)> on_failure;
};

/// Any thread may call any member. What was saved or noted is seen at once by whoever asks, and outlives this
/// process from then on. Nothing is taken any more once something could not be written.
class CaseStore {
 public:
  /// Makes the folder, takes the lock, reads all journals and answers, and deletes what a killed writer of
  /// this part left half written. A line that a kill cut short is ignored, as are lines with a wrong
  /// checksum and answers that the journal does not know. The lock ends with its process, however that ends;
  /// where the file system knows no locks, a remark says so. Errors: conflict (another living process holds
  /// the lock of this part or of the whole, or of any part for a whole study; named with host and process; or
  /// a file has a name that the store needs and is none of ours: then nothing was made or changed),
  /// write_failed, unreadable.
  static Result<std::unique_ptr<CaseStore>> open(const std::filesystem::path& folder,
                                                 const StoreOptions& options);
  /// A store that only looks: no lock, no repair, nothing is set aside or written, also while another process
  /// writes there or where nothing may be written. What a writing store would do is said in `remarks`. Only
  /// const members, `holds` and `load` may be called. Errors: unreadable.
  static Result<std::unique_ptr<CaseStore>> open_to_read(const std::filesystem::path& folder,
                                                         int model_version);
  /// Flushes, then releases the lock.
  ~CaseStore();
  CaseStore(const CaseStore&) = delete;
  CaseStore& operator=(const CaseStore&) = delete;

  /// The newest entry on a case; nothing where none was ever attempted.
  std::optional<JournalEntry> last_entry(const std::string& hash) const;
  /// The newest entries of all cases, in the order of their hashes.
  std::vector<JournalEntry> entries() const;

  /// Whether the whole result of a case is there. A file of the size and
  /// modification time that the journal states is trusted; any other is read and checked, and journaled if it
  /// is whole but was not (a kill after the rename). A damaged one is set aside, see `remarks`.
  bool holds(const std::string& hash);
  /// The result of a case that is held, checked against its checksum, with the wall time from the journal.
  /// Errors: missing; corrupt (it was set aside); unreadable.
  Result<run::CaseResult> load(const std::string& hash);
  /// The text that determined a stored case. Errors as of `load`.
  Result<std::string> input_of(const std::string& hash) const;

  /// Writes a result: the file under a temporary name, synced, renamed; then the journal, synced. Host, times
  /// and wall time go to the journal only, so that equal cases are equal files, bit by bit. `entry` gives
  /// label, wall time and prediction; the rest is filled in, also a model version and a wall time of 0. A
  /// result whose arrays do not fit together counts as something that cannot be written.
  void save(const CaseIdentity& identity, const scene::Scene& scene, run::CaseResult result,
            JournalEntry entry);
  /// Journals an attempt that left no result. That it outlives a power cut is for `flush`.
  void note(JournalEntry entry);

  /// A text derived from a case, under a key of the caller's (hexadecimal digits): one line, such as JSON.
  /// The last one of a key counts. Only `flush` makes sure that it outlives a power cut: it can be drawn
  /// again.
  std::optional<std::string> answer(const std::string& key) const;
  void save_answer(const std::string& key, const std::string& text);

  /// Waits until attempts and answers are on disk too. The first thing that could not be written, if any.
  MaybeError flush();

  /// What a person should know of what was found: files set aside, lines ignored.
  std::vector<std::string> remarks() const;
  const std::filesystem::path& folder() const;

  /// Copies what another folder holds and this one does not: whole case files with their journal entries, and
  /// answers; of cases that are done in neither, the newest attempt. Damaged files there are left where they
  /// are and named in `remarks`. The other folder is not locked. Errors: conflict (a result there is of
  /// another model version; nothing was copied), missing (no such store), unreadable, write_failed.
  struct Imported {
    std::size_t cases = 0, already_there = 0, answers = 0;
  };
  Result<Imported> import_from(const std::filesystem::path& other);

 private:
  struct Content;
  explicit CaseStore(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace launchsafe::store
