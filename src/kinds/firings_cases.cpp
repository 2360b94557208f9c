// Firings as a file: their keys, and the launches that follow.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using scene::Dimension, scene::Key, scene::Standing;
using study::Fault, study::Firing, study::StudyFile;

namespace {

const FiringSettings& settings_in(const study::Study& study) {
  return settings_of<CalibrationSettings>(study).firings;
}

const std::vector<Key<Firing>>& firing_row_keys() {
  static const std::vector<Key<Firing>> keys{
      scene::text_key("name", Standing::input, "What the rounds are called.", "series of March",
                      &Firing::name),
      scene::required(scene::word_key("outcome", Standing::input, "How the rounds ended, all of them.",
                                      {{"no ignition", false}, {"ignition", true}}, &Firing::ignited)),
      scene::number_key("rounds", Dimension::count, scene::between(1, study::most_rounds), Standing::input,
                        "How many rounds.", &Firing::rounds),
      scene::usually(scene::number_key("pressure", Dimension::pressure, scene::above_to(0, 10e9),
                                       Standing::input, "Their mean peak pressure.", &Firing::pressure),
                     "that of the scene"),
      scene::usually(
          scene::number_key("pressure_spread", Dimension::pressure, scene::between(0, 1e9), Standing::input,
                            "Its standard deviation from round to round.", &Firing::pressure_spread),
          "2 % of it"),
      scene::usually(
          scene::number_key("temperature", Dimension::temperature, scene::between(200, 400), Standing::input,
                            "Mean temperature of charge and air.", &Firing::temperature),
          "that of the scene"),
      scene::usually(
          scene::number_key("temperature_spread", Dimension::temperature_difference, scene::between(0, 100),
                            Standing::input, "Its standard deviation from round to round.",
                            &Firing::temperature_spread),
          "6 K"),
      scene::required(scene::value_or_range(
          scene::range_key("gap", Dimension::length, scene::between(0, 0.01), Standing::input,
                           "The gap of the rounds, or between which lengths it was; then the smaller counts.",
                           &Firing::gap, &Firing::most_gap))),
  };
  return keys;
}

/// What a firing leaves out is of the scene, or assumed.
void complete(Firing& firing, const scene::Scene& scene) {
  const auto fill = [](double& number, double usual) { number = std::isnan(number) ? usual : number; };
  fill(firing.pressure, study::fired_pressure(scene.load));
  fill(firing.pressure_spread, study::assumed_load_spread / study::coverage_factor * firing.pressure);
  fill(firing.temperature, scene.initial_temperature);
  fill(firing.temperature_spread, study::assumed_temperature_spread / study::coverage_factor);
}

/// The scene under the pressure and temperature of a firing.
scene::Expected<scene::SceneFile> scene_of(const StudyFile& study, const Firing& firing, std::size_t place) {
  std::vector<study::Change> changes;
  const auto change = [&](const char* key, const char* of_firing, double value, double in_scene,
                          Dimension dimension) {
    if (study::same_number(value, in_scene)) return;
    const std::string named = fmt::format("firing.{}.{}", place, of_firing);
    changes.push_back(
        {key, value, scene::format_quantity(value, dimension), named, place_of_key(study, named)});
  };
  const scene::Scene& own = study.scene.scene;
  change("load.peak", "pressure", firing.pressure, study::fired_pressure(own.load), Dimension::pressure);
  change("initial_temperature", "temperature", firing.temperature, own.initial_temperature,
         Dimension::temperature);
  return study::with_changes(study.scene, changes);
}

/// The load of a measured curve has a peak of its own.
Fault check_curve(const StudyFile& study, const Firing& firing, std::size_t place) {
  const scene::Load& load = study.scene.scene.load;
  const double peak = study::fired_pressure(load);
  if (load.curve_time.empty() || load.rescale_to_peak || study::same_number(firing.pressure, peak))
    return std::nullopt;
  return fault_at(study, fmt::format("firing.{}.pressure", place),
                  fmt::format("{} beside a measured curve with a peak of {}",
                              scene::format_quantity(firing.pressure, Dimension::pressure),
                              scene::format_quantity(peak, Dimension::pressure)),
                  "that of the curve, or load.rescale_to_peak = true in the scene");
}

}  // namespace

