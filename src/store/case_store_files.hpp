// The names of a store's files, and what lies there.
#pragma once

#include "launchsafe/store/manifest.hpp"
#include "launchsafe/store/result.hpp"
#include "posix_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::store {

struct StoreNames {
  std::filesystem::path folder;
  std::string part;

  std::filesystem::path cases() const { return folder / "cases"; }
  std::filesystem::path case_file(const std::string& hash) const { return cases() / (hash + ".h5"); }
  std::filesystem::path results() const { return folder / ("study" + suffix() + ".db"); }
  std::filesystem::path status() const { return folder / ("status" + suffix() + ".json"); }
  /// Ends the names of files that this part is writing.
  std::string mark() const { return part.empty() ? "whole" : part; }

 private:
  std::string suffix() const { return part.empty() ? "" : "." + part; }
};

/// The hashes of what has the name of a case file in a store, in order.
std::vector<std::string> stored_hashes(const StoreNames& names, std::error_code& status);

/// What of a store's own names is taken by somebody else's files, or held by another process. Changes
/// nothing.
MaybeError obstacle_in(const StoreNames& names);
/// A folder that an earlier version of the program stored its results in.
MaybeError obstacle_of_older(const std::filesystem::path& folder);
/// The error, which says who writes where it is that somebody does.
Error told_who_writes(const Error& error, const std::filesystem::path& results);

/// Deletes what writers that were killed left half written. Those of living parts are not ours to judge.
void remove_leftovers_of(const StoreNames& names);

/// The bytes of the case file at `path`, and what they are. Errors: missing, unreadable, corrupt (also when
/// it is the result of another case than `hash` says).
struct CheckedFile {
  std::string bytes;
  Manifest manifest;
};
Result<CheckedFile> read_checked(const std::filesystem::path& path, const std::string& hash);
bool belongs_to(const Manifest& manifest, const std::string& hash);
/// Whether a regular file begins as case files do.
bool began_as_case(const std::filesystem::path& path);
Error of_file(const std::filesystem::path& path, const Error& error);
Error of_another_case(const std::filesystem::path& path);

/// Those of the hashes whose files are whole. Damaged ones are remarked. Errors: conflict, unreadable.
Result<std::vector<std::string>> whole_ones(const StoreNames& names, const std::vector<std::string>& hashes,
                                            int model_version, std::vector<std::string>& remarks);

}  // namespace launchsafe::store
