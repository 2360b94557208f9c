#include "launchsafe/study/calibration_record.hpp"

#include "launchsafe/study/record_reader.hpp"

namespace launchsafe::study {
namespace {

using scene::above_to, scene::between;

constexpr double round_off_of_units = 1e-9;

/// Whether a number lies within those of the firings.
bool is_between(double value, const std::vector<Firing>& firings, double Firing::*number) {
  const auto [lowest, highest] = std::ranges::minmax_element(firings, {}, number);
  return lowest != firings.end() && value >= (*lowest).*number * (1.0 - round_off_of_units) &&
         value <= (*highest).*number * (1.0 + round_off_of_units);
}

constexpr RecordFormat calibration_format{"launchsafe calibration record 3", "calibration.json",
                                          "a study of kind calibration"};

void describe_calibration(RecordObject& object, CalibrationRecord& record) {
  object.value("title", record.title);
  object.model_version("make the calibration anew");
  object.value("failure", record.failure);
  object.scene(record.calibration.scene, "the calibrated scene");
  object.value("load_fitted", record.load_fitted);
  object.value("references_sha256", record.references_digest);
  CalibrationEvidence& evidence = record.calibration.evidence;
  if (object.reading() && !record.failure.empty()) {
    evidence = no_evidence;
    return;
  }
  const OrNone temperature_or_none{between(0, 1e4)};
  object.value("friction_rise_K", evidence.friction_rise, above_to(0, 5000));
  object.value("air_rise_K", evidence.air_rise, above_to(0, 5000));
  object.value("largest_gap_m", evidence.largest_gap, above_to(0, 0.01));
  object.value("misfits", record.misfits, 0, 1000);
  object.value("misfit_bound_K", record.misfit_bound, temperature_or_none);
  object.value("fit_uncertainty_K", evidence.fit_uncertainty, between(0, 1e4));
  constexpr std::size_t entries = fitted_keys.size() * fitted_keys.size();
  const std::size_t expected = record.load_fitted ? entries : 0;
  object.value("covariance_of_logarithms", record.covariance, between(-1e4, 1e4), expected, expected);
  object.value("ignition_lowest_K", record.ignition_lowest, above_to(0, 5000));
  object.value("ignition_highest_K", record.ignition_highest, above_to(record.ignition_lowest, 5000));
  object.value("selection_rms_K", record.selection_root_mean_square, temperature_or_none);
  object.value("station_change_to_finer_K", record.stations.finer, temperature_or_none);
  object.value("station_change_from_coarser_K", record.stations.coarser, temperature_or_none);
}

/// Those of format 1 may have started from constants at a guess.
constexpr RecordFormat firing_format{"launchsafe firing record 2", "calibration.json",
                                     "a study of kind calibration with firings"};
constexpr std::size_t most_firings = 1000, most_points = 10'000;

void describe_firing(RecordObject& object, Firing& firing) {
  object.value("name", firing.name);
  object.value("ignited", firing.ignited);
  object.value("rounds", firing.rounds, 1, most_rounds);
  object.value("pressure_Pa", firing.pressure, above_to(0, 10e9));
  object.value("pressure_spread_Pa", firing.pressure_spread, between(0, 10e9));
  object.value("temperature_K", firing.temperature, above_to(0, 1000));
  object.value("temperature_spread_K", firing.temperature_spread, between(0, 1000));
  object.value("gap_m", firing.gap, between(0, 0.01));
  object.value("most_gap_m", firing.most_gap, between(firing.gap, 0.01));
}

/// Number by number over all points; each list as long as the others.
void describe_posterior(RecordObject& object, Posterior& posterior) {
  constexpr double largest = std::numeric_limits<double>::max();
  std::size_t points = posterior.size();
  const auto describe = [&](const char* key, auto member) {
    auto numbers = of_each(posterior, [&](PosteriorPoint each) { return member(each); });
    const bool first = object.reading() && points == 0;
    object.value(key, numbers, above_to(0, largest), first ? 1 : points, first ? most_points : points);
    points = numbers.size();
    posterior.resize(points);
    for (std::size_t i = 0; i < points; ++i) member(posterior[i]) = numbers[i];
  };
  describe("localisation", [](PosteriorPoint& each) -> double& { return each.constants.localisation; });
  describe("exchange_time_s", [](PosteriorPoint& each) -> double& { return each.constants.exchange_time; });
  describe("ignition_temperature_K",
           [](PosteriorPoint& each) -> double& { return each.constants.ignition_temperature; });
  describe("scatter", [](PosteriorPoint& each) -> double& { return each.scatter; });
}

void describe_firing_record(RecordObject& object, CalibrationRecord& record) {
  object.value("title", record.title);
  object.model_version("make the calibration anew");
  object.scene(record.calibration.scene, "the calibrated scene");
  CalibrationEvidence& evidence = record.calibration.evidence;
  object.value("friction_rise_K", evidence.friction_rise, above_to(0, 5000));
  object.value("air_rise_K", evidence.air_rise, between(0, 5000));
  object.value("largest_gap_m", evidence.largest_gap, between(0, 0.01));
  object.value("fit_uncertainty_K", evidence.fit_uncertainty, between(0, 1e4));
  FiringEvidence firings = record.calibration.firings ? *record.calibration.firings : FiringEvidence{};
  object.value("demonstration", firings.demonstration);
  object.list("firings", firings.firings, 1, most_firings, "1 to 1000 firings", describe_firing);
  object.part("posterior", firings.posterior, describe_posterior);
  object.part("posterior_of_doubled_prior", firings.of_doubled_prior, describe_posterior);
  record.calibration.firings = std::make_shared<const FiringEvidence>(std::move(firings));
}

/// Of this format or an earlier one, which is refused as such.
bool is_firing_record(const std::string& text) {
  return text.find("launchsafe firing record") != std::string::npos;
}

constexpr std::array constants{"friction.localisation", "gap.exchange_time", "kinetics.ignition_temperature"};
constexpr std::array load_shape{"load.shape", "load.peak_time", "load.width", "load.steepness"};

/// Whether the scene and the study leave the shape of the load to the calibration, which fitted one or has
/// that of its firings: one that they state stays, and the constants are carried to it as to any other.
bool takes_load(const StudyFile& study, const CalibrationRecord& record) {
  const auto is_stated = [&](const char* key) {
    return study.scene.given.contains(key) || study.overrides.contains(key);
  };
  return (record.load_fitted || record.calibration.firings) &&
         record.calibration.scene.load.curve_time.empty() && study.scene.scene.load.curve_time.empty() &&
         std::ranges::none_of(load_shape, is_stated);
}

/// Refuses a constant to which the study's scene gives another value than the record.
void check_constants(const StudyFile& study, const scene::Scene& calibrated) {
  constexpr double digits = 1e-3;  // scenes round what a calibration found
  for (const std::string name : constants) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    const scene::Value record = key.get(calibrated), own = key.get(study.scene.scene);
    if (study.overrides.contains(name))
      refuse_at(study, "calibration", "a calibration beside [set] " + name,
                "either a calibration or its constants in [set]");
    const double wanted = std::get<double>(record), found = std::get<double>(own);
    if (!study.scene.given.contains(name) || std::abs(found - wanted) <= digits * std::abs(wanted)) continue;
    refuse_at(study, "calibration",
              fmt::format("{} {} in the scene and {} in the record", name, scene::format_value(key, own),
                          scene::format_value(key, record)),
              "constants from one of both: leave " + name + " out of the scene, or name no calibration");
  }
}

/// A constant's uncertainty may be stated larger than its record shows, not smaller.
void settle_fit_uncertainty(StudyFile& study, const CalibrationRecord& record) {
  const double shown = record.calibration.evidence.fit_uncertainty;
  double& stated = study.study.fit_uncertainty;
  if (std::isnan(stated)) stated = shown;
  if (!(stated >= shown))
    refuse_at(study, "fit_uncertainty.value",
              fmt::format("{:.3g} K, and {:.3g} K in the record of the calibration", stated, shown),
              "no less than the record shows, or no fit_uncertainty, which takes it");
}

}  // namespace

