// What was simulated: shell, load, inputs; and pictures of where and when it becomes hot.
#include "launchsafe/report/case_pictures.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/scene_keys.hpp"
#include "safety_facts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::report::safety {
namespace {

/// A value in the unit of its key: "peak_MPa".
double in(keys::Unit unit, double value) { return shown_value(value, keys::significant(6, unit)); }

/// A long list by its beginning; the manifest holds all of it.
std::string short_value(const std::string& value) {
  constexpr std::size_t longest = 120, beginning = 40;
  if (value.size() <= longest) return value;
  return fmt::format("{} ... ({} values)", value.substr(0, value.rfind(',', beginning)),
                     std::ranges::count(value, ',') + 1);
}

/// All inputs, but those of a law of which no body is made.
Row inputs_of(const scene::SceneFile& file) {
  const auto known = [](const std::string& name) { return scene::find_key(scene::scene_keys(), name); };
  std::vector<std::string> names;
  for (const scene::ListedKey& key : scene::list_keys(file)) names.push_back(key.name);
  // Values of bodies, interfaces and further materials whose source the scene says.
  for (const scene::Source& source : file.scene.sources)
    std::ranges::copy_if(source.keys, std::back_inserter(names),
                         [&](const std::string& name) { return known(name) == nullptr; });
  Row inputs = Row::array();
  for (const std::string& name : names) {
    const std::string law = name.substr(0, name.find('.'));
    const bool is_unused =
        (law == "steel" || law == "elastic") &&
        std::ranges::find(file.scene.bodies, law, &scene::Body::material) == file.scene.bodies.end();
    const auto key = scene::describe_key(file, name, {});
    if (is_unused || !key) continue;
    const std::string value = scene::format_value(*key, scene::value_in(file, name));
    std::string standing = "stated";
    if (const scene::Source* source = scene::source_of(file.scene.sources, name))
      standing = fmt::format("{}: {}", scene::meaning_of(source->standing), source->citation);
    // The manifest writes every key: one with the value of the program's default has the default's standing.
    else if (known(name) && key->usual.empty() &&
             value == scene::format_value(*key, known(name)->default_value()))
      standing = fmt::format("{} (default)", scene::meaning_of(key->standing));
    inputs.push_back(
        {{"key", name}, {"value", short_value(value)}, {"standing", standing}, {"meaning", key->sentence}});
  }
  return inputs;
}

/// Gaps whose histories are shown: the largest that is SAFE, and the smallest that is not, one that ignites
/// before others; or the first.
std::vector<const Row*> shown_gaps(const Row& own) {
  const auto rows = [&](const char* which) { return selected({"", "", which}, own); };
  std::vector<const Row*> shown = rows("verdicts where verdict SAFE largest gap_cm");
  auto next = rows("verdicts where verdict UNSAFE smallest gap_cm");
  if (next.empty() && !shown.empty()) next = rows("verdicts where verdict INDETERMINATE smallest gap_cm");
  std::ranges::move(next, std::back_inserter(shown));
  return shown.empty() ? rows("verdicts first 1") : shown;
}

}  // namespace

Row scene_facts(const StudyEvidence& study) {
  const scene::Scene& scene = study.scene.scene;
  const auto& strength = scene.charge().strength;
  Row facts{{"title", scene.title},
            {"launch", scene::launch_sentence(scene)},
            {"end", scene::end_text(scene)},
            {"exit", scene::exit_text(scene)},
            {"peak_MPa", in(megapascal, own_value(study, "load.peak"))},
            {"crack_um", in(micrometre, strength.initial_crack_radius)},
            {"flaw_mm", in(millimetre, strength.flaw_size)},
            {"temperature_K", scene.initial_temperature},
            {"ignition_K", scene.charge().kinetics.ignition_temperature},
            {"film", scene.surface.air_model == scene::AirModel::film},
            {"closes", scene.surface.model == scene::GapModel::closing},
            {"stations", scene::stations_of(scene).size()},
            {"station_width_mm", in(millimetre, scene.surface.station_width)},
            {"station_depth_mm", in(millimetre, scene.surface.station_depth)},
            {"curve_points", scene.load.curve_time.size()},
            {"curve_file", scene.load.curve_file},
            {"smoothing_ms", in(millisecond, scene.load.smoothing)},
            {"inputs", inputs_of(study.scene)},
            {"held", Row::array()},
            {"bodies", Row::array()},
            {"left_out", Row::array()}};
  for (const scene::InterfaceText& each : scene::describe_interfaces(scene))
    facts["held"].push_back(each.body + ": " + each.condition);
  for (const scene::Body& body : scene.bodies)
    facts["bodies"].push_back({{"body", body.name},
                               {"material", scene::material_text(scene, body)},
                               {"x_begin_cm", in(centimetre, body.x_begin)},
                               {"x_end_cm", in(centimetre, body.x_end)},
                               {"r_begin_cm", in(centimetre, body.r_begin)},
                               {"r_end_cm", in(centimetre, body.r_end)}});
  const scene::Plan plan = scene::make_plan(scene);
  for (const scene::NamedTerm& term : scene::plan_terms)
    if (!(plan.*term.term).in)
      facts["left_out"].push_back({{"term", term.title}, {"why", (plan.*term.term).reason}});
  if (scene.bodies.empty()) return facts;
  facts["section"] = {{"file", "section.svg"}, {"svg", section_svg(scene)}};
  return facts;
}

Row picture_facts(const StudyEvidence& study, const Row& own, const StoredLaunch& stored, PageFacts& all) {
  Row facts = Row::object();
  run::CaseResult shown_result{stored.result.mechanics, {}};
  for (const Row* row : shown_gaps(own)) {
    const double gap = number_of(*row, "gap_cm") / shown_gap(1.0);
    const auto found = std::ranges::find(stored.result.gaps, gap, &run::GapResult::gap);
    if (found != stored.result.gaps.end())
      shown_result.gaps.push_back(*found);
    else  // ignition under two-way coupling goes on in a run of its own
      facts["other_histories"].push_back(*row);
  }
  DrawnCase drawn{stored.scene, shown_result};
  drawn.early_time = number_of(study.study, "early_time_ms") / in(millisecond, 1.0);
  for (const Row& row : study.rows("comparison"))
    drawn.published.push_back({.gap = number_of(row, "gap_cm") / shown_gap(1.0),
                               .maximum_temperature = number_of(row, "temperature_max_published_K"),
                               .point = text_of(row, "temperature_max_published_place"),
                               .early_temperature = number_of(row, "temperature_early_published_K"),
                               .early_point = text_of(row, "temperature_early_published_place"),
                               .ignition_time = number_of(row, "ignition_time_published_ms")});
  for (const PictureKind& kind : picture_kinds()) {
    const std::string word = kind.word;
    if (word == "air" || word == "energy" || word == "combustion") continue;
    if (const std::string why = kind.lacks(drawn); !why.empty()) {
      facts["lacks"].push_back({{"word", word}, {"why", why}});
      continue;
    }
    for (CasePicture& each : kind.pictures(drawn)) {
      facts[word].push_back({{"file", each.file},
                             {"gap_cm", each.gap ? Row(shown_gap(*each.gap)) : Row()},
                             {"time_ms", each.time ? Row(in(millisecond, *each.time)) : Row()}});
      all.drawings[each.file] = std::move(each.plot);
    }
  }
  return facts;
}

}  // namespace launchsafe::report::safety
