#include "launchsafe/study/closing_gaps.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/selective_inertia.hpp"
#include "launchsafe/study/gap_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

CaseRun run_on(const StudyCase& input, const ClosingTerms& terms, double gap) {
  scene::Scene scene = closing_scene(input);
  scene.surface.base = terms.base;
  scene.surface.roughness = terms.roughness;
  scene.surface.release = terms.release;
  scene.surface.release_duration = terms.release_duration;
  return skin_run(scene, gap, fmt::format("{}, closing from {:.6g} cm", input.label, 100.0 * gap));
}

/// Why a run says nothing: how it ended, or the first thing that warns of it. Empty for a sound one.
std::string fault_of(const scene::Scene& scene, const FinishedRun& run) {
  if (!run.failure.empty()) return run.failure;
  if (!run.has_result() || run.result.gaps.empty()) return "it was not computed";
  const std::vector<std::string> warnings = run::validity_warnings(scene, run.result.mechanics);
  return warnings.empty() ? std::string{} : warnings.front();
}

/// Takes one more run into a point: the hotter one counts, and one without a temperature leaves none.
void take(const scene::Scene& scene, const FinishedRun& run, double release, ClosingPoint& point) {
  const bool first = point.hashes.empty();
  point.hashes.push_back(run.hash);
  if (!point.unknown_for.empty()) return;
  point.unknown_for = fault_of(scene, run);
  if (!point.unknown_for.empty()) {
    point.maximum_temperature = not_a_number;
    point.place.clear();
    point.release = release;
    return;
  }
  const run::GapResult& gap = run.result.gaps.front();
  if (gap.skin.ignition) point.ignited = true;
  if (!first && gap.at_stations.temperature <= point.maximum_temperature) return;
  point.maximum_temperature = gap.at_stations.temperature;
  point.release = release;
  const trace::BottomTrace& trace = run.result.mechanics.trace;
  if (gap.at_stations.station < trace.stations.size())
    point.place = trace.stations[gap.at_stations.station].name;
}

bool is_known(const ClosingPoint& point) { return point.ignited || std::isfinite(point.maximum_temperature); }

/// The gaps to compute next, for a bound that has these points; none once its bracket is narrow enough.
std::vector<double> wanted(const Study& study, const ClosingAnswer& answer) {
  std::vector<double> gaps;
  if (answer.points.empty()) {
    gaps = study.gaps;
    for (int i = 0; i <= scan_gaps; ++i) gaps.push_back(largest_gap(study) * i / scan_gaps);
    std::sort(gaps.begin(), gaps.end());
    gaps.erase(std::unique(gaps.begin(), gaps.end(), [](double a, double b) { return b - a < same_gap; }),
               gaps.end());
  } else if (std::isfinite(answer.upper) && answer.upper - answer.lower > study.tolerance) {
    gaps.push_back(0.5 * (answer.lower + answer.upper));
  }
  return gaps;
}

/// The bracket that the points leave.
void narrow(ClosingAnswer& answer) {
  answer.lower = not_a_number;
  answer.upper = std::numeric_limits<double>::infinity();
  for (const ClosingPoint& point : answer.points) {
    if (!is_known(point)) {
      answer.lower = answer.upper = not_a_number;
      return;
    }
    if (point.ignited) {
      answer.upper = point.gap;
      return;
    }
    answer.lower = point.gap;
  }
}

/// Why the worst release of a charge is not looked at; empty where it is.
std::string bond_of(const scene::Scene& scene) {
  for (const std::string& body : scene::bodies_at_the_charge(scene)) {
    const auto faces = std::ranges::find(scene.interfaces, body, &scene::Interface::body);
    if (faces == scene.interfaces.end() || faces->condition != scene::Condition::sliding)
      return fmt::format("the charge is bonded to \"{}\", and when that lets go is not looked at", body);
  }
  return {};
}

