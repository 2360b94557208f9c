// launchsafe explain: what would be computed, and at what cost.
#include "built_in_texts.hpp"
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
scene::InputContent content_of(const path& file) {
  const auto text = scene::read_text_file(file);
  if (!text) return scene::InputContent::unknown;
  const auto table = scene::parse_toml(*text, file.string());
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

/// What is not plausible; what is to be accepted, ready to copy; and acceptances that accept nothing.
std::string checks_text(const std::vector<std::string>& implausible, const study::AcceptancesOfStudy& all,
                        const std::vector<scene::Acceptance>& accepted) {
  Json facts{{"plausibility", implausible}, {"acceptances", Json::array()}};
  Json& lines = facts["acceptances"];
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
  return told("checks.txt", facts);
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

/// Writes the half section and the grid.
void draw_grid(const path& picture, const scene::Scene& scene, Console& console) {
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
  console.print_text(scene_text(scene, update_rate) +
                     checks_text(plausibility_lines(scene), acceptances_of(file), scene.accepted));
  console.print_json(scene_json(scene, update_rate));
  return ExitCode::done;
}

ExitCode explain_study(const path& place, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(place));
  for (const std::string& note : file.scene.notes) console.remark(note);
  const study::Forecast forecast =
      study::forecast_study(file, {}, measured_update_rate(file.cases.front().scene.scene, console));
  const std::vector<std::string> lines = plausibility_lines(file);
  console.print_text(forecast_text(file, forecast, {}) +
                     checks_text(lines, study::acceptances_of(file), file.scene.scene.accepted));
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
  auto [command, explain] = add_command<ExplainArguments>(app, line, "explain");
  add(command, "file", explain.file);
  const std::vector<CLI::Option*> of_program{
      add(command, "--keys", explain.keys), add(command, "--results", explain.results),
      add(command, "--materials", explain.materials),
      add(command, "--schema", explain.schema)->check(CLI::IsMember({"scene", "study", "references"}))};
  for (CLI::Option* option : of_program)
    for (CLI::Option* other : of_program)
      if (other != option) option->excludes(other);
  add(command, "--grid", explain.picture);
}

}  // namespace launchsafe::app
