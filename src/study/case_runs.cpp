// Which runs the cases of a study need, which they share, and how they are divided over shards.
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/raised_load.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <queue>
#include <unordered_map>

namespace launchsafe::study {
namespace {

/// The gaps of a case that have launches of their own: those that close, and with two-way coupling those that
/// are run through ignition; none where the kind does not ask for them.
std::vector<double> launched_gaps(const StudyFile& study, const StudyCase& input) {
  const KindTraits& kind = study.study.kind;
  const scene::Scene& scene = input.scene.scene;
  const bool closes = input.closing && kind.closing_gaps != ClosingGaps::beside;
  const bool burns = kind.goes_through_ignition && scene.coupling != scene::Coupling::one_way;
  return closes || burns ? scene.surface.gaps : std::vector<double>{};
}

/// Of so many cases at the most the runs are planned before they are begun.
constexpr std::size_t most_planned_before = 512;

/// Whether the mechanics of a case has its values of these axes: not where a launch decides whether the
/// mechanics knows a key, as its role says, or as its value is not there.
bool keeps_values(const StudyFile& study, std::size_t index, const std::vector<std::size_t>& axes) {
  const scene::Scene part = scene::mechanical_part(study.cases[index].scene.scene);
  return std::ranges::all_of(axes, [&](std::size_t i) {
    const Axis& axis = study.study.axes[i];
    const keys::ActsOn acts_on = axis.key.role().acts_on;
    const auto* key = scene::find_key(scene::scene_keys(), axis.key.name);
    return (acts_on == keys::ActsOn::mechanics || acts_on == keys::ActsOn::numerics) && key != nullptr &&
           same_value(key->get(part), scene::Value(study.cases.coordinates(index)[i]));
  });
}

/// Whether cases that differ in these axes surely differ in their runs. The first and the last case have
/// other values of each, of which one is not the default.
bool tell_runs_apart(const StudyFile& study, const std::vector<std::size_t>& axes) {
  if (study.cases.empty() || !launched_gaps(study, study.cases.front()).empty()) return false;
  const std::size_t last = study.cases.size() - 1;
  return !study.cases.has_own_scene(0) && !study.cases.has_own_scene(last) && keeps_values(study, 0, axes) &&
         keeps_values(study, last, axes);
}

std::string key_by_runs(const StudyFile& study, const StudyCase& input) {
  std::string key = mechanics_run(input.scene.scene, {}).hash;
  // A case that burns or closes shares its launch alone with no other.
  for (const double gap : launched_gaps(study, input)) key += skin_run(closing_scene(input), gap, {}).hash;
  return key;
}

/// The cases that share runs, in the order of their first ones.
std::vector<CaseRuns> cases_by_runs(const StudyFile& study) {
  std::vector<std::string> keys(study.cases.size());
  std::vector<std::size_t> axes;  // that reach the mechanics
  for (std::size_t i = 0; i < study.study.axes.size(); ++i)
    if (keys::reaches_mechanics(study.study.axes[i].key.role().acts_on)) axes.push_back(i);
  const bool by_values = tell_runs_apart(study, axes);
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
    if (!by_values || study.cases.has_own_scene(i)) {
      keys[i] = key_by_runs(study, study.cases[i]);
      return;
    }
    for (const std::size_t axis : axes) keys[i] += fmt::format("{} ", study.cases.coordinates(i)[axis]);
  });
  std::vector<CaseRuns> cases;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [found, is_new] = known.try_emplace(std::move(keys[i]), cases.size());
    if (is_new) cases.emplace_back();
    cases[found->second].members.push_back(i);
  }
  return cases;
}

/// The run of the mechanics of a case, of its longer launch if there is one.
CaseRun longer_run(const StudyCase& input) {
  return mechanics_run(*with_longer_launch(input.scene.scene),
                       fmt::format("{}, {}", input.label,
                                   scene::is_cut_short(input.scene.scene.load) ? "until the launch is over"
                                                                               : "without muzzle exit"));
}

