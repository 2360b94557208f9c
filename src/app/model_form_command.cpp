// launchsafe model-form: how the critical gap changes with the model, from calibrations and sweeps.
#include "commands.hpp"
#include "launchsafe/report/model_form_report.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "output_folder.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <list>
#include <set>

namespace launchsafe::app {
namespace {

using std::filesystem::path;

/// One model as its folder holds it.
struct Model {
  std::string name;
  study::CalibrationRecord calibration;
  study::CriticalGapCurve curve;
};

scene::Expected<Model> read_model(const path& folder) {
  const path calibration = folder / "calibration" / "calibration.json";
  const path curve = folder / "sweep" / "critical_gaps.json";
  Model model;
  model.name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  const auto calibration_text = scene::read_text_file(calibration);
  if (!calibration_text) return calibration_text.error();
  auto record = study::parse_calibration_record(*calibration_text, calibration.string());
  if (!record) return record.error();
  const auto curve_text = scene::read_text_file(curve);
  if (!curve_text) return curve_text.error();
  auto gaps = study::parse_critical_gap_curve(*curve_text, curve.string());
  if (!gaps) return gaps.error();
  model.calibration = std::move(*record);
  model.curve = std::move(*gaps);
  return model;
}

std::string model_form_command_text(const ModelFormArguments& arguments) {
  std::vector<std::string> words{"launchsafe", "model-form"};
  for (const path& folder : arguments.folders) words.push_back(folder.string());
  return shell_command(words) + " -o DIR";
}

}  // namespace

ExitCode perform(const ModelFormArguments& arguments, Console& console) {
  std::list<Model> models;  // entries point into it
  std::set<std::string> names;
  report::ModelForm form;
  for (const path& folder : arguments.folders) {
    auto model = read_model(folder);
    if (!model) return console.refuse(model.error());
    if (!names.insert(model->name).second)
      return console.refuse(fmt::format("model-form: found two models of the name {}", model->name));
    models.push_back(std::move(*model));
    form.entries.push_back({models.back().name, &models.back().calibration, &models.back().curve});
  }
  auto made = study::make_model_form(form.entries);
  if (!made.record) return console.refuse("model-form: " + made.error);
  form.record = std::move(*made.record);
  form.command = model_form_command_text(arguments);
  if (const auto obstacle = obstacle_to_report(arguments.output, report::model_form_files()))
    return console.refuse(*obstacle);
  const auto written = report::write_report(report::report_of(form), arguments.output);
  if (!written) return console.fail(written.error().message);
  const report::Table table = report::model_form_table(form);
  console.print_text(report::to_text(table));
  console.print_json({{"model_form", report::to_json(table)["rows"]},
                      {"constants", report::to_json(report::model_constants_table(form))["rows"]}});
  return present_report(written, arguments.output, console);
}

}  // namespace launchsafe::app
