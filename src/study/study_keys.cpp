#include "study_keys.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace launchsafe::study {

std::string to_string(StudyKind kind) {
  switch (kind) {
    case StudyKind::critical_gap:
      return "critical-gap";
    case StudyKind::calibration:
      return "calibration";
    case StudyKind::sweep:
      return "sweep";
    case StudyKind::sensitivity:
      return "sensitivity";
    case StudyKind::accuracy:
      return "accuracy";
    case StudyKind::stability:
      return "stability";
  }
  return {};
}

std::string to_string(SensitivityMethod method) {
  return method == SensitivityMethod::sobol ? "sobol" : "morris";
}

namespace detail {
namespace {

using scene::above, scene::above_to, scene::any_number, scene::at_least, scene::between;
using scene::Dimension, scene::Key, scene::plausibly, scene::Standing;
using enum StudyKind;

/// Whole numbers that a double holds exactly.
constexpr double largest_seed = 9007199254740992.0;

Key<Study> study_list(std::string name, Dimension dimension, scene::Limits limits, std::string sentence,
                      std::vector<double> Study::*member) {
  return scene::list_key<Study>(
      std::move(name), dimension, limits, Standing::assumed,
      std::move(sentence), [member](auto& s) -> auto& { return s.*member; });
}

template <class Number>
Key<Study> study_number(std::string name, Dimension dimension, scene::Limits limits, std::string sentence,
                        Number Study::*member) {
  return scene::number_key<Study>(
      std::move(name), dimension, limits, Standing::assumed,
      std::move(sentence), [member](auto& s) -> auto& { return s.*member; });
}

/// Of a temperature, K.
Key<Study> stated_uncertainty(std::string name, std::string sentence, double Study::*member) {
  return plausibly(study_number(std::move(name), Dimension::temperature_difference, between(0, 1000),
                                std::move(sentence), member),
                   between(1, 1000),
                   "no published temperature is met, and no mesh known to be exact, to a kelvin");
}

std::vector<Key<Study>> common_keys() {
  return {
      scene::required(scene::word_key<Study, StudyKind>(
          "kind", Standing::input, "What is asked.",
          {{to_string(critical_gap), critical_gap},
           {to_string(calibration), calibration},
           {to_string(sweep), sweep},
           {to_string(sensitivity), sensitivity},
           {to_string(accuracy), accuracy},
           {to_string(stability), stability}},
          [](auto& s) -> auto& { return s.kind; })),
      scene::text_key<Study>(
          "title", Standing::input, "What this study is, for reports; the scene's title where there is none.",
          [](auto& s) -> auto& { return s.title; }),
      scene::required(scene::text_key<Study>(
          "scene", Standing::input, "Path of the scene from the study file's folder.",
          [](auto& s) -> auto& { return s.scene; })),
      scene::text_key<Study>(
          "references", Standing::input,
          "Path of a file that holds the published rows, [[reference]], from the study file's folder.",
          [](auto& s) -> auto& { return s.references_file; }),
      study_number("early_time", Dimension::time, above_to(0, 1),
                   "An instant at which temperatures are listed and compared too.", &Study::early_time),
      scene::number_key<Study>(
          "reference_line.slope", Dimension::number, any_number(), Standing::paper,
          "Slope of a published line of maximum temperature against gap, K per cm.",
          [](auto& s) -> auto& { return s.reference_line.slope; }),
      scene::number_key<Study>(
          "reference_line.intercept", Dimension::temperature, at_least(0), Standing::paper,
          "Its value at gap 0.", [](auto& s) -> auto& { return s.reference_line.intercept; }),
  };
}

std::vector<Key<Study>> gaps_keys() {
  return {study_list("gaps", Dimension::length, between(0, 0.01),
                     "Gaps to judge; those of the scene if absent.", &Study::gaps)};
}

std::vector<Key<Study>> critical_gap_keys() {
  return {
      study_list("peak_pressures", Dimension::pressure, above_to(0, 10e9),
                 "Peak chamber pressures, each a mechanical run; the scene's if absent.",
                 &Study::peak_pressures),
      study_list("crack_radii", Dimension::length, between(0, 0.01),
                 "Initial crack radii c(0), each a mechanical run; the scene's if absent.",
                 &Study::crack_radii),
      study_list("flaw_sizes", Dimension::length, between(0, 0.01),
                 "Flaw sizes a, each a mechanical run; the scene's if absent.", &Study::flaw_sizes),
      scene::flag_key<Study>(
          "confirm", Standing::assumed, "Complete coupled runs on both sides of the bracket.",
          [](auto& s) -> auto& { return s.confirm; }),
  };
}

/// Of every kind that judges gaps and seeks the critical one.
std::vector<Key<Study>> judging_keys() {
  return {
      plausibly(study_number("tolerance", Dimension::length, between(1e-9, 1e-3),
                             "Largest width of the bracket of the critical gap.", &Study::tolerance),
                between(1e-9, 2e-4), "a wider bracket says little of gaps that are tenths of a millimetre"),
      plausibly(study_number("largest_gap", Dimension::length, above_to(0, 0.01),
                             "Where the search for the critical gap ends.", &Study::largest_gap),
                between(1e-4, 0.01), "a search that ends at less finds no gap that ignites"),
      stated_uncertainty("numerical_uncertainty",
                         "Uncertainty of the maximum temperature from the mesh, from a mesh study.",
                         &Study::numerical_uncertainty),
  };
}

std::vector<Key<Study>> calibration_keys() {
  return {
      study_list("meshes", Dimension::length, between(1e-5, 1),
                 "Cell sizes, each a mechanical run; the scene's if absent.", &Study::meshes),
      scene::flag_key<Study>(
          "compare_kinetics", Standing::assumed,
          "Calibrate with every named kinetics rather than with the scene's alone.",
          [](auto& s) -> auto& { return s.compare_kinetics; }),
      scene::range_key<Study>(
          "ignition_bracket", Dimension::temperature, between(0, 5000), Standing::paper,
          "Published bracket of the ignition temperature, a check on the calibrated one.",
          [](auto& s) -> auto& { return s.ignition_lowest; },
          [](auto& s) -> auto& { return s.ignition_highest; }),
      study_list(
          "fast_rise", Dimension::time, above_to(0, 1),
          "Two instants between which the published temperature without a gap rises fast. Where given, "
          "load.exponent is fitted to the time between them and load.peak_time to the row without a "
          "gap that has early_calibrated = true.",
          &Study::fast_rise),
  };
}

std::vector<Key<Study>> accuracy_keys() {
  return {
      study_list("reference_cell_sizes", Dimension::length, between(1e-5, 1),
                 "Cell sizes of at least three grids, each fitting the charge, that the reference is "
                 "extrapolated from.",
                 &Study::reference_cell_sizes),
      study_list("times", Dimension::time, between(0, 1), "Instants at which temperatures are compared too.",
                 &Study::times),
  };
}

std::vector<Key<Study>> stability_keys() {
  return {scene::flag_key<Study>(
      "laws", Standing::assumed, "The laws by themselves at stiff and extreme arguments, before the cases.",
      [](auto& s) -> auto& { return s.laws; })};
}

/// Where the constants of a study come from.
std::vector<Key<Study>> calibration_record_keys() {
  return {scene::text_key<Study>(
      "calibration", Standing::input,
      "Path of the record of a calibration, calibration.json, from the study file's folder; its load and "
      "constants replace the scene's, and hold where the calibrated launch is the study's.",
      [](auto& s) -> auto& { return s.calibration_record; })};
}

/// What the uncertainty of a verdict is made of, besides the mesh.
std::vector<Key<Study>> uncertainty_keys() {
  return {
      scene::text_key<Study>(
          "accuracy", Standing::input,
          "Path of the record of an accuracy study, accuracy.json, from the study file's folder; it gives "
          "the "
          "numerical uncertainty of every setting in it.",
          [](auto& s) -> auto& { return s.accuracy; }),
      study_number(
          "setting_tolerance", Dimension::temperature_difference, above_to(0, 1000),
          "Replaces the scene's numerics by the cheapest setting of the record that knows the maximum "
          "temperature to this; on the command line --tolerance.",
          &Study::setting_tolerance),
      stated_uncertainty(
          "fit_uncertainty",
          "Uncertainty of the margin from the calibrated constants, on the rows that they were "
          "fitted to; what the record of the calibration says if absent, and without one the largest misfit "
          "of a published temperature that nothing was fitted to.",
          &Study::fit_uncertainty),
      stated_uncertainty(
          "input_uncertainty",
          "Uncertainty of the maximum temperature from what is not known of the launch (see "
          "kind sensitivity), for the study's own scene; if absent an assumed spread of load and "
          "initial temperature is propagated, which takes a second run for every case.",
          &Study::input_uncertainty),
      scene::text_key<Study>(
          "model_form", Standing::input,
          "Path of the record of other models, model_form.json, from the study file's folder; it says how "
          "far "
          "they move the critical gap towards ignition.",
          [](auto& s) -> auto& { return s.model_form_record; }),
      stated_uncertainty(
          "model_form_uncertainty",
          "By how much other models of the launch could be hotter, instead of such a record; an assumed one "
          "if absent.",
          &Study::model_form_uncertainty),
  };
}

/// The one gap of a sensitivity study.
Key<Study> one_gap_key() {
  Key<Study> key{{.name = "gap",
                  .dimension = Dimension::length,
                  .limits = between(0, 0.01),
                  .sentence = "The gap at which temperatures are compared; the scene's if it has one alone."},
                 {},
                 {}};
  key.set = [](Study& study, const scene::Value& value) { study.gaps = {std::get<double>(value)}; };
  key.get = [](const Study& study) {
    return scene::Value(study.gaps.empty() ? not_a_number : study.gaps[0]);
  };
  return key;
}

std::vector<Key<Study>> sensitivity_keys() {
  return {
      scene::word_key<Study, SensitivityMethod>(
          "method", Standing::assumed, "Indices of Sobol, or the elementary effects of Morris.",
          {{to_string(SensitivityMethod::sobol), SensitivityMethod::sobol},
           {to_string(SensitivityMethod::morris), SensitivityMethod::morris}},
          [](auto& s) -> auto& { return s.method; }),
      one_gap_key(),
      study_number("seed", Dimension::count, between(0, largest_seed),
                   "Seed of the design and of the bootstrap.", &Study::seed),
      study_number("resamples", Dimension::count, between(100, 1e6), "Resamples of the bootstrap.",
                   &Study::resamples),
      study_number("confidence", Dimension::number, between(0.5, 0.999), "Confidence of the intervals.",
                   &Study::confidence),
  };
}

std::vector<Key<Study>> sobol_keys() {
  return {
      scene::word_key<Study, math::Design>(
          "design", Standing::assumed,
          "How the samples are laid out; a power of two of them is best "
          "for scrambled-sobol.",
          {{"scrambled-sobol", math::Design::scrambled_sobol},
           {"latin-hypercube", math::Design::latin_hypercube},
           {"monte-carlo", math::Design::monte_carlo}},
          [](auto& s) -> auto& { return s.design; }),
      study_number("samples", Dimension::count, between(2, 1e6),
                   "Samples N of the inputs, each (inputs + 2) mechanical runs.", &Study::samples),
  };
}

std::vector<Key<Study>> morris_keys() {
  return {
      study_number("trajectories", Dimension::count, between(2, 1e6),
                   "Trajectories through the inputs, each (inputs + 1) mechanical runs.",
                   &Study::trajectories),
      study_number("levels", Dimension::count, between(2, 1000), "Levels of every input, an even number.",
                   &Study::levels),
  };
}

Key<Reference> reference_number(std::string name, Dimension dimension, std::string sentence,
                                double Reference::*member) {
  return scene::number_key<Reference>(
      std::move(name), dimension, at_least(0), Standing::paper,
      std::move(sentence), [member](auto& r) -> auto& { return r.*member; });
}

std::vector<Key<Reference>> make_reference_keys() {
  return {
      scene::required(reference_number("gap", Dimension::length, "Gap of a published row.", &Reference::gap)),
      reference_number("maximum_temperature", Dimension::temperature, "Its highest temperature.",
                       &Reference::maximum_temperature),
      scene::text_key<Reference>(
          "point", Standing::paper, "Observation point of the highest temperature.",
          [](auto& r) -> auto& { return r.point; }),
      reference_number("early_temperature", Dimension::temperature, "Its highest temperature at early_time.",
                       &Reference::early_temperature),
      scene::text_key<Reference>(
          "early_point", Standing::paper, "Observation point of the highest temperature at early_time.",
          [](auto& r) -> auto& { return r.early_point; }),
      reference_number("spread", Dimension::temperature_difference,
                       "Highest minus lowest published temperature of the bottom at the end of the launch.",
                       &Reference::spread),
      reference_number("early_spread", Dimension::temperature_difference, "The same at early_time.",
                       &Reference::early_spread),
      reference_number("ignition_time", Dimension::time, "When it ignited; absent where it did not.",
                       &Reference::ignition_time),
      scene::flag_key<Reference>(
          "calibrated", Standing::input, "True where constants are fitted to it, false for a hold-out.",
          [](auto& r) -> auto& { return r.calibrated; }),
      scene::flag_key<Reference>(
          "early_calibrated", Standing::input,
          "True where the load is fitted to its temperature at early_time.",
          [](auto& r) -> auto& { return r.early_calibrated; }),
      scene::flag_key<Reference>(
          "selection", Standing::input,
          "True where its temperature at early_time, spreads and places were used to choose among models.",
          [](auto& r) -> auto& { return r.selection; }),
  };
}

/// Keys, and the kinds that they belong to; no kinds: to all.
struct KeyGroup {
  std::vector<StudyKind> kinds;
  std::vector<Key<Study>> keys;
};

const std::vector<KeyGroup>& key_groups() {
  static const std::vector<KeyGroup> groups{
      {{}, common_keys()},
      {{critical_gap, accuracy, stability}, gaps_keys()},
      {{critical_gap}, critical_gap_keys()},
      {{critical_gap, sweep, sensitivity, accuracy, stability}, judging_keys()},
      {{critical_gap, sweep, sensitivity, accuracy}, calibration_record_keys()},
      {{critical_gap, sweep, sensitivity}, uncertainty_keys()},
      {{calibration}, calibration_keys()},
      {{accuracy}, accuracy_keys()},
      {{stability}, stability_keys()},
      {{sensitivity}, sensitivity_keys()},
      {{sensitivity}, sobol_keys()},
      {{sensitivity}, morris_keys()}};
  return groups;
}

std::vector<Key<Study>> all_study_keys() {
  std::vector<Key<Study>> keys;
  for (const KeyGroup& group : key_groups()) keys.insert(keys.end(), group.keys.begin(), group.keys.end());
  return keys;
}

}  // namespace

const std::vector<Key<Study>>& study_keys() {
  static const std::vector<Key<Study>> keys = all_study_keys();
  return keys;
}

const std::vector<Key<Reference>>& reference_keys() {
  static const std::vector<Key<Reference>> keys = make_reference_keys();
  return keys;
}

std::string to_string(math::Distribution::Kind kind) {
  switch (kind) {
    case math::Distribution::Kind::uniform:
      return "uniform";
    case math::Distribution::Kind::log_uniform:
      return "log-uniform";
    case math::Distribution::Kind::normal:
      return "normal";
  }
  return {};
}

std::vector<Key<InputText>> input_keys(const scene::KeyDescription& scene_key) {
  using Kind = math::Distribution::Kind;
  const Dimension dimension = scene_key.dimension;
  return {
      scene::required(scene::text_key<InputText>(
          "key", Standing::input,
          "What is uncertain: peak_pressure, crack_radius, flaw_size, or a scene key that takes one number.",
          [](auto& i) -> auto& { return i.name; })),
      scene::required(scene::word_key<InputText, Kind>(
          "distribution", Standing::input, "How its values are distributed.",
          {{to_string(Kind::uniform), Kind::uniform},
           {to_string(Kind::log_uniform), Kind::log_uniform},
           {to_string(Kind::normal), Kind::normal}},
          [](auto& i) -> auto& { return i.kind; })),
      scene::range_key<InputText>(
          "range", dimension, scene_key.limits, Standing::input,
          "Least and greatest value, in a unit of the key; of a normal, where it is cut off.",
          [](auto& i) -> auto& { return i.lower; }, [](auto& i) -> auto& { return i.upper; }),
      scene::number_key<InputText>(
          "mean", dimension, any_number(), Standing::input,
          "Mean of a normal before it is cut off, in a unit of the key.",
          [](auto& i) -> auto& { return i.mean; }),
      scene::number_key<InputText>(
          "deviation", scene::difference_of(dimension), above(0), Standing::input,
          "Standard deviation of a normal before it is cut off, in a unit of the key.",
          [](auto& i) -> auto& { return i.deviation; }),
  };
}

std::vector<StudyKind> kinds_of_key(const std::string& name) {
  if (name == "axes") return {sweep};
  if (name == "input") return {sensitivity};
  if (name == "settings") return {accuracy};
  if (name == "case") return {stability};
  if (name == "reference" || name == "references") return {critical_gap, calibration, sweep};
  if (name == "cited_limit") return {critical_gap, sweep};
  for (const KeyGroup& group : key_groups()) {
    if (scene::find_key(group.keys, name)) return group.kinds;
  }
  return {};
}

std::optional<SensitivityMethod> method_of_key(const std::string& name) {
  if (scene::find_key(sobol_keys(), name)) return SensitivityMethod::sobol;
  if (scene::find_key(morris_keys(), name)) return SensitivityMethod::morris;
  return std::nullopt;
}

}  // namespace detail
}  // namespace launchsafe::study
