// [[vary]]: what the cases of a study differ in. Every entry has a key of the scene with values, or with a
// distribution; or the key "constants": those that a fit found vary together.
#include "launchsafe/kinds/sensitivity.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {
namespace {

using math::Distribution;

constexpr const char *table_name = "vary", *constants_key = "constants";

struct VaryText {
  std::string name;
  KeyDescription key;          ///< of the scene
  std::vector<double> values;  ///< SI
  /// SI; what is not given is infinite or NaN. `range` is its lower and upper end.
  math::Distribution distribution{math::Distribution::Kind::uniform, -std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity(), not_a_number, not_a_number};
};

std::vector<Key<Distribution>> distribution_keys(const KeyDescription& scene_key) {
  using Kind = Distribution::Kind;
  const Dimension dimension = scene_key.dimension;
  return {
      range_key("range", dimension, scene_key.limits, Standing::input,
                "Least and greatest value, in a unit of the key; of a normal, where it is cut off.",
                &Distribution::lower, &Distribution::upper),
      word_key("distribution", Standing::input,
               "How values are distributed that are not known exactly; of kind sensitivity.",
               {{"uniform", Kind::uniform}, {"log-uniform", Kind::log_uniform}, {"normal", Kind::normal}},
               &Distribution::kind),
      number_key("mean", dimension, any_number(), Standing::input,
                 "Mean of a normal before it is cut off, in a unit of the key.", &Distribution::centre),
      number_key("deviation", scene::difference_of(dimension), above(0), Standing::input,
                 "Standard deviation of a normal before it is cut off, in a unit of the key.",
                 &Distribution::deviation),
  };
}

/// The keys of an entry that varies this key of a scene.
std::vector<Key<VaryText>> vary_keys(const KeyDescription& scene_key) {
  return joined<VaryText>(
      {{text_key(
            "key", Standing::input,
            "What varies: peak_pressure, crack_radius, flaw_size, a scene key that takes one number; or "
            "constants, those that a fit found of the skin, together, by its covariance (kind sensitivity).",
            "peak_pressure", &VaryText::name) |
            required(),
        list_key("values", scene_key.dimension, scene_key.limits, Standing::input,
                 "Its values, in a unit of the key; every combination with other keys is a case.",
                 &VaryText::values)},
       keys::keys_of_part("", &VaryText::distribution, distribution_keys(scene_key))});
}

/// One entry while it is read.
struct VaryReader {
  StudyFile& study;
  const toml::table& table;
  std::size_t index;
  VaryText text = {};
  std::map<std::string, Place> places = {};

