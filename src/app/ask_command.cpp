// launchsafe ask: what the fit of a sensitivity study predicts of a launch that nobody computed.
#include "commands.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/scene/quantity.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "launchsafe/study/surrogate.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace launchsafe::app {
namespace {

using scene::Expected, scene::InputError;
using study::Surrogate, study::SurrogateOutput, study::SurrogateRecord;

constexpr const char* record_name = "surrogate.json";
constexpr std::size_t largest_record = 20'000'000;  // bytes

Expected<SurrogateRecord> read_record(const std::filesystem::path& place) {
  const bool is_folder = std::filesystem::is_directory(place);
  const std::filesystem::path file = is_folder ? place / record_name : place;
  auto text = scene::read_text_file(file, largest_record);
  if (text) return study::parse_surrogate(*text, file.string());
  if (!text.error().file_missing) return text.error();
  return InputError{file.string(),
                    0,
                    0,
                    {},
                    "no such file",
                    "the folder of a finished study of kind sensitivity with method = \"polynomial-chaos\"",
                    {}};
}

/// An input of the launches that are asked for.
struct AskedInput {
  scene::KeyDescription key;
  std::vector<double> values;  ///< SI
  bool is_set = false;         ///< on the command line; else as in the study's scene

  double value() const { return values.front(); }
};

std::string value_text(const AskedInput& input) {
  return scene::format_quantity(input.value(), input.key.dimension);
}

/// The inputs with their values in the study's scene.
Expected<std::vector<AskedInput>> inputs_in_scene(const SurrogateRecord& record) {
  const auto file = scene::parse_scene(scene::to_toml(record.scene), "scene of the record");
  if (!file) return file.error();
  std::vector<AskedInput> inputs;
  for (const std::string& name : record.keys) {
    auto key = scene::describe_key(*file, name, {file->file});
    if (!key) return key.error();
    const double value = study::number_in(*file, name);
    inputs.push_back({std::move(*key), {value}});
  }
  return inputs;
}

InputError fault_of_set(const std::string& given, std::string found, std::string allowed,
                        std::string suggestion = {}) {
  return {{}, 0, 0, "--set " + given, std::move(found), std::move(allowed), std::move(suggestion)};
}

/// "KEY=VALUE", or a list of values, with a key of the study's inputs by its short or full name.
std::optional<InputError> set_input(const std::string& given, std::vector<AskedInput>& inputs) {
  const std::size_t equals = given.find('=');
  if (equals == std::string::npos)
    return fault_of_set(given, "no =", "KEY=VALUE, such as load.peak=\"510 MPa\"");
  const std::string name = given.substr(0, equals);
  std::vector<std::string> names;
  for (const AskedInput& each : inputs) names.push_back(each.key.name);
  const auto found = std::ranges::find_if(inputs, [&](const AskedInput& each) {
    return each.key.name == name || study::name_of_axis(each.key.name) == name;
  });
  if (found == inputs.end())
    return fault_of_set(given, fmt::format("\"{}\", which the study does not vary", name),
                        scene::quoted_list(names), scene::nearest_of(name, names));
  if (found->is_set) return fault_of_set(given, name + " a second time", "each key once");
  const auto values = scene::parse_list(given.substr(equals + 1), found->key.dimension);
  if (!values)
    return fault_of_set(given, values.error().found, values.error().allowed, values.error().suggestion);
  found->values = *values;
  found->is_set = true;
  return std::nullopt;
}

/// A value beyond what was computed; round-off apart.
std::optional<InputError> check_ranges(const SurrogateRecord& record, const std::vector<AskedInput>& inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const study::InputRange range = study::range_of(record, i);
    const double slack = 1e-9 * (range.upper - range.lower);
    const scene::Dimension dimension = inputs[i].key.dimension;
    for (const double value : inputs[i].values)
      if (!(value >= range.lower - slack && value <= range.upper + slack))
        return InputError{{},
                          0,
                          0,
                          inputs[i].key.name,
                          scene::format_quantity(value, dimension),
                          fmt::format("{} to {}, where launches were computed",
                                      scene::format_quantity(range.lower, dimension),
                                      scene::format_quantity(range.upper, dimension)),
                          {}};
  }
  return std::nullopt;
}

/// One output as predicted.
struct PredictedOutput {
  const SurrogateOutput* output;
  report::Column shown;
  study::Prediction prediction;
};

/// How an output is shown.
report::Column shown_output(const SurrogateOutput& output, const SurrogateRecord& record) {
  if (output.name == report::quantity::critical_gap().name)
    return {output.name, "critical gap", keys::fixed(5, keys::centimetre)};
  std::string heading = "T max at a gap of " + scene::format_quantity(record.gap, scene::Dimension::length);
  if (output.inert) heading += ", without reaction";
  return {output.name, std::move(heading), keys::fixed(1, keys::kelvin)};
}

