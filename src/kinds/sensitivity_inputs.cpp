// [[input]] of a sensitivity study: keys that are not known exactly, and their distributions.
#include "sensitivity_inputs.hpp"

#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/store/sha256.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
namespace {

using math::Distribution;
using scene::Dimension, scene::InputError, scene::KeyDescription, scene::KeyKind, scene::Limits, scene::Place;

/// Deviations of a normal that is not cut off which must lie within the limits of its key.
constexpr double deviations_within_limits = 4.0;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One [[input]] as read.
struct InputText {
  std::string name;
  KeyDescription key;  ///< of the scene
  /// SI; what is not given is infinite or NaN.
  Distribution distribution{Distribution::Kind::uniform, -infinity, infinity, not_a_number, not_a_number};
};

std::string to_string(math::Distribution::Kind kind) {
  constexpr std::array words{"uniform", "log-uniform", "normal"};
  return words.at(static_cast<std::size_t>(kind));
}

std::vector<scene::Key<Distribution>> distribution_keys(const KeyDescription& scene_key) {
  using Kind = Distribution::Kind;
  const Dimension dimension = scene_key.dimension;
  return {
      scene::required(scene::word_key("distribution", scene::Standing::input,
                                      "How its values are distributed.",
                                      {{to_string(Kind::uniform), Kind::uniform},
                                       {to_string(Kind::log_uniform), Kind::log_uniform},
                                       {to_string(Kind::normal), Kind::normal}},
                                      &Distribution::kind)),
      scene::range_key("range", dimension, scene_key.limits, scene::Standing::input,
                       "Least and greatest value, in a unit of the key; of a normal, where it is cut off.",
                       &Distribution::lower, &Distribution::upper),
      scene::number_key("mean", dimension, scene::any_number(), scene::Standing::input,
                        "Mean of a normal before it is cut off, in a unit of the key.",
                        &Distribution::centre),
      scene::number_key("deviation", scene::difference_of(dimension), scene::above(0), scene::Standing::input,
                        "Standard deviation of a normal before it is cut off, in a unit of the key.",
                        &Distribution::deviation),
  };
}

std::vector<scene::Key<InputText>> input_keys(const KeyDescription& scene_key) {
  return keys::joined<InputText>(
      {{scene::required(scene::text_key<InputText>(
           "key", scene::Standing::input,
           "What is uncertain: peak_pressure, crack_radius, flaw_size, or a scene key that takes one number.",
           "peak_pressure", &InputText::name))},
       keys::keys_of_part("", &InputText::distribution, distribution_keys(scene_key))});
}

/// One [[input]] while it is read.
struct InputReader {
  StudyFile& study;
  const toml::table& table;
  std::size_t index;
  InputText text;
  std::map<std::string, Place> places;

