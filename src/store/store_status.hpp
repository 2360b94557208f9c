// status.json: how far a study is, for whoever watches, since nobody else may read a results file that is
// being written.
#pragma once

#include "launchsafe/store/result.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace launchsafe::store {

/// Where a writer is and how far.
struct StoreStatus {
  std::string host;
  long process = 0;
  std::string since;        ///< ISO 8601, UTC
  std::string time;         ///< of this snapshot
  bool ended = false;       ///< the writer closed the store
  std::size_t stored = 0;   ///< runs whose result is in this file
  std::size_t done = 0;     ///< of the runs that the process was asked for
  std::size_t running = 0;  ///< of these
  std::size_t total = 0;
};

/// The file's text.
std::string to_text(const StoreStatus& status);
/// Whether the content of a file is that of a status.
bool is_status(std::string_view content);
/// "HOST process PID since TIME, 3 of 12 runs done", from a status file; "another process" where it names
/// none.
std::string writer_in(const std::filesystem::path& status_file);

}  // namespace launchsafe::store