study::FiringPrior FiringSettings::prior_about(const surface::SurfaceConstants& centre) const {
  study::FiringPrior prior;
  prior.centre = centre;
  prior.log_localisation = std::log(localisation_factor);
  prior.log_exchange_time = std::log(exchange_time_factor);
  prior.ignition_temperature = ignition_temperature;
  prior.scatter = scatter;
  return prior;
}

std::vector<Key<study::Study>> firing_keys() {
  const auto number = [](const char* name, Dimension dimension, scene::Limits limits, const char* sentence,
                         double FiringSettings::*member) {
    return scene::number_key<FiringSettings>(name, dimension, limits, Standing::assumed, sentence, member);
  };
  const std::vector<Key<FiringSettings>> keys{
      number("prior.localisation", Dimension::number, scene::between(1.5, 4),
             "With firings: by which factor the localisation may be more or less than the calibration's, one "
             "standard deviation.",
             &FiringSettings::localisation_factor),
      number("prior.exchange_time", Dimension::number, scene::between(2, 4), "The same of the exchange time.",
             &FiringSettings::exchange_time_factor),
      number("prior.ignition_temperature", Dimension::temperature_difference, scene::between(30, 40),
             "Likewise by how much the ignition temperature may be more or less.",
             &FiringSettings::ignition_temperature),
      number("prior.scatter", Dimension::number, scene::between(0.05, 0.5),
             "By which share the heat of rounds that are fired alike differs, one standard deviation, at a "
             "guess.",
             &FiringSettings::scatter),
      scene::list_key("next_gaps", Dimension::length, scene::between(0, 0.01), Standing::assumed,
                      "Gaps among which the round that would tell most is sought; if absent half of, one, "
                      "one and a half and two times the largest that was fired.",
                      &FiringSettings::next_gaps)};
  return own_keys(keys::keys_of_part("", &CalibrationSettings::firings, keys));
}

StudyTable firing_table() { return study_table_of("firing", firing_row_keys()); }

bool has_firings(const study::Study& study) { return !settings_in(study).firings.empty(); }

Fault read_firings(const toml::table& root, StudyFile& study) {
  const auto tables = study::tables_of(root, "firing", study.file);
  if (!tables) return tables.error();
  std::vector<Firing>& firings = settings_of<CalibrationSettings>(study.study).firings.firings;
  for (const toml::table* table : *tables) {
    Firing firing;
    auto read = scene::read_table(*table, firing_row_keys(), {}, study.file, firing);
    if (!read) return study::in_table(read.error(), "firing");
    const std::size_t place = firings.size();
    for (auto& [key, where] : *read) study.places[fmt::format("firing.{}.{}", place, key)] = where;
    complete(firing, study.scene.scene);
    if (Fault fault = check_curve(study, firing, place)) return fault;
    firings.push_back(std::move(firing));
  }
  return std::nullopt;
}

std::vector<std::size_t> conditions_of(const std::vector<Firing>& firings) {
  std::vector<std::pair<double, double>> made;
  std::vector<std::size_t> conditions;
  for (const Firing& each : firings) {
    const std::pair condition{each.pressure, each.temperature};
    const auto place = static_cast<std::size_t>(std::ranges::find(made, condition) - made.begin());
    if (place == made.size()) made.push_back(condition);
    conditions.push_back(place);
  }
  return conditions;
}

Fault make_firing_cases(StudyFile& study) {
  const std::vector<Firing>& firings = settings_in(study.study).firings;
  const std::vector<std::size_t> conditions = conditions_of(firings);
  for (std::size_t i = 0; i < firings.size(); ++i) {
    if (conditions[i] < study.cases.size()) continue;
    auto scene = scene_of(study, firings[i], i);
    if (!scene) return scene.error();
    study.cases.add(
        study::case_of(fmt::format("{}, {}", scene::format_quantity(firings[i].pressure, Dimension::pressure),
                                   scene::format_quantity(firings[i].temperature, Dimension::temperature)),
                       std::move(*scene)));
  }
  return std::nullopt;
}

}  // namespace launchsafe::kinds