  bool given(const std::string& key) const { return places.contains(key); }
  Place place_of(const std::string& key) const {
    const auto found = places.find(key);
    return found == places.end() ? scene::place_of(table, study.file) : found->second;
  }
  InputError fault(const std::string& key, std::string found, std::string allowed,
                   std::string suggestion = {}) const {
    return scene::error_at(place_of(key), "input." + key, std::move(found), std::move(allowed),
                           std::move(suggestion));
  }
};

/// The scene key that an [[input]] names, which the dimension of its other keys follows from.
scene::Expected<KeyDescription> read_scene_key(InputReader& reader, std::string& name) {
  const toml::node* node = reader.table.get("key");
  const KeyDescription description = *scene::find_key(input_keys({}), "key");
  if (!node) return reader.fault("key", "nothing; the key is missing", scene::allowed_text(description));
  const auto value = scene::read_value(*node, description, reader.study.file);
  if (!value) return in_table(value.error(), "input");
  name = std::get<std::string>(*value);
  const Place place = scene::place_of(*node, reader.study.file);
  reader.places["key"] = place;
  if (name == "gap" || name == "gap.thickness") {
    return reader.fault("key", name + ", which is one for all evaluations",
                        "a scene key that takes one number; the gap is the study's key gap");
  }
  auto key = varied_key(reader.study, name, "input.key", place);
  if (key && key->dimension == Dimension::count) {
    return reader.fault("key", name + ", a whole number", "a key that may take any number between two");
  }
  return key;
}

/// Keys that the distribution needs, and those that would silently do nothing.
Fault check_given(const InputReader& reader) {
  const bool normal = reader.text.distribution.kind == Distribution::Kind::normal;
  const auto missing = [&](const char* key) {
    return reader.fault(key,
                        fmt::format("nothing; a {} input needs it", to_string(reader.text.distribution.kind)),
                        scene::allowed_text(*scene::find_key(input_keys(reader.text.key), key)));
  };
  if (!normal && !reader.given("range")) return missing("range");
  for (const char* key : {"mean", "deviation"}) {
    if (normal && !reader.given(key)) return missing(key);
    if (!normal && reader.given(key)) {
      return reader.fault(
          key, "a key of distribution \"normal\"",
          fmt::format("range alone for distribution \"{}\"", to_string(reader.text.distribution.kind)));
    }
  }
  return std::nullopt;
}

std::string range_text(double lower, double upper, Dimension dimension) {
  return fmt::format("{} to {}", scene::format_quantity(lower, dimension),
                     scene::format_quantity(upper, dimension));
}

/// The range to write for a normal that needs one; empty where the limits leave none.
std::string suggested_range(const InputText& text) {
  const double reach = deviations_within_limits * text.distribution.deviation;
  const double lower = std::max(text.distribution.centre - reach, text.key.limits.lowest);
  const double upper = std::min(text.distribution.centre + reach, text.key.limits.highest);
  if (!(lower < upper) || !text.key.limits.contain(lower) || !text.key.limits.contain(upper)) return {};
  return fmt::format("range = \"{}\"", range_text(lower, upper, text.key.dimension));
}

/// A normal without a range must in practice stay within the limits of its key.
Fault check_reach(const InputReader& reader) {
  const InputText& text = reader.text;
  if (text.distribution.kind != Distribution::Kind::normal || reader.given("range")) return std::nullopt;
  const double reach = deviations_within_limits * text.distribution.deviation;
  const double lower = text.distribution.centre - reach, upper = text.distribution.centre + reach;
  if (text.key.limits.contain(lower) && text.key.limits.contain(upper)) return std::nullopt;
  return reader.fault(
      "deviation",
      fmt::format("values of {} within {:g} deviations, outside the limits of {}",
                  range_text(lower, upper, text.key.dimension), deviations_within_limits, text.key.name),
      "a range that cuts the normal off: " + scene::allowed_text(text.key), suggested_range(text));
}

Fault check_distribution(const InputReader& reader) {
  const InputText& text = reader.text;
  if (text.distribution.kind == Distribution::Kind::log_uniform && !(text.distribution.lower > 0.0)) {
    return reader.fault(
        "range",
        fmt::format("{}, whose lower end has no logarithm",
                    range_text(text.distribution.lower, text.distribution.upper, text.key.dimension)),
        "a range above 0 for distribution \"log-uniform\"");
  }
  if (Fault fault = check_reach(reader)) return fault;
  if (math::is_valid(text.distribution)) return std::nullopt;
  return reader.fault(
      "range",
      fmt::format(
          "{}, where a normal of mean {} and deviation {} has no share",
          range_text(text.distribution.lower, text.distribution.upper, text.key.dimension),
          scene::format_quantity(text.distribution.centre, text.key.dimension),
          scene::format_quantity(text.distribution.deviation, scene::difference_of(text.key.dimension))),
      "a range near the mean");
}

Fault read_input(InputReader& reader) {
  std::string name;
  const auto key = read_scene_key(reader, name);
  if (!key) return key.error();
  reader.text.key = *key;
  auto read = scene::read_table(reader.table, input_keys(*key), {}, reader.study.file, reader.text);
  if (!read) return in_table(read.error(), "input");
  reader.places = std::move(*read);
  for (const auto& [given, place] : reader.places)
    reader.study.places[fmt::format("input.{}.{}", reader.index, given)] = place;
  if (Fault fault = check_free(reader.study, key->name, "as an input", reader.place_of("key"), "input.key"))
    return fault;
  if (Fault fault = check_given(reader)) return fault;
  if (Fault fault = check_distribution(reader)) return fault;
  reader.study.study.axes.push_back(
      {std::move(name),
       fmt::format("input.{}.key", reader.index),
       *key,
       {},
       reader.text.distribution,
       fmt::format("input.{}.{}", reader.index, reader.given("range") ? "range" : "deviation")});
  return std::nullopt;
}

// --- the constants of a calibration, together ---

/// An [[input]] that names a record has no other key.
std::vector<scene::Key<std::string>> record_keys() {
  scene::Key<std::string> key{{.name = "calibration",
                               .kind = KeyKind::text,
                               .sentence = "Instead of the other keys: the calibration.json whose fitted "
                                           "constants vary together, by the covariance of its fit.",
                               .example = "../reports/calibrate_table8/calibration.json"},
                              {},
                              {}};
  key.set = [](std::string& name, const scene::Value& value) { name = std::get<std::string>(value); };
  key.get = [](const std::string& name) { return scene::Value(name); };
  return {key};
}

/// Whether the study's scene and keys allow constants of a record to vary.
Fault check_place_of_record(const InputReader& reader) {
  const StudyFile& study = reader.study;
  if (sensitivity_settings(study.study).correlated)
    return reader.fault("calibration", "a second calibration", "one calibration among the inputs");
  if (!study.study.calibration_record.empty())
    return reader.fault("calibration", "a calibration beside that of the study",
                        "one of both: the constants vary around those of the record that an input names",
                        "leave out calibration = \"" + study.study.calibration_record + "\"");
  const scene::Load& load = study.scene.scene.load;
  if (load.curve_time.empty() && load.shape == scene::LoadShape::bell) return std::nullopt;
  return reader.fault("calibration",
                      fmt::format("constants of a bell for a scene whose load is {}",
                                  load.curve_time.empty() ? '"' + scene::word_of(load.shape) + '"'
                                                          : std::string("a measured curve")),
                      "a scene with load.shape = \"bell\"");
}

/// The record, with a covariance.
scene::Expected<CalibrationRecord> read_covariance(InputReader& reader, const std::filesystem::path& folder,
                                                   const std::string& name) {
  const std::string wanted = "the calibration.json of a calibration with load_fitted = true";
  const auto text = scene::read_text_file(folder / name);
  if (!text)
    return reader.fault("calibration", fmt::format("\"{}\", which cannot be read", name),
                        wanted + ", by its path from the study file's folder", text.error().suggestion);
  auto record = parse_calibration_record(*text, (folder / name).string());
  if (!record) return record;
  reader.study.records.push_back(store::sha256(*text));
  if (!record->failure.empty())
    return reader.fault("calibration", "a record without constants: " + record->failure, wanted);
  if (record->covariance.empty())
    return reader.fault("calibration", "a record without a covariance: its load was not fitted", wanted);
  return record;
}

Fault read_calibrated(InputReader& reader, const std::filesystem::path& folder) {
  std::string name;
  auto read = scene::read_table(reader.table, record_keys(), {}, reader.study.file, name);
  if (!read) return in_table(read.error(), "input");
  reader.places = std::move(*read);
  const Place place = reader.place_of("calibration");
  const std::string study_key = fmt::format("input.{}.calibration", reader.index);
  reader.study.places[study_key] = place;
  if (Fault fault = check_place_of_record(reader)) return fault;
  const auto record = read_covariance(reader, folder, name);
  if (!record) return record.error();
  constexpr std::size_t count = fitted_keys.size();
  auto factor = math::covariance_factor(record->covariance, count);
  if (!factor)
    return reader.fault("calibration", "a record whose covariance is not positive definite",
                        "the record of a calibration whose fit is not singular");
  Study& study = reader.study.study;
  settings_of<SensitivitySettings>(study).correlated = {study.axes.size(), count, std::move(*factor)};
  for (std::size_t i = 0; i < count; ++i) {
    const std::string key_name = fitted_keys[i];
    if (Fault fault = check_free(reader.study, key_name, "as an input", place, "input.calibration"))
      return fault;
    const auto key = varied_key(reader.study, key_name, "input.calibration", place);
    if (!key) return key.error();
    const double median =
        std::get<double>(scene::find_key(scene::scene_keys(), key_name)->get(record->calibration.scene));
    const double deviation = std::sqrt(record->covariance[i * count + i]);
    study.axes.push_back({key_name, study_key, *key, {}, Distribution::log_normal(median, deviation)});
  }
  return std::nullopt;
}

}  // namespace

StudyTable input_table() {
  StudyTable table = study_table_of("input", input_keys({}));
  for (scene::DocumentedKey& key : study_table_of("input", record_keys()).keys)
    table.keys.push_back(std::move(key));
  return table;
}

Fault read_inputs(const StudySource& source, StudyFile& study) {
  const auto tables =
      some_tables_of(source.root, "input", study, "with key and distribution, or a calibration");
  if (!tables) return tables.error();
  std::size_t index = 0;
  for (const toml::table* table : *tables) {
    InputReader reader{study, *table, index++, {}, {}};
    Fault fault =
        table->contains("calibration") ? read_calibrated(reader, source.folder) : read_input(reader);
    if (fault) return fault;
  }
  return std::nullopt;
}

}  // namespace launchsafe::kinds
