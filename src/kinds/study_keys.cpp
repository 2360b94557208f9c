#include "study_keys.hpp"

namespace launchsafe::kinds {
namespace {

template <class Number>
Key<Study> study_number(std::string name, Dimension dimension, Limits limits, std::string sentence,
                        Number Study::*member) {
  return number_key<Study>(std::move(name), dimension, limits, Standing::assumed, std::move(sentence),
                           member);
}

constexpr const char *value_part = ".value", *because_part = ".because";

/// The source of an uncertainty that is stated by hand; it is read after the value.
Key<Study> because_key(const std::string& name, double Study::*member, double least) {
  Key<Study> key{keys::description(name + because_part, scene::KeyKind::text, Standing::input,
                                   "Where that comes from, in words; told beside verdicts.")};
  key.example = "mesh study of this shell, 2.5 and 1.25 mm";
  key.set = [=](Study& study, const Value& value) {
    study.stated.push_back({name, study.*member, std::get<std::string>(value), least});
  };
  key.get = [](const Study&) { return Value(std::string{}); };
  return key;
}

/// Of a temperature, K: NAME = { value = "1 K", because = "..." }. `least`: K, at the least, without it.
StudyKeys stated_uncertainty(const std::string& name, std::string sentence, double Study::*member,
                             double least = study::not_a_number) {
  return {study_number(name + value_part, Dimension::temperature_difference, between(0, 1000),
                       std::move(sentence), member) |
              plausibly(between(1, 1000),
                        "no published temperature is met, and no mesh known to be exact, to a kelvin"),
          because_key(name, member, least)};
}

/// The uncertainties that are stated by hand among some keys.
std::vector<std::string> uncertainties_in(const StudyKeys& keys) {
  std::vector<std::string> names;
  for (const Key<Study>& key : keys)
    if (key.name.ends_with(because_part)) names.push_back(key.name.substr(0, key.name.rfind('.')));
  return names;
}

Key<Study> kind_key() {
  Key<Study> key{{.name = "kind", .kind = scene::KeyKind::word, .standing = Standing::input}, {}, {}};
  key.sentence = "What is asked.";
  key.required = true;
  for (const Kind& each : kinds()) key.words.push_back(each.traits.name);
  key.set = [](Study& study, const Value& value) { study.kind = traits_of(std::get<std::string>(value)); };
  key.get = [](const Study& study) { return Value(study.kind.name); };
  return key;
}

Key<Reference> reference_number(std::string name, Dimension dimension, std::string sentence,
                                double Reference::*member) {
  return number_key<Reference>(std::move(name), dimension, at_least(0), Standing::paper, std::move(sentence),
                               member);
}

const std::vector<Key<Reference>> published_row_keys{
    reference_number("gap", Dimension::length, "Gap of a published row.", &Reference::gap) | required(),
    text_key("scene", Standing::input,
             "Path of the scene of its launch from its file's folder; constants are fitted to no other.",
             "table8_fields.toml", &Reference::scene),
    reference_number("maximum_temperature", Dimension::temperature, "Its highest temperature.",
                     &Reference::maximum_temperature),
    text_key("point", Standing::paper, "Observation point of the highest temperature.", "G2",
             &Reference::point),
    reference_number("early_temperature", Dimension::temperature, "Its highest temperature at early_time.",
                     &Reference::early_temperature),
    text_key("early_point", Standing::paper, "Observation point of the highest temperature at early_time.",
             "G13", &Reference::early_point),
    reference_number("spread", Dimension::temperature_difference,
                     "Highest minus lowest published temperature of the bottom at the end of the launch.",
                     &Reference::spread),
    reference_number("early_spread", Dimension::temperature_difference, "The same at early_time.",
                     &Reference::early_spread),
    reference_number("ignition_time", Dimension::time, "When it ignited; absent where it did not.",
                     &Reference::ignition_time),
    reference_number("rise_begins", Dimension::time, "From when on its highest temperature rises fast.",
                     &Reference::rise_begins),
    reference_number("rise_ends", Dimension::time, "Until when it rises fast.", &Reference::rise_ends),
};

/// Reads the file of references that a study names, which several may share.
void read_shared_references(const StudySource& source, StudyFile& study) {
  constexpr const char *key = "references", *table_name = "reference", *tables = "[[reference]]";
  const std::string& name = study.study.references_file;
  if (name.empty()) return;
  if (source.root.contains(table_name))
    refuse_at(study, key, fmt::format("a file of references beside {}", tables), "one of both");
  const std::string text =
      read_named_file(study, source.folder, key, name, fmt::format("a file with {}", tables));
  study.records.push_back(store::sha256(text));
  const std::string file = (source.folder / name).string();
  const toml::table table = taken(scene::parse_toml(text, file));
  for (const auto& [each, node] : table)
    if (each.str() != table_name)
      throw error_at(scene::place_of(node, file), std::string(each.str()), "a key of another kind of file",
                     fmt::format("only {}", tables));
  study::read_rows(table, table_name, published_row_keys, file, study, study.study.references);
}

void check_references(const StudyFile& study) {
  const auto& references = study.study.references;
  for (std::size_t i = 0; i < references.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(references[i].gap - references[j].gap) <= 1e-9)
        refuse_at(study, fmt::format("reference.{}.gap", i),
                  format_quantity(references[i].gap, Dimension::length) + " twice", "each gap once");
}

}  // namespace

const StudyKeys& common_keys() {
  static const StudyKeys keys{
      kind_key(),
      text_key("title", Standing::input,
               "What this study is, for reports; the scene's title where there is none.",
               "Critical gap of the 155 mm shell", &Study::title),
      text_key("scene", Standing::input, "Path of the scene from the study file's folder.",
               "scene_155mm.toml", &Study::scene) |
          required(),
      text_key(
          "constants", Standing::input,
          "Name of shipped constants, or path of a constants file from the study file's folder, in place "
          "of those of the scene.",
          "155mm", &Study::constants),
      study_number("early_time", Dimension::time, above_to(0, 1),
                   "An instant at which temperatures are listed and compared too.", &Study::early_time),
  };
  return keys;
}

StudyKeys gaps_keys() {
  return {list_key("gaps", Dimension::length, between(0, 0.01), Standing::assumed,
                   "Gaps to judge; those of the scene if absent.", &Study::gaps)};
}

StudyKeys search_keys() {
  return {
      study_number("tolerance", Dimension::length, between(1e-9, 1e-3),
                   "Largest width of the bracket of the critical gap; 0.0001 cm at most.",
                   &Study::tolerance) |
          plausibly(between(1e-9, 2e-4),
                    "a wider bracket says little of gaps that are tenths of a millimetre"),
      study_number("largest_gap", Dimension::length, above_to(0, study::widest_search),
                   "Where the search for the critical gap ends. Without ignition up to there no gap is SAFE, "
                   "unless it "
                   "is the largest value, of which gaps up to half can be.",
                   &Study::largest_gap) |
          plausibly(between(1e-4, 0.01), "a search that ends at less finds no gap that ignites"),
  };
}

StudyKeys judging_keys() {
  return joined(
      {search_keys(),
       stated_uncertainty("numerical_uncertainty",
                          "Uncertainty of the maximum temperature from the mesh, from a mesh study.",
                          &Study::numerical_uncertainty, study::assumed_numerical_uncertainty)});
}

StudyKeys uncertainty_keys() {
  const StudyKeys records{
      text_key("accuracy", Standing::input,
               "Path of the record of an accuracy study, accuracy.json, from the study file's folder; it "
               "gives the numerical uncertainty of every setting in it. Of several, \"a, b\", that which was "
               "made of such a scene; one of gaps that close is of them alone.",
               "../reports/accuracy/accuracy_155mm.json", &Study::accuracy),
      study_number("setting_tolerance", Dimension::temperature_difference, above_to(0, 1000),
                   "Replaces the scene's numerics by the cheapest setting of the record that knows the "
                   "maximum temperature to this; on the command line --tolerance.",
                   &Study::setting_tolerance),
  };
  return joined(
      {records,
       stated_uncertainty("fit_uncertainty",
                          "Uncertainty of the margin from the calibrated constants, on the rows that they "
                          "were fitted to; what the record of the calibration says if absent, and without "
                          "one that of the shipped calibration.",
                          &Study::fit_uncertainty),
       stated_uncertainty("input_uncertainty",
                          "Uncertainty of the maximum temperature from what is not known of the launch (see "
                          "kind sensitivity), for the study's own scene; if absent an assumed spread of load "
                          "and initial temperature is propagated, which takes a second run for every case.",
                          &Study::input_uncertainty, study::assumed_temperature_spread)});
}

StudyKeys models_keys() {
  return {
      text_key("models", Standing::input,
               "Other constants, \"a, b\": names, or paths of constants files from the study file's "
               "folder. Every case is launched under each of them too, and how far its critical gap moves "
               "counts as uncertainty.",
               "bonded_base, wall_friction", &Study::model_names)};
}

StudyKeys reference_keys() {
  return {
      text_key("references", Standing::input,
               "Path of a file that holds the published rows, [[reference]], from the study file's folder.",
               "table8.toml", &Study::references_file),
  };
}

std::string default_text(const KeyDescription& key, const Value& value) {
  const auto* number = std::get_if<double>(&value);
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  const bool none = key.required || (number && !std::isfinite(*number)) ||
                    (numbers && !numbers->empty() && !std::isfinite(numbers->front()));
  return none ? std::string{} : scene::format_value(key, value);
}

StudyTable reference_table() { return study_table_of("reference", published_row_keys); }

void check_bare_uncertainties(const toml::table& root, const StudyKeys& keys, const std::string& file) {
  for (const std::string& name : uncertainties_in(keys)) {
    const toml::node* node = root.get(name);
    if (node == nullptr || (node->is_table() && !node->as_table()->empty())) continue;
    const std::string value = node->is_string() ? found_text(*node) : "\"1 K\"";
    throw error_at(scene::place_of(*node, file), name, found_text(*node) + " without a source",
                   "a value with where it comes from, in words",
                   fmt::format("{{ value = {}, because = \"...\" }}", value));
  }
}

void check_stated_uncertainties(const StudyKeys& keys, const StudyFile& study) {
  const auto has = [&](const std::string& key) { return study.places.contains(key); };
  for (const std::string& name : uncertainties_in(keys)) {
    const std::string value = name + value_part, because = name + because_part;
    if (has(value) != has(because))
      refuse_at(study, has(because) ? because : value,
                has(because) ? "a source without a value" : "a value without a source",
                fmt::format("{} = {{ value = \"1 K\", because = \"...\" }}", name));
  }
  for (const study::StatedUncertainty& each : study.study.stated) {
    const std::string key = each.key + because_part;
    scene::check_reason(each.because, place_of_key(study, key), key);
  }
}

void read_references(const StudySource& source, StudyFile& study) {
  study::read_rows(source.root, "reference", published_row_keys, study.file, study, study.study.references);
  read_shared_references(source, study);
  check_references(study);
}

}  // namespace launchsafe::kinds
