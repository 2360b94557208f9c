#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/record_reader.hpp"

namespace launchsafe::study {
namespace {

using nlohmann::ordered_json;

/// Neighbouring recorded pressures that are further apart than this ratio tell nothing of those between.
constexpr double widest_interval = 1.15;

std::optional<PressureInterval> interval_of(const std::vector<double>& pressures, double peak) {
  constexpr double round_off = 1e-9;
  const auto is_there = [&](double pressure) { return std::abs(pressure - peak) <= round_off * peak; };
  const auto place = [&](auto found) { return static_cast<std::size_t>(found - pressures.begin()); };
  const auto there = std::ranges::find_if(pressures, is_there);
  if (there != pressures.end()) return PressureInterval{place(there), place(there)};
  const auto above = std::ranges::upper_bound(pressures, peak);
  if (above == pressures.begin() || above == pressures.end()) return std::nullopt;
  return PressureInterval{place(above) - 1, place(above)};
}

/// The shift at one recorded pressure. NaN where it is not known: where the default has a bound alone, how
/// far another one lies is not known, and where no other model counts, nothing was compared.
ModelFormShift shift_at(const ModelFormRecord& record, std::size_t pressure) {
  const ModelFormShift unknown{math::not_a_number, math::not_a_number, {}};
  const GapOrBound own = record.critical_gap[pressure];
  if (!(own > 0.0) || own == no_ignition) return unknown;
  bool compared = false;
  ModelFormShift most;
  for (const ModelAlternative& each : record.alternatives) {
    if (!each.not_counted.empty()) continue;
    compared = true;
    const GapOrBound other = each.critical_gap[pressure];
    if (other == no_ignition) {
      most.later = no_ignition;
      continue;
    }
    most.gap = larger_bound(most.gap, own - other);
    most.later = larger_bound(most.later, other - own);
  }
  return compared ? most : unknown;
}

double peak_of(const scene::Scene& scene) { return scene::PressureHistory(scene.load).stated_peak(); }

/// Why a record says nothing of a scene; empty where it does. Over the initial temperature it is not carried:
/// a colder launch ignites at a gap beyond the rows that all models are calibrated on, and there they part.
std::string why_outside(const ModelFormRecord& record, const scene::Scene& scene) {
  const auto other = distance_to_record(RecordKind::model_form, scene, record.scene).names();
  if (!other.empty()) return fmt::format("it was made for another launch ({})", fmt::join(other, ", "));
  if (const auto interval = interval_of(record.peak_pressures, peak_of(scene))) {
    const double below = record.peak_pressures[interval->below],
                 above = record.peak_pressures[interval->above];
    if (above <= widest_interval * below) return {};
    return fmt::format("it has no peak pressure between {:.4g} and {:.4g} MPa", 1e-6 * below, 1e-6 * above);
  }
  return fmt::format("it was made from {:.4g} to {:.4g} MPa", 1e-6 * record.peak_pressures.front(),
                     1e-6 * record.peak_pressures.back());
}

constexpr RecordFormat model_form_format{"launchsafe model form 1", "model_form.json", "calibrated models"};
constexpr const char* no_ignition_text = "none";

/// One for every pressure; null where it is not a number.
void describe_gaps(RecordObject& object, std::vector<GapOrBound>& gaps, std::size_t pressures) {
  const std::string key = "critical_gap_m";
  ordered_json& list = object[key];
  if (!object.reading()) {
    list = ordered_json::array();
    for (const GapOrBound gap : gaps)
      list.push_back(gap == no_ignition ? ordered_json(no_ignition_text) : ordered_json(gap));
    return;
  }
  if (!list.is_array() || list.size() != pressures)
    object.refuse(key, "another number of values", fmt::format("{} critical gaps", pressures));
  for (const ordered_json& each : list) {
    const double other = each == no_ignition_text ? no_ignition : math::not_a_number;
    gaps.push_back(each.is_number() ? each.get<double>() : other);
  }
}

void describe_alternative(RecordObject& object, ModelAlternative& each, std::size_t pressures) {
  object.value("name", each.name);
  object.value("title", each.title);
  object.value("not_counted", each.not_counted);
  describe_gaps(object, each.critical_gap, pressures);
}

void describe_model_form(RecordObject& object, ModelFormRecord& record) {
  object.model_version("make it anew");
  object.scene(record.scene, "a scene");
  std::vector<double>& pressures = record.peak_pressures;
  object.value("peak_pressures_Pa", pressures);
  describe_gaps(object, record.critical_gap, pressures.size());
  object.list("alternatives", record.alternatives, [&](RecordObject& own, ModelAlternative& each) {
    describe_alternative(own, each, pressures.size());
  });
}

}  // namespace

scene::Limits compared_pressures(const std::optional<ModelFormRecord>& record) {
  constexpr double lowest = 400e6, highest = 550e6;
  if (!record || record->peak_pressures.empty()) return scene::between(lowest, highest);
  return scene::between(record->peak_pressures.front(), record->peak_pressures.back());
}

ModelFormShift model_form_shift(const ModelFormRecord& record, const scene::Scene& scene) {
  if (std::string reason = why_outside(record, scene); !reason.empty())
    return {math::not_a_number, math::not_a_number, std::move(reason)};
  const PressureInterval around = *interval_of(record.peak_pressures, peak_of(scene));
  const ModelFormShift below = shift_at(record, around.below), above = shift_at(record, around.above);
  const double sooner = larger_bound(below.gap, above.gap), later = larger_bound(below.later, above.later);
  if (std::isnan(sooner))
    return {sooner, later,
            "it has no critical gap of the default model, or no other model that counts, there", around};
  return {sooner, later, {}, around};
}

std::vector<std::string> models_that_differ(const ModelFormRecord& record, const PressureInterval& around,
                                            double gap, bool ignites) {
  const auto differs = [&](const ModelAlternative& each, GapOrBound critical) {
    return ignites ? !(critical <= gap) : !each.not_counted.empty() && !(critical > gap);
  };
  std::vector<std::string> titles;
  for (const ModelAlternative& each : record.alternatives)
    if (differs(each, each.critical_gap[around.below]) || differs(each, each.critical_gap[around.above]))
      titles.push_back(each.title.empty() ? each.name : each.title);
  return titles;
}

std::string to_json_text(const ModelFormRecord& record) {
  return record_text(model_form_format, describe_model_form, record);
}

scene::Expected<ModelFormRecord> parse_model_form(const std::string& text, const std::string& file) {
  return parse_record<ModelFormRecord>(text, file, model_form_format, describe_model_form);
}

}  // namespace launchsafe::study
