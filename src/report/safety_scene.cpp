// What was simulated: shell, load, inputs; and where and when it becomes hot.
#include "launchsafe/report/case_pictures.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/section_drawing.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "launchsafe/scene/stations.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace launchsafe::report::safety {
namespace {

// --- load ---

/// Points of the analytic load; enough for a smooth line on paper.
constexpr int curve_points = 400;

void say_load(const Subject& subject, SafetySection& section) {
  const scene::Load& load = subject.scene().load;
  const bool measured_curve = !load.curve_time.empty();
  const CaseEvidence* run = nullptr;
  for (const CaseEvidence& each : subject.evidence.cases)
    if (each.present && run == nullptr && !each.mechanics.trace.time.empty()) run = &each;
  Plot plot;
  plot.title = "Load";
  plot.x.label = "time [ms]";
  plot.y.label = "pressure [MPa]";
  plot.height = 440;
  const auto add = [&](const char* label, const std::vector<double>& time,
                       const std::vector<double>& pressure, Style style, int colour) {
    plot.series.push_back({.label = label, .style = style, .colour = colour});
    for (std::size_t i = 0; i < time.size(); ++i) plot.series.back().add(1e3 * time[i], 1e-6 * pressure[i]);
  };
  if (measured_curve) add("measured, as stated", load.curve_time, load.curve_pressure, Style::line, 7);
  const scene::PressureHistory chamber(load);
  std::vector<double> time, pressure;
  const double end = scene::end_time(load);
  for (int i = 0; i <= curve_points; ++i) {
    time.push_back(end * i / curve_points);
    pressure.push_back(chamber.at(time.back()));
  }
  add("chamber, as simulated", time, pressure, Style::line, 0);
  if (run != nullptr)
    add("charge's bottom, computed", run->mechanics.trace.time, run->mechanics.trace.bottom_pressure,
        Style::dashed_line, 1);
  section.draw("load", "load.svg", std::move(plot),
               {{"peak", significant(1e-6 * chamber.stated_peak(), 4) + " MPa"},
                {"launch", scene::end_text(subject.scene())},
                {"exit", scene::exit_text(subject.scene())},
                {"measured", measured_curve},
                {"points", load.curve_time.size()},
                {"file", load.curve_file},
                {"bottom", run != nullptr},
                {"smoothing", load.smoothing > 0 ? significant(1e3 * load.smoothing, 3) + " ms" : ""}},
               subject.origin("the scene, in its manifest", run != nullptr ? run->label : ""));
}

// --- inputs ---

/// Keys of the study file's [set].
bool is_set_by_study(const Subject& subject, const std::string& key) {
  const std::string& input = subject.study.record.manifest.input_text;
  const std::size_t end = input.find("\n\n# scene\n");
  const std::size_t set = input.find("\n[set");
  return set < end && input.substr(set, end - set).find(key.substr(key.rfind('.') + 1)) != std::string::npos;
}

/// A long list by its beginning; the manifest holds all of it.
std::string short_value(const std::string& value) {
  constexpr std::size_t longest = 120, beginning = 40;
  if (value.size() <= longest) return value;
  const auto commas = std::count(value.begin(), value.end(), ',');
  return fmt::format("{} ... ({} values)", value.substr(0, value.rfind(',', beginning)), commas + 1);
}

/// Keys of a law of which no body is made.
bool is_of_unused_law(const scene::Scene& scene, const std::string& key) {
  const std::string law = key.substr(0, key.find('.'));
  if (law != "steel" && law != "elastic") return false;
  return std::none_of(scene.bodies.begin(), scene.bodies.end(),
                      [&](const scene::Body& body) { return body.material == law; });
}

/// Values of bodies, interfaces and further materials whose source the scene says.
void add_sources_of_tables(const scene::SceneFile& file, Table& table) {
  for (const scene::Source& source : file.scene.sources)
    for (const std::string& name : source.keys) {
      const auto key = scene::describe_key(file, name, {});
      if (!key || scene::find_key(scene::scene_keys(), name) != nullptr) continue;
      table.rows.push_back({name, scene::format_value(*key, scene::value_in(file, name)),
                            fmt::format("{}: {}", scene::meaning_of(source.standing), source.citation),
                            key->sentence});
    }
}

Table input_table(const Subject& subject) {
  std::map<std::string, scene::DocumentedKey> documented;
  for (scene::DocumentedKey& key : scene::describe_keys()) documented.emplace(key.description.name, key);
  Table table{.columns = {Column{"key", "key"}, Column{"value", "value"}, Column{"standing", "standing"},
                          Column{"meaning", "meaning"}}};
  for (const scene::ListedKey& key : scene::list_keys(subject.study.scene)) {
    if (is_of_unused_law(subject.scene(), key.name)) continue;
    // The manifest writes every key: one with the value of the program's default has the default's standing.
    const auto found = documented.find(key.name);
    std::string standing = "stated";
    if (!key.citation.empty())
      standing = fmt::format("{}: {}", scene::meaning_of(key.standing), key.citation);
    else if (found != documented.end() && found->second.default_text == key.value)
      standing = std::string(scene::meaning_of(found->second.description.standing)) + " (default)";
    else if (is_set_by_study(subject, key.name))
      standing = "set by the study";
    table.rows.push_back({key.name, short_value(key.value), standing, key.sentence});
  }
  add_sources_of_tables(subject.study.scene, table);
  return table;
}

Table body_table(const scene::Scene& scene) {
  Table table{.columns = {Column{"body", "body"}, Column{"material", "material"},
                          Column{"x_begin", "x from", keys::significant(6, centimetre)},
                          Column{"x_end", "to", keys::significant(6, centimetre)},
                          Column{"r_begin", "r from", keys::significant(6, centimetre)},
                          Column{"r_end", "to", keys::significant(6, centimetre)}}};
  for (const scene::Body& body : scene.bodies)
    table.rows.push_back({body.name, scene::material_text(scene, body), 100 * body.x_begin, 100 * body.x_end,
                          100 * body.r_begin, 100 * body.r_end});
  return table;
}

/// How bodies hold the charge, in words.
std::string held_text(const scene::Scene& scene) {
  std::string text;
  for (const scene::InterfaceText& each : scene::describe_interfaces(scene))
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", each.body, each.condition);
  return text;
}

// --- where and when ---

Table place_table(const JudgedCase& each) {
  return table_of(each.verdicts, {quantity::gap(), Column{"temperature_max", "T max", keys::fixed(0, kelvin)},
                                  Column{"temperature_max_place", "hottest station"},
                                  Column{"temperature_max_time", "at time", keys::fixed(2, millisecond)},
                                  Column{"ignition_time", "ignition at", keys::fixed(2, millisecond)},
                                  Column{"ignition_cause", "cause"},
                                  Column{"ignition_chemical_share", "chemical share", keys::fixed(2)},
                                  Column{"spread", "spread along the bottom", keys::fixed(0, kelvin)}});
}

/// Gaps whose histories are shown: the largest that is SAFE, and the smallest that is not.
std::vector<const Row*> shown_gaps(const JudgedCase& each) {
  const Row *safe = nullptr, *other = nullptr;
  for (const Row* row : each.verdicts) {
    if (text_of(*row, "verdict") == "SAFE") safe = row;
    if (other == nullptr && text_of(*row, "verdict") != "SAFE" && safe != nullptr) other = row;
    if (text_of(*row, "verdict") == "UNSAFE") {
      other = row;
      break;
    }
  }
  std::vector<const Row*> rows;
  for (const Row* row : {safe, other})
    if (row != nullptr) rows.push_back(row);
  if (rows.empty() && !each.verdicts.empty()) rows.push_back(each.verdicts.front());
  return rows;
}

void add_pictures(const Subject& subject, const JudgedCase& judged, const DrawnCase& drawn,
                  SafetySection& section) {
  for (const PictureKind& kind : picture_kinds()) {
    const std::string word = kind.word;
    if (word != "histories" && word != "profile" && word != "fields") continue;
    if (const std::string why = kind.lacks(drawn); !why.empty()) {
      section.say("place.lacks",
                  {{"fields", word == "fields"},
                   {"histories", word == "histories"},
                   {"profile", word == "profile"},
                   {"why", why}},
                  subject.origin("cases/*.h5", judged.label));
      continue;
    }
    std::vector<CasePicture> pictures = kind.pictures(drawn);
    std::erase_if(pictures, [&](const CasePicture& each) {
      return each.file == "profile_spread.svg" ||
             (word == "fields" && !each.file.starts_with("field_temperature"));
    });
    // The last snapshot shows what the launch has done.
    if (word == "fields" && pictures.size() > 1) pictures.erase(pictures.begin(), pictures.end() - 1);
    for (CasePicture& each : pictures) {
      Parts parts{{"case", judged.label}};
      if (each.gap) parts["gap"] = significant(100 * *each.gap, 6) + " cm";
      if (each.time) parts["time"] = significant(1e3 * *each.time, 4) + " ms";
      std::variant<Plot, CellPlot, std::string> picture;
      std::visit([&](auto& plot) { picture = std::move(plot); }, each.plot);
      section.draw("place." + word, each.file, std::move(picture), std::move(parts),
                   subject.origin("cases/*.h5", judged.label));
    }
  }
}

void say_histories(const Subject& subject, const JudgedCase& judged, const CaseEvidence& stored,
                   SafetySection& section) {
  const auto scene = scene_of(subject.study, *judged.verdicts.front());
  if (!scene || stored.mechanics.trace.samples() < 2) return;
  run::CaseResult result{stored.mechanics, {}};
  for (const Row* row : shown_gaps(judged)) {
    const double gap = 1e-2 * number_of(*row, "gap_cm");
    result.gaps.push_back(run::evaluate_gap(*scene, result.mechanics.trace, gap));
    const double difference =
        std::abs(result.gaps.back().at_stations.temperature - number_of(*row, "temperature_max_K"));
    if (difference <= same_temperature) continue;
    // Ignition under two-way coupling goes on in a run of its own.
    result.gaps.pop_back();
    section.say("place.other_history", {{"gap", significant(100 * gap, 6) + " cm"}},
                subject.origin("cases/*.h5", judged.label));
  }
  add_pictures(subject, judged, {*scene, result}, section);
}

}  // namespace

