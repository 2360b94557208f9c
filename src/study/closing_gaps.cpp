#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::study {
namespace {

/// Gaps of the scan beside those of the study.
constexpr int scan_gaps = 8;
/// Closer gaps are one, m.
constexpr double same_gap = 1e-9;

scene::Scene scene_on(const StudyCase& input, const ClosingTerms& terms) {
  scene::Scene scene = input.scene.scene;
  scene.surface = terms.surface;
  scene.charge().kinetics = terms.kinetics;
  return scene;
}

CaseRun run_on(const StudyCase& input, const ClosingTerms& terms, double gap) {
  scene::Scene scene = scene_on(input, terms);
  // Without a gap its terms are nothing, but for when the charge lets go.
  if (gap <= terms.surface.roughness) {
    scene.surface = *input.closing;
    scene.surface.release = terms.surface.release;
    if (terms.surface.release > 0.0) scene.surface.release_duration = terms.surface.release_duration;
  }
  return skin_run(scene, gap, fmt::format("{}, closing from {:.6g} cm", input.label, 100.0 * gap));
}

/// Why a run says nothing: how it ended, or the first thing that warns of it. Empty for a sound one.
std::string fault_of(const scene::Scene& scene, const FinishedRun& run) {
  if (!run.failure.empty()) return run.failure;
  if (!run.has_result() || run.result.gaps.empty()) return "it was not computed";
  const std::vector<std::string> warnings = run::validity_warnings(scene, run.result.mechanics);
  return warnings.empty() ? std::string{} : warnings.front();
}

/// A gap as one launch has it.
ClosingPoint point_of(const CaseRun& asked, const FinishedRun& run) {
  ClosingPoint point{.gap = *asked.skin_gap,
                     .release = asked.scene.surface.release,
                     .unknown_for = fault_of(asked.scene, run)};
  if (!point.unknown_for.empty()) return point;
  const run::GapResult& gap = run.result.gaps.front();
  point.ignited = gap.skin.ignition.has_value();
  point.maximum_temperature = gap.at_stations.temperature;
  if (!point.ignited && !std::isfinite(point.maximum_temperature))
    point.unknown_for = "its temperature is not a number";
  const trace::BottomTrace& trace = run.result.mechanics.trace;
  if (gap.at_stations.station < trace.stations.size())
    point.place = trace.stations[gap.at_stations.station].name;
  return point;
}

/// With what its computation may have wrong.
ClosingPoint with_share(ClosingPoint point, const StudyCase& input, const ClosingTerms& terms) {
  const double rise = point.maximum_temperature - input.scene.scene.initial_temperature;
  const ClosingShare share = closing_share(input, scene_on(input, terms), point.gap, rise);
  point.at_most = point.maximum_temperature + share.kelvin;
  point.recorded = share.recorded;
  return point;
}

/// Takes one more launch into a point: one that ignites says enough, whatever another one lacks; else the
/// hotter one counts, and one without a temperature leaves none.
void join(const ClosingPoint& launch, ClosingPoint& point) {
  const bool counts =
      launch.ignited != point.ignited
          ? launch.ignited
          : point.unknown_for.empty() &&
                (!launch.unknown_for.empty() || !(launch.maximum_temperature <= point.maximum_temperature));
  ClosingPoint both = counts ? launch : point;
  both.launches = point.launches + launch.launches;
  both.at_most = larger_bound(point.at_most, launch.at_most);
  both.recorded = point.recorded && launch.recorded;
  point = std::move(both);
}

bool is_known(const ClosingPoint& point) { return point.ignited || std::isfinite(point.maximum_temperature); }

/// The gaps of a case and the largest one, ascending; in detail with those of a scan between them.
std::vector<double> scanned_gaps(const Study& study, const StudyCase& input) {
  std::vector<double> gaps = gaps_of(study, input);
  const int parts = study.in_detail ? scan_gaps : 1;
  for (int i = 0; i <= parts; ++i) gaps.push_back(largest_gap(study) * i / parts);
  std::ranges::sort(gaps);
  const auto same = std::ranges::unique(gaps, [](double a, double b) { return b - a < same_gap; });
  gaps.erase(same.begin(), same.end());
  return gaps;
}

/// A bound of a case whose gaps are sought.
struct Search {
  std::size_t index = 0;  ///< of the case
  ClosingBound bound;
  ClosingAnswer* answer = nullptr;
  std::vector<double> scanned;  ///< m
};

/// Whether a gap has not been launched on all terms, and these may make it hotter than is known.
bool is_open(const Search& search, const ClosingPoint& point) {
  return point.launches < search.bound.terms.size() && !point.ignited && point.unknown_for.empty();
}

/// The gaps to compute next; none once the bracket is narrow enough.
std::vector<double> wanted(const Study& study, const Search& search) {
  const ClosingAnswer& answer = *search.answer;
  std::vector<double> open;
  for (const ClosingPoint& point : answer.points)
    if (is_open(search, point)) open.push_back(point.gap);
  if (!open.empty()) return open;
  const bool is_bracketed = std::isfinite(answer.upper);
  if (is_bracketed && !(answer.upper - answer.lower > study.tolerance)) return {};
  if (is_bracketed) return {0.5 * (answer.lower + answer.upper)};
  if (!answer.points.empty() && std::isnan(answer.upper)) return {};
  std::vector<double> gaps = search.scanned;
  std::erase_if(gaps, [&](double gap) { return answer.at(gap) != nullptr; });
  if (!study.in_detail && gaps.size() > 1) gaps.resize(1);
  return gaps;
}

/// The bracket that the points leave.
void narrow(ClosingAnswer& answer) {
  answer.lower = not_a_number;
  answer.upper = math::infinity;
  for (const ClosingPoint& point : answer.points) {
    if (!is_known(point) || point.ignited) {
      answer.upper = point.ignited ? point.gap : not_a_number;
      return;
    }
    answer.lower = point.gap;
  }
}

/// A launch that a search waits for.
struct Asked {
  const Search* search;
  const ClosingTerms* terms;
  double gap;
};

/// Of every gap those on the next terms whose air flows alike: what ignites with air that stays needs none
/// with air that flows, which takes longer.
std::vector<Asked> launches_of(const Study& study, const std::vector<Search>& searches) {
  std::vector<Asked> launches;
  for (const Search& search : searches)
    for (const double gap : wanted(study, search)) {
      const ClosingPoint* known = search.answer->at(gap);
      const std::vector<ClosingTerms>& terms = search.bound.terms;
      const std::size_t first = known ? known->launches : 0;
      const auto flows_alike = [&](std::size_t i) {
        return terms[i].surface.air_flow == terms[first].surface.air_flow;
      };
      for (std::size_t i = first; i < terms.size() && flows_alike(i); ++i)
        launches.push_back({&search, &terms[i], gap});
    }
  return launches;
}

/// What launches say, by their identity.
using KnownLaunches = std::map<std::string, ClosingPoint>;

/// K, by which T max between a release and its neighbours may be above what it is at the release: a parabola
/// through three instants evenly apart is at most an eighth of their second difference above the middle one.
/// Twice that counts, and a neighbour that is missing is taken to be like the other one.
double rise_between_releases(const std::vector<Asked>& launches, const Asked& at,
                             const std::function<double(const Asked&)>& temperature_of) {
  const Asked *before = nullptr, *after = nullptr;
  for (const Asked& each : launches) {
    const scene::Surface &other = each.terms->surface, &own = at.terms->surface;
    if (each.search != at.search || each.gap != at.gap || other.air_flow != own.air_flow ||
        each.terms->kinetics.name != at.terms->kinetics.name)
      continue;
    const double release = other.release;
    if (release < own.release && (!before || release > before->terms->surface.release)) before = &each;
    if (release > own.release && (!after || release < after->terms->surface.release)) after = &each;
  }
  if (!before && !after) return 0.0;
  const double here = temperature_of(at);
  const double neighbours =
      temperature_of(before ? *before : *after) + temperature_of(after ? *after : *before);
  return std::max(0.0, 0.25 * (2.0 * here - neighbours));
}

/// Computes those launches that are not known, and takes all of them in.
void add_points(const StudyFile& study, const std::vector<Asked>& launches, const RunBatch& run,
                KnownLaunches& known) {
  std::vector<PlannedRun> runs;
  std::vector<std::string> hashes;  // of the launches
  std::set<std::size_t> cases;
  for (const Asked& each : launches) {
    cases.insert(each.search->index);
    const auto make = [&study, each] {
      return run_on(study.cases[each.search->index], *each.terms, each.gap);
    };
    const CaseRun asked = make();
    hashes.push_back(asked.hash);
    if (known.try_emplace(asked.hash).second) runs.push_back({make, cost_of(asked)});
  }
  run(runs, std::ssize(cases), [&](std::size_t i, const FinishedRun& finished) {
    const CaseRun asked = runs[i].make();
    known.at(asked.hash) = point_of(asked, finished);
  });
  const auto temperature_of = [&](const Asked& launch) {
    return known.at(hashes[static_cast<std::size_t>(&launch - launches.data())]).maximum_temperature;
  };
  for (std::size_t i = 0; i < launches.size(); ++i) {
    const auto& [search, terms, gap] = launches[i];
    ClosingPoint launch = with_share(known.at(hashes[i]), study.cases[search->index], *terms);
    launch.at_most += rise_between_releases(launches, launches[i], temperature_of);
    std::vector<ClosingPoint>& points = search->answer->points;
    const auto point = std::ranges::find(points, gap, &ClosingPoint::gap);
    point == points.end() ? points.push_back(launch) : join(launch, *point);
  }
}

/// One of which nothing can be said at any gap.
void leave_unknown(const Search& search) {
  for (const double gap : search.scanned)
    search.answer->points.push_back({.gap = gap, .unknown_for = search.bound.unknown_for});
}

}  // namespace

