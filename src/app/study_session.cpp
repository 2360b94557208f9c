#include "study_session.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/store/sha256.hpp"
#include "output_folder.hpp"
#include "shell_words.hpp"
#include "signals.hpp"
#include "study_folder.hpp"
#include "terminal_width.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

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

ExitCode exit_code_of(const kinds::StudyOutcome& result) {
  if (!result.failures.empty()) return ExitCode::cases_failed;
  return result.indeterminate ? ExitCode::indeterminate : ExitCode::done;
}

nlohmann::ordered_json shard_json(const kinds::StudyOutcome& result, const study::Shard& shard) {
  return {{"shard", shard.index},
          {"shards", shard.count},
          {"mechanical_runs", result.timing.runs},
          {"reused", result.timing.reused},
          {"wall_time_s", result.timing.wall_time},
          {"failed", result.failures.size()}};
}

}  // namespace

StudySession::StudySession(SessionRequest request, Console& console)
    : request_(std::move(request)), console_(console) {}

ExitCode StudySession::open() {
  auto obstacle = obstacle_in_folder(request_.folder, request_.kind, request_.manifest, request_.update);
  if (!obstacle) obstacle = prepare_output_folder(request_.folder);
  if (obstacle) return console_.refuse(*obstacle);
  store::StoreOptions options;
  options.part = request_.part;
  options.model_version = request_.manifest.model_version;
  options.on_failure = [](const store::Error&) { stop_requested() = true; };
  auto opened = store::CaseStore::open(request_.folder, options);
  if (!opened) return console_.end_with(opened.error());
  store_ = std::move(*opened);
  print_remarks();
  // Until the store was ours somebody else may have been at work here.
  if (const auto late =
          obstacle_in_folder(request_.folder, request_.kind, request_.manifest, request_.update))
    return console_.refuse(*late);
  if (request_.part.empty()) remove_leftovers(request_.folder);
  const auto moved = take_folder(request_.folder, record());
  if (!moved) return console_.end_with(moved.error());
  if (!moved->empty()) console_.remark(fmt::format("the earlier report moved to {}", moved->string()));
  return ExitCode::done;
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
  watch_ = std::make_unique<StudyWatch>(*store_, request_.command, progress_style(console_.quiet()),
                                        request_.until);
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
  console_.print_json(shard_json(result, shard));
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
  if (console_.json()) console_.print_json(nlohmann::ordered_json::parse(result.report.json));
  console_.failures(result.failures);
  console_.remark(report::timing_text(result.timing));
  const ExitCode written = write_files(result);
  return written == ExitCode::done ? exit_code_of(result) : written;
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