SafetySection scene_section(const Subject& subject) {
  SafetySection section{"scene"};
  const scene::Scene& scene = subject.scene();
  const Origin origin = subject.origin("the scene, in its manifest");
  section.say("scene.what",
              {{"title", scene.title},
               {"stations", scene::stations_of(scene).size()},
               {"width", significant(1e3 * scene.surface.station_width, 4) + " mm"},
               {"depth", significant(1e3 * scene.surface.station_depth, 4) + " mm"},
               {"interfaces", held_text(scene)}},
              origin);
  if (!scene.bodies.empty())
    section.draw("section", "section.svg", section_svg(scene), {{"title", scene.title}}, origin);
  section.show("bodies", body_table(scene), origin);
  say_load(subject, section);
  section.say("scene.inputs", {}, origin);
  section.show("inputs", input_table(subject), origin);
  return section;
}

SafetySection place_section(const Subject& subject) {
  SafetySection section{"place"};
  const JudgedCase* own = subject.own_case();
  if (own == nullptr) {
    section.say("place.none", {{"command", subject.study.command()}});
    return section;
  }
  if (!own->completed) {
    section.say("place.not_completed", {{"case", own->label}}, subject.origin("runs", own->label));
    return section;
  }
  section.show("place", place_table(*own), subject.origin("verdicts", own->label));
  const auto stored =
      std::find_if(subject.evidence.cases.begin(), subject.evidence.cases.end(),
                   [&](const CaseEvidence& each) { return each.present && each.label == own->label; });
  if (stored == subject.evidence.cases.end())
    section.say("place.no_case_file", {{"command", subject.study.command()}},
                subject.origin("runs", own->label));
  else
    say_histories(subject, *own, *stored, section);
  return section;
}

}  // namespace launchsafe::report::safety
