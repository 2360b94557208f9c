// What launchsafe explains of itself: the keys of its files, what editors take, and materials with every
// number and where it comes from.
#include "explain.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::app {
namespace {

std::string standings() {
  using enum scene::Standing;
  std::vector<std::string> texts;
  for (const scene::Standing standing : {paper, literature, derived, assumed, calibrated})
    texts.push_back(fmt::format("[{}] {}", scene::letter_of(standing), scene::meaning_of(standing)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// A list whose every entry ends with an empty line.
ExitCode print_list(std::string text, Json members, Console& console) {
  text.pop_back();
  return console.done(text, std::move(members));
}

bool has(const std::string& name, const std::string& word) { return name.find(word) != std::string::npos; }

/// The keys with a word in their name; all for an empty one.
Json listed(const std::vector<scene::DocumentedKey>& keys, const std::string& word) {
  Json rows = Json::array();
  for (const auto& [described, default_text] : keys)
    if (has(described.name, word))
      rows.push_back({{"key", described.name},
                      {"si_unit", scene::si_unit_of(described.dimension)},
                      {"allowed", scene::allowed_text(described)},
                      {"plausible", scene::plausible_text(described)},
                      {"default", default_text},
                      {"required", described.required},
                      {"standing", scene::letter_of(described.standing)},
                      {"sentence", described.sentence}});
  return rows;
}

/// For people, who are told what is plausible only where a reason is known.
std::string text_of_keys(Json rows) {
  for (Json& row : rows)
    if (row["plausible"].get_ref<std::string&>().find(", because ") == std::string::npos)
      row.erase("plausible");
  return told("key_list.txt", {{"rows", rows}});
}

/// The keys of scene and study files, from the same descriptions that read them.
ExitCode explain_keys(const std::string& word, Console& console) {
  Json rows{{"keys", listed(scene::describe_keys(), word)}};
  if (word.empty())
    for (const auto& [described, value] : scene::derived_quantities())
      rows["derived_quantities"].push_back({{"quantity", described.name},
                                            {"si_unit", scene::si_unit_of(described.dimension)},
                                            {"plausible", scene::plausible_text(described)},
                                            {"sentence", described.sentence}});
  rows["study_keys"] = listed(kinds::describe_study_keys(), word);
  Json facts{{"standings", word.empty() ? standings() : ""}};
  for (const auto& [name, list] : rows.items()) facts[name] = text_of_keys(list);
  if (facts["keys"] == "" && facts["study_keys"] == "")
    console.refuse(fmt::format(
        "explain --keys: found \"{}\", which no key has; allowed: a part of a name, such as load", word));
  return print_list(told("keys.txt", facts), rows, console);
}

/// Every column of the tables of all kinds, from the same descriptions that write them.
ExitCode explain_results(const std::string& word, Console& console) {
  Json list = Json::array();
  for (const kinds::Kind& kind : kinds::kinds()) {
    for (const report::ReportTable& table : kind.results()) {
      Json columns = Json::array();
      for (const report::Column& column : table.table.columns)
        if (const std::string key = column.key(); has(key, word))
          columns.push_back({{"key", key},
                             {"name", column.heading},
                             {"unit", column.form.unit},
                             {"meaning", column.meaning}});
      if (!columns.empty())
        list.push_back(
            {{"kind", kind.traits.name}, {"member", table.member}, {"csv", table.csv}, {"columns", columns}});
    }
  }
  if (list.empty())
    console.refuse(
        fmt::format("explain --results: found \"{}\", which no column has; allowed: a part of a name, such "
                    "as critical_gap",
                    word));
  return print_list(told("results.txt", {{"tables", list}, {"all", word.empty()}}), {{"results", list}},
                    console);
}

using scene::NamedMaterial;

/// A scene with the numbers of a material.
scene::Scene with_material(scene::Scene scene, const NamedMaterial& material) {
  for (const auto& key : scene::scene_keys())
    if (const auto given = material.values.find(key.name); given != material.values.end())
      key.set(scene, given->second.value);
  return scene;
}

/// The value of a key, which has a name of its own in a material.
struct Number {
  std::string key, name, value;
};

/// In the order of their sources; the user's word is the source of those that have no other.
Json numbers_json(const std::vector<scene::Source>& sources, const std::vector<Number>& numbers) {
  Json list = Json::array();
  const auto add = [&list](const Number& number, scene::Standing standing, const std::string& citation) {
    list.push_back({{"key", number.name},
                    {"value", number.value},
                    {"standing", scene::letter_of(standing)},
                    {"citation", citation}});
  };
  for (const scene::Source& source : sources)
    for (const std::string& key : source.keys)
      add(*std::ranges::find(numbers, key, &Number::key), source.standing, source.citation);
  for (const Number& each : numbers)
    if (scene::source_of(sources, each.key) == nullptr)
      add(each, scene::Standing::input, "no source is given");
  return list;
}

Json json_of(const NamedMaterial& material) {
  std::vector<Number> numbers;
  for (const auto& [key, given] : material.values)
    numbers.push_back({key, scene::key_in_material(material.law, key),
                       scene::format_value(*scene::find_key(scene::scene_keys(), key), given.value)});
  const study::Calibration shipped = study::shipped_calibration();
  const bool calibrated =
      study::distance_to_calibration(with_material(shipped.scene, material), shipped).inside();
  const char* calibration = calibrated
                                ? "the constants of the 155 mm shell were calibrated with it"
                                : "never calibrated: no verdict that rests on it is SAFE until somebody "
                                  "accepts it as it is, or calibrates it";
  std::string what = fmt::format("law {}; {}", material.law, calibration);
  if (material.law == "charge") {
    const materials::Charge charge = with_material({}, material).charge();
    what += "; " + report::runaway_text(charge.kinetics, charge.specific_heat);
  }
  return {{"name", material.name},
          {"title", material.title},
          {"what", what},
          {"law", material.law},
          {"calibrated", calibrated},
          {"numbers", numbers_json(material.sources, numbers)}};
}

template <class Named>
std::vector<Number> numbers_of(const std::vector<scene::Key<Named>>& keys, const Named& named) {
  std::vector<Number> numbers;
  for (const auto& key : keys)
    if (key.name != "title" && key.is_used(named))
      numbers.push_back({key.name, key.name, scene::format_value(key, key.get(named))});
  return numbers;
}

Json json_of(const scene::NamedContact& contact) {
  return {{"name", contact.name},
          {"title", contact.title},
          {"what", "contact of an interface"},
          {"numbers", numbers_json(contact.sources, numbers_of(scene::contact_keys(), contact))}};
}

Json json_of(const scene::Decomposition& decomposition) {
  const double specific_heat = materials::Charge{}.specific_heat;
  const auto runaway = [&](double from) {
    return 1e3 * materials::adiabatic_runaway_time(decomposition.kinetics, specific_heat, from);
  };
  return {{"name", decomposition.name},
          {"title", decomposition.title},
          {"what", "decomposition of a flame, combustion.kinetics; with the specific heat of comp-b it " +
                       report::runaway_text(decomposition.kinetics, specific_heat)},
          {"runaway_from_519_K_ms", runaway(519.0)},
          {"runaway_from_550_K_ms", runaway(550.0)},
          {"numbers",
           numbers_json(decomposition.sources, numbers_of(scene::decomposition_keys(), decomposition))}};
}

/// The same for people.
std::string text_of(const Json& told) {
  const auto text_in = [](const Json& object, const char* key) { return object[key].get<std::string>(); };
  std::string text =
      fmt::format("{}: {}\n  {}\n", text_in(told, "name"), text_in(told, "title"), text_in(told, "what"));
  std::string source;
  for (const Json& number : told["numbers"]) {
    const std::string own =
        fmt::format("  [{}] {}\n", text_in(number, "standing"), text_in(number, "citation"));
    if (std::exchange(source, own) != own) text += own;
    text += fmt::format("      {:<32}{}\n", text_in(number, "key"), text_in(number, "value"));
  }
  return text;
}

/// Prints those with a word in their name, every number and where it comes from: all for an empty one.
/// Where there is none, `fault` is.
ExitCode explain_materials(const scene::NamedMaterials& named, const std::string& word,
                           const std::string& fault, Console& console) {
  std::string text;
  const auto list_of = [&](const auto& all) {
    Json list = Json::array();
    for (const auto& each : all) {
      if (!has(each.name, word)) continue;
      list.push_back(json_of(each));
      text += (text.empty() ? "" : "\n") + text_of(list.back());
    }
    return list;
  };
  const auto materials = list_of(named.materials), contacts = list_of(named.contacts),
             decompositions = list_of(named.decompositions);
  if (text.empty()) console.refuse(fault);
  return console.done(text,
                      {{"materials", materials}, {"contacts", contacts}, {"decompositions", decompositions}});
}

}  // namespace

ExitCode explain_program(const ExplainArguments& arguments, Console& console) {
  const std::string word = arguments.file.string();
  if (arguments.keys) return explain_keys(word, console);
  if (arguments.results) return explain_results(word, console);
  if (arguments.materials)
    return explain_materials(
        {scene::shipped_materials(), scene::shipped_contacts(), scene::shipped_decompositions()}, word,
        fmt::format("explain --materials: found \"{}\", which no shipped material or contact has; "
                    "allowed: a part of a name, such as comp-b",
                    word),
        console);
  const Json schema = arguments.schema == "study"   ? study_schema()
                      : arguments.schema == "scene" ? scene_schema()
                                                    : references_schema();
  return console.done(schema.dump(2) + "\n", schema);
}

ExitCode explain_material_file(const path& file, Console& console) {
  return explain_materials(
      console.value_of(scene::read_material_file(file)), {},
      fmt::format("{}: found no material and no contact; allowed: tables [material.NAME] and [contact.NAME]",
                  file.string()),
      console);
}

}  // namespace launchsafe::app
