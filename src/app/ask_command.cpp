// launchsafe ask: what the fit of a study predicts of a launch that nobody computed.
#include "common_options.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"

#include <boost/algorithm/string/trim.hpp>

namespace launchsafe::app {
namespace {

struct AskArguments {
  path study;                         ///< folder of a finished study, or its surrogate.json
  std::vector<std::string> settings;  ///< "KEY=VALUE", or a list of values
  std::optional<double> gap;          ///< m; none: the study's
  bool csv = false;                   ///< a row a launch, for programs
};

using scene::InputError;
using study::Surrogate, study::SurrogateOutput, study::SurrogateRecord;

constexpr const char* record_name = "surrogate.json";
constexpr std::size_t largest_record = 20'000'000;  // bytes

SurrogateRecord read_record(const path& place, Console& console) {
  const path file = std::filesystem::is_directory(place) ? place / record_name : place;
  const auto text = scene::read_text_file(file, largest_record);
  if (!text && text.error().file_missing)
    console.refuse(scene::error_at({file.string()}, {}, "no such file",
                                   "the folder of a finished study of kind sensitivity with method = "
                                   "\"polynomial-chaos\", or of a sweep with "
                                   "surrogate = true (launchsafe study --update fits a finished one)"));
  return console.value_of(study::parse_surrogate(console.value_of(text), file.string()));
}

/// An input of the launches that are asked for.
struct AskedInput {
  scene::KeyDescription key;
  math::Interval range;        ///< SI, where launches were computed
  std::vector<double> values;  ///< SI
  bool is_set = false;         ///< on the command line; else as in the study's scene
};

/// The inputs with their values in the study's scene.
std::vector<AskedInput> inputs_in_scene(const SurrogateRecord& record, Console& console) {
  // To read it once more takes a millisecond, and tells keys of its materials and interfaces alone.
  const bool of_scene = std::ranges::all_of(record.keys, [](const std::string& name) {
    return scene::find_key(scene::scene_keys(), name) != nullptr;
  });
  scene::SceneFile file;
  if (of_scene)
    file.scene = record.scene;
  else
    file = console.value_of(scene::parse_scene(scene::to_toml(record.scene), "scene of the record"));
  const std::vector<math::Interval> ranges = study::ranges_of(record);
  std::vector<AskedInput> inputs;
  for (const std::string& name : record.keys)
    inputs.push_back({console.value_of(scene::describe_key(file, name, {file.file})),
                      ranges[inputs.size()],
                      {study::number_in(file, name)}});
  return inputs;
}

InputError fault_of_set(const std::string& given, const std::string& found, const std::string& allowed,
                        const std::string& suggestion = {}) {
  return scene::error_at({}, "--set " + given, found, allowed, suggestion);
}

/// "KEY=VALUE", or a list of values, with a key of the study's inputs by its short or full name.
std::optional<InputError> set_input(const std::string& given, const SurrogateRecord& record,
                                    std::vector<AskedInput>& inputs) {
  const std::size_t equals = given.find('=');
  if (equals == std::string::npos)
    return fault_of_set(given, "no =", "KEY=VALUE, such as load.peak=\"510 MPa\"");
  const std::string name = boost::algorithm::trim_copy(given.substr(0, equals));
  const auto found = std::ranges::find_if(inputs, [&](const AskedInput& each) {
    return each.key.name == name || study::name_of_axis(each.key.name) == name;
  });
  if (found == inputs.end())
    return fault_of_set(given, fmt::format("\"{}\", which the study does not vary", name),
                        scene::quoted_list(record.keys), scene::nearest_of(name, record.keys));
  if (found->is_set) return fault_of_set(given, name + " a second time", "each key once");
  const auto values = scene::parse_list(given.substr(equals + 1), found->key.dimension);
  if (!values)
    return fault_of_set(given, values.error().found, values.error().allowed, values.error().suggestion);
  found->values = *values;
  found->is_set = true;
  return std::nullopt;
}

/// More launches than a table should have, or than a gap is told of.
std::optional<InputError> fault_of_count(const AskArguments& arguments,
                                         const std::vector<AskedInput>& inputs) {
  constexpr double most_launches = 1e6;
  double count = 1;
  for (const AskedInput& input : inputs) count *= static_cast<double>(input.values.size());
  if (arguments.gap && count > 1)
    return scene::error_at({}, "--gap", fmt::format("{:.0f} launches", count), "one launch");
  if (!(count > most_launches)) return std::nullopt;
  return fault_of_set("...", fmt::format("{:.0f} combinations", count), "up to a million");
}

/// A value (SI) of an input beyond what was computed, round-off apart.
std::optional<InputError> fault_in(const std::vector<AskedInput>& inputs, const std::vector<double>& values) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& [lower, upper] = inputs[i].range;
    const double slack = 1e-9 * (upper - lower);
    if (values[i] >= lower - slack && values[i] <= upper + slack) continue;
    const scene::Dimension dimension = inputs[i].key.dimension;
    return scene::error_at(
        {}, inputs[i].key.name, scene::format_quantity(values[i], dimension),
        fmt::format("{} to {}, where launches were computed", scene::format_quantity(lower, dimension),
                    scene::format_quantity(upper, dimension)));
  }
  return std::nullopt;
}

