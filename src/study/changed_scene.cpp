#include "launchsafe/study/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {

bool same_number(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

bool same_value(const scene::Value& a, const scene::Value& b) {
  if (a.index() != b.index()) return false;
  if (const auto* number = std::get_if<double>(&a)) return same_number(*number, std::get<double>(b));
  const auto* list = std::get_if<std::vector<double>>(&a);
  if (list == nullptr) return a == b;
  const auto& other = std::get<std::vector<double>>(b);
  return std::equal(list->begin(), list->end(), other.begin(), other.end(), same_number);
}

namespace {

scene::Expected<scene::SceneFile> with_all(const scene::SceneFile& scene,
                                           const std::vector<Change>& changes) {
  std::vector<scene::KeyChange> all;
  for (const Change& change : changes) all.push_back({change.key, change.value, change.place});
  return scene::with_keys(scene, all);
}

/// The change that a fault of all together is about: of the key that it names, else the first that the scene
/// could not have alone, else the first.
const Change& change_at_fault(const scene::SceneFile& scene, const std::vector<Change>& changes,
                              const scene::InputError& error) {
  const auto named = std::ranges::find(changes, error.key, &Change::key);
  if (named != changes.end()) return *named;
  const auto alone =
      std::ranges::find_if(changes, [&](const Change& change) { return !with_all(scene, {change}); });
  return alone != changes.end() ? *alone : changes.front();
}

}  // namespace

scene::Expected<scene::SceneFile> with_changes(const scene::SceneFile& scene,
                                               const std::vector<Change>& changes, bool may_close) {
  if (changes.empty()) return scene;
  auto changed = with_all(scene, changes);
  const auto model = std::ranges::find(changes, "gap.model", &Change::key);
  if (!may_close && changed && changed->scene.surface.model == scene::GapModel::closing &&
      model != changes.end())
    return scene::error_at(model->place, model->study_key, model->text, only_reservoir);
  if (changed) return changed;
  scene::InputError error = changed.error();
  const Change& change = change_at_fault(scene, changes, error);
  if (error.key != change.key) {
    error.found = fmt::format("{}, with which {} is {}", change.text, error.key, error.found);
    error.allowed = fmt::format("values with which {} is {}", error.key, error.allowed);
  }
  error.file = change.place.file;
  error.line = change.place.line;
  error.column = change.place.column;
  error.key = change.study_key;
  return error;
}

}  // namespace launchsafe::study
