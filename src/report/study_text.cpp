#include "launchsafe/report/study_text.hpp"

#include "launchsafe/report/quantities.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report {
namespace {

/// The unit of a text such as "18 ms" or "1780 J/(kg K)".
std::string unit_of(const std::string& quantity) {
  const std::size_t blank = quantity.find(' ');
  return blank == std::string::npos ? std::string{} : quantity.substr(blank + 1);
}

/// The form of an axis: of a few keys that of their columns, and else the unit of the largest value.
Form form_of(const study::Axis& axis) {
  for (const auto& [key, column] : {std::pair{"load.peak", &quantity::peak_pressure},
                                    {"charge.crack_radius", &quantity::crack_radius},
                                    {"charge.flaw_size", &quantity::flaw_size},
                                    {"numerics.cell_size", &quantity::cell_size}})
    if (axis.key.name == key) return column->form;
  double largest = 0.0;
  if (axis.distribution)
    largest = std::isfinite(axis.distribution->upper) ? axis.distribution->upper : axis.distribution->centre;
  for (const double value : axis.values) largest = std::max(largest, std::abs(value));
  const scene::Dimension dimension = axis.key.dimension;
  return {Notation::significant, 6, dimension, unit_of(scene::format_quantity(largest, dimension))};
}

/// " MPa"; empty of a pure number.
std::string unit_behind(const ShownKey& key) { return key.form.unit.empty() ? "" : " " + key.form.unit; }

}  // namespace

ShownKey shown(const study::Axis& axis) {
  ShownKey key{{.name = axis.name, .heading = axis.name, .meaning = axis.key.sentence}, axis.key.name};
  // An alias such as peak_pressure is words; a dotted name is shown as it is to be written.
  const bool dotted = axis.name.find('.') != std::string::npos;
  if (!dotted) std::ranges::replace(key.heading, '_', ' ');
  std::ranges::replace(key.name, '.', '_');
  key.form = form_of(axis);
  return key;
}

std::vector<ShownKey> shown_axes(const study::Study& study) { return study::of_each(study.axes, shown); }

Quantities<std::vector<double>> axis_quantities(const study::Study& study) {
  Quantities<std::vector<double>> quantities;
  for (const study::Axis& axis : study.axes) {
    const std::size_t place = quantities.size();
    quantities.emplace_back(always(shown(axis)), [place](const std::vector<double>& coordinates) {
      return place < coordinates.size() ? std::optional(coordinates[place]) : std::nullopt;
    });
  }
  return quantities;
}

