#include "launchsafe/study/closing_gaps.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/named_material.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/gap_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace launchsafe::study {
namespace {

/// m, below what is made: the smoothest faces that are plausible.
constexpr double smoothest = 1e-6;
/// Of the peak pressure, at which a charge may let go.
constexpr double release_shares[] = {0.25, 0.5, 0.75, 1.0};
/// Gaps of the scan beside those of the study.
constexpr int scan_gaps = 8;
/// Closer gaps are one, m.
constexpr double same_gap = 1e-9;

/// s, when a load first has a share of its peak.
double time_at_share(const scene::Load& load, double share) {
  constexpr int parts = 20000;
  const scene::PressureHistory history(load);
  const double peak_time = history.peak_time();
  for (int i = 0; i < parts; ++i) {
    const double time = peak_time * i / parts;
    if (history.at(time) >= share * history.peak()) return time;
  }
  return peak_time;
}

scene::Scene scene_on(const StudyCase& input, const ClosingTerms& terms) {
  scene::Scene scene = closing_scene(input);
  scene.surface.base = terms.base;
  scene.surface.roughness = terms.roughness;
  scene.surface.release = terms.release;
  scene.surface.release_duration = terms.release_duration;
  scene.surface.air_flow = terms.air_flow;
  scene.surface.melts = terms.melts;
  scene.charge().kinetics = terms.kinetics;
  return scene;
}

CaseRun run_on(const StudyCase& input, const ClosingTerms& terms, double gap) {
  scene::Scene scene = scene_on(input, terms);
  // Without a gap its terms are nothing, but for when the charge lets go.
  if (gap <= terms.roughness) {
    scene.surface = *input.closing;
    scene.surface.release = terms.release;
    if (terms.release > 0.0) scene.surface.release_duration = terms.release_duration;
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
  ClosingPoint point;
  point.gap = *asked.skin_gap;
  point.release = asked.scene.surface.release;
  point.unknown_for = fault_of(asked.scene, run);
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

/// Takes one more launch into a point: the hotter one counts, and one without a temperature leaves none.
void join(const ClosingPoint& launch, ClosingPoint& point) {
  point.launches += launch.launches;
  point.ignited = point.ignited || launch.ignited;
  point.at_most = larger_bound(point.at_most, launch.at_most);
  point.recorded = point.recorded && launch.recorded;
  if (!point.unknown_for.empty()) return;
  if (launch.unknown_for.empty() && launch.maximum_temperature <= point.maximum_temperature) return;
  point.unknown_for = launch.unknown_for;
  point.maximum_temperature = launch.maximum_temperature;
  point.place = launch.place;
  point.release = launch.release;
}

bool is_known(const ClosingPoint& point) { return point.ignited || std::isfinite(point.maximum_temperature); }

/// The gaps of a case and the largest one, ascending; in detail with those of a scan between them.
std::vector<double> scanned_gaps(const Study& study, const StudyCase& input) {
  std::vector<double> gaps = gaps_of(study, input);
  const int parts = study.in_detail ? scan_gaps : 1;
  for (int i = 0; i <= parts; ++i) gaps.push_back(largest_gap(study) * i / parts);
  std::sort(gaps.begin(), gaps.end());
  gaps.erase(std::unique(gaps.begin(), gaps.end(), [](double a, double b) { return b - a < same_gap; }),
             gaps.end());
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
  if (std::isfinite(answer.upper))
    return answer.upper - answer.lower > study.tolerance
               ? std::vector<double>{0.5 * (answer.lower + answer.upper)}
               : std::vector<double>{};
  if (!answer.points.empty() && std::isnan(answer.upper)) return {};
  std::vector<double> gaps = search.scanned;
  std::erase_if(gaps, [&](double gap) { return answer.at(gap) != nullptr; });
  if (!study.in_detail && gaps.size() > 1) gaps.resize(1);
  return gaps;
}

/// The bracket that the points leave.
void narrow(ClosingAnswer& answer) {
  answer.lower = not_a_number;
  answer.upper = std::numeric_limits<double>::infinity();
  for (const ClosingPoint& point : answer.points) {
    if (!is_known(point) || point.ignited) {
      answer.upper = point.ignited ? point.gap : not_a_number;
      return;
    }
    answer.lower = point.gap;
  }
}

/// Why the worst corner of a gap is not looked at; empty where it is.
std::string why_without_corner(const scene::Scene& scene) {
  if (scene.surface.opens_by_cooling)
    return "how far cooling has opened the gap is not known, and a thicker one is not looked at";
  for (const std::string& body : scene::bodies_at_the_charge(scene)) {
    const auto faces = std::ranges::find(scene.interfaces, body, &scene::Interface::body);
    if (faces == scene.interfaces.end() || faces->condition != scene::Condition::sliding)
      return fmt::format("the charge is bonded to \"{}\", and when that lets go is not looked at", body);
  }
  return {};
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
      for (std::size_t i = first; i < terms.size() && terms[i].air_flow == terms[first].air_flow; ++i)
        launches.push_back({&search, &terms[i], gap});
    }
  return launches;
}

/// What launches say, by their identity.
using KnownLaunches = std::map<std::string, ClosingPoint>;

/// Computes those launches that are not known, and takes all of them in.
void add_points(const StudyFile& study, const std::vector<Asked>& launches, const RunBatch& run,
                KnownLaunches& known) {
  std::vector<PlannedRun> runs;
  std::vector<ClosingPoint*> points;
  std::vector<const ClosingPoint*> point_of_launch;
  for (const Asked& each : launches) {
    const auto make = [&study, each] {
      return run_on(study.cases[each.search->index], *each.terms, each.gap);
    };
    const CaseRun asked = make();
    const auto [found, is_new] = known.try_emplace(asked.hash);
    point_of_launch.push_back(&found->second);
    if (!is_new) continue;
    runs.push_back({make, cost_of(asked)});
    points.push_back(&found->second);
  }
  const auto makers = runs;
  run(std::move(runs),
      [&](std::size_t i, const FinishedRun& finished) { *points[i] = point_of(makers[i].make(), finished); });
  for (std::size_t i = 0; i < launches.size(); ++i) {
    const Search& search = *launches[i].search;
    const ClosingPoint launch =
        with_share(*point_of_launch[i], study.cases[search.index], *launches[i].terms);
    std::vector<ClosingPoint>& points_of_gaps = search.answer->points;
    const auto point = std::ranges::find(points_of_gaps, launches[i].gap, &ClosingPoint::gap);
    point == points_of_gaps.end() ? points_of_gaps.push_back(launch) : join(launch, *point);
  }
}

/// One of which nothing can be said at any gap.
void leave_unknown(const Search& search) {
  for (const double gap : search.scanned) {
    ClosingPoint& point = search.answer->points.emplace_back();
    point.gap = gap;
    point.unknown_for = search.bound.unknown_for;
  }
  narrow(*search.answer);
}

}  // namespace

std::vector<materials::KineticsParameters> kinetics_of(const scene::Scene& scene) {
  const materials::KineticsParameters& own = scene.charge().kinetics;
  std::vector<materials::KineticsParameters> kinetics{own};
  for (const scene::Decomposition& each : scene::shipped_decompositions()) {
    kinetics.push_back(each.kinetics);
    kinetics.back().name = each.name;
    kinetics.back().ignition_temperature = own.ignition_temperature;
    kinetics.back().burnt_temperature = own.burnt_temperature;
  }
  const auto heats_more = [&](const materials::KineticsParameters& a,
                              const materials::KineticsParameters& b) {
    const auto at = [&](double kelvin) {
      return arrhenius_heating(a, 1.0, kelvin) >= arrhenius_heating(b, 1.0, kelvin);
    };
    return at(scene.initial_temperature) && at(own.ignition_temperature);
  };
  std::vector<materials::KineticsParameters> counting;
  for (const materials::KineticsParameters& each : kinetics) {
    const auto outdoes = [&](const auto& other) { return heats_more(other, each); };
    if (std::ranges::any_of(counting, outdoes)) continue;
    std::erase_if(counting, [&](const auto& other) { return heats_more(each, other); });
    counting.push_back(each);
  }
  return counting;
}

std::vector<ClosingBound> closing_bounds(const StudyCase& input, bool with_corner) {
  using scene::GapBase;
  const scene::Scene& scene = input.scene.scene;
  const scene::Surface& own = *input.closing;
  const ClosingTerms insulated{GapBase::insulated, own.roughness, own.release, own.release_duration,
                               own.air_flow};
  ClosingTerms conducting = insulated, melting = insulated, smooth = insulated;
  conducting.base = GapBase::conducting;
  melting.melts = true;
  smooth.roughness = std::min(smoothest, own.roughness);
  if (!(own.release_duration && *own.release_duration < scene::transit_time(scene)))
    smooth.release_duration.reset();
  std::vector<ClosingBound> bounds{{"conducting", {conducting}}, {"insulated", {insulated}}};
  if (with_corner) {
    std::vector<double> releases{0.0, own.release};
    for (const double share : release_shares) releases.push_back(time_at_share(scene.load, share));
    std::sort(releases.begin(), releases.end());
    releases.erase(std::unique(releases.begin(), releases.end()), releases.end());
    ClosingBound flowing{"flowing", {smooth, smooth}}, corner{"corner", {}, why_without_corner(scene)};
    flowing.terms.front().air_flow = scene::AirFlow::trapped;
    flowing.terms.back().air_flow = scene::AirFlow::common_pressure;
    for (ClosingTerms terms : flowing.terms)
      for (const double release : releases) {
        terms.release = release;
        corner.terms.push_back(terms);
      }
    bounds.push_back({"melting", {melting}});
    bounds.push_back({"smooth", {smooth}});
    bounds.push_back(std::move(flowing));
    bounds.push_back(std::move(corner));
  }
  const std::vector<materials::KineticsParameters> kinetics = kinetics_of(scene);
  for (ClosingBound& bound : bounds) {
    const std::vector<ClosingTerms> terms = std::exchange(bound.terms, {});
    for (ClosingTerms each : terms)
      for (const materials::KineticsParameters& pair : kinetics) {
        each.kinetics = pair;
        bound.terms.push_back(each);
      }
  }
  return bounds;
}

const ClosingPoint* ClosingAnswer::at(double gap) const {
  const auto found = std::ranges::find_if(
      points, [gap](const ClosingPoint& point) { return std::abs(point.gap - gap) < same_gap; });
  return found == points.end() ? nullptr : &*found;
}

std::vector<std::vector<ClosingAnswer>> find_closing_gaps(const StudyFile& study,
                                                          const std::vector<std::size_t>& cases,
                                                          const RunBatch& run,
                                                          const std::function<void(std::size_t)>& on_done) {
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
  std::set<std::size_t> open(cases.begin(), cases.end());
  while (!open.empty()) {
    const std::vector<Asked> launches = launches_of(study.study, searches);
    std::set<std::size_t> sought;
    for (const Asked& each : launches) sought.insert(each.search->index);
    for (const std::size_t index : open)
      if (!sought.contains(index)) on_done(index);
    open = std::move(sought);
    add_points(study, launches, run, known);
    for (const Search& search : searches) {
      std::ranges::sort(search.answer->points, {}, &ClosingPoint::gap);
      narrow(*search.answer);
    }
  }
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
  constexpr double infinite = std::numeric_limits<double>::infinity();
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
    evidence.corner_margin = -infinite;
  } else if (corner_known) {
    evidence.corner_margin = ignition_temperature - worst->maximum_temperature;
    evidence.numerical = worst->at_most - worst->maximum_temperature;
  }
  return evidence;
}

CriticalGap critical_gap_of(const ClosingAnswer& answer) {
  CriticalGap gap;
  gap.lower = answer.lower;
  gap.upper = answer.upper;
  if (std::isnan(answer.upper)) {
    gap.reason.code = GapReason::Code::undefined;
  } else if (std::isinf(answer.upper)) {
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
