// Which runs the cases of a study need, which they share, and how they are divided over shards.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"

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

/// A launch of a case under other constants.
CaseRun model_run(const StudyCase& input, const std::shared_ptr<const scene::Constants>& model) {
  return mechanics_run(scene_of_model(input, model),
                       fmt::format("{}, constants {}", input.label, name_of_model(*model)));
}

std::string key_by_runs(const StudyFile& study, const StudyCase& input) {
  std::string key = mechanics_run(input.scene.scene, {}).hash;
  for (const auto& model : study.study.models) key += model_run(input, model).hash;
  // A case that burns shares its launch alone with no other.
  for (const double gap : launched_gaps(study, input)) key += skin_run(input.scene.scene, gap, {}).hash;
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

/// The same launch with the pressure at the hot end of the assumed spread.
scene::Scene with_raised_load(const scene::Scene& scene) {
  scene::Scene raised = scene;
  const double factor = 1.0 + assumed_load_spread;
  scene::Load& load = raised.load;
  load.peak *= factor;
  if (!load.rescale_to_peak)
    for (double& pressure : load.curve_pressure) pressure *= factor;
  return raised;
}

/// The runs of the first of the cases that share them.
void plan_runs(const StudyFile& study, CaseRuns& cases) {
  const std::size_t first = cases.members.front();
  const auto add = [&](auto make, std::string model = {}) {
    cases.runs.push_back(
        {[of = &study, first, make] { return make(of->cases[first]); }, 1.0, std::move(model)});
  };
  // Where every case has runs of the same kinds none is made to know them.
  const StudyCase input = study.study.kind.goes_through_ignition ? study.cases[first] : StudyCase{};
  add([](const StudyCase& own) { return mechanics_run(own.scene.scene, own.label); });
  for (const double gap : launched_gaps(study, input))
    add([gap](const StudyCase& own) {
      return skin_run(own.scene.scene, gap,
                      fmt::format("{}, through ignition at {:.6g} cm", own.label, 100.0 * gap));
    });
  if (propagates_spread(study.study))
    add([](const StudyCase& own) {
      return mechanics_run(with_raised_load(own.scene.scene),
                           fmt::format("{}, load +{:.3g} %", own.label, 100.0 * assumed_load_spread));
    });
  for (const auto& model : study.study.models)
    add([model](const StudyCase& own) { return model_run(own, model); }, name_of_model(*model));
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

std::string Shard::part() const { return whole() ? std::string{} : fmt::format("{}-of-{}", index, count); }

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

bool propagates_spread(const Study& study) {
  return study.kind.gives_verdicts && study.kind.bounds_critical_gaps &&
         !std::isfinite(study.input_uncertainty);
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