/// The runs of the first of the cases that share them.
void plan_runs(const StudyFile& study, bool checkpoints, CaseRuns& cases) {
  const std::size_t first = cases.members.front();
  const StudyFile* of = &study;
  const bool longer = study.study.in_detail && with_longer_launch(study.cases[first].scene.scene);
  if (!compares_closing(study.study, study.cases[first]))
    cases.runs.push_back({[of, first, checkpoints, longer] {
      const StudyCase input = of->cases[first];
      CaseRun run = mechanics_run(input.scene.scene, input.label);
      run.checkpoints = checkpoints || longer;
      return run;
    }});
  for (const double gap : launched_gaps(study, study.cases[first]))
    cases.runs.push_back({[of, first, gap] {
      const StudyCase input = of->cases[first];
      return skin_run(closing_scene(input), gap,
                      fmt::format("{}, {} {:.6g} cm", input.label,
                                  input.closing ? "closing from" : "through ignition at", 100.0 * gap));
    }});
  if (propagates_spread(study.study)) {
    if (const auto loads = neighbouring_loads(study, first))
      for (const std::size_t each : {loads->above, loads->beside}) {
        cases.runs.push_back({[of, each] {
          const StudyCase input = of->cases[each];
          return mechanics_run(input.scene.scene, input.label);
        }});
        cases.runs.back().first_run_of = each;
      }
    else
      cases.runs.push_back({[of, first] {
        const StudyCase input = of->cases[first];
        return mechanics_run(with_raised_load(input.scene.scene), label_of_raised(input));
      }});
  }
  if (longer) cases.runs.push_back({[of, first] { return longer_run(of->cases[first]); }});
}

void predict_costs(std::vector<CaseRuns>& cases) {
  const std::size_t every = (cases.size() + most_planned_before - 1) / most_planned_before;
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    if (i % every != 0) return;
    for (PlannedRun& run : cases[i].runs) run.cost = cost_of(run.make());
  });
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t j = 0; j < cases[i].runs.size(); ++j) {
      const std::vector<PlannedRun>& alike = cases[i - i % every].runs;
      cases[i].runs[j].cost = alike[std::min(j, alike.size() - 1)].cost;
    }
}

}  // namespace

std::string Shard::part() const { return whole() ? std::string{} : fmt::format("{}-of-{}", index, count); }

bool parse_shard(std::string_view text, Shard& shard) {
  constexpr int most_shards = 10000;
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return false;
  const auto whole_number = [](std::string_view digits, int& number) {
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return status == std::errc{} && end == digits.data() + digits.size();
  };
  Shard read;
  if (!whole_number(text.substr(0, slash), read.index) || !whole_number(text.substr(slash + 1), read.count))
    return false;
  if (read.index < 1 || read.index > read.count || read.count > most_shards) return false;
  shard = read;
  return true;
}

std::vector<int> shards_of(const std::vector<double>& costs, int count) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&costs](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
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

std::size_t own_runs(const CaseRuns& runs) {
  return std::ranges::count_if(runs.runs, [](const PlannedRun& run) { return !run.first_run_of; });
}

std::optional<scene::Scene> with_longer_launch(const scene::Scene& scene) {
  std::optional<scene::Load> longer = scene::longer_launch(scene.load);
  if (!longer) return std::nullopt;
  scene::Scene other = scene;
  other.load = std::move(*longer);
  return other;
}

std::vector<CaseRuns> case_runs(const StudyFile& study, int shards, bool checkpoints) {
  std::vector<CaseRuns> cases = cases_by_runs(study);
  for (CaseRuns& each : cases) plan_runs(study, checkpoints, each);
  predict_costs(cases);
  std::vector<double> costs;
  for (const CaseRuns& each : cases) costs.push_back(each.runs.front().cost);
  const std::vector<int> shard = shards_of(costs, shards);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].shard = shard[i];
  return cases;
}

}  // namespace launchsafe::study
