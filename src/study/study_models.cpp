// Launches of a study's cases under other constants than their own.
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/study/study_cases.hpp"

#include <tbb/parallel_for.h>

#include <ranges>
#include <set>

namespace launchsafe::study {
namespace {

constexpr const char* models_key = "models";

}  // namespace

std::string name_of_model(const scene::Constants& model) {
  const std::filesystem::path path(model.name);
  return path.extension() == ".toml" ? path.stem().string() : model.name;
}

scene::Scene scene_of_model(const StudyCase& input, const std::shared_ptr<const scene::Constants>& model) {
  return scene::with_constants(input.scene, model).or_throw().scene;
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
    for (const auto& model : study.study.models)
      if (const auto scene = scene::with_constants(input.scene, model); !scene && faults[i].empty())
        faults[i] = fmt::format("{}, with which {} has a fault: {}", name_of_model(*model), input.label,
                                scene.error().message());
  });
  const auto fault = std::ranges::find_if_not(faults, &std::string::empty);
  if (fault != faults.end())
    refuse_at(study, models_key, *fault, "constants with which every case is a valid scene");
}

}  // namespace launchsafe::study
