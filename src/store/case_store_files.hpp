// The names of a store's files, and what lies there.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "posix_file.hpp"

namespace launchsafe::store {

/// The error, which names the folder where it is that somebody writes there.
Error told_who_writes(const Error& error, const std::filesystem::path& results);
/// What `use` gives, or throws like that, of a results file.
template <class Use>
auto of_results(const std::filesystem::path& results, Use use) try {
  return use();
} catch (const Error& error) {
  throw told_who_writes(error, results);
}

/// The newest attempts on all cases, or on those that a condition selects, in the order of their hashes; none
/// where they cannot be read.
std::vector<RunRecord> records_in(Database& database, const std::string& which = {},
                                  const SqlRow& values = {});

}  // namespace launchsafe::store
