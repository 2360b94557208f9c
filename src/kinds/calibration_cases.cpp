// A study of kind calibration as a file: its keys, what it fits, and what its published rows must have.
#include "calibration_parts.hpp"

#include <boost/algorithm/string.hpp>

namespace launchsafe::kinds {
namespace {

Key<CalibrationSettings> weight_key(std::string name, std::string sentence,
                                    double CalibrationSettings::*weight) {
  return number_key(std::move(name), Dimension::temperature_difference, above_to(0, 1000), Standing::assumed,
                    std::move(sentence), weight);
}

const std::vector<Key<CalibrationSettings>> calibration_keys{
    text_key("fit", Standing::input,
             "Keys that are found by least squares, each with one positive number where the search starts: "
             "of the scene, or of a face of the charge, such as interface.side.friction.",
             "load.peak_time, load.width, friction.localisation", &CalibrationSettings::fit),
    weight_key("temperature_weight", "Standard deviation of a published temperature.",
               &CalibrationSettings::temperature_weight),
    weight_key("spread_weight", "Standard deviation of a published spread over the charge's bottom.",
               &CalibrationSettings::spread_weight),
    weight_key("place_weight", "By how much a published hottest place may be colder than the computed one.",
               &CalibrationSettings::place_weight),
    text_key("file", Standing::input, "Name of the constants file that is written beside the page.",
             "constants.toml", &CalibrationSettings::file),
};

std::vector<Key<CalibrationSettings>> interval_keys() {
  std::vector<Key<CalibrationSettings>> keys;
  for (const scene::RangeKey& each : scene::range_keys())
    keys.push_back(text_key<CalibrationSettings>(
        "range." + each.name, Standing::input,
        fmt::format("Interval in which the constants hold: {}.", each.meaning),
        each.dimension == Dimension::share ? "5 %" : "400 to 550 MPa",
        [name = each.name](auto& settings) -> auto& { return settings.range.at(name); }));
  return keys;
}

void check_file(const StudyFile& study) {
  const std::filesystem::path file = settings_of<CalibrationSettings>(study).file;
  if (file.filename() != file || file.extension() != ".toml")
    refuse_at(study, "file", '"' + file.string() + '"', "the name of a file without folders, with .toml");
}

// --- the rows ---

[[noreturn]] void refuse_rows(const StudyFile& study, std::string found, std::string allowed) {
  const char* at = study.places.contains("reference.0.gap") ? "reference.0.gap" : "kind";
  throw error_at(place_of_key(study, at), "reference", std::move(found), std::move(allowed));
}

void check_rows(const StudyFile& study) {
  const std::vector<Reference>& rows = study.study.references;
  if (rows.empty() || !(largest_safe(study).gap < smallest_igniting(study).gap))
    refuse_rows(study, "no row that ignites, or not only above one that does not",
                "rows with an ignition_time, all at larger gaps than at least one without");
  if (!std::isfinite(largest_safe(study).maximum_temperature))
    refuse_rows(study, "no maximum_temperature of the largest gap that does not ignite", "a row with it");
  const auto& points = study.scene.scene.output.observation_points;
  for (const Reference& row : rows)
    for (const std::string& point : {row.point, row.early_point})
      if (row.gap == 0.0 && !point.empty() && keys::find_named(points, point) == nullptr)
        refuse_rows(study, "the point \"" + point + '"', "an observation point of the scene");
}

/// Whether the rows' launch must have an input as the scene that is calibrated: it is no setting, no model of
/// the launch, and the constants do not hold it.
bool is_of_launch(const std::string& name, const std::vector<FittedKey>& fitted) {
  static const std::vector<std::string> others{
      "gap.thickness", "title", "coupling", "interface", "observation_point", "load.expected_velocity"};
  const auto begins_name = [&](const char* group) { return name.starts_with(group); };
  const auto is_fitted = [&](const FittedKey& each) { return each.description.name == name; };
  return std::ranges::count(constant_keys(), name) == 0 && std::ranges::count(others, name) == 0 &&
         std::ranges::none_of(fitted, is_fitted) &&
         std::ranges::none_of(std::array{"numerics.", "output.", "physics."}, begins_name);
}

/// "load.peak = 400 MPa, and 496 MPa in the scene of the study"; the name alone of a body.
std::string difference_text(const std::string& name, const SceneFile& of_row, const SceneFile& own) {
  const auto* key = scene::find_key(scene::scene_keys(), name);
  if (key == nullptr) return "another " + name;
  const auto text = [&](const SceneFile& file) {
    return scene::format_value(*key, scene::value_in(file, name));
  };
  return fmt::format("{} = {}, and {} in the scene of the study", name, text(of_row), text(own));
}

/// Constants that were fitted to the rows of another launch would pass as those of this one.
void check_launch_of_rows(const StudyFile& study) {
  const std::vector<FittedKey> fitted = keys_to_fit(study);
  for (std::size_t i = 0; i < study.study.references.size(); ++i) {
    const std::string& name = study.study.references[i].scene;
    if (name.empty()) refuse_rows(study, "a row without scene", "the scene of its launch in each row");
    const Place place = place_of_key(study, fmt::format("reference.{}.scene", i));
    const auto folder = std::filesystem::path(place.file).parent_path();
    const SceneFile of_row =
        scene::read_scene(scene::named_file(folder, name, place, "reference.scene", "a scene file"));
    for (const std::string& each : study::differences(study.scene.scene, of_row.scene))
      if (is_of_launch(each, fitted))
        throw error_at(place, "reference.scene",
                       fmt::format("\"{}\" with {}", name, difference_text(each, of_row, study.scene)),
                       "rows of the launch that is calibrated, or a scene of theirs in the study");
  }
}

void make_calibration_case(const StudySource& source, StudyFile& study) {
  read_references(source, study);
  check_file(study);
  check_launch_of_rows(study);
  check_rows(study);
  make_factorial(study);
}

std::vector<Failure> failed_calibration(const CalibrationResult& result) {
  if (result.failure.empty()) return {};
  return {{"calibration", result.failure, result.run.outcome}};
}

/// A key that a study fits, in the scene; throws what is wrong with it.
FittedKey key_to_fit(const StudyFile& study, const std::string& name) {
  constexpr const char* fit = "fit";
  const auto refuse = [&](const std::string& found, const std::string& allowed) {
    refuse_at(study, fit, name + ", " + found, allowed);
  };
  const Scene& scene = study.scene.scene;
  const std::string in_scene = scene::key_in_scene(scene, name);
  if (in_scene.empty()) refuse("a face that no body of the scene bears on", "a face that one does");
  FittedKey key{
      name,
      scene::within(fit,
                    [&] { return scene::describe_key(study.scene, in_scene, place_of_key(study, fit)); }),
      0.0};
  if (key.description.kind != scene::KeyKind::number)
    refuse("which takes no number", "keys with one positive number");
  const auto* of_scene = scene::find_key(scene::scene_keys(), in_scene);
  if (of_scene != nullptr && !of_scene->is_used(scene))
    refuse("which does nothing in this scene", "keys that do something in it");
  key.start = std::get<double>(scene::value_in(study.scene, in_scene));
  if (!(key.start > 0.0))
    refuse("which is " + scene::format_value(key.description, key.start) + " in the scene",
           "a positive number to start from, in the scene or in [set]");
  return key;
}

}  // namespace

std::vector<FittedKey> keys_to_fit(const StudyFile& study) {
  std::vector<std::string> names;
  boost::algorithm::split(names, settings_of<CalibrationSettings>(study).fit, boost::is_any_of(", "),
                          boost::token_compress_on);
  std::vector<FittedKey> fitted;
  for (const std::string& name : names) {
    if (name.empty() || std::ranges::count(names, name) > 1)
      refuse_at(study, "fit", name.empty() ? "no key" : name + " twice", "at least one key, each once");
    fitted.push_back(key_to_fit(study, name));
  }
  return fitted;
}

const Reference& largest_safe(const StudyFile& study) {
  return *std::ranges::max_element(study.study.references, {}, [](const Reference& row) {
    return row.ignited() ? -math::infinity : row.gap;
  });
}

const Reference& smallest_igniting(const StudyFile& study) {
  return *std::ranges::min_element(study.study.references, {}, [](const Reference& row) {
    return row.ignited() ? row.gap : math::infinity;
  });
}

Kind calibration_kind() {
  return {
      .traits = {.name = "calibration", .judges_gaps = false, .gives_verdicts = false},
      .keys = joined({reference_keys(), own_keys(calibration_keys), own_keys(interval_keys())}),
      .tables = {reference_table()},
      .make_cases = make_calibration_case,
      .run = outcome_of<run_calibration, failed_calibration>,
      .results = calibration_results,
  };
}

}  // namespace launchsafe::kinds
