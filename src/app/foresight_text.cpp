#include "foresight_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

namespace launchsafe::app {
namespace {

using study::Foresight, study::ForeseenRun;

std::string state_of(const ForeseenRun& run) {
  return run.stored || run.given_up ? run.why : "to run: " + run.why;
}

report::Table run_table(const Foresight& foresight) {
  report::Table table;
  table.columns = {report::text_column("mechanical run"), {.name = "cases", .unit = ""},
                   {.name = "particles", .unit = ""},     {.name = "steps", .unit = ""},
                   {.name = "memory", .unit = "MB"},      {.name = "time", .unit = "s"},
                   {.name = "shard", .unit = ""},         report::text_column("state")};
  for (const ForeseenRun& run : foresight.runs) {
    table.rows.push_back({run.label, static_cast<std::int64_t>(run.cases), run.particles, run.steps,
                          run.memory / 1e6, run.time, static_cast<std::int64_t>(run.shard), state_of(run)});
  }
  return table;
}

std::string foresight_line(std::string_view label, const std::string& value) {
  return fmt::format("  {:<21} {}\n", label, value);
}

std::size_t cases_in(const Foresight& foresight) {
  std::size_t cases = 0;
  for (const ForeseenRun& run : foresight.runs) cases += run.cases;
  return cases;
}

std::size_t stored_in(const Foresight& foresight) {
  return static_cast<std::size_t>(
      std::count_if(foresight.runs.begin(), foresight.runs.end(),
                    [](const ForeseenRun& run) { return run.stored || (run.given_up && !run.refused); }));
}

std::size_t refused_in(const Foresight& foresight) {
  return static_cast<std::size_t>(std::count_if(foresight.runs.begin(), foresight.runs.end(),
                                                [](const ForeseenRun& run) { return run.refused; }));
}

std::size_t to_run_in(const Foresight& foresight) {
  return foresight.runs.size() - stored_in(foresight) - refused_in(foresight);
}

double updates_in(const Foresight& foresight) {
  double updates = 0;
  for (const ForeseenRun& run : foresight.runs) {
    if (!run.stored && !run.given_up)
      updates += static_cast<double>(run.particles) * static_cast<double>(run.steps);
  }
  return updates;
}

bool judges_gaps(study::StudyKind kind) { return kind != study::StudyKind::calibration; }

std::size_t gaps_of(const study::StudyFile& file) {
  return judges_gaps(file.study.kind) ? file.study.gaps.size() : 0;
}

std::string runs_text(const Foresight& foresight) {
  const std::size_t stored = stored_in(foresight), cases = cases_in(foresight);
  const std::size_t refused = refused_in(foresight);
  std::string text = fmt::format("{} for {} case{}", foresight.runs.size(), cases, cases == 1 ? "" : "s");
  if (refused > 0) text += fmt::format("; {} refused", refused);
  if (stored > 0 || refused > 0) text += fmt::format("; {} stored, {} to run", stored, to_run_in(foresight));
  return text;
}

std::string time_text(const Foresight& foresight, const std::filesystem::path& folder) {
  if (refused_in(foresight) > 0 && to_run_in(foresight) == 0) return "none: nothing is left that may run";
  if (stored_in(foresight) == foresight.runs.size()) return "next to none: every mechanical run is stored";
  const std::string origin = foresight.learned_from == 0
                                 ? "measured now"
                                 : fmt::format("learned from {} run{} in {}", foresight.learned_from,
                                               foresight.learned_from == 1 ? "" : "s", folder.string());
  return fmt::format("about {} at {:.3g} particle updates per second on a core, {}",
                     report::duration(foresight.time), foresight.update_rate, origin);
}

}  // namespace

std::string foresight_text(const study::StudyFile& file, const Foresight& foresight,
                           const std::filesystem::path& folder) {
  std::string text = file.study.title.empty() ? std::string{} : file.study.title + "\n\n";
  text += "Study\n";
  text += foresight_line("kind", study::to_string(file.study.kind));
  text += foresight_line("scene", file.study.scene);
  for (const auto& [key, value] : file.overrides) text += foresight_line("  " + key, value);
  text += foresight_line("mechanical runs", runs_text(foresight));
  if (foresight.confirmations > 0)
    text += foresight_line(
        "coupled runs", fmt::format("at most {} more, to confirm the critical gap; their time comes on top",
                                    foresight.confirmations));
  if (judges_gaps(file.study.kind))
    text +=
        foresight_line("gaps", fmt::format("{} on the trace of each run, then a bisection", gaps_of(file)));
  text += foresight_line("at a time", fmt::format("{}", foresight.jobs));
  text += foresight_line("memory", fmt::format("about {:.3g} MB", foresight.memory / 1e6));
  text += foresight_line("time", time_text(foresight, folder));
  return text + "\n" + report::to_text(run_table(foresight));
}

nlohmann::ordered_json foresight_json(const study::StudyFile& file, const Foresight& foresight) {
  return {{"title", file.study.title},
          {"kind", study::to_string(file.study.kind)},
          {"cases", cases_in(foresight)},
          {"mechanical_runs", foresight.runs.size()},
          {"stored", stored_in(foresight)},
          {"to_run", to_run_in(foresight)},
          {"refused", refused_in(foresight)},
          {"coupled_runs_at_most", foresight.confirmations},
          {"gaps", gaps_of(file)},
          {"jobs", foresight.jobs},
          {"particle_updates", updates_in(foresight)},
          {"updates_per_second", foresight.update_rate},
          {"rate_learned_from_runs", foresight.learned_from},
          {"memory_bytes", foresight.memory},
          {"predicted_time_s", foresight.time},
          {"runs", report::to_json(run_table(foresight))["rows"]}};
}

std::vector<std::string> reason_lines(const Foresight& foresight) {
  constexpr std::size_t few = 30;
  std::vector<std::string> lines;
  if (foresight.runs.size() < few) {
    for (const ForeseenRun& run : foresight.runs) lines.push_back(run.label + ": " + state_of(run));
    return lines;
  }
  std::map<std::string, std::size_t> places;
  std::vector<std::vector<const ForeseenRun*>> groups;
  for (const ForeseenRun& run : foresight.runs) {
    const auto [place, is_new] = places.try_emplace(state_of(run), groups.size());
    if (is_new) groups.emplace_back();
    groups[place->second].push_back(&run);
  }
  for (const auto& group : groups) {
    const ForeseenRun& first = *group.front();
    lines.push_back(group.size() == 1 ? first.label + ": " + state_of(first)
                                      : fmt::format("{} runs: {}", group.size(), state_of(first)));
  }
  return lines;
}

}  // namespace launchsafe::app
