// Scenes from any bytes. An input is the text of a scene and, after a line "%%%%", that of its pressure
// curve, curve.csv. Whatever is read must be fit for what every command does with a scene next; whatever is
// not must say why.
#include "launchsafe/scene/read_scene.hpp"

#include "fuzz_input.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;

/// Equal texts are equal scenes: every key is written, with every digit.
void check_round_trip(const scene::Scene& given) {
  const std::string written = scene::to_toml(given);
  const auto again = scene::caught([&] { return scene::parse_scene(written, "written.toml"); });
  fuzz::require(again.has_value(), "what was read and written can be read",
                again ? std::string{} : again.error().message() + "\n" + written);
  const std::string twice = scene::to_toml(again->scene);
  fuzz::require(twice == written, "what was read and written is the same scene",
                written + "\n----\n" + twice);
}

void check_plan(const scene::Scene& given) {
  const scene::Plan plan = scene::make_plan(given);
  fuzz::require(plan.particles() > 0 && plan.cells > 0 && plan.steps > 0, "a plan has something to do",
                scene::to_toml(given));
  fuzz::require(std::isfinite(plan.time_step) && plan.time_step > 0.0, "a plan has a time step",
                scene::to_toml(given));
  fuzz::require(std::isfinite(plan.work) && std::isfinite(plan.memory), "the cost of a plan is known",
                scene::to_toml(given));
}

void check_load(const scene::Scene& given) {
  const scene::PressureHistory history(given.load);
  fuzz::require(std::isfinite(history.peak()), "the peak of the load is a number");
  constexpr int instants = 16;
  for (int i = 0; i <= instants; ++i) {
    const double pressure = history.at(scene::end_time(given.load) * i / instants);
    fuzz::require(std::isfinite(pressure) && pressure >= 0.0, "the load is a pressure at any time");
  }
}

void check_scene(const scene::SceneFile& file) {
  check_round_trip(file.scene);
  check_round_trip(scene::mechanical_part(file.scene));
  check_plan(file.scene);
  check_load(file.scene);
  const auto listed = std::ranges::count_if(scene::scene_keys(), [&](const auto& key) {
    return !key.is_written || key.is_written(file.scene) || file.given.contains(key.name);
  });
  fuzz::require(scene::list_keys(file).size() == static_cast<std::size_t>(listed),
                "every key that does something is listed");
}

void check_curve(const std::string& text) {
  const auto curve = scene::caught([&] { return scene::parse_pressure_curve(text, "curve.csv"); });
  if (!curve) return fuzz::require_told(curve.error());
  fuzz::require(curve->time.size() >= 2 && curve->time.size() == curve->pressure.size(),
                "a curve has at least two points");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::ScratchFolder folder;
  const auto parts = fuzz::parts_of(data, size);
  if (parts.size() > 1) {
    check_curve(parts[1]);
    folder.write("curve.csv", parts[1]);
  } else {
    folder.remove("curve.csv");
  }
  const auto file = scene::caught([&] { return scene::parse_scene(parts[0], folder.path() / "scene.toml"); });
  file ? check_scene(*file) : fuzz::require_told(file.error());
  return 0;
}