constexpr const char* farther_out = "farther out than any launch by which the error of the fit is known";

/// A launch that is asked for, with a prediction of every output; none at all where it lies beyond what was
/// computed or, for any of them, `farther_out`.
struct AskedLaunch {
  std::vector<double> values = {};  ///< SI, of the inputs
  std::vector<std::optional<study::Prediction>> predictions = {};
  std::string reason = {};  ///< why a prediction is missing; empty where none is
};

/// All combinations of the values, the last input the fastest.
std::vector<AskedLaunch> launches_of(const std::vector<AskedInput>& inputs) {
  std::vector<AskedLaunch> launches{{}};
  for (const AskedInput& input : inputs) {
    std::vector<AskedLaunch> longer;
    for (const AskedLaunch& launch : launches)
      for (const double value : input.values) {
        longer.push_back(launch);
        longer.back().values.push_back(value);
      }
    launches = std::move(longer);
  }
  return launches;
}

/// The outputs of which something is predicted.
std::vector<const SurrogateOutput*> predicted_outputs(const SurrogateRecord& record) {
  std::vector<const SurrogateOutput*> outputs;
  for (const SurrogateOutput& output : record.outputs)
    if (output.reason.empty()) outputs.push_back(&output);
  return outputs;
}

/// A fit that predicts nothing, or no critical gap where a gap is asked about.
std::optional<InputError> fault_of_fit(const AskArguments& arguments, const SurrogateRecord& record) {
  const bool predicts_gap = record.predicted(report::quantity::critical_gap.name) != nullptr;
  if (arguments.gap ? predicts_gap : !predicted_outputs(record).empty()) return std::nullopt;
  std::string found = "a fit without an answer";
  for (const SurrogateOutput& output : record.outputs)
    if (!output.reason.empty()) found += fmt::format("; {}: {}", kinds::shown(output).heading, output.reason);
  return scene::error_at({arguments.study.string()}, arguments.gap ? "--gap" : "", found,
                         "a study whose launches have numbers there");
}

/// Columns of what is set, and of every output with its error.
report::Quantities<AskedLaunch> launch_quantities(const SurrogateRecord& record,
                                                  const std::vector<AskedInput>& inputs) {
  report::Quantities<AskedLaunch> quantities;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].is_set)
      quantities.emplace_back(
          report::shown(
              study::Axis{study::name_of_axis(inputs[i].key.name), {}, inputs[i].key, inputs[i].values}),
          [i](const AskedLaunch& launch) { return launch.values[i]; });
  const std::vector<const SurrogateOutput*> outputs = predicted_outputs(record);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto prediction = [i](const AskedLaunch& launch) { return launch.predictions[i]; };
    report::Column value = kinds::shown(*outputs[i]), error = value;
    error.name += "_error";
    error.heading = "±";
    error.form.notation = keys::Notation::significant;
    error.form.digits = 2;
    quantities.emplace_back(std::move(value), prediction, &study::Prediction::value);
    quantities.emplace_back(std::move(error), prediction, &study::Prediction::error);
  }
  return quantities;
}

