// A store of a test's own, and results to keep in it.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "sample_case.hpp"
#include "temporary_folder.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace launchsafe::testing {

/// The case of a number; its results can be told apart by their end time.
inline store::CaseIdentity identity_of(int number) {
  return store::CaseIdentity(fmt::format("model 7, case {}\n", number));
}

inline run::CaseResult result_of(int number) {
  run::CaseResult result = sample_case();
  result.mechanics.end_time = number;
  return result;
}

inline store::RunRecord record_of(int number) {
  store::RunRecord entry;
  entry.label = fmt::format("case {}", number);
  entry.wall_time = 61.5;
  entry.processor_time = 60.25;
  return entry;
}

inline void save(store::CaseStore& store, int number) {
  store.save(identity_of(number), sample_scene(), result_of(number), record_of(number));
}

class StoreFixture : public TemporaryFolder {
 protected:
  static constexpr int model_version = scene::model_version;

  std::filesystem::path where() const { return folder() / "study"; }
  std::filesystem::path results() const { return where() / "study.db"; }
  std::filesystem::path file_of(int number) const {
    return where() / "cases" / (identity_of(number).hash() + ".h5");
  }

  static store::Result<std::unique_ptr<store::CaseStore>> try_open(const std::filesystem::path& path,
                                                                   const std::string& part = {}) {
    return store::CaseStore::open(path, part);
  }

  /// A store, or a null pointer and a failed test.
  static std::unique_ptr<store::CaseStore> opened_at(const std::filesystem::path& path,
                                                     const std::string& part = {}) {
    auto store = try_open(path, part);
    if (store) return std::move(*store);
    ADD_FAILURE() << store.error().message;
    return nullptr;
  }
  std::unique_ptr<store::CaseStore> opened(const std::string& part = {}) const {
    return opened_at(where(), part);
  }

  /// A folder with the cases 0 to `count` - 1, closed again.
  void fill(int count) const {
    const auto store = opened();
    for (int number = 0; number < count; ++number) save(*store, number);
  }

  static bool any_contains(const std::vector<std::string>& texts, const std::string& part) {
    for (const std::string& text : texts) {
      if (text.find(part) != std::string::npos) return true;
    }
    return false;
  }
};

}  // namespace launchsafe::testing
