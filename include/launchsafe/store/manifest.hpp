// Where a result came from: input, program, machine.
#pragma once

#include <string>
#include <vector>

namespace launchsafe::store {

struct LibraryVersion {
  std::string name, version;
  bool operator==(const LibraryVersion&) const = default;
};

struct Manifest {
  std::string input_text;    ///< all that determines the case, as it was read
  std::string input_sha256;  ///< of `input_text`; two results with the same one are the same question
  int model_version = 0;     ///< of the physics, see run::model_version; 0 where it was not recorded
  std::string program_version, commit, compiler, compiler_flags, build_type;
  std::vector<LibraryVersion> libraries;
  std::string host;
  int threads = 1;
  std::string start_time;  ///< ISO 8601, UTC
  double wall_time = 0;    ///< s
  bool operator==(const Manifest&) const = default;
};

/// A manifest of this program and its model on this machine, started now; the wall time is left to the
/// caller.
Manifest make_manifest(std::string input_text, int threads);

/// The name of this machine on its network.
std::string host_name();

/// The versions of the libraries that this program was built with.
std::vector<LibraryVersion> library_versions();

/// The time now, such as 2026-03-01T09:30:00Z.
std::string utc_now();

}  // namespace launchsafe::store