const ClosingPoint* ClosingAnswer::at(double gap) const {
  const auto found = std::ranges::find_if(
      points, [gap](const ClosingPoint& point) { return std::abs(point.gap - gap) < same_gap; });
  return found == points.end() ? nullptr : &*found;
}

std::vector<std::vector<ClosingAnswer>> find_closing_gaps(const StudyFile& study,
                                                          const std::vector<std::size_t>& cases,
                                                          const RunBatch& run) {
  std::vector<std::vector<ClosingAnswer>> answers(cases.size());
  std::vector<Search> searches;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const StudyCase input = study.cases[cases[i]];
    std::vector<ClosingBound> bounds = closing_bounds(input, study.study.in_detail);
    answers[i].resize(bounds.size());
    for (std::size_t j = 0; j < bounds.size(); ++j) {
      answers[i][j].name = bounds[j].name;
      searches.push_back({cases[i], std::move(bounds[j]), &answers[i][j], scanned_gaps(study.study, input)});
      if (!searches.back().bound.unknown_for.empty()) leave_unknown(searches.back());
    }
  }
  KnownLaunches known;
  std::vector<Asked> launches;
  do {
    launches = launches_of(study.study, searches);
    add_points(study, launches, run, known);
    for (const Search& search : searches) {
      std::ranges::sort(search.answer->points, {}, &ClosingPoint::gap);
      narrow(*search.answer);
    }
  } while (!launches.empty());
  return answers;
}

