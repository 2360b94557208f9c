#include "study_watch.hpp"

#include "launchsafe/report/study_text.hpp"

namespace launchsafe::app {

using namespace std::chrono_literals;

StudyWatch::StudyWatch(store::CaseStore& store, store::StudyStatus status, bool quiet,
                       std::optional<std::time_t> until)
    : store_(store), status_(std::move(status)), until_(until), line_(std::in_place, quiet) {
  store_.tell_status(status_, true);
  thread_ = std::jthread([this](const std::stop_token& ended) {
    std::mutex idle;
    std::unique_lock lock(idle);
    std::condition_variable_any wakened;
    while (!wakened.wait_for(lock, ended, 200ms, [&] { return ended.stop_requested(); })) show();
  });
}

StudyWatch::~StudyWatch() { end_line(); }

study::ProgressCallback StudyWatch::callback() {
  return [this](const study::Progress& progress) {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    told_ = std::chrono::steady_clock::now();
  };
}

void StudyWatch::show() {
  if (until_ && std::time(nullptr) >= *until_) stop_requested = true;
  std::unique_lock lock(mutex_);
  study::Progress now = progress_;
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - told_;
  lock.unlock();
  if (now.seconds_left >= 0) now.seconds_left = std::max(0.0, now.seconds_left - since.count());
  line_->show(report::progress_line(now, std::time(nullptr)));
  store_.tell_status(status_of(now), false);
}

store::StudyStatus StudyWatch::status_of(const study::Progress& progress) const {
  store::StudyStatus status = status_;
  status.cases = static_cast<std::int64_t>(progress.cases);
  status.cases_done = static_cast<std::int64_t>(progress.cases_done);
  status.cases_failed = static_cast<std::int64_t>(progress.cases_failed);
  status.time_left = progress.seconds_left < 0 ? math::not_a_number : progress.seconds_left;
  return status;
}

void StudyWatch::end_line() {
  thread_ = {};  // which ends it and waits
  line_.reset();
}

void StudyWatch::tell_end(ExitCode code) {
  end_line();
  store::StudyStatus status = status_of(progress_);
  status.exit_code = static_cast<int>(code);
  store_.tell_status(status, true);
}

}  // namespace launchsafe::app
