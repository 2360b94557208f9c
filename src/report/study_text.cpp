#include "launchsafe/report/study_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/scene/interfaces.hpp"
#include "launchsafe/scene/load_roughness.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

namespace launchsafe::report {
namespace {

/// The unit of a text such as "18 ms" or "1780 J/(kg K)".
std::string unit_of(const std::string& quantity) {
  const std::size_t blank = quantity.find(' ');
  return blank == std::string::npos ? std::string{} : quantity.substr(blank + 1);
}

/// Whether a unit is used for one of these quantities, or is a tenth of one that is: 1 mm is also 0.1 cm.
bool suits(const std::string& unit, const std::vector<std::string>& used, scene::Dimension dimension) {
  const double size = scene::in_unit(1.0, dimension, unit);  // pieces in one SI unit
  return std::ranges::any_of(used, [&](const std::string& each) {
    return each == unit || std::lround(1e3 * size / scene::in_unit(1.0, dimension, each)) == 10'000;
  });
}

/// The units to choose from: those that people use for single values, in the order of `units_of`.
std::vector<std::string> candidate_units(const std::vector<double>& si_values, scene::Dimension dimension) {
  std::vector<std::string> used, all_used, candidates;
  for (const double value : si_values) used.push_back(unit_of(scene::format_quantity(value, dimension)));
  for (int power = -12; power <= 15; ++power)
    all_used.push_back(unit_of(scene::format_quantity(std::pow(10.0, power), dimension)));
  for (const std::string& unit : scene::units_of(dimension)) {
    const bool common = std::ranges::find(all_used, unit) != all_used.end();
    if (common && suits(unit, used, dimension)) candidates.push_back(unit);
  }
  return candidates;
}

/// What makes a number long: decimals and the zero before them; digits beyond three before the point count
/// three times.
std::size_t clutter(double value) {
  const std::string text = significant(std::abs(value), 6);
  if (text.find('e') != std::string::npos) return 2 * text.size();
  const std::size_t whole = std::min(text.find('.'), text.size());
  const std::size_t leading_zero = text.starts_with('0') && text.size() > 1 ? 1 : 0;
  return text.size() - whole + leading_zero + (whole > 3 ? 3 * (whole - 3) : 0);
}

bool is_log_normal(const math::Distribution& distribution) {
  return distribution.kind == math::Distribution::Kind::log_normal;
}

std::vector<double> marks_of(const math::Distribution& distribution) {
  if (is_log_normal(distribution)) return {distribution.centre};
  std::vector<double> values;
  for (const double value : {distribution.lower, distribution.upper}) {
    if (std::isfinite(value)) values.push_back(value);
  }
  if (distribution.kind == math::Distribution::Kind::normal) values.push_back(distribution.centre);
  return values;
}

/// The unit in which all of these values read best, among those that people use; empty for pure numbers.
std::string unit_for(const std::vector<double>& si_values, scene::Dimension dimension) {
  std::string best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  std::size_t place = 0;  // the units come in the order of their use
  for (const std::string& unit : candidate_units(si_values, dimension)) {
    std::size_t total = place++;
    for (const double value : si_values) total += clutter(scene::as_written(value, dimension, unit));
    if (total >= least) continue;
    least = total;
    best = unit;
  }
  return best;
}

}  // namespace

ShownKey shown(const study::Axis& axis) {
  ShownKey key{{.name = axis.name, .heading = axis.name, .meaning = axis.key.sentence}, axis.key.name};
  // An alias such as peak_pressure is words; a dotted name is shown as it is to be written.
  const bool dotted = axis.name.find('.') != std::string::npos;
  if (!dotted) std::ranges::replace(key.heading, '_', ' ');
  std::ranges::replace(key.name, '.', '_');
  const scene::Dimension dimension = axis.key.dimension;
  key.form = {Notation::significant, 6, dimension,
              unit_for(axis.distribution ? marks_of(*axis.distribution) : axis.values, dimension)};
  return key;
}

std::vector<ShownKey> shown_axes(const study::Study& study) {
  std::vector<ShownKey> keys;
  for (const study::Axis& axis : study.axes) keys.push_back(shown(axis));
  return keys;
}

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
  const std::string unit = key.form.unit.empty() ? "" : " " + key.form.unit;
  if (si_values.size() > most) {
    const auto [low, high] = std::minmax_element(si_values.begin(), si_values.end());
    return fmt::format("{} values from {} to {}{}", si_values.size(), digits_of(*low, key.form),
                       digits_of(*high, key.form), unit);
  }
  std::string text;
  for (const double value : si_values) text += (text.empty() ? "" : ", ") + digits_of(value, key.form);
  return text + unit;
}

