// The names of a store's files, and what lies there.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "posix_file.hpp"

namespace launchsafe::store {

/// The hashes of what has the name of a case file in a store, in order.
std::vector<std::string> stored_hashes(const StoreNames& names);

/// Throws what of a store's own names is taken by somebody else's files, or held by another process. Changes
/// nothing.
void demand_free(const StoreNames& names);
/// The error, which says who writes where it is that somebody does.
Error told_who_writes(const Error& error, const std::filesystem::path& results);
/// What `use` gives, or throws like that, of a results file.
template <class Use>
auto of_results(const std::filesystem::path& results, Use use) try {
  return use();
} catch (const Error& error) {
  throw told_who_writes(error, results);
}

/// Deletes what writers that were killed left half written. Those of living parts are not ours to judge.
void remove_leftovers_of(const StoreNames& names);

/// The manifest of the case file at `path`, all of which is checked. Errors: missing, unreadable, corrupt
/// (also when it is the result of another case than `hash` says).
Result<Manifest> read_checked(const std::filesystem::path& path, const std::string& hash);
bool belongs_to(const Manifest& manifest, const std::string& hash);
/// Whether a regular file begins as case files do.
bool began_as_case(const std::filesystem::path& path);
Error of_another_case(const std::filesystem::path& path);

/// The newest attempts on all cases, or on those that a condition selects, in the order of their hashes; none
/// where they cannot be read.
std::vector<RunRecord> records_in(Database& database, const std::string& which = {},
                                  const SqlRow& values = {});

}  // namespace launchsafe::store
