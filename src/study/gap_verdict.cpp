#include "launchsafe/study/gap_verdict.hpp"

#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/study/verdict.hpp"
#include "launchsafe/surface/skin.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace launchsafe::study {
namespace {

using keys::ActsOn;

/// Whether a key acts on the skin of a given trace, or in proportion to what the trace holds.
bool is_of_skin(const std::string& key) {
  constexpr std::array felt{ActsOn::trace, ActsOn::heat, ActsOn::conduction, ActsOn::surface};
  return std::ranges::find(felt, scene::role_of(key).acts_on) != felt.end();
}

}  // namespace

std::vector<std::string> skin_keys(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys;
  for (const scene::Implausible& each : to_be_accepted) {
    if (is_of_skin(each.key)) keys.push_back(each.key);
    // Any of the three may be the one that is wrong.
    if (each.key == "gap.gas_law")
      keys.insert(keys.end(), {"gap.air_temperature", "gap.air_pressure", "gap.air_density"});
  }
  return keys;
}

std::vector<std::string> keys_as_calibrated(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys = skin_keys(to_be_accepted);
  if (!keys.empty()) keys.insert(keys.begin(), "");
  for (const scene::Implausible& each : to_be_accepted)
    if (scene::role_of(each.key).acts_on == ActsOn::chemistry) keys.push_back(each.key);
  return keys;
}

scene::Scene with_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                             const std::vector<std::string>& keys) {
  scene::Scene changed = scene;
  for (const std::string& name : keys) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    key.set(changed, key.get(calibrated));
  }
  if (std::ranges::find(keys, "charge.sliding_friction") != keys.end())
    changed.surface.localisation *= calibrated.charge().sliding_friction / scene.charge().sliding_friction;
  return changed;
}

std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const std::vector<scene::Implausible>& to_be_accepted,
                                        const trace::BottomTrace& trace, double gap) {
  std::vector<AsCalibrated> all;
  for (const std::string& key : keys_as_calibrated(to_be_accepted)) {
    const std::vector<std::string> keys = key.empty() ? skin_keys(to_be_accepted) : std::vector{key};
    const scene::Scene changed = with_calibrated(scene, calibrated, keys);
    const auto skin = surface::integrate_skin(surface::skin_model(changed), trace, gap);
    all.push_back({key, surface::maximum_at_stations(skin, trace).temperature, skin.ignition.has_value()});
  }
  return all;
}

double margin_as_calibrated(const std::vector<AsCalibrated>& all, double ignition_temperature) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const AsCalibrated& each : all)
    if (each.key.empty()) return each.ignites ? -infinity : ignition_temperature - each.temperature;
  return infinity;
}

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

double GapVerdict::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return until_exit.temperature - reference->maximum_temperature;
}

double GapVerdict::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

void judge_rows(const Study& study, const std::shared_ptr<const CaseEvidence>& of_case,
                const CriticalGap& critical, std::vector<GapVerdict>& rows) {
  const std::optional<PressureInterval>& around = of_case->input.model_form.around;
  for (GapVerdict& row : rows) {
    Evidence& evidence = row.evidence;
    evidence.of_case = of_case;
    evidence.ignited = row.ignition.has_value();
    evidence.gap = row.gap;
    evidence.maximum_temperature = row.maximum.temperature;
    evidence.margin = row.margin;
    evidence.uncertainty = row.uncertainty.total();
    evidence.calibrated_margin =
        margin_as_calibrated(row.as_calibrated, row.margin + row.maximum.temperature);
    evidence.noise = row.uncertainty.load_curve;
    if (around) evidence.models = models_that_differ(*study.model_form, *around, row.gap, evidence.ignited);
    row.judgement = judge(evidence, critical);
  }
}

std::string reason_text(const GapVerdict& row) { return reason_text(row.evidence, row.judgement); }

double largest_safe_gap(const std::vector<GapVerdict>& rows) {
  double largest = not_a_number, first_other = no_ignition;
  for (const GapVerdict& each : rows)
    if (each.judgement.verdict != Verdict::safe) first_other = std::min(first_other, each.gap);
  for (const GapVerdict& each : rows)
    if (each.gap < first_other && !(each.gap <= largest)) largest = each.gap;
  return largest;
}

}  // namespace launchsafe::study