void add_points(const StudyCase& input, const ClosingBound& bound, const std::vector<double>& gaps,
                const RunBatch& run, ClosingAnswer& answer) {
  if (!bound.unknown_for.empty()) {
    for (const double gap : gaps) {
      ClosingPoint& point = answer.points.emplace_back();
      point.gap = gap;
      point.unknown_for = bound.unknown_for;
    }
    return;
  }
  std::vector<CaseRun> runs;
  for (const double gap : gaps)
    for (const ClosingTerms& terms : bound.terms) runs.push_back(run_on(input, terms, gap));
  std::vector<scene::Scene> scenes;
  for (const CaseRun& each : runs) scenes.push_back(each.scene);
  const std::vector<FinishedRun> finished = run(std::move(runs));
  std::size_t next = 0;
  for (const double gap : gaps) {
    ClosingPoint point;
    point.gap = gap;
    for (const ClosingTerms& terms : bound.terms) {
      take(scenes[next], finished[next], terms.release, point);
      ++next;
    }
    answer.points.push_back(std::move(point));
  }
  std::ranges::sort(answer.points, {}, &ClosingPoint::gap);
  narrow(answer);
}

}  // namespace

std::vector<ClosingBound> closing_bounds(const StudyCase& input) {
  using scene::GapBase;
  const scene::Surface& own = *input.closing;
  const std::optional<double> duration = own.release_duration;
  std::vector<ClosingBound> bounds{
      {"conducting", {{GapBase::conducting, own.roughness, own.release, duration}}},
      {"insulated", {{GapBase::insulated, own.roughness, own.release, duration}}}};
  ClosingBound corner{"corner", {}, bond_of(input.scene.scene)};
  const double roughness = std::min(smoothest, own.roughness);
  std::vector<double> releases{0.0, own.release};
  for (const double share : release_shares) releases.push_back(time_at_share(input.scene.scene.load, share));
  std::sort(releases.begin(), releases.end());
  releases.erase(std::unique(releases.begin(), releases.end()), releases.end());
  const std::optional<double> fastest =
      duration && *duration < scene::transit_time(input.scene.scene) ? duration : std::nullopt;
  for (const double release : releases)
    corner.terms.push_back({GapBase::insulated, roughness, release, fastest});
  bounds.push_back(std::move(corner));
  return bounds;
}

const ClosingPoint* ClosingAnswer::at(double gap) const {
  const auto found = std::ranges::find_if(
      points, [gap](const ClosingPoint& point) { return std::abs(point.gap - gap) < same_gap; });
  return found == points.end() ? nullptr : &*found;
}

std::vector<ClosingAnswer> find_closing_gaps(const Study& study, const StudyCase& input,
                                             const RunBatch& run) {
  std::vector<ClosingAnswer> answers;
  for (const ClosingBound& bound : closing_bounds(input)) {
    ClosingAnswer answer;
    answer.name = bound.name;
    for (std::vector<double> gaps = wanted(study, answer); !gaps.empty(); gaps = wanted(study, answer))
      add_points(input, bound, gaps, run, answer);
    answers.push_back(std::move(answer));
  }
  return answers;
}

/// A thinner gap that ignites says that this one does too: T max need not rise with the gap.
ClosingEvidence closing_evidence(const std::vector<ClosingAnswer>& answers, double gap,
                                 double ignition_temperature) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  ClosingEvidence evidence;
  evidence.known = !answers.empty();
  const auto hides_a_thinner = [gap](const ClosingPoint& point) {
    return point.gap < gap && !is_known(point);
  };
  for (const ClosingAnswer& answer : answers) {
    const ClosingPoint* point = answer.at(gap);
    if (std::ranges::any_of(answer.points, hides_a_thinner)) evidence.known = false;
    if (point == nullptr || !is_known(*point)) {
      evidence.known = false;
      continue;
    }
    const bool ignites = point->ignited || answer.upper <= gap;
    if (&answer != &answers.back())
      evidence.ignited = evidence.ignited || ignites;
    else
      evidence.corner_margin = ignites ? -infinite : ignition_temperature - point->maximum_temperature;
  }
  return evidence;
}

}  // namespace launchsafe::study