std::size_t most_closing_launches(const Study& study, const StudyCase& input) {
  const std::vector<double> scanned = scanned_gaps(study, input);
  double widest = study.tolerance;
  for (std::size_t i = 1; i < scanned.size(); ++i) widest = std::max(widest, scanned[i] - scanned[i - 1]);
  // An odd bit of round-off is no halving.
  const double halvings = std::ceil(std::log2(widest / study.tolerance) - 1e-9);
  const std::size_t gaps = scanned.size() + static_cast<std::size_t>(halvings);
  std::set<std::string> without_a_gap, of_a_gap;
  for (const ClosingBound& bound : closing_bounds(input, study.in_detail))
    for (const ClosingTerms& terms : bound.terms)
      if (bound.unknown_for.empty()) {
        without_a_gap.insert(run_on(input, terms, 0.0).hash);
        of_a_gap.insert(run_on(input, terms, scanned.back()).hash);
      }
  return without_a_gap.size() + (gaps - 1) * of_a_gap.size();
}

/// A thinner gap that ignites says that this one does too: T max need not rise with the gap. Nor need the
/// corner be the hottest: what may come nearest to ignition counts.
ClosingEvidence closing_evidence(const std::vector<ClosingAnswer>& answers, double gap,
                                 double ignition_temperature) {
  ClosingEvidence evidence;
  evidence.known = !answers.empty();
  const ClosingPoint* worst = nullptr;
  bool corner_known = false, corner_ignites = false;
  const auto hides_a_thinner = [gap](const ClosingPoint& point) {
    return point.gap < gap && !is_known(point);
  };
  for (const ClosingAnswer& answer : answers) {
    if (!answer.is_nominal() && !answer.is_worst_corner()) continue;
    const ClosingPoint* point = answer.at(gap);
    const bool is_computed = point != nullptr && is_known(*point);
    if (!is_computed || std::ranges::any_of(answer.points, hides_a_thinner)) evidence.known = false;
    const bool ignites = (is_computed && point->ignited) || answer.upper <= gap;
    if (is_computed && (worst == nullptr || !(point->at_most <= worst->at_most))) worst = point;
    if (answer.is_worst_corner()) {
      corner_known = ignites || is_computed;
      corner_ignites = ignites;
    } else {
      evidence.ignited = evidence.ignited || ignites;
    }
  }
  if (corner_ignites) {
    evidence.corner_margin = -math::infinity;
  } else if (corner_known) {
    evidence.corner_margin = ignition_temperature - worst->maximum_temperature;
    evidence.numerical = worst->at_most - worst->maximum_temperature;
  }
  return evidence;
}

void take_closing_evidence(const std::vector<ClosingAnswer>& answers, const scene::Scene& scene,
                           GapVerdict& row) {
  const double ignition = scene.charge().kinetics.ignition_temperature;
  row.closing = closing_evidence(answers, row.gap, ignition);
  const double rise = row.maximum.temperature - scene.initial_temperature,
               of_corner = ignition - row.closing.corner_margin - scene.initial_temperature;
  row.closing.heat_ratio = of_corner <= rise ? 1.0 : of_corner / rise;  // NaN where either is
}

CriticalGap critical_gap_of(const ClosingAnswer& answer) {
  CriticalGap gap;
  gap.lower = answer.lower;
  gap.upper = answer.upper;
  if (std::isnan(answer.upper)) return gap;
  if (std::isinf(answer.upper)) {
    gap.kind = CriticalGapKind::all_safe;
  } else if (std::isnan(answer.lower)) {
    gap.kind = CriticalGapKind::all_ignite;
  } else {
    gap.kind = CriticalGapKind::value;
    gap.value = 0.5 * (answer.lower + answer.upper);
  }
  return gap;
}

}  // namespace launchsafe::study
