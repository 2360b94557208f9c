#include "launchsafe/report/study_text.hpp"

#include <fmt/chrono.h>

namespace launchsafe::report {
namespace {

constexpr int interrupted_code = 75, failed_code = 70;

/// Seconds since the epoch of "2026-03-01T09:30:00Z".
std::time_t time_in(const std::string& text) {
  std::tm parts{};
  ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return ::timegm(&parts);
}

/// "05:40", local time; with the day before it where that is another one than now's.
std::string clock_time(std::time_t time, std::time_t now) {
  const std::tm then = fmt::localtime(time), today = fmt::localtime(now);
  const bool is_today = then.tm_yday == today.tm_yday && then.tm_year == today.tm_year;
  return is_today ? fmt::format("{:%H:%M}", then) : fmt::format("{:%Y-%m-%d %H:%M}", then);
}

std::string left_text(double seconds, std::time_t now) {
  return fmt::format("{} left, until about {}", duration(seconds),
                     clock_time(now + static_cast<std::time_t>(seconds), now));
}

/// Of one folder. One that neither lives nor came to its end was killed.
Row facts_of(const std::string& folder, const store::StudyStatus& status, std::time_t now) {
  const int code = status.alive ? 0 : status.exit_code >= 0 ? status.exit_code : interrupted_code;
  const char* state = status.alive               ? "running"
                      : code == interrupted_code ? "interrupted"
                      : code == failed_code      ? "failed"
                                                 : "finished";
  const double left = std::max(0.0, status.time_left - static_cast<double>(now - time_in(status.time)));
  const bool is_known = status.alive && std::isfinite(status.time_left);
  return {{"folder", folder},
          {"shard", status.shard},
          {"state", state},
          {"cases", status.cases},
          {"cases_done", status.cases_done},
          {"cases_failed", status.cases_failed},
          {"time", status.time},
          {"time_left_s", is_known ? Row(left) : Row()},
          {"command", status.command},
          {"exit_code", code}};
}

}  // namespace

std::string progress_line(const study::Progress& progress, std::time_t now) {
  if (progress.phase == study::Phase::report || (progress.total > 0 && progress.done == progress.total))
    return fmt::format("{} of {} cases done, judging and writing", progress.cases_done, progress.cases);
  if (progress.total == 0) return "planning the cases";
  return fmt::format("{:.0f} %, {} of {} cases done, {} failed{}",
                     std::clamp(100.0 * progress.fraction, 0.0, 99.0), progress.cases_done, progress.cases,
                     progress.cases_failed,
                     progress.seconds_left < 0 ? "" : ", " + left_text(progress.seconds_left, now));
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

Row status_facts(const std::map<std::string, store::StudyStatus>& studies, std::time_t now) {
  Row facts{{"folders", Row::array()}, {"exit_code", 0}};
  for (const auto& [folder, status] : studies) {
    const Row own = facts_of(folder, status, now);
    facts["exit_code"] = std::max(facts["exit_code"].get<int>(), own["exit_code"].get<int>());
    facts["folders"].push_back(own);
  }
  return facts;
}

std::string status_text(const Row& facts, std::time_t now) {
  std::string text;
  for (const Row& each : facts["folders"]) {
    text +=
        fmt::format("{}: {}, {} of {} cases done, {} failed", text_of(each, "folder"), text_of(each, "state"),
                    number_of(each, "cases_done"), number_of(each, "cases"), number_of(each, "cases_failed"));
    if (!each["time_left_s"].is_null()) text += ", " + left_text(number_of(each, "time_left_s"), now);
    if (each["exit_code"] == interrupted_code) text += "; to go on: " + text_of(each, "command");
    text += "\n";
  }
  return text;
}

}  // namespace launchsafe::report
