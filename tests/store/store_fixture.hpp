// A store of a test's own, and results to keep in it.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "sample_case.hpp"
#include "temporary_folder.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace launchsafe::testing {

/// The kind of the error that `body` throws; nothing where it throws none.
template <class Body>
std::optional<store::Error::Kind> kind_of(Body body) {
  try {
    body();
    return std::nullopt;
  } catch (const store::Error& error) {
    return error.kind;
  }
}

/// The case of a number; its results can be told apart by their end time.
inline store::CaseIdentity identity_of(int number) {
  return store::CaseIdentity(fmt::format("model 7, case {}\n", number));
}
inline std::string hash_of(int number) { return identity_of(number).hash; }

inline run::CaseResult result_of(int number) {
  run::CaseResult result = sample_case();
  result.mechanics.end_time = number;
  return result;
}

inline store::RunRecord record_of(int number, store::CaseState state = store::CaseState::done) {
  store::RunRecord record;
  record.hash = hash_of(number);
  record.state = state;
  record.label = fmt::format("case {}", number);
  record.model_version = 7;
  record.wall_time = 61.5;
  record.processor_time = 60.25;
  return record;
}

inline void save(store::CaseStore& store, int number) {
  store.save(identity_of(number), result_of(number), record_of(number));
}

class StoreFixture : public TemporaryFolder {
 protected:
  std::filesystem::path where() const { return folder() / "study"; }
  std::filesystem::path file_of(int number) const { return where() / "cases" / (hash_of(number) + ".h5"); }
  std::unique_ptr<store::CaseStore> opened() const { return store::CaseStore::open(where()); }

  /// The kind of the error of opening; nothing where it opens.
  std::optional<store::Error::Kind> fault() const {
    return kind_of([&] { opened(); });
  }

  /// A folder with the cases 0 to `count` - 1, closed again.
  void fill(int count) const {
    const auto store = opened();
    for (int number = 0; number < count; ++number) save(*store, number);
  }
};

}  // namespace launchsafe::testing
