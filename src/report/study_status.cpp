#include "launchsafe/report/study_text.hpp"

#include <fmt/chrono.h>

namespace launchsafe::report {
namespace {

constexpr int interrupted_code = 75, failed_code = 70;

enum class State : std::size_t { finished, waiting, interrupted, failed, running };

const char* word_for(State state) {
  return std::array{"finished", "waiting", "interrupted", "failed", "running"}.at(std::size_t(state));
}

/// Seconds since the epoch of "2026-03-01T09:30:00Z"; 0 for any other text.
std::time_t time_in(const std::string& text) {
  std::tm parts{};
  const char* end = ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return end != nullptr && *end == '\0' ? ::timegm(&parts) : 0;
}

/// A number of a snapshot, 0 where there is none.
double amount_in(const Row& row, const std::string& key) { return known(number_of(row, key)).value_or(0.0); }

struct Writer {
  Row row;  ///< of its snapshot, and what follows from it
  State state = State::running;
  int exit_code = 0;
  std::time_t since = 0, time = 0;
  std::optional<double> left = {};  ///< s from now on, of one that runs
};

Writer writer_of(const store::StoreStatus& snapshot, std::time_t now) {
  const Row& members = snapshot.members;
  Writer writer{
      .row = members, .since = time_in(text_of(members, "since")), .time = time_in(text_of(members, "time"))};
  const double code = number_of(members, "exit_code");
  const auto silence = static_cast<double>(now - writer.time);
  if (std::isfinite(code)) {
    writer.exit_code = static_cast<int>(std::clamp(code, 0.0, 255.0));
    writer.state = writer.exit_code == interrupted_code ? State::interrupted
                   : writer.exit_code < failed_code     ? State::finished
                                                        : State::failed;
  } else if (found_in(members, "ended") == true) {
    writer.exit_code = failed_code;
    writer.state = State::failed;
  } else if (!snapshot.alive) {  // it was killed
    writer.exit_code = interrupted_code;
    writer.state = State::interrupted;
  } else if (const double left = number_of(members, "time_left_s"); left >= 0) {
    writer.left = std::max(0.0, left - silence);
  }
  const std::string& part = snapshot.part;
  const std::size_t of = part.find("-of-");
  writer.row.update(
      {{"shard", of == std::string::npos ? "whole" : part.substr(0, of) + "/" + part.substr(of + 4)},
       {"state", word_for(writer.state)},
       {"left", writer.left ? duration(*writer.left) : ""}});
  return writer;
}

/// Shards that nobody has seen at work, by the number that the others tell.
std::size_t shards_not_seen(const std::vector<store::StoreStatus>& snapshots) {
  std::set<std::string> seen;
  std::size_t count = 0;
  for (const store::StoreStatus& each : snapshots) {
    const std::size_t of = each.part.find("-of-");
    if (of == std::string::npos) return 0;
    seen.insert(each.part);
    count = std::max<std::size_t>(count, std::strtoul(each.part.c_str() + of + 4, nullptr, 10));
  }
  return count - std::min(count, seen.size());
}

/// When all that runs will have ended; nothing where somebody cannot tell, or has not begun.
void add_estimate(Row& facts, const std::vector<Writer>& writers, std::size_t not_seen, std::time_t now) {
  double left = 0;
  for (const Writer& each : writers) {
    if (each.state != State::running) continue;
    if (!each.left || not_seen > 0) return;
    left = std::max(left, *each.left);
  }
  facts["time_left_s"] = left;
  facts["left"] = left < 1.0 ? "a moment" : "about " + duration(left);
  facts["end"] = clock_time(now + static_cast<std::time_t>(std::llround(left)), now);
}

std::string left_text(const study::Progress& progress, std::time_t now) {
  if (progress.seconds_left < 0) return {};
  if (progress.seconds_left < 1) return ", nearly done";
  return fmt::format(", {} left, until about {}", duration(progress.seconds_left),
                     clock_time(now + static_cast<std::time_t>(progress.seconds_left), now));
}

}  // namespace

std::string progress_line(const study::Progress& progress, std::time_t now) {
  if (progress.phase == study::Phase::report || (progress.total > 0 && progress.done == progress.total))
    return fmt::format("{} of {} cases done, judging and writing", progress.cases_done, progress.cases);
  if (progress.total == 0) return "planning the cases";
  const std::string failed =
      progress.cases_failed > 0 ? fmt::format(", {} failed", progress.cases_failed) : "";
  const std::string begin =
      progress.phase == study::Phase::launches ? "" : study::to_string(progress.phase) + ": ";
  // "0.3 %", "42 %"; 99 % at most: a study that works has not done all.
  const double done_percent = std::clamp(100.0 * progress.fraction, 0.0, 99.0);
  return fmt::format("{}{:.{}f} %, {} of {} cases done{}{}", begin, done_percent, done_percent < 9.95 ? 1 : 0,
                     progress.cases_done, progress.cases, failed, left_text(progress, now));
}

Row progress_row(const study::Progress& progress) {
  return {{"phase", to_string(progress.phase)},
          {"runs_done", progress.done},
          {"runs_running", progress.running},
          {"runs_total", progress.total},
          {"cases", progress.cases},
          {"cases_done", progress.cases_done},
          {"cases_failed", progress.cases_failed},
          {"time_left_s", progress.seconds_left < 0 ? Row() : Row(progress.seconds_left)}};
}

std::string clock_time(std::time_t time, std::time_t now) {
  constexpr std::time_t week = 6 * 86400;
  const std::tm then = fmt::localtime(time), today = fmt::localtime(now);
  if (then.tm_yday == today.tm_yday && then.tm_year == today.tm_year) return fmt::format("{:%H:%M}", then);
  return time - now < week ? fmt::format("{:%a %H:%M}", then) : fmt::format("{:%Y-%m-%d %H:%M}", then);
}

std::optional<std::time_t> next_clock_time(const std::string& text, std::time_t now) {
  std::tm time = fmt::localtime(now);
  const char* end = ::strptime(text.c_str(), "%H:%M", &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  time.tm_sec = 0;
  for (const int days : {0, 1}) {
    std::tm then = time;
    then.tm_mday += days;
    then.tm_isdst = -1;
    if (const std::time_t found = std::mktime(&then); found > now) return found;
  }
  return std::nullopt;
}

Row status_facts(const std::string& folder, const std::vector<store::StoreStatus>& snapshots,
                 std::time_t now) {
  const std::size_t not_seen = shards_not_seen(snapshots);
  std::vector<Writer> writers;
  State state = not_seen > 0 ? State::waiting : State::finished;
  for (const store::StoreStatus& each : snapshots) {
    writers.push_back(writer_of(each, now));
    state = std::max(state, writers.back().state);
  }
  Row facts{
      {"folder", folder}, {"state", word_for(state)}, {"is", {{word_for(state), true}}}, {"exit_code", 0}};
  for (const char* key : {"cases", "cases_done", "cases_failed", "runs_running", "runs_stored"}) {
    double sum = 0;
    for (const Writer& each : writers) sum += amount_in(each.row, key);
    facts[key] = static_cast<std::int64_t>(sum);
  }
  facts["cases_left"] =
      std::max<std::int64_t>(0, facts["cases"].get<std::int64_t>() - facts["cases_done"].get<std::int64_t>());
  std::time_t begin = now, end = 0;
  for (const Writer& each : writers) {
    begin = std::min(begin, each.since);
    end = std::max(end, each.state == State::running ? now : each.time);
    facts["exit_code"] = std::max(facts["exit_code"].get<int>(), each.exit_code);
    facts["writers"].push_back(each.row);
    if (each.state == State::interrupted) facts["command"] = text_of(each.row, "command");
  }
  facts["phase"] = text_of(snapshots.front().members, "phase");
  facts["time"] = clock_time(end, now);
  facts["elapsed"] = duration(static_cast<double>(std::max<std::time_t>(0, end - begin)));
  if (not_seen > 0) facts["shards_not_seen"] = not_seen;
  if (writers.size() > 1 || not_seen > 0) facts["is"]["in_shards"] = true;
  if (facts["cases"] == 0) facts["is"]["planned"] = true;
  if (state == State::running) add_estimate(facts, writers, not_seen, now);
  return facts;
}

std::string status_text(const Row& facts) { return filled(status_text_template, {&facts}); }

}  // namespace launchsafe::report
