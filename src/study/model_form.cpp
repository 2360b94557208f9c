#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/record_reader.hpp"

#include <set>

namespace launchsafe::study {
namespace {

using namespace std::string_literals;
using nlohmann::ordered_json;

/// K; a model whose stations move by more from the scene's mesh to a finer one has no limit that is known.
constexpr double most_station_change = 3.0;

/// Neighbouring recorded pressures that are further apart than this ratio tell nothing of those between.
constexpr double widest_interval = 1.15;

std::string why_not_counted(const CalibrationRecord& calibration) {
  if (!calibration.failure.empty()) return "no calibration: " + calibration.failure;
  if (calibration.stations.finer > most_station_change)
    return fmt::format("no limit of meshes: a station changes by {:.3g} K", calibration.stations.finer);
  return {};
}

bool is_unknown(double gap) { return std::isnan(gap); }

/// The tables of keys in which an entry is another model than the default.
std::set<std::string> changed_tables(const ModelFormEntry& own, const ModelFormEntry& other) {
  std::set<std::string> tables;
  for (const Difference& each : differences(other.scene, own.scene)) {
    const std::string& key = each.key.name;
    if (each.key.role().part == keys::Part::model)
      tables.insert(key == scene::foreign_interfaces ? "interface" : key.substr(0, key.find('.')));
  }
  return tables;
}

/// Why a model cannot stand in a record: its scene is not that of its calibration, or it is no alternative to
/// the default: a copy of it, or a model of another launch, or one that was calibrated on other published
/// rows, or without a finer mesh to compare with, or it would count and has a critical gap that is not known.
std::string why_unfit(const ModelFormEntry& own, const ModelFormEntry& other, std::size_t pressures) {
  const bool calibrated = other.calibration->failure.empty();
  const RecordDistance distance =
      distance_to_record(RecordKind::calibration, other.scene, other.calibration->calibration.scene);
  if (calibrated && !distance.inside())
    return fmt::format("its sweep is not of the calibrated launch ({})", fmt::join(distance.names(), ", "));
  if (other.critical_gap.size() != pressures) return "other peak pressures than " + own.name;
  if (&own == &other) return {};
  std::vector<std::string> of_launch;
  for (const Difference& each : differences(other.scene, own.scene)) {
    // Every model has its own load and constants, and may have its own numerics.
    const keys::Part part = each.key.role().part;
    if (part == keys::Part::constant || part == keys::Part::range) of_launch.push_back(each.key.name);
  }
  if (!of_launch.empty()) return fmt::format("it is of another launch ({})", fmt::join(of_launch, ", "));
  if (changed_tables(own, other).empty()) return "it is the same model as " + own.name;
  if (own.calibration->references_digest != other.calibration->references_digest)
    return "it was calibrated on other published rows than " + own.name;
  if (calibrated && !std::isfinite(other.calibration->stations.finer))
    return "its calibration has no finer mesh to compare stations with (meshes)";
  if (why_not_counted(*other.calibration).empty() && std::ranges::any_of(other.critical_gap, is_unknown))
    return "a critical gap is not known";
  return {};
}

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
constexpr double widest_critical_gap = 0.01;  ///< m
constexpr std::size_t most_pressures = 1000;
constexpr std::size_t most_alternatives = 1000;

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
    object.refuse(key, found_in(list), fmt::format("{} critical gaps", pressures));
  for (const ordered_json& each : list) {
    double& gap = gaps.emplace_back(no_ignition);
    if (each != no_ignition_text) object.read(each, key, gap, OrNone{scene::between(0, widest_critical_gap)});
  }
}

void describe_alternative(RecordObject& object, ModelAlternative& each, std::size_t pressures) {
  object.value("name", each.name);
  object.value("title", each.title);
  object.value("not_counted", each.not_counted);
  describe_gaps(object, each.critical_gap, pressures);
  if (object.reading() && each.not_counted.empty() && std::ranges::any_of(each.critical_gap, is_unknown))
    object.refuse("critical_gap_m", "null", "known critical gaps of a model that counts");
}

void describe_model_form(RecordObject& object, ModelFormRecord& record) {
  object.model_version("make it anew");
  object.scene(record.scene, "a scene");
  std::vector<double>& pressures = record.peak_pressures;
  object.value("peak_pressures_Pa", pressures, scene::above_to(0, 10e9), 1, most_pressures);
  const auto falls = std::ranges::adjacent_find(pressures, std::greater_equal{});
  if (object.reading() && falls != pressures.end())
    object.refuse("peak_pressures_Pa", fmt::format("{:g} after {:g}", falls[1], falls[0]),
                  "increasing pressures");
  describe_gaps(object, record.critical_gap, pressures.size());
  object.list(
      "alternatives", record.alternatives, 1, most_alternatives, "1 to 1000 alternatives",
      [&](RecordObject& own, ModelAlternative& each) { describe_alternative(own, each, pressures.size()); });
}

}  // namespace

scene::Expected<ModelFormRecord, std::string> make_model_form(const std::vector<ModelFormEntry>& entries,
                                                              std::vector<double> peak_pressures) {
  if (entries.size() < 2) return "a record needs the default model and at least one alternative"s;
  const ModelFormEntry& own = entries.front();
  ModelFormRecord record;
  record.scene = own.scene;
  record.peak_pressures = std::move(peak_pressures);
  record.critical_gap = own.critical_gap;
  if (!std::isfinite(own.calibration->stations.finer))
    return own.name + " cannot be the default: its calibration has no finer mesh to compare stations with";
  if (const std::string reason = why_not_counted(*own.calibration); !reason.empty())
    return fmt::format("{} cannot be the default: {}", own.name, reason);
  // Those of the shipped models: any of them may ignite earliest.
  std::set<std::string> not_compared{"charge", "friction", "interface", "station"};
  for (const ModelFormEntry& each : entries) {
    if (const auto reason = why_unfit(own, each, record.peak_pressures.size()); !reason.empty())
      return fmt::format("{}: {}", each.name, reason);
    const std::set<std::string> changed = changed_tables(own, each);
    if (changed.size() == 1) not_compared.erase(*changed.begin());
    if (&each != &own)
      record.alternatives.push_back(
          {each.name, each.title, why_not_counted(*each.calibration), each.critical_gap});
  }
  if (!not_compared.empty())
    return fmt::format("no alternative is another model in [{}] alone",
                       fmt::join(not_compared, "] alone, nor in ["));
  return record;
}

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
  return record_text(content_by(model_form_format, describe_model_form, record));
}

scene::Expected<ModelFormRecord> parse_model_form(const std::string& text, const std::string& file) {
  return parse_record<ModelFormRecord>(text, file, model_form_format, describe_model_form);
}

}  // namespace launchsafe::study
