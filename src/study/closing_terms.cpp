// The terms on which a gap that closes is looked at.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::study {
namespace {

/// m, below what is made: the smoothest faces that are plausible.
constexpr double smoothest = 1e-6;
/// Of the peak pressure, at which a charge may let go; the last one after the peak. Closer about the peak,
/// where T max is highest: of the 155 mm shell between 85 % of it and itself, and far colder half a
/// millisecond later.
constexpr double release_shares[] = {0.25, 0.5, 0.75, 0.85, 0.95, 1.0};
constexpr double last_release_share = 0.95;

/// s, when a load first has a share of its peak; or last, up to twice the time of the peak.
double time_at_share(const scene::Load& load, double share, bool after_peak = false) {
  constexpr int parts = 20000;
  const scene::PressureHistory history(load);
  const double peak_time = history.peak_time(), begin = after_peak ? 2.0 * peak_time : 0.0;
  for (int i = 0; i < parts; ++i) {
    const double time = begin + (peak_time - begin) * i / parts;
    if (history.at(time) >= share * history.peak()) return time;
  }
  return peak_time;
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
  const scene::Scene& scene = input.scene.scene;
  const std::vector<materials::KineticsParameters> kinetics = kinetics_of(scene);
  std::vector<ClosingBound> bounds;
  const auto add = [&](const char* name, const std::vector<scene::Surface>& surfaces,
                       std::string unknown_for = {}) {
    bounds.push_back({name, {}, std::move(unknown_for)});
    for (const scene::Surface& surface : surfaces)
      for (const materials::KineticsParameters& each : kinetics)
        bounds.back().terms.push_back({surface, each});
  };
  scene::Surface insulated = *input.closing;
  insulated.base = scene::GapBase::insulated;
  insulated.melts = false;
  scene::Surface conducting = insulated, melting = insulated, smooth = insulated;
  conducting.base = scene::GapBase::conducting;
  add("conducting", {conducting});
  add("insulated", {insulated});
  if (!with_corner) return bounds;
  melting.melts = true;
  smooth.roughness = std::min(smoothest, smooth.roughness);
  if (!(smooth.release_duration && *smooth.release_duration < scene::transit_time(scene)))
    smooth.release_duration.reset();
  std::set<double> releases{0.0, smooth.release};
  for (const double share : release_shares) releases.insert(time_at_share(scene.load, share));
  releases.insert(time_at_share(scene.load, last_release_share, true));
  std::vector<scene::Surface> flowing{smooth, smooth}, corner;
  flowing.front().air_flow = scene::AirFlow::trapped;
  flowing.back().air_flow = scene::AirFlow::common_pressure;
  for (scene::Surface each : flowing)
    for (const double release : releases) {
      each.release = release;
      corner.push_back(each);
    }
  add("melting", {melting});
  add("smooth", {smooth});
  add("flowing", flowing);
  add("corner", corner, why_without_corner(scene));
  return bounds;
}

}  // namespace launchsafe::study