void predict(const SurrogateRecord& record, const std::vector<AskedInput>& inputs,
             std::vector<AskedLaunch>& launches) {
  for (AskedLaunch& launch : launches)
    if (const auto fault = fault_in(inputs, launch.values)) launch.reason = fault->message();
  for (const SurrogateOutput* output : predicted_outputs(record)) {
    const Surrogate surrogate(record, *output);
    for (AskedLaunch& launch : launches) {
      const study::Prediction prediction =
          launch.reason.empty() ? surrogate.at(record.inputs.point_of(launch.values)) : study::Prediction{};
      launch.predictions.push_back(prediction.covered ? std::optional(prediction) : std::nullopt);
    }
  }
  const auto is_told = [](const auto& prediction) { return prediction.has_value(); };
  for (AskedLaunch& launch : launches) {
    if (!launch.reason.empty() || std::ranges::all_of(launch.predictions, is_told)) continue;
    launch.reason = farther_out;
    launch.predictions.assign(launch.predictions.size(), std::nullopt);
  }
}

/// The key whose value takes a launch farthest out: in the middle of its range it would err least.
std::string farthest_input(const SurrogateRecord& record, const std::vector<AskedInput>& inputs,
                           const AskedLaunch& launch) {
  const Surrogate surrogate(record, *predicted_outputs(record).front());
  const auto error_in_middle = [&](const AskedInput& input) {
    std::vector<double> values = launch.values;
    values[static_cast<std::size_t>(&input - inputs.data())] =
        std::midpoint(input.range.lower, input.range.upper);
    return surrogate.at(record.inputs.point_of(values)).error;
  };
  return std::ranges::min_element(inputs, {}, error_in_middle)->key.name;
}

/// What stands under the table.
std::string notes_on(const SurrogateRecord& record, const std::vector<AskedInput>& inputs) {
  Json facts{{"fitted", record.fitted()}, {"held_out", record.held_out.size()}};
  for (const AskedInput& each : inputs)
    if (!each.is_set)
      facts["unset"].push_back(each.key.name + " = " +
                               scene::format_quantity(each.values.front(), each.key.dimension));
  for (const SurrogateOutput& output : record.outputs)
    if (!output.reason.empty())
      facts["open"].push_back({{"heading", kinds::shown(output).heading}, {"reason", output.reason}});
  return told("ask.txt", facts);
}

// --- a gap ---

/// What is held in every draw: what is set, and with one of them all that vary together.
std::vector<std::optional<double>> fixed_coordinates(const SurrogateRecord& record,
                                                     const std::vector<AskedInput>& inputs,
                                                     const std::vector<double>& point) {
  const auto& correlated = record.inputs.correlated;
  bool holds_together = false;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    holds_together = holds_together || (correlated && correlated->has(i) && inputs[i].is_set);
  std::vector<std::optional<double>> fixed(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].is_set || (holds_together && correlated->has(i))) fixed[i] = point[i];
  return fixed;
}

/// How often a gap (m) would ignite over what the inputs that are not set may be.
Json print_ignitions(const SurrogateRecord& record, const std::vector<AskedInput>& inputs,
                     const AskedLaunch& launch, double gap, Console& console) {
  const auto fixed = fixed_coordinates(record, inputs, record.inputs.point_of(launch.values));
  const study::PredictedIgnitions of = ignitions_of(study::drawn_critical_gaps(record, fixed), gap);
  const auto share = [&of](std::size_t count) {
    return report::in_words(static_cast<double>(count) / static_cast<double>(of.draws),
                            keys::significant(3, keys::percent));
  };
  if (!std::ranges::all_of(inputs, &AskedInput::is_set))
    console.print_text(fmt::format(
        "Over what the other inputs may be: of {} draws {} ignite by the fit. With its error it is {} to {}: "
        "the "
        "{} that lie farther out than any computed launch, where nothing is known, count as either.\n",
        of.draws, share(of.predicted), share(of.at_least), share(of.at_most), share(of.uncovered)));
  return {{"ignitions",
           {{"draws", of.draws},
            {"at_least", of.at_least},
            {"predicted", of.predicted},
            {"at_most", of.at_most},
            {"uncovered", of.uncovered}}}};
}

