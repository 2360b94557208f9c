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

/// The units to choose from: those that people use for single values, in the order of `units_of`.
std::vector<std::string> candidate_units(const std::vector<double>& si_values, scene::Dimension dimension) {
  std::vector<std::string> used, all_used, candidates;
  for (const double value : si_values) used.push_back(unit_of(scene::format_quantity(value, dimension)));
  for (int power = -12; power <= 15; ++power)
    all_used.push_back(unit_of(scene::format_quantity(std::pow(10.0, power), dimension)));
  for (const std::string& unit : scene::units_of(dimension)) {
    const bool common = std::ranges::find(all_used, unit) != all_used.end();
    const double size = scene::in_unit(1.0, dimension, unit);  // pieces in one SI unit
    // Used for one of these quantities, or a tenth of one that is: 1 mm is also 0.1 cm.
    const auto suits = [&](const std::string& each) {
      return each == unit || std::lround(1e3 * size / scene::in_unit(1.0, dimension, each)) == 10'000;
    };
    if (common && std::ranges::any_of(used, suits)) candidates.push_back(unit);
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

std::vector<double> marks_of(const math::Distribution& distribution) {
  using enum math::Distribution::Kind;
  if (distribution.kind == log_normal) return {distribution.centre};
  std::vector<double> values{distribution.lower, distribution.upper};
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (distribution.kind == normal) values.push_back(distribution.centre);
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

Quantities<std::vector<double>> launch_quantities(const study::StudyFile& study) {
  Quantities<std::vector<double>> axes = axis_quantities(study.study), launch;
  const study::StudyCase first = study.cases.empty() ? study::StudyCase{} : study.cases.front();
  const std::pair<Column, double> fixed_values[] = {
      {quantity::peak_pressure, first.peak_pressure},
      {quantity::crack_radius, first.strength().initial_crack_radius},
      {quantity::flaw_size, first.strength().flaw_size}};
  for (const auto& [column, value] : fixed_values) {
    if (const auto* axis = keys::find_named(axes, column.name))
      launch.push_back(*axis);
    else
      launch.emplace_back(for_programs(column),
                          [value = value](const std::vector<double>&) { return value; });
  }
  for (const auto& axis : axes)
    if (keys::find_named(study::named_axes(), axis.name) == nullptr) launch.push_back(axis);
  return launch;
}

std::string plain_words(std::string name) {
  name.erase(0, name.rfind('.') + 1);
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string values_text(const ShownKey& key, const std::vector<double>& si_values) {
  constexpr std::size_t most = 12;
  Row facts{{"unit", key.form.unit}};
  for (const double value : si_values) facts["values"].push_back(digits_of(value, key.form));
  if (si_values.size() > most) {
    const auto [low, high] = std::ranges::minmax(si_values);
    facts["ends"] = {{"low", digits_of(low, key.form)}, {"high", digits_of(high, key.form)}};
  }
  return fmt::format("{}", fmt::join(noted("values", facts), ""));
}

std::string distribution_text(const ShownKey& key, const math::Distribution& distribution) {
  using enum math::Distribution::Kind;
  const auto number = [&key](double value_si) {
    return std::isfinite(value_si) ? digits_of(value_si, key.form) : "";
  };
  const char* kind = distribution.kind == uniform       ? "uniform"
                     : distribution.kind == log_uniform ? "log-uniform"
                     : distribution.kind == normal      ? "normal"
                                                        : "log-normal";
  return noted("distribution", {{"kind", kind},
                                {"unit", key.form.unit},
                                {"centre", number(distribution.centre)},
                                {"deviation", number(distribution.deviation)},
                                {"lower", number(distribution.lower)},
                                {"upper", number(distribution.upper)},
                                {"share", in_words(distribution.deviation, keys::significant(3, percent))}})
      .front();
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
  Row facts{{"activation_temperature_K", kinetics.activation_temperature},
            {"frequency_per_s", kinetics.frequency},
            {"heat_of_reaction_J_per_kg", kinetics.heat_of_reaction},
            {"from", scene::kinetics_origin(file)}};
  facts["text"] = noted("kinetics", facts).front();
  return facts;
}

std::string setup_text(const study::StudyFile& study) {
  Row facts{{"study", study_file_name(study)},
            {"scene", study.study.scene},
            {"measured", scene::smoothing_text(study.scene.scene.load)},
            {"kinetics", kinetics_json(study.scene)}};
  for (const auto& [key, value] : study.overrides)
    facts["overrides"].push_back({{"key", key}, {"value", value}});
  for (const study::Axis& axis : study.study.axes)
    facts["axes"].push_back({{"key", axis.key.name},
                             {"values", axis.distribution ? distribution_text(shown(axis), *axis.distribution)
                                                          : values_text(shown(axis), axis.values)}});
  // What tells one launch from another; the manifest has all inputs.
  constexpr std::string_view told[] = {"load.peak", "charge.crack_radius", "charge.flaw_size",
                                       "numerics.cell_size"};
  for (const scene::ListedKey& key : scene::list_keys(study.scene))
    if (std::ranges::find(told, key.name) != std::end(told) && !varies(study.study, key.name))
      facts["launch"].push_back(fmt::format("`{}` = {}", key.name, key.value));
  Row held = Row::object();  // the bodies, by the condition that holds them
  for (const scene::InterfaceText& each : scene::describe_interfaces(study.scene.scene))
    held[each.condition + "; " + each.assumes].push_back(fmt::format("`interface.{}`", each.body));
  for (const auto& [condition, bodies] : held.items())
    facts["held"].push_back({{"condition", condition}, {"bodies", bodies}});
  return fmt::format("{}\n", fmt::join(noted("setup", facts), "\n"));
}

std::string timing_text(const study::Timing& timing) {
  return noted("timing", {{"reused", timing.reused},
                          {"runs", timing.runs},
                          {"wall_time", duration(timing.wall_time)},
                          {"jobs", timing.jobs}})
      .front();
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
      {"jobs", "jobs", count(), "Runs at once.", &Timing::jobs}};
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

}  // namespace launchsafe::report
