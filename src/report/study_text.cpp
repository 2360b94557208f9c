#include "launchsafe/report/study_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/load_roughness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace launchsafe::report {
namespace {

std::string values_or_distribution(const study::Axis& axis) {
  const ShownKey key = shown(axis);
  return axis.distribution ? distribution_text(key, *axis.distribution) : values_text(key, axis.values);
}

}  // namespace

bool varies(const study::Study& study, const std::string& key) {
  return std::any_of(study.axes.begin(), study.axes.end(),
                     [&key](const study::Axis& axis) { return axis.key.name == key; });
}

std::string study_file_name(const study::StudyFile& study) {
  const std::filesystem::path path(study.file);
  return path.is_absolute() ? path.filename().string() : path.string();
}

std::string remaking_command(const study::StudyFile& study) {
  return fmt::format("launchsafe study {} -o DIR", study_file_name(study));
}

std::string setup_text(const study::StudyFile& study) {
  std::string text = fmt::format("- Study `{}`, scene `{}`", study_file_name(study), study.study.scene);
  for (const auto& [key, value] : study.overrides) text += fmt::format(", with `{}` = {}", key, value);
  text += "\n";
  if (!study.chosen_setting.empty())
    text += fmt::format("- Setting picked from `{}`: {}\n", study.study.accuracy, study.chosen_setting);
  for (const study::Axis& axis : study.study.axes)
    text += fmt::format("- `{}` is varied: {}\n", axis.key.name, values_or_distribution(axis));
  const std::set<std::string> told({"symmetry",
                                    "frame",
                                    "barrel",
                                    "load.peak",
                                    "load.duration",
                                    "load.muzzle_exit",
                                    "load.muzzle_travel",
                                    "numerics.cell_size",
                                    "numerics.inertial_scaling",
                                    "numerics.damping_time",
                                    "charge.crack_radius",
                                    "charge.flaw_size",
                                    "gap.pressure",
                                    "gap.air",
                                    "gap.exchange",
                                    "gap.exchange_time",
                                    "friction.closure",
                                    "friction.localisation",
                                    "kinetics.set",
                                    "kinetics.ignition_temperature"});
  for (const scene::ListedKey& key : scene::list_keys(study.scene)) {
    if (!told.contains(key.name)) continue;
    if (varies(study.study, key.name)) continue;
    text += fmt::format("- `{}` = {}\n", key.name, key.value);
  }
  if (const std::string measured = scene::measured_load_text(study.scene.scene.load); !measured.empty())
    text += fmt::format("- The measured pressure curve: {}\n", measured);
  for (const scene::InterfaceText& each : scene::describe_interfaces(study.scene.scene))
    text += fmt::format("- `interface.{}`: {}; {}\n", each.body, each.condition, each.assumes);
  return text;
}

std::string timing_text(const study::Timing& timing) {
  std::string text = fmt::format("re-used {}, ran {}", counted(timing.reused, "mechanical run"), timing.runs);
  if (timing.run_time > 0)
    text += fmt::format(" at {} particle updates per second and core",
                        scientific(timing.updates_per_second(), 2));
  return text +
         fmt::format("; {} of wall time with {}", duration(timing.wall_time), counted(timing.jobs, "job"));
}

std::string timing_sentence(const study::Timing& timing) {
  return fmt::format("This computation {}.\n", timing_text(timing));
}

nlohmann::ordered_json timing_json(const study::Timing& timing) {
  using study::Timing;
  static const Quantities<Timing> quantities{
      {quantity::wall_time(), &Timing::wall_time},
      {{"runs", "runs", count(), "Mechanical runs that were made."}, &Timing::runs},
      {{"reused", "used again", count(), "Mechanical runs that were stored."}, &Timing::reused},
      {{"jobs", "jobs", count(), "Runs at once."}, &Timing::jobs},
      {{"particle_updates", "particle updates", keys::scientific(2), "Of all runs."},
       &Timing::particle_updates},
      {{"run_time", "time of runs", keys::fixed(1, second), "Processor time of all runs."},
       &Timing::run_time},
      {quantity::updates_per_second(), &Timing::updates_per_second}};
  return json_of(quantities, timing);
}

std::string limiters_text(const run::LimiterCounts& limiters) {
  const std::string text = run::to_string(limiters);
  return text.empty() ? "none" : text;
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json axes_json(const study::Study& study) {
  auto axes = nlohmann::ordered_json::array();
  for (const study::Axis& axis : study.axes) {
    const ShownKey key = shown(axis);
    nlohmann::ordered_json& json = axes.emplace_back();
    json = {{"name", axis.name}, {"scene_key", key.scene_key}, {"key", key.key()}, {"unit", key.form.unit}};
    if (axis.distribution) {
      json["distribution"] = distribution_text(key, *axis.distribution);
      continue;
    }
    json["values"] = nlohmann::ordered_json::array();
    for (const double value : axis.values) json["values"].push_back(number(key.value(value)));
  }
  return axes;
}

std::string json_file_text(const nlohmann::ordered_json& object) {
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace launchsafe::report
