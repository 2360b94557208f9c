// launchsafe explain: what would be computed, and at what cost.
#include "commands.hpp"
#include "explain_scene.hpp"
#include "foresight_text.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/foresight.hpp"
#include "plausibility_text.hpp"
#include "signals.hpp"
#include "update_rate.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

ExitCode explain_keys(Console& console) {
  console.print_text(keys_text());
  console.print_json(keys_json());
  return ExitCode::done;
}

/// Only a study names a kind or a scene. What cannot be read is left to the reader of scenes to complain
/// about.
bool is_study(const std::filesystem::path& path) {
  const auto text = scene::read_text_file(path);
  if (!text) return false;
  const auto table = scene::parse_toml(*text, path.string());
  return table && (table->contains("kind") || table->contains("scene"));
}

ExitCode refuse(const scene::InputError& error, const Console& console) {
  console.error(error.message());
  return ExitCode::bad_input;
}

ExitCode interrupted(const Console& console) {
  console.error("interrupted while measuring the speed of this machine; there is nothing to keep");
  return ExitCode::interrupted;
}

/// Nothing where all is plausible.
std::string section_of(const std::vector<std::string>& lines) {
  std::string text = lines.empty() ? "" : "\nPlausibility\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

ExitCode explain_scene(const std::filesystem::path& path, Console& console) {
  const auto file = scene::read_scene(path);
  if (!file) return refuse(file.error(), console);
  const double update_rate = measured_update_rate(file->scene);
  if (stop_requested()) return interrupted(console);
  console.print_text(scene_text(file->scene, update_rate) + section_of(plausibility_lines(file->scene)));
  nlohmann::ordered_json object = scene_json(file->scene, update_rate);
  object["implausible"] = plausibility_json(file->scene);
  console.print_json(object);
  return ExitCode::done;
}

ExitCode explain_study(const std::filesystem::path& path, Console& console) {
  const auto file = study::read_study(path);
  if (!file) return refuse(file.error(), console);
  const double update_rate = measured_update_rate(file->cases.front().scene.scene);
  if (stop_requested()) return interrupted(console);
  const study::Foresight foresight = study::foresee(*file, {}, update_rate);
  const std::vector<std::string> lines = plausibility_lines(*file);
  console.print_text(foresight_text(*file, foresight, {}) + section_of(lines));
  nlohmann::ordered_json object = foresight_json(*file, foresight);
  object["implausible"] = lines;
  console.print_json(object);
  return ExitCode::done;
}

}  // namespace

ExitCode explain_command(const ExplainArguments& arguments, Console& console) {
  if (arguments.keys) return explain_keys(console);
  return is_study(arguments.file) ? explain_study(arguments.file, console)
                                  : explain_scene(arguments.file, console);
}

}  // namespace launchsafe::app
