// The one thread that writes into a store, so that whoever computes waits for no disk.
#pragma once

#include "journal.hpp"
#include "launchsafe/store/case_store.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace launchsafe::store {

/// The names of a store's files.
struct StoreNames {
  std::filesystem::path folder;
  std::string part;

  std::filesystem::path cases() const { return folder / "cases"; }
  std::filesystem::path case_file(const std::string& hash) const { return cases() / (hash + ".h5"); }
  std::filesystem::path journal() const { return folder / ("journal" + suffix() + ".jsonl"); }
  std::filesystem::path answers() const { return folder / ("answers" + suffix() + ".jsonl"); }
  /// Marks the names of files that this part is writing.
  std::string mark() const { return part.empty() ? "whole" : part; }

 private:
  std::string suffix() const { return part.empty() ? "" : "." + part; }
};

/// Something to be written: any of a case file, the line of the journal that tells of it, and an answer.
struct StoreJob {
  std::string file;  ///< bytes of the case file of `entry`, whose size and time are filled in
  std::optional<JournalEntry> entry;
  std::string answer;        ///< a whole line
  std::string answer_entry;  ///< the journal's line about it

  std::size_t bytes() const { return file.size() + answer.size() + answer_entry.size(); }
};

/// What the writer tells, from its own thread.
struct WriterCallbacks {
  std::function<void(const JournalEntry&)> stored;   ///< file and journal line are on disk
  std::function<void(const JournalEntry&)> dropped;  ///< it will not be written, since something failed
  std::function<void(const Error&)> failed;          ///< once
};

/// Any thread may call any member.
class StoreWriter {
 public:
  StoreWriter(StoreNames names, WriterCallbacks callbacks);
  /// Writes all that was taken, then ends.
  ~StoreWriter();
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  /// Waits while too much is waiting already. After a failure it drops the job.
  void put(StoreJob job);
  /// Drops all that waits, and all that comes.
  void fail(const Error& error);
  /// Waits until all that was taken before is on disk or dropped.
  MaybeError flush();
  bool failed() const;

  /// Held while a case file gets its name.
  std::mutex& naming() { return naming_; }

 private:
  struct Outcome {
    std::size_t durable = 0;  ///< of how many jobs, from the first, all is on disk
    MaybeError error;
  };

  void run();
  std::vector<StoreJob> take_batch();
  Outcome write_batch(std::vector<StoreJob>& batch);
  Outcome write_cases(std::vector<StoreJob>& batch);
  MaybeError write_case(StoreJob& job);
  MaybeError append_lines(const std::vector<StoreJob>& batch, std::size_t count);
  void settle(const std::vector<StoreJob>& batch, const Outcome& outcome);

  const StoreNames names_;
  const WriterCallbacks callbacks_;
  AppendedFile journal_, answers_;
  std::mutex naming_;

  mutable std::mutex mutex_;
  std::condition_variable work_, progress_;
  std::deque<StoreJob> waiting_;
  std::size_t bytes_ = 0;                  ///< of what was taken and not yet settled
  std::uint64_t taken_ = 0, settled_ = 0;  ///< jobs
  MaybeError error_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace launchsafe::store
