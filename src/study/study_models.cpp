// Launches of a study's cases under other constants than their own.
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <tbb/parallel_for.h>

#include <ranges>
#include <set>

namespace launchsafe::study {
namespace {

constexpr const char *models_key = "models", *constants_key = "constants";

/// The keys of a scene that its constants have, but for those of a steel.
std::set<std::string> keys_of_constants(const scene::SceneFile& file) {
  std::set<std::string> names;
  for (const auto& [key, value] : file.constants->values)
    if (!key.starts_with("steel.")) names.insert(scene::key_in_scene(file.scene, key));
  return names;
}

}  // namespace

void use_constants(StudyFile& study, const std::filesystem::path& folder) {
  const std::string& name = study.study.constants;
  if (name.empty()) return;
  auto constants = scene::find_constants(name, folder, place_of_key(study, constants_key), constants_key);
  study.scene = scene::with_constants(study.scene, std::move(constants));
}

void check_constants(const StudyFile& study) {
  const scene::SceneFile& file = study.scene;
  if (!study.study.kind.gives_verdicts || file.constants == nullptr) return;
  const bool has_curve = !file.scene.load.curve_time.empty();
  const std::string allowed = fmt::format(
      "no such key where verdicts are given: it stands in the constants \"{}\" alone", file.constants->name);
  for (const std::string& key : keys_of_constants(file)) {
    if (has_curve && key.starts_with("load.")) continue;
    if (const auto given = file.given.find(key); given != file.given.end() && !given->second.of_material)
      throw scene::error_at(given->second.place, key, "a constant that was fitted or chosen", allowed);
    if (const auto place = file.places.find(key); place != file.places.end())
      throw scene::error_at(place->second, key, "a constant that was fitted or chosen", allowed);
    for (const Axis& axis : study.study.axes)
      if (axis.key.name == key)
        refuse_at(study, axis.study_key, key + ", a constant that was fitted or chosen", allowed);
  }
}

std::string name_of_model(const scene::Constants& model) {
  const std::filesystem::path path(model.name);
  return path.extension() == ".toml" ? path.stem().string() : model.name;
}

scene::Scene scene_of_model(const StudyCase& input, const std::shared_ptr<const scene::Constants>& model) {
  return scene::with_constants(input.scene, model).scene;
}

void read_models(StudyFile& study, const std::filesystem::path& folder) {
  std::set<std::string> known;
  for (const auto part : std::views::split(study.study.model_names, std::string_view(", "))) {
    const std::string name(part.begin(), part.end());
    auto model = scene::find_constants(name, folder, place_of_key(study, models_key), models_key);
    if (model == nullptr) refuse_at(study, models_key, "no constants", "names or paths of constants files");
    if (!known.insert(name_of_model(*model)).second)
      refuse_at(study, models_key, name_of_model(*model) + " twice", "each name once");
    study.records.push_back(store::sha256(to_toml(*model)));
    study.study.models.push_back(std::move(model));
  }
}

void check_models(const StudyFile& study) {
  if (study.study.models.empty()) return;
  std::vector<std::string> faults(study.cases.size());
  tbb::parallel_for(std::size_t{0}, faults.size(), [&](std::size_t i) {
    const StudyCase input = study.cases[i];
    for (const auto& model : study.study.models) try {
        scene_of_model(input, model);
      } catch (const scene::InputError& error) {
        faults[i] = fmt::format("{}, with which {} has a fault: {}", name_of_model(*model), input.label,
                                error.message());
      }
  });
  const auto fault = std::ranges::find_if_not(faults, &std::string::empty);
  if (fault != faults.end())
    refuse_at(study, models_key, *fault, "constants with which every case is a valid scene");
}

}  // namespace launchsafe::study