  bool given(const std::string& key) const { return places.contains(key); }
  Place place_of(const std::string& key) const {
    return given(key) ? places.at(key) : scene::place_of(table, study.file);
  }
  /// The key of the study file by which places and faults are kept: "vary.0.range".
  std::string study_key(const std::string& key) const {
    return fmt::format("{}.{}.{}", table_name, index, key);
  }
  [[noreturn]] void refuse(const std::string& key, std::string found, std::string allowed,
                           std::string suggestion = {}) const {
    throw error_at(place_of(key), "vary." + key, std::move(found), std::move(allowed), std::move(suggestion));
  }
  /// Refuses an entry such as `what`, which needs this key, without it.
  void need(const std::string& key, const std::string& what) const {
    if (!given(key))
      refuse(key, fmt::format("nothing; {} needs it", what),
             allowed_text(*scene::find_key(vary_keys(text.key), key)));
  }
};

// --- distributions ---

/// Deviations of a normal that is not cut off which must lie within the limits of its key.
constexpr double deviations_within_limits = 4.0;

/// Keys that the distribution needs, and those that would silently do nothing.
void check_given(const VaryReader& reader) {
  const bool normal = reader.text.distribution.kind == Distribution::Kind::normal;
  const auto word = scene::find_key(distribution_keys({}), "distribution")->get(reader.text.distribution);
  const std::string kind = std::get<std::string>(word), what = "a " + kind + " distribution";
  if (!normal) reader.need("range", what);
  for (const char* key : {"mean", "deviation"}) {
    if (normal) reader.need(key, what);
    if (!normal && reader.given(key))
      reader.refuse(key, "a key of distribution \"normal\"",
                    fmt::format("range alone for distribution \"{}\"", kind));
  }
}

std::string range_text(double lower, double upper, Dimension dimension) {
  return fmt::format("{} to {}", format_quantity(lower, dimension), format_quantity(upper, dimension));
}

/// A normal without a range must in practice stay within the limits of its key. The range to write for one
/// that does not is suggested, unless the limits leave none.
void check_reach(const VaryReader& reader) {
  const KeyDescription& key = reader.text.key;
  const Distribution& normal = reader.text.distribution;
  if (normal.kind != Distribution::Kind::normal || reader.given("range")) return;
  const double reach = deviations_within_limits * normal.deviation;
  const double lower = normal.centre - reach, upper = normal.centre + reach;
  const auto may_be = [&](double value) { return key.limits.contain(value); };
  if (may_be(lower) && may_be(upper)) return;
  const double from = std::max(lower, key.limits.lowest), to = std::min(upper, key.limits.highest);
  reader.refuse("deviation",
                fmt::format("values of {} within {:g} deviations, outside the limits of {}",
                            range_text(lower, upper, key.dimension), deviations_within_limits, key.name),
                "a range that cuts the normal off: " + allowed_text(key),
                from < to && may_be(from) && may_be(to)
                    ? fmt::format("range = \"{}\"", range_text(from, to, key.dimension))
                    : "");
}

/// Whether the distribution of an entry is whole and possible.
void check_distribution(const VaryReader& reader) {
  check_given(reader);
  const Dimension dimension = reader.text.key.dimension;
  const Distribution& of = reader.text.distribution;
  const std::string range = range_text(of.lower, of.upper, dimension);
  if (of.kind == Distribution::Kind::log_uniform && !(of.lower > 0.0))
    reader.refuse("range", range + ", whose lower end has no logarithm",
                  "a range above 0 for distribution \"log-uniform\"");
  check_reach(reader);
  if (!math::is_valid(of))
    reader.refuse("range",
                  fmt::format("{}, where a normal of mean {} and deviation {} has no share", range,
                              format_quantity(of.centre, dimension),
                              format_quantity(of.deviation, scene::difference_of(dimension))),
                  "a range near the mean");
}

// --- entries ---

/// The scene key that an entry names, which the dimension of its other keys follows from.
KeyDescription read_scene_key(VaryReader& reader, const Varied& admitted) {
  const toml::node* node = reader.table.get("key");
  const KeyDescription description = *scene::find_key(vary_keys({}), "key");
  if (!node) reader.refuse("key", "nothing; the key is missing", allowed_text(description));
  const std::string name = std::get<std::string>(
      scene::within(table_name, [&] { return scene::read_value(*node, description, reader.study.file); }));
  const Place place = scene::place_of(*node, reader.study.file);
  reader.places["key"] = place;
  if (name == study::gap_key && admitted.distributions)
    return scene::describe_key(reader.study.scene, name, place);
  if (name == "gap" || name == study::gap_key)
    reader.refuse("key", name + ", which all cases share",
                  "a scene key that takes one number; the gaps are the study's key gaps");
  KeyDescription key = varied_key(reader.study, name, "vary.key", place);
  if (admitted.distributions && key.dimension == Dimension::count)
    reader.refuse("key", name + ", a whole number", "a key that may take any number between two");
  return key;
}

/// An entry without a distribution lists its values.
void check_values(const VaryReader& reader) {
  for (const char* key : {"distribution", "range", "mean", "deviation"})
    if (reader.given(key))
      reader.refuse(key, "a distribution in a study of kind " + reader.study.study.kind.name, "values");
  reader.need("values", "an entry of this kind");
}

void read_entry(VaryReader& reader, const Varied& admitted) {
  const KeyDescription key = reader.text.key = read_scene_key(reader, admitted);
  reader.places = scene::within(table_name, [&] {
    return scene::read_table(reader.table, vary_keys(key), {}, reader.study.file, reader.text);
  });
  for (const auto& [given, place] : reader.places) reader.study.places[reader.study_key(given)] = place;
  check_free(reader.study, key.name, reader.place_of("key"), "vary.key");
  Axis axis{study::name_of_axis(key.name), reader.study_key("key"), key, {}};
  if (admitted.distributions) {
    if (reader.given("values"))
      reader.refuse("values", "values in a study of kind " + reader.study.study.kind.name, "a distribution");
    reader.need("distribution", "an entry of this kind");
    check_distribution(reader);
    axis.distribution = reader.text.distribution;
    axis.values_key = reader.study_key(reader.given("range") ? "range" : "deviation");
  } else {
    check_values(reader);
    axis.values_key = reader.study_key("values");
    check_twice(reader.study, axis.values_key, key.dimension, reader.text.values);
    axis.values = std::move(reader.text.values);
  }
  reader.study.study.axes.push_back(std::move(axis));
}

// --- the constants of a fit, together ---

/// Throws where the constants of the study's scene cannot vary together.
void check_constants(const VaryReader& reader) {
  const StudyFile& study = reader.study;
  if (settings_of<SensitivitySettings>(study.study).calibrated)
    reader.refuse("key", "the constants a second time", "each key once");
  if (study.scene.constants == nullptr || study.scene.constants->fitted_keys.empty())
    reader.refuse("key", "constants of a scene that has none that were fitted",
                  "a scene or study with constants = the file of a calibration");
}

/// Adds an axis for a fitted constant, whose logarithm has that standard deviation.
void add_constant(VaryReader& reader, const std::string& name, double deviation) {
  StudyFile& study = reader.study;
  const Place place = reader.place_of("key");
  check_free(study, name, place, "vary.key");
  const KeyDescription key = varied_key(study, name, "vary.key", place);
  study.study.axes.push_back({name,
                              reader.study_key("key"),
                              key,
                              {},
                              Distribution::log_normal(study::number_in(study.scene, name), deviation)});
}

void read_constants(VaryReader& reader) {
  const toml::node& node = *reader.table.get("key");
  const Place place = reader.places["key"] = scene::place_of(node, reader.study.file);
  reader.study.places[reader.study_key("key")] = place;
  for (const auto& [key, other] : reader.table)
    if (key != "key") reader.refuse("key", std::string(key.str()) + " beside constants", "the key alone");
  check_constants(reader);
  const scene::Constants& constants = *reader.study.scene.constants;
  const auto [names, covariance] = scene::skin_constants(constants);
  auto factor = math::covariance_factor(covariance, names.size());
  if (!factor)
    reader.refuse("key", "constants whose covariance is not positive definite",
                  "those of a fit that settled");
  Study& study = reader.study.study;
  settings_of<SensitivitySettings>(study).calibrated = {study.axes.size(), names.size(), std::move(*factor)};
  for (std::size_t i = 0; i < names.size(); ++i)
    add_constant(reader, names[i], std::sqrt(covariance[i * names.size() + i]));
}

}  // namespace

StudyTable vary_table() {
  StudyTable table = study_table_of(table_name, vary_keys({}));
  for (scene::DocumentedKey& key : table.keys) key.default_text.clear();  // an entry has what its form needs
  return table;
}

void read_vary(const StudySource& source, const Varied& admitted, StudyFile& study) {
  const auto tables = study::tables_of(source.root, table_name, study, admitted.needed);
  for (std::size_t index = 0; const toml::table* table : tables) {
    VaryReader reader{study, *table, index++};
    if (admitted.distributions && (*table)["key"].value_or(std::string{}) == constants_key)
      read_constants(reader);
    else
      read_entry(reader, admitted);
  }
}

}  // namespace launchsafe::kinds
