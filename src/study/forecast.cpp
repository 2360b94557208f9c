#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <tbb/parallel_for.h>

#include <regex>
#include <sstream>

namespace launchsafe::study {
namespace {

using store::CaseState, store::RunRecord;

/// The line of a table in a list as that of a key: "G1 = { x = ... }" of "  { name = 'G1', x = ... },".
std::string as_line_of_key(const std::string& line) {
  static const std::regex table(R"(^  \{ name = '(.*?)', (.*),$)");
  return std::regex_replace(line, table, "$1 = { $2");
}

/// The lines that one text alone has, "key = value".
std::vector<std::string> lines_only_in(const std::string& text, const std::string& other) {
  std::map<std::string, int> counts;
  std::istringstream others(other), own(text);
  for (std::string line; std::getline(others, line);) ++counts[line];
  std::vector<std::string> result;
  for (std::string line; std::getline(own, line);)
    if (--counts[line] < 0 && !line.empty()) result.push_back(as_line_of_key(line));
  return result;
}

/// The value, as people read it, that one of the lines of an input gives a name.
std::string value_in(const std::vector<std::string>& lines, const std::string& name) {
  const auto line =
      std::ranges::find_if(lines, [&](const auto& each) { return each.starts_with(name + " = "); });
  if (line == lines.end()) return "nothing";
  std::string text = line->substr(name.size() + 3);
  std::erase_if(text, [](char c) { return c == '"' || c == '\''; });
  if (const auto* key = scene::find_key(scene::scene_keys(), name))
    if (const auto value = scene::parse_value(text, *key, {})) text = scene::format_value(*key, *value);
  return scene::quotable(text, 80);
}

/// Runs that are done, by their labels.
using Done = std::map<std::string, RunRecord>;
Done done_in(const store::CaseStore* store) {
  Done done;
  if (store == nullptr) return done;
  for (RunRecord& entry : store->records())
    if (entry.state == CaseState::done) done.insert_or_assign(entry.label, std::move(entry));
  return done;
}

std::string why_run(const CaseRun& needed, store::CaseStore* store, const Done& done) {
  if (store == nullptr) return "nothing is stored";
  if (const auto entry = store->record_of(needed.hash)) {
    if (entry->state == CaseState::done) return "its file is gone or damaged";
    constexpr std::array ends{"done", "failed", "timed out", "interrupted"};
    return fmt::format("{} before: {}", ends.at(static_cast<std::size_t>(entry->state)), entry->reason);
  }
  const auto before = done.find(needed.label);
  if (before == done.end()) return "never run here";
  const auto stored = store->input_of(before->second.hash);
  if (!stored) return "never run here";
  return fmt::format("other input than the stored case {:.8}: {}", before->second.hash,
                     difference_of_inputs(identity_of(needed).input(), *stored));
}

/// True for a run that would not be tried now: it was timed out under a limit no smaller than today's, or it
/// failed and nothing may be computed.
bool is_given_up(const std::string& hash, const StudyOptions& options) {
  const auto entry = options.store ? options.store->record_of(hash) : std::nullopt;
  if (!entry) return false;
  if (entry->state == CaseState::failed) return !options.compute;
  return entry->state == CaseState::timed_out &&
         (!options.compute || options.time_limit <= entry->time_limit);
}

/// Particle updates per second that the recorded runs came to.
void learn_rate(Forecast& forecast, const StudyOptions& options) {
  if (options.store == nullptr) return;
  double updates = 0, seconds = 0;
  for (const RunRecord& entry : options.store->records()) {
    if (entry.state != CaseState::done || !(entry.wall_time > 0)) continue;
    updates += entry.predicted_updates;
    seconds += entry.wall_time;
    ++forecast.learned_from;
  }
  if (updates > 0)
    forecast.update_rate = updates / seconds;
  else
    forecast.learned_from = 0;
}

/// Wall time of runs on several cores, the longest first.
double time_on(std::vector<double> times, int jobs) {
  std::ranges::sort(times, std::greater());
  std::vector<double> ends(static_cast<std::size_t>(jobs), 0.0);
  for (const double time : times) *std::ranges::min_element(ends) += time;
  return std::ranges::max(ends);
}

ForecastRun forecast_run(const CaseRun& needed, const StudyOptions& options, const Done& done,
                         double update_rate) {
  const scene::Plan plan = scene::make_plan(needed.scene);
  ForecastRun run;
  run.label = needed.label;
  run.hash = needed.hash;
  run.particles = plan.particles();
  run.steps = plan.steps;
  const run::Cost cost = run::cost_of(needed.scene);
  run.memory = memory_of(needed);
  run.kept = cost.kept_trace;
  constexpr double file_of_nothing = 110e3;  // bytes, measured: of a launch with the shortest trace
  run.disk = file_of_nothing + cost.kept_trace;
  if (needed.scene.output.asks_for_snapshots()) run.disk += run::snapshot_size(needed.scene).bytes();
  // Each has the trace so far.
  if (needed.checkpoints) run.kept += scene::parts_of_launch * (cost.particles + 0.5 * cost.kept_trace);
  run.stored = options.store != nullptr && options.store->holds(run.hash);
  if (run.stored) {
    run.why = "stored";
    return run;
  }
  const std::string refusal = refusal_of(needed.scene, options);
  run.refused = !refusal.empty();
  run.why = run.refused ? "refused: " + refusal : why_run(needed, options.store, done);
  run.given_up = run.refused || is_given_up(run.hash, options);
  run.time = run.given_up ? 0.0 : cost_of(needed) / update_rate;
  return run;
}

/// s on a core, at most, of each run that follows that of a case which is to run. What follows a stored
/// launch is as a rule stored too.
double confirmation_time(const StudyFile& study, const CaseRuns& runs, double update_rate) {
  const StudyCase input = study.cases[runs.members.front()];
  return continued_cost(skin_run(input.scene.scene, study.study.largest_gap, {})) / update_rate;
}

/// Bytes that a study takes at most: beside its runs, which take so many side by side, or as the report is
/// written. Measured: the program on one core and on four, shards of 2 000 and 10 000 cases of two gaps and
/// of twelve, and their merges.
double memory_of(const StudyFile& study, const Forecast& forecast, bool whole, double side_by_side) {
  constexpr double program = 19e6, of_job = 4e6, of_planned_case = 2e3;
  const auto all = static_cast<double>(study.cases.size()), own = static_cast<double>(forecast.cases);
  const auto gaps = static_cast<double>(study.study.gaps.size());
  const double plan = program + of_job * forecast.jobs + of_planned_case * all;
  const double at_end = std::max(side_by_side, whole ? (5e3 + 21e3 * gaps) * all : 0.0);
  if (!study.study.in_detail && study.study.kind.keeps_answers)
    return plan + at_end + (4e3 + 1e3 * gaps) * own;
  // Whole outcomes. A point of a measured curve has a time and a pressure, as they are and as they were
  // given.
  const double of_points = 4 * 8.0 * static_cast<double>(study.scene.scene.load.curve_time.size());
  double kept = (200e3 + of_points) * own;
  for (const ForecastRun& run : forecast.runs) kept += run.kept;
  return plan + at_end + kept;
}

/// Of so many cases, evenly spread over all of them.
std::vector<CaseRuns> some_of(std::vector<CaseRuns> cases, std::size_t most) {
  if (cases.size() <= most) return cases;
  std::vector<CaseRuns> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(std::move(cases[i * cases.size() / most]));
  return some;
}

}  // namespace

std::string difference_of_inputs(const std::string& here, const std::string& there) {
  const std::vector<std::string> own = lines_only_in(here, there), others = lines_only_in(there, here);
  const std::string first = !own.empty() ? own.front() : !others.empty() ? others.front() : "";
  const std::size_t end = first.find(" = "), count = std::max(own.size(), others.size());
  if (end == std::string::npos) return "another model, or another file that it rests on";
  const std::string name = first.substr(0, end);
  return fmt::format("{} = {} here, {} there{}", name, value_in(own, name), value_in(others, name),
                     count > 1 ? fmt::format(" and {} more", count - 1) : "");
}

std::optional<scene::InputError> all_out_of_reach(const StudyFile& study, const run::Reach& reach) {
  for (const StudyCase& input : study.cases)
    if (!run::out_of_reach(input.scene.scene, reach)) return std::nullopt;
  return study.cases.empty() ? std::nullopt : run::out_of_reach(study.cases.front().scene, reach);
}

std::size_t Forecast::of_all(std::size_t runs_like_that) const {
  if (runs.empty()) return 0;
  return static_cast<std::size_t>(
      std::llround(static_cast<double>(runs_like_that) * static_cast<double>(run_count) /
                   static_cast<double>(runs.size())));
}

Forecast forecast_study(const StudyFile& study, const StudyOptions& options, double update_rate,
                        std::size_t most_cases) {
  Forecast forecast;
  forecast.update_rate = update_rate;
  learn_rate(forecast, options);
  const Done done = done_in(options.store);
  std::vector<CaseRuns> all = case_runs(study, options.shard.count, study.confirmations_per_case > 0);
  std::erase_if(all, [&](const CaseRuns& each) { return each.shard != options.shard.index; });
  for (CaseRuns& each : all) {
    // Of a shard the other cases may be those of another, where it runs them itself.
    if (options.shard.whole())
      std::erase_if(each.runs, [](const PlannedRun& run) { return run.first_run_of.has_value(); });
    forecast.cases += each.members.size();
    forecast.run_count += each.runs.size();
  }
  std::size_t following = 0;  // runs that may follow that of a case, at most
  if (!study.study.kind.goes_through_ignition && !study.cases.empty())
    following = study.confirmations_per_case;
  forecast.confirmations = following * all.size();
  const std::vector<CaseRuns> cases = some_of(std::move(all), most_cases);
  std::vector<std::vector<ForecastRun>> runs(cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    for (const PlannedRun& each : cases[i].runs) {
      runs[i].push_back(forecast_run(each.make(), options, done, forecast.update_rate));
      runs[i].back().shard = cases[i].shard;
    }
    runs[i].front().cases = cases[i].members.size();
  });
  std::vector<double> times, confirmation_times, memories;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (following > 0 && !runs[i].front().stored && !runs[i].front().given_up)
      confirmation_times.insert(confirmation_times.end(), following,
                                confirmation_time(study, cases[i], forecast.update_rate));
    for (ForecastRun& run : runs[i]) {
      if (!run.stored && !run.given_up) {
        times.push_back(run.time);
        memories.push_back(run.memory);
        // What confirms a launch has a trace of its own.
        forecast.disk +=
            run.disk * static_cast<double>(&run == &runs[i].front() ? 1 + study.confirmations_per_case : 1);
      }
      forecast.runs.push_back(std::move(run));
    }
  }
  forecast.jobs = std::max(1, std::min(jobs_of(options), static_cast<int>(forecast.run_count)));
  const double share = static_cast<double>(forecast.run_count) /
                       static_cast<double>(std::max<std::size_t>(forecast.runs.size(), 1));
  forecast.confirmation_time = share * time_on(confirmation_times, forecast.jobs);
  forecast.disk *= share;
  forecast.time = share * time_on(times, forecast.jobs) + forecast.confirmation_time;
  std::sort(memories.rbegin(), memories.rend());
  memories.resize(std::min<std::size_t>(memories.size(), static_cast<std::size_t>(forecast.jobs)));
  forecast.memory = memory_of(study, forecast, options.shard.whole(),
                              std::accumulate(memories.begin(), memories.end(), 0.0));
  return forecast;
}

}  // namespace launchsafe::study
