#include "study_session.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_status.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/store/sha256.hpp"
#include "output_folder.hpp"

#include <unistd.h>

#include <condition_variable>
#include <thread>

namespace launchsafe::app {
namespace {

std::string digest_of(const std::vector<kinds::Failure>& failures) {
  std::string text;
  for (const kinds::Failure& failure : failures) text += failure.label + "\n" + failure.reason + "\n";
  return store::sha256(text);
}

/// Whether the report in the folder says what a new one would. A study's results follow from its input, but
/// for what failed.
bool report_stands(const std::filesystem::path& folder, const StudyRecord& record,
                   const store::Manifest& manifest, const std::string& failures) {
  return !record.files.empty() && record.complete && same_study(record.manifest, manifest) &&
         record.manifest.program_version == manifest.program_version &&
         record.manifest.commit == manifest.commit && record.failures == failures &&
         store::read_as_written(folder, record.files);
}

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

/// The names of reports in a study's folder that its page links.
std::vector<std::string> reports_in(const std::filesystem::path& folder) {
  std::vector<std::string> names{"report.html", "report.md", "ask.html"};
  std::error_code failed;
  std::erase_if(names,
                [&](const std::string& name) { return !std::filesystem::exists(folder / name, failed); });
  return names;
}

/// The line of progress; `width`: columns that it may take.
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

}  // namespace

/// From before the runs to the end of the study. A thread of its own shows what was told last, also while
/// runs tell nothing.
class StudyWatch {
 public:
  /// `command` goes on after an interruption. At the time `until` the study is asked to stop, as by a signal.
  StudyWatch(store::CaseStore& store, std::string command, bool quiet, std::optional<std::time_t> until)
      : store_(store), command_(std::move(command)), until_(until), told_(Clock::now()), line_(quiet) {
    thread_ = std::thread([this] { show_until_ended(); });
  }
  ~StudyWatch() { end_line(); }
  StudyWatch(const StudyWatch&) = delete;
  StudyWatch& operator=(const StudyWatch&) = delete;

  /// For the runs: remembers how far they are.
  study::ProgressCallback callback() {
    return [this](const study::Progress& progress) {
      const std::lock_guard lock(mutex_);
      progress_ = progress;
      told_ = Clock::now();
    };
  }

  /// Removes the line; nothing is shown any more but the end.
  void end_line() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
    line_.reset();
  }

  /// Tells the folder how the study ended.
  void tell_end(int exit_code) {
    end_line();
    Json told = members(progress_);
    told["runs_running"] = 0;
    told["time_left_s"] = nullptr;
    told["exit_code"] = exit_code;
    store_.tell_progress(std::move(told), true);
    write_page();
  }

