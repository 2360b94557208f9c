#include "study_keys.hpp"

#include <algorithm>

namespace launchsafe::study {

std::string to_string(StudyKind kind) {
  return kind == StudyKind::critical_gap ? "critical-gap" : "calibration";
}

std::vector<scene::KeyDescription> describe_study_keys() {
  std::vector<scene::KeyDescription> described;
  for (const auto& key : detail::study_keys()) described.push_back(key);
  for (const auto& key : detail::reference_keys()) {
    described.push_back(key);
    described.back().name = "reference." + key.name;
  }
  return described;
}

namespace detail {
namespace {

using scene::above_to, scene::at_least, scene::between;
using scene::Dimension, scene::Key, scene::Standing;

Key<Study> study_list(std::string name, Dimension dimension, scene::Limits limits, std::string sentence,
                      std::vector<double> Study::*member) {
  return scene::list_key<Study>(
      std::move(name), dimension, limits, Standing::assumed,
      std::move(sentence), [member](auto& s) -> auto& { return s.*member; });
}

Key<Study> study_number(std::string name, Dimension dimension, scene::Limits limits, std::string sentence,
                        double Study::*member) {
  return scene::number_key<Study>(
      std::move(name), dimension, limits, Standing::assumed,
      std::move(sentence), [member](auto& s) -> auto& { return s.*member; });
}

std::vector<Key<Study>> common_keys() {
  return {
      scene::required(scene::word_key<Study, StudyKind>(
          "kind", Standing::input, "What is asked.",
          {{"critical-gap", StudyKind::critical_gap}, {"calibration", StudyKind::calibration}},
          [](auto& s) -> auto& { return s.kind; })),
      scene::text_key<Study>(
          "title", Standing::input, "What this study is, for reports; the scene's title where there is none.",
          [](auto& s) -> auto& { return s.title; }),
      scene::required(scene::text_key<Study>(
          "scene", Standing::input, "Path of the scene from the study file's folder.",
          [](auto& s) -> auto& { return s.scene; })),
      study_number("early_time", Dimension::time, above_to(0, 1),
                   "An instant at which temperatures are listed and compared too.", &Study::early_time),
      scene::number_key<Study>(
          "reference_line.slope", Dimension::number, scene::any_number(), Standing::paper,
          "Slope of a published line of maximum temperature against gap, K per cm.",
          [](auto& s) -> auto& { return s.reference_line.slope; }),
      scene::number_key<Study>(
          "reference_line.intercept", Dimension::temperature, at_least(0), Standing::paper,
          "Its value at gap 0.", [](auto& s) -> auto& { return s.reference_line.intercept; }),
  };
}

std::vector<Key<Study>> critical_gap_keys() {
  return {
      study_list("gaps", Dimension::length, between(0, 0.01), "Gaps to judge; those of the scene if absent.",
                 &Study::gaps),
      study_list("peak_pressures", Dimension::pressure, above_to(0, 10e9),
                 "Peak chamber pressures, each a mechanical run; the scene's if absent.",
                 &Study::peak_pressures),
      study_list("crack_radii", Dimension::length, between(0, 0.01),
                 "Initial crack radii c(0), each a mechanical run; the scene's if absent.",
                 &Study::crack_radii),
      study_list("flaw_sizes", Dimension::length, between(0, 0.01),
                 "Flaw sizes a, each a mechanical run; the scene's if absent.", &Study::flaw_sizes),
      study_number("tolerance", Dimension::length, between(1e-9, 1e-3),
                   "Largest width of the bracket of the critical gap.", &Study::tolerance),
      study_number("largest_gap", Dimension::length, above_to(0, 0.01),
                   "Where the search for the critical gap ends.", &Study::largest_gap),
      scene::flag_key<Study>(
          "confirm", Standing::assumed, "Complete coupled runs on both sides of the bracket.",
          [](auto& s) -> auto& { return s.confirm; }),
      study_number("numerical_uncertainty", Dimension::temperature, between(0, 1000),
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
      reference_number("spread", Dimension::temperature,
                       "Highest minus lowest observation point at the end of the launch.",
                       &Reference::spread),
      reference_number("early_spread", Dimension::temperature, "The same at early_time.",
                       &Reference::early_spread),
      reference_number("ignition_time", Dimension::time, "When it ignited; absent where it did not.",
                       &Reference::ignition_time),
      scene::flag_key<Reference>(
          "calibrated", Standing::input, "True where constants are fitted to it, false for a hold-out.",
          [](auto& r) -> auto& { return r.calibrated; }),
  };
}

template <class Owner>
bool has_key(const std::vector<Key<Owner>>& keys, const std::string& name) {
  return scene::find_key(keys, name) != nullptr;
}

std::vector<Key<Study>> all_study_keys() {
  std::vector<Key<Study>> keys = common_keys();
  for (auto& more : {critical_gap_keys(), calibration_keys()})
    keys.insert(keys.end(), more.begin(), more.end());
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

std::string kind_of_key(const std::string& name) {
  if (has_key(critical_gap_keys(), name)) return "critical-gap";
  if (has_key(calibration_keys(), name)) return "calibration";
  return {};
}

}  // namespace detail
}  // namespace launchsafe::study