std::string plain_words(std::string name) {
  name.erase(0, name.rfind('.') + 1);
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string values_text(const ShownKey& key, const std::vector<double>& si_values) {
  constexpr std::size_t most = 12;
  const auto digits = [&](double value) { return digits_of(value, key.form); };
  const auto [low, high] = std::ranges::minmax(si_values);
  const std::string all =
      si_values.size() > most
          ? fmt::format("{} values from {} to {}", si_values.size(), digits(low), digits(high))
          : fmt::format("{}", fmt::join(study::of_each(si_values, digits), ", "));
  return all + unit_behind(key);
}

std::string distribution_text(const ShownKey& key, const math::Distribution& distribution) {
  using enum math::Distribution::Kind;
  const auto digits = [&](double value) { return digits_of(value, key.form); };
  const std::string unit = unit_behind(key), centre = digits(distribution.centre),
                    lower = digits(distribution.lower), upper = digits(distribution.upper);
  if (distribution.kind == log_normal)
    return fmt::format("log-normal, {}{} ± {}", centre, unit,
                       in_words(distribution.deviation, keys::significant(3, percent)));
  if (distribution.kind != normal)
    return fmt::format("{} from {} to {}{}", distribution.kind == uniform ? "uniform" : "log-uniform", lower,
                       upper, unit);
  const std::string whole = fmt::format("normal, {} ± {}{}", centre, digits(distribution.deviation), unit);
  const bool is_cut = std::isfinite(distribution.lower) || std::isfinite(distribution.upper);
  return is_cut ? fmt::format("{}, cut off at {} and {}{}", whole, lower, upper, unit) : whole;
}

std::string place_text(const std::vector<ShownKey>& keys, const std::vector<double>& coordinates) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(keys.size(), coordinates.size()); ++i)
    // A pure number says nothing without its name.
    parts.push_back((keys[i].form.unit.empty() ? keys[i].heading + " " : "") + keys[i].text(coordinates[i]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

bool varies(const study::Study& study, const std::string& key) {
  return std::ranges::any_of(study.axes, [&key](const study::Axis& axis) { return axis.key.name == key; });
}

std::string study_file_name(const study::StudyFile& study) {
  const std::filesystem::path path(study.file);
  return path.is_absolute() ? path.filename().string() : path.string();
}

std::string remaking_command(const study::StudyFile& study) {
  return fmt::format("launchsafe study {} -o DIR", study_file_name(study));
}

Row kinetics_json(const scene::SceneFile& file) {
  if (!scene::has_charge(file.scene)) return nullptr;
  const materials::KineticsParameters& kinetics = file.scene.charge().kinetics;
  const std::string from = scene::kinetics_origin(file);
  return {{"activation_temperature_K", kinetics.activation_temperature},
          {"frequency_per_s", kinetics.frequency},
          {"heat_of_reaction_J_per_kg", kinetics.heat_of_reaction},
          {"from", from},
          {"text",
           fmt::format("activation temperature {} K, frequency factor {} 1/s, heat of reaction {} MJ/kg, "
                       "from {}",
                       significant(kinetics.activation_temperature, 6), significant(kinetics.frequency, 4),
                       significant(1e-6 * kinetics.heat_of_reaction, 4), from)}};
}

std::string setup_text(const study::StudyFile& study) {
  const scene::Load& load = study.scene.scene.load;
  std::string text = fmt::format("- Study `{}`, scene `{}`", study_file_name(study), study.study.scene);
  for (const auto& [key, value] : study.overrides) text += fmt::format(", with `{}` = {}", key, value);
  for (const study::Axis& axis : study.study.axes)
    text += fmt::format("\n- `{}` is varied: {}", axis.key.name,
                        axis.distribution ? distribution_text(shown(axis), *axis.distribution)
                                          : values_text(shown(axis), axis.values));
  // The keys that tell one launch from another; the manifest has all inputs. A measured curve has its peak.
  std::vector<std::string> launch;
  for (const char* name : {"load.peak", "charge.crack_radius", "charge.flaw_size", "numerics.cell_size"})
    for (const scene::ListedKey& key : scene::list_keys(study.scene))
      if (key.name == name && !varies(study.study, name) &&
          (load.curve_time.empty() || key.name != "load.peak"))
        launch.push_back(fmt::format("`{}` = {}", key.name, key.value));
  if (!launch.empty()) text += fmt::format("\n- {}", fmt::join(launch, ", "));
  if (const std::string measured = scene::smoothing_text(load); !measured.empty())
    text += "\n- The measured pressure curve: " + measured;
  if (const Row kinetics = kinetics_json(study.scene); !kinetics.is_null())
    text += "\n- Kinetics of the charge: " + text_of(kinetics, "text");
  for (const scene::InterfaceText& each : scene::describe_interfaces(study.scene.scene))
    text += fmt::format("\n- `interface.{}`: {}; {}", each.body, each.condition, each.assumes);
  return text + "\n";
}

std::string timing_text(const study::Timing& timing) {
  return fmt::format("re-used {}, ran {}; {} of wall time with {}",
                     counted(static_cast<std::int64_t>(timing.reused), "mechanical run"), timing.runs,
                     duration(timing.wall_time), counted(static_cast<std::int64_t>(timing.jobs), "job"));
}

nlohmann::ordered_json timing_json(const study::Timing& timing) {
  return {{"wall_time_s", timing.wall_time},
          {"runs", timing.runs},
          {"reused", timing.reused},
          {"jobs", timing.jobs}};
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

}  // namespace launchsafe::report