/// "predicted: no ignition" of a gap that lies below the predicted critical gap by more than its error.
std::string word_on(double gap, const study::Prediction& critical_gap) {
  if (gap < critical_gap.value - critical_gap.error) return "predicted: no ignition";
  if (gap > critical_gap.value + critical_gap.error) return "predicted: ignition";
  return "not predicted: nearer to the critical gap than the error of the fit";
}

/// What is held in every draw: what is set, and with one of them all that vary together.
std::vector<std::optional<double>> fixed_coordinates(const SurrogateRecord& record,
                                                     const std::vector<AskedInput>& inputs,
                                                     const std::vector<double>& point) {
  const auto& correlated = record.inputs.correlated;
  const auto is_set = [&](std::size_t i) { return inputs[i].is_set; };
  bool holds_together = false;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    holds_together = holds_together || (correlated && correlated->has(i) && is_set(i));
  std::vector<std::optional<double>> fixed(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (is_set(i) || (holds_together && correlated->has(i))) fixed[i] = point[i];
  return fixed;
}

/// What is predicted of one launch.
class Answer {
 public:
  Answer(const SurrogateRecord& record, std::vector<AskedInput> inputs, double gap)
      : record_(record), inputs_(std::move(inputs)), gap_(gap) {
    std::vector<double> values;
    for (const AskedInput& each : inputs_) values.push_back(each.value());
    point_ = record_.inputs.point_of(values);
  }

  /// Nothing where the launch is too far from those that were computed.
  std::optional<InputError> predict() {
    for (const SurrogateOutput& output : record_.outputs) {
      if (!output.reason.empty()) continue;
      const study::Prediction prediction = Surrogate(record_, output).at(point_);
      if (!prediction.covered)
        return InputError{{},
                          0,
                          0,
                          "--set",
                          "a launch that is farther out than any by which the error of the fit is known",
                          "values nearer to the middle of their ranges, or a study of the launch itself",
                          {}};
      outputs_.push_back({&output, shown_output(output, record_), prediction});
    }
    if (record_.predicted("critical_gap") != nullptr)
      ignitions_ = study::predicted_ignitions(record_, gap_, fixed_coordinates(record_, inputs_, point_));
    return std::nullopt;
  }

  void print(Console& console) const {
    console.print_text(text());
    console.print_json(json());
  }

 private:
  const PredictedOutput* critical_gap() const {
    const auto found = std::ranges::find_if(
        outputs_, [](const PredictedOutput& each) { return each.output->name == "critical_gap"; });
    return found == outputs_.end() ? nullptr : &*found;
  }

  std::string text() const {
    std::string text;
    for (const AskedInput& each : inputs_)
      text += fmt::format("{} = {}{}\n", each.key.name, value_text(each),
                          each.is_set ? "" : "  (the study's scene)");
    text += "\n";
    for (const PredictedOutput& each : outputs_)
      text += fmt::format("{}: {} +- {} (1 of 100 launches is beyond, on each side)\n", each.shown.heading,
                          report::in_words(each.prediction.value, each.shown.form),
                          report::in_words(each.prediction.error, each.shown.form));
    for (const SurrogateOutput& output : record_.outputs)
      if (!output.reason.empty())
        text += fmt::format("{}: not predicted, {}\n", shown_output(output, record_).heading, output.reason);
    if (critical_gap() != nullptr) text += gap_text();
    return text +
           fmt::format(
               "\nA fit to {} launches, held against {} others; this one was not computed, and the error of "
               "a "
               "computation comes on top.\nOnly a launch that was computed can be SAFE: launchsafe study.\n",
               record_.fitted, record_.points.size() / record_.keys.size() - record_.fitted);
  }

  std::string gap_text() const {
    const auto share = [&](std::size_t count) {
      return report::in_words(static_cast<double>(count) / static_cast<double>(ignitions_.draws),
                              keys::significant(3, keys::percent));
    };
    std::string text = fmt::format("{}: {}\n", scene::format_quantity(gap_, scene::Dimension::length),
                                   word_on(gap_, critical_gap()->prediction));
    if (std::ranges::all_of(inputs_, &AskedInput::is_set)) return text;
    text += fmt::format(
        "    over what the other inputs may be: of {} draws {} ignite, {} to {} within the error of the "
        "fit\n",
        ignitions_.draws, share(ignitions_.predicted), share(ignitions_.at_least), share(ignitions_.at_most));
    if (ignitions_.uncovered > 0)
      text += fmt::format("    {} of the draws are farther out than any launch that tells that error\n",
                          share(ignitions_.uncovered));
    return text;
  }

  nlohmann::ordered_json json() const {
    nlohmann::ordered_json inputs, outputs = nlohmann::ordered_json::array();
    for (const AskedInput& each : inputs_)
      inputs.push_back({{"key", each.key.name}, {"value_si", each.value()}, {"set", each.is_set}});
    for (const PredictedOutput& each : outputs_)
      outputs.push_back({{"output", each.output->name},
                         {"value_si", each.prediction.value},
                         {"error_si", each.prediction.error},
                         {"inert", each.output->inert}});
    nlohmann::ordered_json object{
        {"inputs", inputs}, {"outputs", outputs}, {"confidence", 0.99}, {"gap_m", gap_}};
    if (critical_gap() == nullptr) return object;
    object["gap"] = word_on(gap_, critical_gap()->prediction);
    object["ignitions"] = {{"draws", ignitions_.draws},
                           {"at_least", ignitions_.at_least},
                           {"predicted", ignitions_.predicted},
                           {"at_most", ignitions_.at_most},
                           {"uncovered", ignitions_.uncovered}};
    return object;
  }

  const SurrogateRecord& record_;
  std::vector<AskedInput> inputs_;
  double gap_;  ///< m
  std::vector<double> point_;
  std::vector<PredictedOutput> outputs_;
  study::PredictedIgnitions ignitions_;
};

// --- many launches ---

/// One of them, with a prediction of every output; none where it is too far from those that were computed.
struct AskedLaunch {
  std::vector<double> values;  ///< SI, of the inputs
  std::vector<std::optional<study::Prediction>> predictions;
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

/// Columns of what is set, and of every output with its error.
report::Quantities<AskedLaunch> launch_quantities(const std::vector<AskedInput>& inputs,
                                                  const std::vector<report::Column>& outputs) {
  report::Quantities<AskedLaunch> quantities;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].is_set)
      quantities.emplace_back(
          report::shown(
              study::Axis{study::name_of_axis(inputs[i].key.name), {}, inputs[i].key, inputs[i].values}),
          [i](const AskedLaunch& launch) { return launch.values[i]; });
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto of = [i](double study::Prediction::*part) {
      return [i, part](const AskedLaunch& launch) -> std::optional<double> {
        const auto& prediction = launch.predictions[i];
        return prediction ? std::optional((*prediction).*part) : std::nullopt;
      };
    };
    report::Column error = outputs[i];
    error.name += "_error";
    error.heading = "+-";
    quantities.emplace_back(outputs[i], of(&study::Prediction::value));
    quantities.emplace_back(std::move(error), of(&study::Prediction::error));
  }
  return quantities;
}