std::string distribution_text(const ShownKey& key, const math::Distribution& distribution) {
  const auto number = [&key](double value_si) { return digits_of(value_si, key.form); };
  const std::string unit = key.form.unit.empty() ? "" : " " + key.form.unit;
  if (is_log_normal(distribution))
    return fmt::format("log-normal, {}{} ± {}", number(distribution.centre), unit,
                       in_words(distribution.deviation, keys::significant(3, percent)));
  if (distribution.kind != math::Distribution::Kind::normal) {
    const bool uniform = distribution.kind == math::Distribution::Kind::uniform;
    return fmt::format("{} from {} to {}{}", uniform ? "uniform" : "log-uniform", number(distribution.lower),
                       number(distribution.upper), unit);
  }
  std::string text =
      fmt::format("normal, {} ± {}{}", number(distribution.centre), number(distribution.deviation), unit);
  const bool below = std::isfinite(distribution.lower), above = std::isfinite(distribution.upper);
  if (below && above)
    return text + fmt::format(", cut off at {} and {}{}", number(distribution.lower),
                              number(distribution.upper), unit);
  if (below) text += fmt::format(", cut off below {}{}", number(distribution.lower), unit);
  if (above) text += fmt::format(", cut off above {}{}", number(distribution.upper), unit);
  return text;
}

std::string place_text(const std::vector<ShownKey>& keys, const std::vector<double>& coordinates) {
  std::string text;
  for (std::size_t i = 0; i < std::min(keys.size(), coordinates.size()); ++i) {
    // A pure number says nothing without its name.
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ",
                        keys[i].form.unit.empty() ? keys[i].heading + " " : "", keys[i].text(coordinates[i]));
  }
  return text;
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

std::string setup_text(const study::StudyFile& study) {
  std::string text = fmt::format("- Study `{}`, scene `{}`", study_file_name(study), study.study.scene);
  for (const auto& [key, value] : study.overrides) text += fmt::format(", with `{}` = {}", key, value);
  text += "\n";
  if (!study.chosen_setting.empty())
    text += fmt::format("- Setting picked from `{}`: {}\n", study.study.accuracy, study.chosen_setting);
  for (const study::Axis& axis : study.study.axes)
    text += fmt::format("- `{}` is varied: {}\n", axis.key.name,
                        axis.distribution ? distribution_text(shown(axis), *axis.distribution)
                                          : values_text(shown(axis), axis.values));
  // What tells one launch from another; the manifest has all inputs.
  constexpr std::string_view told[] = {"load.peak", "charge.crack_radius", "charge.flaw_size",
                                       "numerics.cell_size"};
  std::vector<std::string> launch;
  for (const scene::ListedKey& key : scene::list_keys(study.scene))
    if (std::ranges::find(told, key.name) != std::end(told) && !varies(study.study, key.name))
      launch.push_back(fmt::format("`{}` = {}", key.name, key.value));
  if (!launch.empty()) text += fmt::format("- {}\n", fmt::join(launch, ", "));
  if (const std::string measured = scene::measured_load_text(study.scene.scene.load); !measured.empty())
    text += fmt::format("- The measured pressure curve: {}\n", measured);
  std::vector<std::pair<std::string, std::string>> held;  // a condition with the bodies that it holds
  for (const scene::InterfaceText& each : scene::describe_interfaces(study.scene.scene)) {
    const std::string condition = each.condition + "; " + each.assumes;
    auto found = std::ranges::find(held, condition, &std::pair<std::string, std::string>::first);
    if (found == held.end()) found = held.insert(found, {condition, {}});
    found->second += fmt::format("{}`interface.{}`", found->second.empty() ? "" : ", ", each.body);
  }
  for (const auto& [condition, bodies] : held) text += fmt::format("- {}: {}\n", bodies, condition);
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
      {quantity::wall_time, &Timing::wall_time},
      {"runs", "runs", count(), "Mechanical runs that were made.", &Timing::runs},
      {"reused", "used again", count(), "Mechanical runs that were stored.", &Timing::reused},
      {"jobs", "jobs", count(), "Runs at once.", &Timing::jobs},
      {"particle_updates", "particle updates", keys::scientific(2), "Of all runs.",
       &Timing::particle_updates},
      {"run_time", "time of runs", keys::fixed(1, second), "Processor time of all runs.", &Timing::run_time},
      {quantity::updates_per_second, &Timing::updates_per_second}};
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
