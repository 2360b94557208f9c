// launchsafe run: one case.
#include "case_summary.hpp"
#include "commands.hpp"
#include "explain_scene.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/own_files.hpp"
#include "launchsafe/study/scheduler.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace launchsafe::app {
namespace {

std::string milliseconds(double seconds) { return scene::format_quantity(seconds, scene::Dimension::time); }

run::CaseResult run_with_progress(const scene::Scene& scene, const Console& console) {
  Progress progress(progress_style(console.quiet()));
  const auto start = std::chrono::steady_clock::now();
  run::RunOptions options;
  options.stop = &stop_requested();
  options.threads = study::available_cores();
  options.progress = [&](double share) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    progress.show(fmt::format("{} of {}, {:.0f} %  {}", milliseconds(share * scene.load.duration),
                              milliseconds(scene.load.duration), 100.0 * share,
                              time_left(share, elapsed.count())));
  };
  return run::run_case(scene, options);
}

/// Why the result may not be written at `path`; found out before anything is computed.
std::optional<std::string> obstacle_at(const std::filesystem::path& path, const store::Manifest& manifest) {
  std::error_code failed;
  if (std::filesystem::is_symlink(path, failed))
    return path.string() +
           " is a link, and nothing is written in its place: move it away or name another folder";
  const auto present = store::read_manifest(path);
  if (present) {
    if (present->input_sha256 == manifest.input_sha256) return std::nullopt;
    return fmt::format(
        "{} holds the result of a different input, and nothing is overwritten; name another folder",
        path.string());
  }
  if (present.error().kind == store::Error::Kind::missing) return std::nullopt;
  return present.error().message + "; it is not overwritten: move it away or name another folder";
}

/// Likewise for the file that ParaView opens.
std::optional<std::string> obstacle_to_sidecar(const std::filesystem::path& path) {
  const auto error = store::obstacle_to_own_file(store::sidecar_of(path));
  return error ? std::optional(error->message) : std::nullopt;
}

ExitCode report_interruption(const RunArguments& arguments, const run::MechanicsResult& mechanics,
                             const scene::Scene& scene, Console& console) {
  const std::string output = arguments.output ? fmt::format(" -o {}", arguments.output->string()) : "";
  console.error(fmt::format(
      "interrupted at {} of {}; nothing of this case was kept; to start it again: launchsafe run {}{}",
      milliseconds(mechanics.end_time), milliseconds(scene.load.duration), arguments.scene.string(), output));
  return ExitCode::interrupted;
}

}  // namespace

ExitCode perform(const RunArguments& arguments, Console& console) {
  const auto file = scene::read_scene(arguments.scene);
  if (!file) return console.refuse(file.error());
  for (const std::string& note : file->notes) console.remark(note);
  const scene::Scene& scene = file->scene;
  run::Reach reach{.memory = study::available_memory(), .keeps_skins = true};
  if (arguments.longest_run) reach.longest_run = *arguments.longest_run;
  if (const auto error = run::out_of_reach(*file, reach)) return console.refuse(*error);
  store::Manifest manifest = store::make_manifest(scene::to_toml(scene), 1);
  std::filesystem::path target;
  if (arguments.output) {
    target = *arguments.output / arguments.scene.stem().concat(".h5");
    auto obstacle = obstacle_at(target, manifest);
    if (!obstacle && !scene.output.snapshot_times.empty()) obstacle = obstacle_to_sidecar(target);
    if (!obstacle) obstacle = prepare_output_folder(*arguments.output);
    if (obstacle) return console.refuse(*obstacle);
  }

  for (const scene::Implausible& each : scene::implausible_values(scene)) {
    if (!each.accepted()) console.remark("validity warning: " + scene::validity_warning(each));
  }
  const run::CaseResult result = run_with_progress(scene, console);
  manifest.wall_time = result.mechanics.wall_time;
  if (result.mechanics.status == run::RunStatus::interrupted) {
    return report_interruption(arguments, result.mechanics, scene, console);
  }
  if (!target.empty()) {
    if (const auto error = store::write_case_file(target, scene, result, manifest))
      return console.end_with(*error);
    console.remark(fmt::format("wrote {}", target.string()));
  }
  console.print_text(case_text(scene, result));
  nlohmann::ordered_json object = case_json(scene, result);
  object["implausible"] = plausibility_json(scene);
  object["input_sha256"] = manifest.input_sha256;
  object["file"] = target.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(target.string());
  console.print_json(object);
  const bool finite = std::all_of(result.gaps.begin(), result.gaps.end(), [](const run::GapResult& gap) {
    return std::isfinite(gap.at_stations.temperature);
  });
  if (!finite) {
    console.error("a skin temperature is not a number; every verdict on it is indeterminate");
    return ExitCode::indeterminate;
  }
  if (result.mechanics.status == run::RunStatus::completed) return ExitCode::done;
  console.error(fmt::format("the run ended early ({}): {}; every verdict on it is indeterminate",
                            run::to_string(result.mechanics.status), result.mechanics.reason));
  return ExitCode::indeterminate;
}

}  // namespace launchsafe::app