/// Nothing is said of a launch that is too far out.
report::Table table_of_launches(const SurrogateRecord& record, const std::vector<AskedInput>& inputs) {
  std::vector<AskedLaunch> launches = launches_of(inputs);
  std::vector<report::Column> outputs;
  for (const SurrogateOutput& output : record.outputs) {
    if (!output.reason.empty()) continue;
    outputs.push_back(shown_output(output, record));
    const Surrogate surrogate(record, output);
    for (AskedLaunch& launch : launches) {
      const study::Prediction prediction = surrogate.at(record.inputs.point_of(launch.values));
      launch.predictions.push_back(prediction.covered ? std::optional(prediction) : std::nullopt);
    }
  }
  report::Table table = report::table_of("Predicted", launch_quantities(inputs, outputs), launches);
  table.notes = {
      "1 of 100 launches is beyond the error (+-), on each side. A row without numbers is farther out than "
      "any launch "
      "by which the error is known. Only a launch that was computed can be SAFE."};
  return table;
}

ExitCode print_launches(const AskArguments& arguments, const SurrogateRecord& record,
                        const std::vector<AskedInput>& inputs, Console& console) {
  constexpr double most_launches = 1e6;
  double count = 1;
  for (const AskedInput& each : inputs) count *= static_cast<double>(each.values.size());
  if (count > most_launches)
    return console.refuse(fmt::format("--set: found {:.0f} combinations; allowed: up to a million", count));
  const report::Table table = table_of_launches(record, inputs);
  console.print_text(arguments.csv ? report::to_csv(table) : report::to_text(table));
  if (console.json())
    console.print_json({{"launches", report::to_json(table)["rows"]}, {"confidence", 0.99}});
  return ExitCode::done;
}

}  // namespace

ExitCode perform(const AskArguments& arguments, Console& console) {
  const auto record = read_record(arguments.study);
  if (!record) return console.refuse(record.error());
  auto inputs = inputs_in_scene(*record);
  if (!inputs) return console.refuse(inputs.error());
  for (const std::string& given : arguments.settings)
    if (const auto fault = set_input(given, *inputs)) return console.refuse(*fault);
  if (const auto fault = check_ranges(*record, *inputs)) return console.refuse(*fault);
  const bool several = std::ranges::any_of(*inputs, [](const auto& each) { return each.values.size() > 1; });
  if (several || arguments.csv) return print_launches(arguments, *record, *inputs, console);
  Answer answer(*record, std::move(*inputs), arguments.gap.value_or(record->gap));
  if (const auto fault = answer.predict()) return console.refuse(*fault);
  answer.print(console);
  return ExitCode::done;
}

}  // namespace launchsafe::app
