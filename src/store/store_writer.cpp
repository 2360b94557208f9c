#include "store_writer.hpp"

#include "case_store_content.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>

namespace launchsafe::store {
namespace {

constexpr std::size_t most_bytes = 32 << 20;
constexpr std::size_t most_jobs = 512;
/// What is synced together. Small enough that whoever waits for room does not wait for long.
constexpr std::size_t batch_bytes = 16 << 20;

}  // namespace

StoreWriter::StoreWriter(StoreNames names, WriterCallbacks callbacks)
    : names_(std::move(names)),
      callbacks_(std::move(callbacks)),
      journal_(names_.journal()),
      answers_(names_.answers()),
      thread_([this] { run(); }) {}

StoreWriter::~StoreWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  work_.notify_one();
  thread_.join();
}

void StoreWriter::put(StoreJob job) {
  std::unique_lock lock(mutex_);
  progress_.wait(lock, [this] { return error_ || (bytes_ < most_bytes && waiting_.size() < most_jobs); });
  if (error_) {
    lock.unlock();
    if (job.entry) callbacks_.dropped(*job.entry);
    return;
  }
  bytes_ += job.bytes();
  ++taken_;
  waiting_.push_back(std::move(job));
  lock.unlock();
  work_.notify_one();
}

void StoreWriter::fail(const Error& error) {
  std::deque<StoreJob> dropped;
  {
    const std::lock_guard lock(mutex_);
    if (error_) return;
    error_ = error;
    dropped.swap(waiting_);
    settled_ += dropped.size();
    for (const StoreJob& job : dropped) bytes_ -= job.bytes();
  }
  for (const StoreJob& job : dropped) {
    if (job.entry) callbacks_.dropped(*job.entry);
  }
  callbacks_.failed(error);
  progress_.notify_all();
}

MaybeError StoreWriter::flush() {
  std::unique_lock lock(mutex_);
  progress_.wait(lock, [this, target = taken_] { return error_ || settled_ >= target; });
  return error_;
}

bool StoreWriter::failed() const {
  const std::lock_guard lock(mutex_);
  return error_.has_value();
}

void StoreWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    std::vector<StoreJob> batch = take_batch();
    lock.unlock();
    settle(batch, write_batch(batch));
    lock.lock();
  }
}

std::vector<StoreJob> StoreWriter::take_batch() {
  std::vector<StoreJob> batch;
  for (std::size_t bytes = 0; !waiting_.empty() && bytes < batch_bytes; waiting_.pop_front()) {
    bytes += waiting_.front().bytes();
    batch.push_back(std::move(waiting_.front()));
  }
  return batch;
}

StoreWriter::Outcome StoreWriter::write_batch(std::vector<StoreJob>& batch) {
  Outcome outcome = write_cases(batch);
  // What was written before a failure is journaled all the same, if that is still possible.
  if (const MaybeError error = append_lines(batch, outcome.durable)) {
    outcome.durable = 0;
    if (!outcome.error) outcome.error = error;
  }
  return outcome;
}

StoreWriter::Outcome StoreWriter::write_cases(std::vector<StoreJob>& batch) {
  Outcome outcome;
  bool any_file = false;
  for (StoreJob& job : batch) {
    if (!job.file.empty()) {
      outcome.error = write_case(job);
      if (outcome.error) break;
      any_file = true;
    }
    ++outcome.durable;
  }
  if (any_file && !sync_folder(names_.cases()))
    return {0, outcome.error ? outcome.error : write_error(names_.cases(), errno)};
  return outcome;
}

MaybeError StoreWriter::write_case(StoreJob& job) {
  const std::filesystem::path target = names_.case_file(job.entry->hash);
  const std::filesystem::path temporary =
      names_.cases() / temporary_name(job.entry->hash + "." + names_.mark());
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.is_open()) return write_error(target, errno);
  struct stat status {};
  bool written = write_all(file.number(), job.file) && ::fsync(file.number()) == 0 &&
                 ::fstat(file.number(), &status) == 0 && file.close();
  if (written) {
    const std::lock_guard lock(naming_);
    written = rename_to_free_name(temporary, target);
  }
  if (!written) {
    const int error_number = errno;
    ::unlink(temporary.c_str());
    // Where nothing keeps a second process out, it may have stored the same result.
    const bool there_already = error_number == EEXIST && read_checked(target, job.entry->hash) &&
                               ::stat(target.c_str(), &status) == 0;
    if (!there_already) return write_error(target, error_number);
  }
  job.entry->file_size = size_of(status);
  job.entry->file_time = time_of(status);
  return {};
}

MaybeError StoreWriter::append_lines(const std::vector<StoreJob>& batch, std::size_t count) {
  std::string entries, answers;
  for (std::size_t i = 0; i < count; ++i) {
    if (batch[i].entry) entries += journal_line(*batch[i].entry);
    // The journal first: an answer that it does not know would be drawn again.
    entries += batch[i].answer_entry;
    answers += batch[i].answer;
  }
  if (!entries.empty()) {
    if (MaybeError error = journal_.append(entries)) return error;
  }
  return answers.empty() ? MaybeError() : answers_.append(answers);
}

void StoreWriter::settle(const std::vector<StoreJob>& batch, const Outcome& outcome) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    bytes += batch[i].bytes();
    if (batch[i].entry) (i < outcome.durable ? callbacks_.stored : callbacks_.dropped)(*batch[i].entry);
  }
  // Before the jobs count as settled: whoever waits for them has to see the error.
  if (outcome.error) fail(*outcome.error);
  {
    const std::lock_guard lock(mutex_);
    settled_ += batch.size();
    bytes_ -= bytes;
  }
  progress_.notify_all();
}

}  // namespace launchsafe::store
