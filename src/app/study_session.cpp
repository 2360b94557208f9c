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

/// Whether the report in the folder says what a new one would. A study's results follow from its input, but
/// for what failed.
bool report_stands(const path& folder, const StudyRecord& record, const store::Manifest& manifest,
                   const std::string& failures) {
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

/// The line of progress; `width`: columns that it may take.
std::string progress_line(const study::Progress& progress, std::time_t now, std::size_t width) {
  if (progress.phase == study::Phase::report || (progress.total > 0 && progress.done == progress.total))
    return fmt::format("{} of {} cases done, judging and writing", progress.cases_done, progress.cases);
  if (progress.total == 0) return "planning the cases";
  const std::string failed =
      progress.cases_failed > 0 ? fmt::format(", {} failed", progress.cases_failed) : "";
  const std::string begin =
      progress.phase == study::Phase::launches ? "" : study::to_string(progress.phase) + ": ";
  // "0.3 %", "42 %"; 99 % at most: a study that works has not done all.
  const double percent = std::clamp(100.0 * progress.fraction, 0.0, 99.0);
  const std::string counts = fmt::format("{}{:.{}f} %, {} of {} cases done{}", begin, percent,
                                         percent < 9.95 ? 1 : 0, progress.cases_done, progress.cases, failed);
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
    thread_ = std::jthread([this](const std::stop_token& ended) { show_until(ended); });
  }
  ~StudyWatch() { end_line(); }

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
    thread_ = {};  // which ends it and waits
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
  void show_until(const std::stop_token& ended) {
    std::mutex idle;
    std::unique_lock lock(idle);
    std::condition_variable_any wakened;
    while (true) {
      wakened.wait_for(lock, ended, between_looks, [] { return false; });
      if (ended.stop_requested()) return;
      if (until_ && std::time(nullptr) >= *until_) stop_requested() = true;
      // What watches the study must not end it.
      try {
        show();
      } catch (const std::exception&) {
      }
    }
  }

  void show() {
    std::unique_lock lock(mutex_);
    study::Progress now = progress_;
    const double since = std::chrono::duration<double>(Clock::now() - told_).count();
    lock.unlock();
    if (now.seconds_left >= 0) now.seconds_left = std::max(0.0, now.seconds_left - since);
    if (now.total > 0 && now.done == now.total) now.phase = study::Phase::report;
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
    std::vector<std::string> linked{"report.html", "report.md", "ask.html"};
    std::error_code failed;
    std::erase_if(linked, [&](const std::string& name) {
      return !std::filesystem::exists(store_.folder() / name, failed);
    });
    store_.write_page(report::status_page(facts, linked));
  }

  store::CaseStore& store_;
  std::string command_;
  std::optional<std::time_t> until_;
  std::mutex mutex_;  ///< of what follows
  study::Progress progress_;
  Clock::time_point told_;
  std::optional<Clock::time_point> page_written_;
  std::optional<Progress> line_;
  std::jthread thread_;
};

StudySession::StudySession(const StudyArguments& asked, const study::StudyFile& file, int jobs,
                           Console& console)
    : asked_(asked), file_(file), console_(console), record_{.manifest = study_manifest(file, jobs)} {
  // Never an absolute path: it would name this machine.
  record_.study = asked.study.is_absolute() ? asked.study.filename() : asked.study;
  const auto obstacle_there = [&] {
    return obstacle_in_folder(asked.output, kinds::kind_of(file.study), record_.manifest, asked.update);
  };
  auto obstacle = obstacle_there();
  if (!obstacle) obstacle = prepare_output_folder(asked.output);
  if (obstacle) throw Ended{console.refuse(*obstacle)};
  const auto stop = [](const store::Error&) { stop_requested() = true; };
  auto opened = store::CaseStore::open(asked.output, asked.shard.part(), stop);
  if (!opened) throw Ended{console.end_with(opened.error())};
  store_ = std::move(*opened);
  print_remarks();
  // Until the store was ours somebody else may have been at work here.
  if (const auto late = obstacle_there()) throw Ended{console.refuse(*late)};
  if (asked.shard.whole()) remove_leftovers(asked.output);
  const auto moved = take_folder(asked.output, record_);
  if (!moved) throw Ended{console.end_with(moved.error())};
  if (!moved->empty()) console.remark(fmt::format("the earlier report moved to {}", moved->string()));
}

