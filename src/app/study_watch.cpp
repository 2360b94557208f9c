#include "study_watch.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_status.hpp"
#include "signals.hpp"
#include "terminal_width.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace launchsafe::app {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto between_looks = 200ms;
constexpr auto between_pages = 10s;

std::string bar(double fraction) {
  constexpr std::size_t length = 12;
  const auto full = static_cast<std::size_t>(fraction * static_cast<double>(length));
  return fmt::format("[{}{}] ", std::string(full, '#'), std::string(length - full, '-'));
}

/// "0.3 %", "42 %"; 99 % at most: a study that works has not done all.
std::string share_text(double fraction) {
  const double percent = std::clamp(100.0 * fraction, 0.0, 99.0);
  return fmt::format("{:.{}f} %", percent, percent < 9.95 ? 1 : 0);
}

/// "3.2 cases/min" with a unit in which it is a number of some size.
std::string rate_text(double per_second) {
  if (!(per_second > 0)) return {};
  if (per_second >= 1) return fmt::format(", {:.3g} cases/s", per_second);
  if (per_second >= 1.0 / 60) return fmt::format(", {:.2g} cases/min", 60 * per_second);
  return fmt::format(", {:.2g} cases/h", 3600 * per_second);
}

std::string left_text(const study::Progress& progress, std::time_t now) {
  if (progress.seconds_left < 0) return {};
  if (progress.seconds_left < 1) return ", nearly done";
  return fmt::format(", {} left, until about {}", report::duration(progress.seconds_left),
                     report::clock_time(now + static_cast<std::time_t>(progress.seconds_left), now));
}

}  // namespace

std::vector<std::string> reports_in(const std::filesystem::path& folder) {
  std::vector<std::string> names{"report.html", "report.md", "ask.html"};
  std::error_code failed;
  std::erase_if(names,
                [&](const std::string& name) { return !std::filesystem::exists(folder / name, failed); });
  return names;
}

std::string progress_line(const study::Progress& progress, std::time_t now, std::size_t width) {
  if (progress.phase == study::Phase::report || (progress.total > 0 && progress.done == progress.total))
    return fmt::format("{} of {} cases done, judging and writing", progress.cases_done, progress.cases);
  if (progress.total == 0) return "planning the cases";
  const std::string failed =
      progress.cases_failed > 0 ? fmt::format(", {} failed", progress.cases_failed) : "";
  const std::string begin =
      progress.phase == study::Phase::launches ? "" : study::to_string(progress.phase) + ": ";
  const std::string counts = fmt::format("{}{}, {} of {} cases done{}", begin, share_text(progress.fraction),
                                         progress.cases_done, progress.cases, failed);
  const std::string left = left_text(progress, now);
  // What matters least goes first where the terminal is narrow.
  const std::string rate = rate_text(progress.cases_per_second);
  for (const std::string& line :
       {bar(progress.fraction) + counts + rate + left, bar(progress.fraction) + counts + left})
    if (line.size() <= width) return line;
  return counts + left;
}

StudyWatch::StudyWatch(store::CaseStore& store, std::string command, ProgressStyle style,
                       std::optional<std::time_t> until)
    : store_(store), command_(std::move(command)), until_(until), told_(Clock::now()), line_(style) {
  thread_ = std::thread([this] { show_until_ended(); });
}

study::ProgressCallback StudyWatch::callback() {
  return [this](const study::Progress& progress) {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    told_ = Clock::now();
  };
}

void StudyWatch::end_line() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
  line_.reset();
}

void StudyWatch::tell_end(int exit_code) {
  end_line();
  nlohmann::ordered_json told = members(progress_);
  told["runs_running"] = 0;
  told["time_left_s"] = nullptr;
  told["exit_code"] = exit_code;
  store_.tell_progress(std::move(told), true);
  write_page();
}

void StudyWatch::show_until_ended() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, between_looks, [this] { return ended_; })) {
    lock.unlock();
    if (until_ && std::time(nullptr) >= *until_) stop_requested() = true;
    // What watches the study must not end it.
    try {
      show();
    } catch (const std::exception&) {
    }
    lock.lock();
  }
}

study::Progress StudyWatch::progress_now() {
  const std::lock_guard lock(mutex_);
  study::Progress now = progress_;
  const double since = std::chrono::duration<double>(Clock::now() - told_).count();
  if (now.seconds_left >= 0) now.seconds_left = std::max(0.0, now.seconds_left - since);
  if (now.total > 0 && now.done == now.total) now.phase = study::Phase::report;
  return now;
}

void StudyWatch::show() {
  const study::Progress now = progress_now();
  line_->show(progress_line(now, std::time(nullptr), terminal_width(STDERR_FILENO).value_or(80) - 1));
  store_.tell_progress(members(now));
  if (page_written_ && Clock::now() - *page_written_ < between_pages) return;
  page_written_ = Clock::now();
  write_page();
}

nlohmann::ordered_json StudyWatch::members(const study::Progress& progress) const {
  nlohmann::ordered_json members = report::progress_row(progress);
  members["command"] = command_;
  return members;
}

void StudyWatch::write_page() {
  const auto snapshots = store::statuses_in(store_.folder());
  if (snapshots.empty()) return;
  const std::time_t now = std::time(nullptr);
  const auto facts = report::status_facts(store_.folder().filename().string(), snapshots, now);
  store_.write_page(report::status_page(facts, reports_in(store_.folder())));
}

}  // namespace launchsafe::app
