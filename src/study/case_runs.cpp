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

std::string key_by_runs(const StudyFile& study, const StudyCase& input) {
  std::string key = mechanics_run(input.scene.scene, {}).hash;
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
void plan_runs(const StudyFile& study, bool checkpoints, CaseRuns& cases) {
  const auto add = [&](std::size_t index, auto make) {
    cases.runs.push_back({[of = &study, index, make] { return make(of->cases[index]); }});
  };
  const std::size_t first = cases.members.front();
  // Where every case has runs of the same kinds none is made to know them.
  const bool may_differ = study.study.in_detail || study.study.kind.goes_through_ignition;
  const StudyCase input = may_differ ? study.cases[first] : StudyCase{};
  const bool longer = study.study.in_detail && with_longer_launch(input.scene.scene);
  add(first, [checkpoints = checkpoints || longer](const StudyCase& own) {
    CaseRun run = mechanics_run(own.scene.scene, own.label);
    run.checkpoints = checkpoints;
    return run;
  });
  for (const double gap : launched_gaps(study, input))
    add(first, [gap](const StudyCase& own) {
      return skin_run(own.scene.scene, gap,
                      fmt::format("{}, through ignition at {:.6g} cm", own.label, 100.0 * gap));
    });
  if (const auto loads = neighbouring_loads(study, first); loads && propagates_spread(study.study)) {
    for (const std::size_t each : {loads->above, loads->beside}) {
      add(each, [](const StudyCase& other) { return mechanics_run(other.scene.scene, other.label); });
      cases.runs.back().first_run_of = each;
    }
  } else if (propagates_spread(study.study)) {
    add(first, [](const StudyCase& own) {
      return mechanics_run(with_raised_load(own.scene.scene),
                           fmt::format("{}, load +{:.3g} %", own.label, 100.0 * assumed_load_spread));
    });
  }
  if (longer)
    add(first, [](const StudyCase& own) {
      const bool cut_short = scene::is_cut_short(own.scene.scene.load);
      return mechanics_run(
          *with_longer_launch(own.scene.scene),
          fmt::format("{}, {}", own.label, cut_short ? "until the launch is over" : "without muzzle exit"));
    });
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

/// The axis over the peak pressure of a full factorial, and how many cases lie between neighbours on it.
struct PressureAxis {
  std::vector<double> peaks;  ///< Pa, in the order written
  std::size_t stride = 1;
};

/// Nothing where launches under other loads end at other times.
std::optional<PressureAxis> pressure_axis(const StudyFile& study) {
  if (study.scene.scene.load.muzzle_travel) return std::nullopt;
  std::optional<PressureAxis> found;
  std::size_t cases = 1;
  for (std::size_t i = study.study.axes.size(); i-- > 0;) {
    const Axis& axis = study.study.axes[i];
    if (axis.key.name == "load.peak") found = {axis.values, cases};
    cases *= axis.values.size();
  }
  return cases == study.cases.size() ? found : std::nullopt;
}

bool are_neighbours(double lower, double upper) {
  const double ratio = upper / lower;
  return ratio >= least_load_ratio && ratio <= largest_load_ratio;
}

/// The place of the pressure nearest to one among those that are its neighbours on one side.
std::optional<std::size_t> neighbour_of(double peak, const std::vector<double>& peaks, bool above) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    if (!(above ? are_neighbours(peak, peaks[i]) : are_neighbours(peaks[i], peak))) continue;
    if (!nearest || std::abs(peaks[i] - peak) < std::abs(peaks[*nearest] - peak)) nearest = i;
  }
  return nearest;
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

bool propagates_spread(const Study& study) {
  return study.kind.gives_verdicts && study.kind.bounds_critical_gaps &&
         !std::isfinite(study.input_uncertainty);
}

std::optional<NeighbouringLoads> neighbouring_loads(const StudyFile& study, std::size_t index) {
  if (study.study.raised_load != RaisedLoad::interpolated) return std::nullopt;
  const auto axis = pressure_axis(study);
  if (!axis) return std::nullopt;
  const std::vector<double>& peaks = axis->peaks;
  const std::size_t own = index / axis->stride % peaks.size();
  const auto above = neighbour_of(peaks[own], peaks, true);
  auto beside = neighbour_of(peaks[own], peaks, false);
  if (above && !beside) beside = neighbour_of(peaks[*above], peaks, true);
  if (!above || !beside) return std::nullopt;
  const auto at = [&](std::size_t place) { return index + (place - own) * axis->stride; };
  const NeighbouringLoads loads{at(*above), at(*beside), peaks[own], peaks[*above], peaks[*beside]};
  // One with a scene of its own may differ in more.
  for (const std::size_t each : {index, loads.above, loads.beside})
    if (study.cases.has_own_scene(each)) return std::nullopt;
  return loads;
}

void interpolate_raised_load(const NeighbouringLoads& loads, std::vector<FinishedRun>& runs) {
  const auto beside = runs.begin() + 2;
  FinishedRun &own = runs[0], &raised = runs[1];
  if (raised.has_result() && raised.failure.empty()) {
    const auto trace = [](const FinishedRun& run) -> const trace::BottomTrace& {
      return run.result.mechanics.trace;
    };
    if (!beside->has_result() || !beside->failure.empty()) {
      raised = *beside;
    } else if (auto between =
                   trace::at_load((1.0 + assumed_load_spread) * loads.own_peak, {loads.own_peak, trace(own)},
                                  {loads.above_peak, trace(raised)}, {loads.beside_peak, trace(*beside)})) {
      raised.result.mechanics.trace = std::move(*between);
    } else {
      raised = {};
      raised.failure = "the run failed: launches at neighbouring peak pressures end at other times";
    }
  }
  runs.erase(beside);
}

std::vector<CaseRuns> case_runs(const StudyFile& study, int shards, bool checkpoints) {
  std::vector<CaseRuns> cases = cases_by_runs(study);
  tbb::parallel_for(std::size_t{0}, cases.size(),
                    [&](std::size_t i) { plan_runs(study, checkpoints, cases[i]); });
  predict_costs(cases);
  const auto cost_of_first = [](const CaseRuns& each) { return each.runs.front().cost; };
  const std::vector<int> shard = shards_of(of_each(cases, cost_of_first), shards);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].shard = shard[i];
  return cases;
}

}  // namespace launchsafe::study