/// What a gap (m) does in one launch, and over what its other inputs may be.
void print_gap(const SurrogateRecord& record, const std::vector<AskedInput>& inputs,
               const AskedLaunch& launch, double gap, Console& console) {
  const auto outputs = predicted_outputs(record);
  const auto found = std::ranges::find(outputs, report::quantity::critical_gap.name, &SurrogateOutput::name);
  if (found == outputs.end()) return;
  const study::Prediction& critical = *launch.predictions[static_cast<std::size_t>(found - outputs.begin())];
  const char* word = gap < critical.value - critical.error   ? "predicted: no ignition"
                     : gap > critical.value + critical.error ? "predicted: ignition"
                                                             : "not predicted: nearer to the critical gap "
                                                               "than the error of the fit";
  console.print_text(fmt::format("\n{}: {}\n", scene::format_quantity(gap, scene::Dimension::length), word));
  Json facts{{"gap_cm", report::shown_gap(gap)}, {"gap", word}};
  if (record.drawn) facts.update(print_ignitions(record, inputs, launch, gap, console));
  console.print_json(facts);
}

ExitCode perform(const AskArguments& arguments, Console& console) {
  const SurrogateRecord record = read_record(arguments.study, console);
  std::vector<AskedInput> inputs = inputs_in_scene(record, console);
  for (const std::string& given : arguments.settings) console.refuse_any(set_input(given, record, inputs));
  console.refuse_any(fault_of_count(arguments, inputs));
  console.refuse_any(fault_of_fit(arguments, record));
  std::vector<AskedLaunch> launches = launches_of(inputs);
  predict(record, inputs, launches);
  const bool is_one = launches.size() == 1;
  if (std::ranges::none_of(launches, &std::string::empty, &AskedLaunch::reason)) {
    console.refuse_any(fault_in(inputs, launches.front().values));
    console.refuse(
        fault_of_set("...",
                     fmt::format("a launch that is {}, most of all by {}", farther_out,
                                 farthest_input(record, inputs, launches.front())),
                     "values nearer to the middle of their ranges, or a study of the launch itself"));
  }
  auto quantities = launch_quantities(record, inputs);
  if (!is_one)
    quantities.emplace_back(report::headed("not answered", report::quantity::reason), &AskedLaunch::reason);
  const report::Table table = report::table_of("Predicted", quantities, launches);
  console.print_text(arguments.csv ? report::to_csv(table)
                                   : report::to_text(table, width_of_output()) + notes_on(record, inputs));
  if (console.json()) console.print_json({{"launches", report::json_rows(table)}});
  if (is_one && !arguments.csv)
    print_gap(record, inputs, launches.front(), arguments.gap.value_or(record.gap), console);
  return ExitCode::done;
}

}  // namespace

void add_ask(CLI::App& app, CommandLine& line) {
  auto [command, ask] = add_command<AskArguments>(app, line, "ask");
  add_required(command, "study", ask.study);
  add(command, "--set", ask.settings)->allow_extra_args(false);
  const auto read_gap = [](std::string_view text) {
    const double gap = parse_scene_quantity<Dimension::length>(text);
    const bool is_gap = scene::find_key(scene::scene_keys(), "gap.thickness")->limits.contain(gap);
    return is_gap ? std::optional(gap) : std::nullopt;
  };
  CLI::Option* gap = add_amount(command, "--gap", ask.gap, read_gap);
  add(command, "--csv", ask.csv)->excludes(gap);
}

}  // namespace launchsafe::app
