#include "study_keys.hpp"

namespace launchsafe::kinds {
namespace {

template <class Number>
Key<Study> study_number(std::string name, Dimension dimension, Limits limits, std::string sentence,
                        Number Study::*member) {
  return number_key<Study>(std::move(name), dimension, limits, Standing::assumed, std::move(sentence),
                           member);
}

/// Reasons by name, one key for each name that there may be: "accept.low-velocity".
Key<Study> reason_key(const std::string& table, const std::string& name, const std::string& of,
                      std::map<std::string, std::string> Study::*reasons) {
  Key<Study> key{keys::description(table + name, scene::KeyKind::text, Standing::input,
                                   "Reason for which it is accepted: " + of + ".")};
  key.example = "proof shots are fired so";
  key.set = [=](Study& study, const Value& value) { (study.*reasons)[name] = std::get<std::string>(value); };
  key.get = [](const Study&) { return Value(std::string{}); };
  return key;
}

StudyKeys reason_keys() {
  StudyKeys keys;
  for (const run::WarningKind& each : run::warning_kinds())
    if (each.acceptable)
      keys.push_back(reason_key("accept.", each.name, each.meaning, &Study::accepted_warnings));
  for (const scene::RangeKey& each : scene::range_keys())
    if (each.acceptable)
      keys.push_back(reason_key("accept.extrapolation.", each.name,
                                "outside of the interval of the " + each.meaning,
                                &Study::accepted_extrapolation));
  return keys;
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
  const toml::table table = scene::parse_toml(text, file);
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
  return {study_number("largest_gap", Dimension::length, between(1e-4, study::widest_search),
                       "Where the search for the critical gap ends.", &Study::largest_gap)};
}

StudyKeys verdict_keys() {
  using study::Spreads, study::StatedNumerics;
  const StudyKeys spreads = keys::keys_of_part(
      "uncertainty.", &Study::spreads,
      std::vector<Key<Spreads>>{
          number_key("peak_pressure", Dimension::share, between(0, 0.2), Standing::assumed,
                     "Two standard deviations of the peak pressure from round to round.",
                     &Spreads::peak_pressure),
          number_key("pulse_length", Dimension::share, between(0, 0.5), Standing::assumed,
                     "Two standard deviations of the length of the pulse at the same peak.",
                     &Spreads::pulse_length),
          number_key("initial_temperature", Dimension::temperature_difference, between(0, 100),
                     Standing::assumed, "Two standard deviations of the temperature before launch.",
                     &Spreads::initial_temperature)});
  const StudyKeys numerics = keys::keys_of_part(
      "numerics.", &Study::numerics,
      std::vector<Key<StatedNumerics>>{
          number_key("value", Dimension::temperature_difference, between(0.1, 1000), Standing::input,
                     "Error of T max by cells and steps, in place of a companion launch with other cells.",
                     &StatedNumerics::error),
          text_key("because", Standing::input, "Ground for it, in words.",
                   "companions of the corners of this sweep", &StatedNumerics::because)});
  const StudyKeys models{text_key(
      "models", Standing::input,
      "Other constants, \"a, b\": names, or paths of constants files from the study file's "
      "folder. Every case is launched under each of them too, and the largest change of its critical "
      "gap widens its bounds.",
      "bonded_base, wall_friction", &Study::model_names)};
  return joined({spreads, numerics, models, reason_keys()});
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

void check_reasons(const StudyFile& study) {
  const study::StatedNumerics& numerics = study.study.numerics;
  if (numerics.is_stated() || !numerics.because.empty()) {
    if (!numerics.is_stated())
      refuse_at(study, "numerics.because", "a ground without a value",
                "numerics = { value = \"1 K\", because = \"...\" }");
    if (!study.places.contains("numerics.because"))
      refuse_at(study, "numerics.value", "a value without a ground",
                "numerics = { value = \"1 K\", because = \"...\" }");
    scene::check_reason(numerics.because, place_of_key(study, "numerics.because"), "numerics.because");
  }
  const auto check = [&](const std::map<std::string, std::string>& reasons, const std::string& table) {
    for (const auto& [name, because] : reasons)
      scene::check_reason(because, place_of_key(study, table + name), table + name);
  };
  check(study.study.accepted_warnings, "accept.");
  check(study.study.accepted_extrapolation, "accept.extrapolation.");
}

void read_references(const StudySource& source, StudyFile& study) {
  study::read_rows(source.root, "reference", published_row_keys, study.file, study, study.study.references);
  read_shared_references(source, study);
  check_references(study);
}

}  // namespace launchsafe::kinds
