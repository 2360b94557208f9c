// Which runs the cases of a study need, which they share, and how they are divided over shards.
#include "launchsafe/study/causes.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <tbb/parallel_for.h>

#include <queue>
#include <regex>

namespace launchsafe::study {
namespace {

/// The gaps of a case that have launches of their own: with two-way coupling those that are run through
/// ignition; none where the kind does not ask for them.
std::vector<double> launched_gaps(const StudyFile& study, const StudyCase& input) {
  const scene::Scene& scene = input.scene.scene;
  const bool burns = study.study.kind.goes_through_ignition && scene.coupling != scene::Coupling::one_way;
  return burns ? scene.surface.gaps : std::vector<double>{};
}

/// Of so many cases at the most the runs are planned before they are begun.
constexpr std::size_t most_planned_before = 512;

CaseRun run_of(const StudyCase& input, const SideLaunch& launch) {
  constexpr std::array words{"",          "through ignition",   "raised load",
                             "companion", "cells of constants", "constants"};
  return mechanics_run(launch.scene(input),
                       fmt::format("{}, {}{}{}", input.label, words.at(static_cast<std::size_t>(launch.part)),
                                   launch.name.empty() ? "" : " ", launch.name));
}

std::string key_by_runs(const StudyFile& study, const StudyCase& input) {
  std::string key = mechanics_run(input.scene.scene, {}).hash;
  for (const SideLaunch& each : side_launches(study.study, input)) key += run_of(input, each).hash;
  // A case that burns shares its launch alone with no other.
  for (const double gap : launched_gaps(study, input)) key += skin_run(input.scene.scene, gap, {}).hash;
  return key;
}

/// The cases that share runs, in the order of their first ones.
std::vector<CaseRuns> cases_by_runs(const StudyFile& study) {
  std::vector<std::string> keys(study.cases.size());
  tbb::parallel_for(std::size_t{0}, keys.size(),
                    [&](std::size_t i) { keys[i] = key_by_runs(study, study.cases[i]); });
  std::vector<CaseRuns> cases;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [found, is_new] = known.try_emplace(std::move(keys[i]), cases.size());
    if (is_new) cases.emplace_back();
    cases[found->second].members.push_back(i);
  }
  return cases;
}

/// The runs of the first of the cases that share them.
void plan_runs(const StudyFile& study, CaseRuns& cases) {
  const std::size_t first = cases.members.front();
  const auto add = [&](Part part, std::string name, auto make) {
    cases.runs.push_back({[of = &study, first, make] { return make(of->cases[first]); }, 1.0, part, name});
  };
  const StudyCase input = study.cases[first];
  add(Part::own, {}, [](const StudyCase& own) { return mechanics_run(own.scene.scene, own.label); });
  for (const double gap : launched_gaps(study, input))
    add(Part::through_ignition, {}, [gap](const StudyCase& own) {
      return skin_run(own.scene.scene, gap,
                      fmt::format("{}, through ignition at {:.6g} cm", own.label, 100.0 * gap));
    });
  for (const SideLaunch& each : side_launches(study.study, input))
    add(each.part, each.name, [each](const StudyCase& own) { return run_of(own, each); });
}

void predict_costs(std::vector<CaseRuns>& cases) {
  const std::size_t every = (cases.size() + most_planned_before - 1) / most_planned_before;
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    if (i % every != 0) return;
    for (PlannedRun& run : cases[i].runs) run.cost = cost_of(run.make());
  });
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t j = 0; j < cases[i].runs.size(); ++j) {
      const std::vector<PlannedRun>& shared = cases[i - i % every].runs;
      cases[i].runs[j].cost = shared[std::min(j, shared.size() - 1)].cost;
    }
}

}  // namespace

bool parse_shard(std::string_view text, Shard& shard) {
  constexpr int most_shards = 10000;
  static const std::regex form("([0-9]{1,9})/([0-9]{1,9})");
  std::cmatch part;
  if (!std::regex_match(text.data(), text.data() + text.size(), part, form)) return false;
  const Shard read{std::stoi(part[1]), std::stoi(part[2])};
  if (read.index < 1 || read.index > read.count || read.count > most_shards) return false;
  shard = read;
  return true;
}

std::vector<int> shards_of(const std::vector<double>& costs, int count) {
  const auto order = places_by(costs.size(), [&](std::size_t i) { return -costs[i]; });
  using Load = std::pair<double, int>;  // ties go to the lower shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (int shard = 1; shard <= count; ++shard) least.emplace(0.0, shard);
  std::vector<int> shards(costs.size());
  for (const std::size_t at : order) {
    auto [load, shard] = least.top();
    least.pop();
    shards[at] = shard;
    least.emplace(load + costs[at], shard);
  }
  return shards;
}

std::vector<CaseRuns> case_runs(const StudyFile& study, int shards) {
  std::vector<CaseRuns> cases = cases_by_runs(study);
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) { plan_runs(study, cases[i]); });
  predict_costs(cases);
  const auto cost_of_first = [](const CaseRuns& each) { return each.runs.front().cost; };
  const std::vector<int> shard = shards_of(of_each(cases, cost_of_first), shards);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].shard = shard[i];
  return cases;
}

Estimate estimate_of(const StudyFile& study, const StudyOptions& options) {
  constexpr std::size_t most_looked_at = 1000;
  Estimate estimate;
  std::vector<CaseRuns> cases = case_runs(study, options.shard.count);
  std::erase_if(cases, [&](const CaseRuns& each) { return each.shard != options.shard.index; });
  for (const CaseRuns& each : cases) {
    estimate.cases += each.members.size();
    estimate.runs += each.runs.size();
  }
  if (cases.empty()) return estimate;
  double looked_at = 0, stored = 0;
  const std::size_t every = (cases.size() + most_looked_at - 1) / most_looked_at;
  for (std::size_t i = 0; i < cases.size(); i += every)
    for (const PlannedRun& planned : cases[i].runs) {
      const CaseRun run = planned.make();
      ++looked_at;
      estimate.memory = std::max(estimate.memory, memory_of(run));
      if (options.store != nullptr && options.store->holds(run.hash))
        ++stored;
      else
        estimate.updates += planned.cost;
    }
  const double all = static_cast<double>(estimate.runs) / looked_at;
  estimate.stored = static_cast<std::size_t>(std::llround(all * stored));
  estimate.updates *= all;
  estimate.coupled_runs = study.confirmations_per_case * estimate.cases;
  if (estimate.coupled_runs > 0 && estimate.stored < estimate.runs) {
    const StudyCase first = study.cases[cases.front().members.front()];
    estimate.updates += static_cast<double>(estimate.coupled_runs) *
                        cost_of(skin_run(first.scene.scene, study.study.largest_gap, {}));
  }
  estimate.jobs = std::max(1, std::min(jobs_of(options), static_cast<int>(estimate.runs)));
  return estimate;
}

}  // namespace launchsafe::study