scene::Scene calibration_scene() {
  scene::Scene scene;
  scene.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  for (const char* body : {"nose", "wall"})
    scene.interfaces.push_back({.body = body, .condition = scene::Condition::sliding, .friction = 0.0});
  scene.load.muzzle_exit = 18e-3;  // where the published rows are read
  scene.numerics.cell_size = 1.25e-3;
  scene.numerics.growth_x = scene.numerics.growth_r = 1.3;
  scene.numerics.largest_cell = 20e-3;
  scene.numerics.time_step_factor = 0.65;
  scene.numerics.selective_inertia = 4.0;
  return scene;
}

Calibration shipped_calibration() { return {calibration_scene(), {}}; }

double fired_pressure(const scene::Load& load) {
  const bool is_scaled = load.curve_time.empty() || load.rescale_to_peak;
  return is_scaled ? load.peak : scene::PressureHistory(load).stated_peak();
}

double calibrated_gap(const std::vector<Firing>& firings, double pressure, double temperature) {
  const auto at_least = [](double value, double other) {
    return value >= other * (1.0 - round_off_of_units);
  };
  double ignites = math::infinity;
  for (const Firing& each : firings)
    if (each.ignited && at_least(pressure, each.pressure) && at_least(temperature, each.temperature))
      ignites = std::min(ignites, each.gap);
  const auto is_as_severe = [&](const Firing& each) {
    return !each.ignited && at_least(each.pressure, pressure) && at_least(each.temperature, temperature) &&
           each.gap < ignites;
  };
  double largest = -1.0;
  for (const Firing& candidate : firings) {
    int rounds = 0;
    for (const Firing& each : firings)
      if (is_as_severe(each) && each.gap >= candidate.gap) rounds += each.rounds;
    if (is_as_severe(candidate) && rounds >= fewest_rounds) largest = std::max(largest, candidate.gap);
  }
  return largest;
}

