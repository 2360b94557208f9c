// launchsafe explain: what would be computed, and at what cost.
#include "common_options.hpp"
#include "explain.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/report/case_pictures.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
#include "output_folder.hpp"

#include <fmt/format.h>

namespace launchsafe::app {
namespace {

/// What cannot be read is left to the reader of scenes to complain about.
scene::InputContent content_of(const std::filesystem::path& path) {
  const auto text = scene::read_text_file(path);
  if (!text) return scene::InputContent::unknown;
  const auto table = scene::parse_toml(*text, path.string());
  return table ? scene::content_of(*table) : scene::InputContent::unknown;
}

std::string line_of(const scene::Implausible& value) {
  if (value.accepted()) return scene::accepted_text({value});
  return "validity warning: " + scene::validity_warning(value);
}

/// One sentence for every value that is not plausible.
std::vector<std::string> plausibility_lines(const scene::Scene& scene) {
  std::vector<std::string> lines;
  for (const scene::Implausible& each : scene::implausible_values(scene)) lines.push_back(line_of(each));
  return lines;
}

/// What a study of the scene alone would have to accept, or does, under the shipped calibration.
study::AcceptancesOfStudy acceptances_of(const scene::SceneFile& file) {
  study::StudyFile alone;
  alone.study.kind.gives_verdicts = scene::has_charge(file.scene);
  study::StudyCase only;
  only.scene = file;
  alone.cases.add(std::move(only));
  return study::acceptances_of(alone);
}

/// What is to be accepted, ready to copy; and acceptances that accept nothing.
std::vector<std::string> acceptance_lines(const study::AcceptancesOfStudy& all,
                                          const std::vector<scene::Acceptance>& accepted) {
  std::vector<std::string> lines;
  if (!all.missing.empty())
    lines.push_back("not accepted; a file that does says, with reasons in words:\n" +
                    scene::acceptances_to_write(all.missing));
  for (const scene::Acceptance& each : accepted) {
    const auto used = [&](const scene::Implausible& value) {
      return value.key == each.key && value.accepted_value == each.value;
    };
    if (!std::ranges::any_of(all.accepted, used))
      lines.push_back(fmt::format("accept names {} = {}, which nothing needs", each.key, each.value));
  }
  return lines;
}

/// The same for the cases of a study and what it states itself, each with the number of cases. Empty for a
/// kind that gives no verdicts on scenes of its own.
std::vector<std::string> plausibility_lines(const study::StudyFile& study) {
  if (!study.study.kind.gives_verdicts && study.study.kind.own_scenes) return {};
  std::vector<std::string> lines;
  for (const scene::Implausible& each : study.study.implausible) lines.push_back(line_of(each));
  std::vector<std::string> order;
  std::map<std::string, std::size_t> cases;
  for (const study::StudyCase& each : study.cases) {
    for (const scene::Implausible& value : scene::implausible_values(each.scene.scene)) {
      const std::string line = line_of(value);
      if (++cases[line] == 1) order.push_back(line);
    }
  }
  // A sensitivity study may have another value in every case.
  constexpr std::size_t most_lines = 20;
  for (std::size_t i = 0; i < std::min(order.size(), most_lines); ++i)
    lines.push_back(fmt::format("{} ({} of {} cases)", order[i], cases[order[i]], study.cases.size()));
  if (order.size() > most_lines)
    lines.push_back(fmt::format("and {} other values like these", order.size() - most_lines));
  return lines;
}

/// Nothing without lines.
std::string section_of(const char* title, const std::vector<std::string>& lines) {
  std::string text = lines.empty() ? "" : fmt::format("\n{}\n", title);
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

/// Writes the half section and the grid.
void draw_grid(const std::filesystem::path& picture, const scene::Scene& scene, Console& console) {
  if (picture.extension() != ".svg")
    throw Ended{console.refuse(fmt::format(
        "--grid: found \"{}\"; allowed: the name of an SVG file, such as grid.svg", picture.string()))};
  write_where_absent(store::folder_of(picture), {{picture.filename(), report::section_svg(scene)}}, console);
  console.remark(fmt::format("wrote {}", picture.string()));
}

ExitCode explain_scene(const ExplainArguments& arguments, Console& console) {
  const scene::SceneFile file = console.value_of(scene::read_scene(arguments.file));
  const scene::Scene& scene = file.scene;
  for (const std::string& note : file.notes) console.remark(note);
  if (arguments.picture) draw_grid(*arguments.picture, scene, console);
  const double update_rate = measured_update_rate(scene, console);
  console.print_text(scene_text(scene, update_rate) + section_of("Plausibility", plausibility_lines(scene)) +
                     section_of("Acceptances", acceptance_lines(acceptances_of(file), scene.accepted)));
  console.print_json(scene_json(scene, update_rate));
  return ExitCode::done;
}

ExitCode explain_study(const std::filesystem::path& path, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(path));
  for (const std::string& note : file.scene.notes) console.remark(note);
  const study::Forecast forecast =
      study::forecast_study(file, {}, measured_update_rate(file.cases.front().scene.scene, console));
  const std::vector<std::string> lines = plausibility_lines(file);
  console.print_text(
      forecast_text(file, forecast, {}) + section_of("Plausibility", lines) +
      section_of("Acceptances", acceptance_lines(study::acceptances_of(file), file.scene.scene.accepted)));
  Json object = forecast_json(file, forecast);
  object["implausible"] = lines;
  console.print_json(object);
  return ExitCode::done;
}

/// What of these options makes no sense together; empty for nothing.
std::string contradiction(const ExplainArguments& explain) {
  const bool of_program = !explain.schema.empty();
  const bool lists = explain.lists();
  if (!lists && of_program != explain.file.empty())
    return "explain: allowed: a scene, study or file of materials, or one of --keys, --results, "
           "--materials and --schema";
  if (explain.picture && (of_program || lists))
    return "explain: --grid draws the grid of a scene; allowed: with a scene file";
  return {};
}

}  // namespace

ExitCode perform(const ExplainArguments& arguments, Console& console) {
  if (const std::string fault = contradiction(arguments); !fault.empty())
    return console.refuse(fault + usage_hint);
  if (arguments.lists() || !arguments.schema.empty()) return explain_program(arguments, console);
  const scene::InputContent content = content_of(arguments.file);
  if (content != scene::InputContent::study && content != scene::InputContent::materials)
    return explain_scene(arguments, console);
  if (arguments.picture)
    return console.refuse(
        fmt::format("--grid: found {}, which is no scene; allowed: a scene, such as that of a study",
                    arguments.file.string()));
  return content == scene::InputContent::study ? explain_study(arguments.file, console)
                                               : explain_material_file(arguments.file, console);
}

void add_explain(CLI::App& app, CommandLine& line) {
  auto [command, explain] = add_command<ExplainArguments>(
      app, line, "explain", "Say what a scene or a study will compute, what it leaves out, and the cost");
  add_optional(
      command, "file", explain.file, "SCENE.toml|STUDY.toml|MATERIALS.toml",
      "Scene, study or file of materials; with --keys, --results or --materials the beginning of names, such "
      "as load");
  CLI::Option* keys = command.add_flag("--keys", explain.keys,
                                       "List the keys of scene and study files, or those whose name begins "
                                       "with the word given in the place of a "
                                       "file: unit, range, default, standing, meaning");
  CLI::Option* results = command.add_flag(
      "--results", explain.results,
      "List the columns of the tables that studies write, or those whose name begins with the word given in "
      "the place of a file: name in files with its unit, meaning");
  CLI::Option* materials =
      command.add_flag("--materials", explain.materials,
                       "List the materials that ship, or those whose name begins with the "
                       "word given in the place of a file: every number and its source");
  CLI::Option* schema = command
                            .add_option("--schema", explain.schema,
                                        "Print the JSON schema of scene or study files, for editors")
                            ->check(CLI::IsMember({"scene", "study", "references"}))
                            ->type_name("scene|study|references");
  for (CLI::Option* option : {keys, results, materials, schema})
    for (CLI::Option* other : {keys, results, materials, schema})
      if (other != option) option->excludes(other);
  add_place(command, "--grid", explain.picture, "FILE.svg", "file",
            "File to draw the half section of a scene and its grid to");
}

}  // namespace launchsafe::app