StudySession::~StudySession() = default;

bool StudySession::kept() {
  const auto error = store_->flush();
  print_remarks();
  if (!error) return true;
  console_.error(
      fmt::format("{}; the study ended, what was stored before is kept; once there is room, go on with: {}",
                  error->message, asked_.command));
  return false;
}

void StudySession::print_remarks() {
  const std::vector<std::string> remarks = store_->remarks();
  for (; remarks_printed_ < remarks.size(); ++remarks_printed_) console_.remark(remarks[remarks_printed_]);
}

ExitCode StudySession::report_interruption() {
  const auto stored = std::ranges::count(store_->records(), store::CaseState::done, &store::RunRecord::state);
  const bool was_planned = asked_.until && std::time(nullptr) >= *asked_.until;
  console_.error(fmt::format("{}; {} kept in {}; to go on: {}",
                             was_planned ? "stopped at the time that --until says" : "interrupted",
                             stored == 1 ? "1 run is" : fmt::format("{} runs are", stored),
                             asked_.output.string(), asked_.command));
  return ExitCode::interrupted;
}

kinds::StudyOutcome StudySession::run(study::StudyOptions options) {
  watch_ = std::make_unique<StudyWatch>(*store_, asked_.command, console_.quiet(), asked_.until);
  options.store = store_.get();
  options.progress = watch_->callback();
  kinds::StudyOutcome result = kinds::run_study(file_, options);
  watch_->end_line();
  return result;
}

ExitCode StudySession::conclude(const kinds::StudyOutcome& result) {
  if (!kept()) return end(ExitCode::failed);
  return end(result.interrupted     ? report_interruption()
             : asked_.shard.whole() ? deliver_whole(result)
                                    : deliver_shard(result));
}

ExitCode StudySession::end(ExitCode code) {
  watch_->tell_end(static_cast<int>(code));
  return code;
}

ExitCode StudySession::deliver_shard(const kinds::StudyOutcome& result) {
  const study::Shard& shard = asked_.shard;
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
      shell_command({"launchsafe", "merge", asked_.study.string(), "-o", asked_.output.string()})));
  return failures.empty() ? ExitCode::done : ExitCode::cases_failed;
}

ExitCode StudySession::deliver_whole(const kinds::StudyOutcome& result) {
  console_.print_text(report::to_text(result.report, asked_.output, width_of_output()));
  if (console_.json()) console_.print_json(Json::parse(result.report.json));
  console_.failures(result.failures);
  console_.remark(report::timing_text(result.timing));
  if (const ExitCode written = write_files(result); written != ExitCode::done) return written;
  if (!result.failures.empty()) return ExitCode::cases_failed;
  return result.indeterminate ? ExitCode::indeterminate : ExitCode::done;
}

ExitCode StudySession::write_files(const kinds::StudyOutcome& result) {
  std::string failures;
  for (const auto& [label, reason, outcome] : result.failures) failures += label + "\n" + reason + "\n";
  const std::string digest = store::sha256(failures);
  const auto present = store::read_study_record(asked_.output);
  if (result.timing.runs == 0 && present &&
      report_stands(asked_.output, *present, record_.manifest, digest)) {
    console_.remark(fmt::format("the report in {} stands as it is", asked_.output.string()));
    return ExitCode::done;
  }
  store_->replace_tables(report::plain_tables(result.report));
  if (!kept()) return ExitCode::failed;
  const report::RenderedReport rendered = report::render_report(result.report, {.stop = &stop_requested()});
  for (const std::string& remark : rendered.remarks) console_.remark(remark);
  StudyRecord written = record_;
  written.failures = digest;
  written.manifest.wall_time = result.timing.wall_time;
  // A report that lacks a picture is no finished one: the next time it is written again.
  written.complete = rendered.pictures_missing == 0;
  const auto remarks = store::write_report_files(asked_.output, written, rendered.files);
  if (!remarks) return console_.end_with(remarks.error());
  for (const std::string& remark : *remarks) console_.remark(remark);
  console_.remark(fmt::format("wrote {} files to {}", rendered.files.size() + 1, asked_.output.string()));
  if (written.complete || !stop_requested()) return ExitCode::done;
  console_.error(fmt::format(
      "interrupted while a picture was drawn; all results are kept; for the picture: {}", asked_.command));
  return ExitCode::interrupted;
}

}  // namespace launchsafe::app