double calibrated_gap(const Calibration& calibration, const scene::Scene& scene) {
  if (!calibration.firings) return calibration.evidence.largest_gap;
  return calibrated_gap(calibration.firings->firings, fired_pressure(scene.load), scene.initial_temperature);
}

RecordDistance distance_to_calibration(const scene::Scene& scene, const Calibration& calibration) {
  if (!calibration.firings) return distance_to_record(RecordKind::calibration, scene, calibration.scene);
  scene::Scene recorded = calibration.scene;
  const std::vector<Firing>& firings = calibration.firings->firings;
  const double pressure = fired_pressure(scene.load);
  if (is_between(pressure, firings, &Firing::pressure)) recorded.load.peak = scene.load.peak;
  // The air of the gap has the temperature of the charge.
  recorded.surface.air =
      materials::warmed(recorded.surface.air, scene.initial_temperature - recorded.initial_temperature);
  if (is_between(scene.initial_temperature, firings, &Firing::temperature))
    recorded.initial_temperature = scene.initial_temperature;
  return distance_to_record(RecordKind::firings, scene, recorded);
}

bool StationConvergence::converges() const {
  constexpr double most = 3.0, small = 1.0;  // K
  return finer <= most && (finer <= coarser || finer < small);
}

std::string to_json_text(const CalibrationRecord& record) {
  return record_text(record.calibration.firings
                         ? content_by(firing_format, describe_firing_record, record)
                         : content_by(calibration_format, describe_calibration, record));
}

scene::Expected<CalibrationRecord> parse_either_calibration(const std::string& text,
                                                            const std::string& file) {
  return is_firing_record(text)
             ? parse_record<CalibrationRecord>(text, file, firing_format, describe_firing_record)
             : parse_record<CalibrationRecord>(text, file, calibration_format, describe_calibration);
}

scene::Expected<CalibrationRecord> parse_calibration_record(const std::string& text,
                                                            const std::string& file) {
  if (is_firing_record(text))
    return scene::error_at({file}, "format", "the record of a calibration on firings",
                           "the record of a calibration on published results");
  return parse_either_calibration(text, file);
}

void use_calibration(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.calibration_record;
  if (name.empty()) return;
  const auto record = read_named_record(study, folder, "calibration", name,
                                        "the calibration.json of a calibration", parse_either_calibration);
  if (record.calibration.firings && !study.study.kind.gives_verdicts)
    refuse_at(study, "calibration",
              "a calibration on firings, of whose constants a study of this kind would take one value",
              "the record of a calibration on published results");
  if (!record.failure.empty())
    refuse_at(study, "calibration", "a record without constants: " + record.failure,
              "the record of a calibration that meets its rows");
  check_constants(study, record.calibration.scene);
  std::vector<std::string> keys(constants.begin(), constants.end());
  if (takes_load(study, record)) keys.insert(keys.end(), load_shape.begin(), load_shape.end());
  Setting values;
  for (const std::string& key : keys) {
    const auto& known = *scene::find_key(scene::scene_keys(), key);
    values[key] = known.get(record.calibration.scene);
    study.overrides[key] = scene::format_value(known, values[key]);
  }
  set_keys(study, values, "calibration");
  study.study.calibration = record.calibration;
  const auto& firings = study.study.calibration.firings;
  study.study.demonstration |= firings && firings->demonstration;
  settle_fit_uncertainty(study, record);
}

void read_model_form(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.model_form_record;
  if (name.empty()) return;
  if (std::isfinite(study.study.model_form_uncertainty))
    refuse_at(study, "model_form_uncertainty.value", "a stated uncertainty beside a record of other models",
              "either model_form_uncertainty or model_form");
  study.study.model_form =
      read_named_record(study, folder, "model_form", name,
                        "the model_form.json of a comparison of calibrated models", parse_model_form);
}

}  // namespace launchsafe::study