 private:
  void show_until_ended() {
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

  study::Progress progress_now() {
    const std::lock_guard lock(mutex_);
    study::Progress now = progress_;
    const double since = std::chrono::duration<double>(Clock::now() - told_).count();
    if (now.seconds_left >= 0) now.seconds_left = std::max(0.0, now.seconds_left - since);
    if (now.total > 0 && now.done == now.total) now.phase = study::Phase::report;
    return now;
  }

  void show() {
    const study::Progress now = progress_now();
    line_->show(progress_line(now, std::time(nullptr), terminal_width(STDERR_FILENO).value_or(80) - 1));
    store_.tell_progress(members(now));
    if (page_written_ && Clock::now() - *page_written_ < between_pages) return;
    page_written_ = Clock::now();
    write_page();
  }

  Json members(const study::Progress& progress) const {
    Json members = report::progress_row(progress);
    members["command"] = command_;
    return members;
  }

  void write_page() {
    const auto snapshots = store::statuses_in(store_.folder());
    if (snapshots.empty()) return;
    const std::time_t now = std::time(nullptr);
    const auto facts = report::status_facts(store_.folder().filename().string(), snapshots, now);
    store_.write_page(report::status_page(facts, reports_in(store_.folder())));
  }

  store::CaseStore& store_;
  std::string command_;
  std::optional<std::time_t> until_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  bool ended_ = false;
  study::Progress progress_;
  Clock::time_point told_;
  std::optional<Clock::time_point> page_written_;
  std::optional<Progress> line_;
  std::thread thread_;
};

StudySession::StudySession(SessionRequest request, Console& console)
    : request_(std::move(request)), console_(console) {}

StudySession::~StudySession() = default;

void StudySession::open() {
  auto obstacle = obstacle_in_folder(request_.folder, request_.kind, request_.manifest, request_.update);
  if (!obstacle) obstacle = prepare_output_folder(request_.folder);
  if (obstacle) throw Ended{console_.refuse(*obstacle)};
  const auto stop = [](const store::Error&) { stop_requested() = true; };
  auto opened = store::CaseStore::open(request_.folder, request_.part, stop);
  if (!opened) throw Ended{console_.end_with(opened.error())};
  store_ = std::move(*opened);
  print_remarks();
  // Until the store was ours somebody else may have been at work here.
  if (const auto late =
          obstacle_in_folder(request_.folder, request_.kind, request_.manifest, request_.update))
    throw Ended{console_.refuse(*late)};
  if (request_.part.empty()) remove_leftovers(request_.folder);
  const auto moved = take_folder(request_.folder, record());
  if (!moved) throw Ended{console_.end_with(moved.error())};
  if (!moved->empty()) console_.remark(fmt::format("the earlier report moved to {}", moved->string()));
}

bool StudySession::kept() {
  const auto error = store_->flush();
  print_remarks();
  if (!error) return true;
  console_.error(
      fmt::format("{}; the study ended, what was stored before is kept; once there is room, go on with: {}",
                  error->message, request_.command));
  return false;
}

void StudySession::print_remarks() {
  const std::vector<std::string> remarks = store_->remarks();
  for (; remarks_printed_ < remarks.size(); ++remarks_printed_) console_.remark(remarks[remarks_printed_]);
}

ExitCode StudySession::report_interruption() {
  if (!kept()) return ExitCode::failed;
  const auto stored = std::ranges::count(store_->records(), store::CaseState::done, &store::RunRecord::state);
  const bool was_planned = request_.until && std::time(nullptr) >= *request_.until;
  console_.error(fmt::format("{}; {} kept in {}; to go on: {}",
                             was_planned ? "stopped at the time that --until says" : "interrupted",
                             stored == 1 ? "1 run is" : fmt::format("{} runs are", stored),
                             request_.folder.string(), request_.command));
  return ExitCode::interrupted;
}

kinds::StudyOutcome StudySession::run(const study::StudyFile& file, study::StudyOptions options) {
  watch_ = std::make_unique<StudyWatch>(*store_, request_.command, console_.quiet(), request_.until);
  options.store = store_.get();
  options.progress = watch_->callback();
  kinds::StudyOutcome result = kinds::run_study(file, options);
  watch_->end_line();
  return result;
}

ExitCode StudySession::conclude(const kinds::StudyOutcome& result, const study::Shard& shard) {
  return end(deliver(result, shard));
}

ExitCode StudySession::end(ExitCode code) {
  watch_->tell_end(static_cast<int>(code));
  return code;
}

ExitCode StudySession::deliver(const kinds::StudyOutcome& result, const study::Shard& shard) {
  if (result.interrupted) return report_interruption();
  if (!kept()) return ExitCode::failed;
  return shard.whole() ? deliver_whole(result) : deliver_shard(result, shard);
}

ExitCode StudySession::deliver_shard(const kinds::StudyOutcome& result, const study::Shard& shard) {
  const std::vector<kinds::Failure>& failures = result.failures;
  console_.print_json({{"shard", shard.index},
                       {"shards", shard.count},
                       {"mechanical_runs", result.timing.runs},
                       {"reused", result.timing.reused},
                       {"wall_time_s", result.timing.wall_time},
                       {"failed", failures.size()}});
  console_.failures(failures);
  console_.remark(report::timing_text(result.timing));
  console_.remark(fmt::format(
      "shard {}/{} is done{}; once all are: {} (then the folders of shards that have one of their own)",
      shard.index, shard.count, failures.empty() ? "" : fmt::format(", {} failed", failures.size()),
      shell_command({"launchsafe", "merge", request_.study.string(), "-o", request_.folder.string()})));
  return failures.empty() ? ExitCode::done : ExitCode::cases_failed;
}

ExitCode StudySession::deliver_whole(const kinds::StudyOutcome& result) {
  console_.print_text(report::to_text(result.report, request_.folder, width_of_output()));
  if (console_.json()) console_.print_json(Json::parse(result.report.json));
  console_.failures(result.failures);
  console_.remark(report::timing_text(result.timing));
  if (const ExitCode written = write_files(result); written != ExitCode::done) return written;
  if (!result.failures.empty()) return ExitCode::cases_failed;
  return result.indeterminate ? ExitCode::indeterminate : ExitCode::done;
}

StudyRecord StudySession::record() const {
  // Never an absolute path: it would name this machine.
  const std::filesystem::path& study = request_.study;
  return {.manifest = request_.manifest, .study = study.is_absolute() ? study.filename() : study};
}

ExitCode StudySession::write_files(const kinds::StudyOutcome& result) {
  const std::string digest = digest_of(result.failures);
  const auto present = store::read_study_record(request_.folder);
  if (result.timing.runs == 0 && present &&
      report_stands(request_.folder, *present, request_.manifest, digest)) {
    console_.remark(fmt::format("the report in {} stands as it is", request_.folder.string()));
    return ExitCode::done;
  }
  store_->replace_tables(report::plain_tables(result.report));
  if (!kept()) return ExitCode::failed;
  const report::RenderedReport rendered = report::render_report(result.report, {.stop = &stop_requested()});
  for (const std::string& remark : rendered.remarks) console_.remark(remark);
  StudyRecord written = record();
  written.failures = digest;
  written.manifest.wall_time = result.timing.wall_time;
  // A report that lacks a picture is no finished one: the next time it is written again.
  written.complete = rendered.pictures_missing == 0;
  const auto remarks = store::write_report_files(request_.folder, written, rendered.files);
  if (!remarks) return console_.end_with(remarks.error());
  for (const std::string& remark : *remarks) console_.remark(remark);
  console_.remark(fmt::format("wrote {} files to {}", rendered.files.size() + 1, request_.folder.string()));
  if (written.complete || !stop_requested()) return ExitCode::done;
  console_.error(fmt::format(
      "interrupted while a picture was drawn; all results are kept; for the picture: {}", request_.command));
  return ExitCode::interrupted;
}

}  // namespace launchsafe::app
