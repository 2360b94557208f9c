#include "launchsafe/study/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

void ChangedScene::apply(const Change& change) {
  if (auto error = try_to(change)) {
    waiting_.push_back({change, std::move(*error)});
  } else if (!waiting_.empty()) {
    retry();
  }
  try_all();
}

std::optional<scene::InputError> ChangedScene::try_to(const Change& change) {
  auto changed = scene::with_key(scene_, change.key, change.value, change.place);
  if (!changed) return changed.error();
  scene_ = std::move(*changed);
  return std::nullopt;
}

void ChangedScene::retry() {
  for (bool progress = true; progress && !waiting_.empty();) {
    progress = false;
    for (auto each = waiting_.begin(); each != waiting_.end();) {
      if (auto error = try_to(each->change)) {
        (each++)->error = std::move(*error);
      } else {
        each = waiting_.erase(each);
        progress = true;
      }
    }
  }
}

/// Those that wait, together. What they lack even so says more than what each lacks alone.
void ChangedScene::try_all() {
  if (waiting_.size() < 2) return;
  std::vector<scene::KeyChange> changes;
  for (const Waiting& each : waiting_)
    changes.push_back({each.change.key, each.change.value, each.change.place});
  auto changed = scene::with_keys(scene_, changes);
  if (!changed) {
    waiting_.front().error = std::move(changed.error());
    return;
  }
  scene_ = std::move(*changed);
  waiting_.clear();
}

scene::InputError ChangedScene::error() const {
  const auto& [change, reason] = waiting_.front();
  scene::InputError error = reason;
  if (reason.key != change.key) {
    error.found = fmt::format("{}, with which {} is {}", change.text, reason.key, reason.found);
    error.allowed = fmt::format("values with which {} is {}", reason.key, reason.allowed);
  }
  error.file = change.place.file;
  error.line = change.place.line;
  error.column = change.place.column;
  error.key = change.study_key;
  return error;
}

}  // namespace launchsafe::study
