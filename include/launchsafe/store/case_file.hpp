// One result file a case: HDF5 with units on every dataset, whole or not there, never silently replaced; and
// where a result came from: input, program, time.
//
// The first 512 bytes are an HDF5 user block that holds, as text, the length and the SHA-256 of what follows.
// They are checked before HDF5 sees a byte, so that no damage can be read as a result.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/file.hpp"

namespace launchsafe::store {

struct Manifest {
  std::string input_text;         ///< all that determines the case, as it was read
  std::string input_sha256 = {};  ///< of `input_text`; two results with the same one are the same question
  int model_version = 0;          ///< of the physics, see run::model_version
  std::string program_version = {}, commit = {}, compiler = {}, compiler_flags = {}, build_type = {};
  std::string start_time = {};  ///< ISO 8601, UTC
  double wall_time = 0;         ///< s, of the case or the study
  bool operator==(const Manifest&) const = default;
};

/// The members of a manifest as case files and manifest.json have them.
inline constexpr std::tuple manifest_members{
    run::Stored{"input_sha256", &Manifest::input_sha256, "none"},
    run::Stored{"model_version", &Manifest::model_version, "1"},
    run::Stored{"program_version", &Manifest::program_version, "none"},
    run::Stored{"commit", &Manifest::commit, "none"},
    run::Stored{"compiler", &Manifest::compiler, "none"},
    run::Stored{"compiler_flags", &Manifest::compiler_flags, "none"},
    run::Stored{"build_type", &Manifest::build_type, "none"},
    run::Stored{"start_time", &Manifest::start_time, "none"},
    run::Stored{"wall_time_s", &Manifest::wall_time, "s"},
    run::Stored{"input", &Manifest::input_text, "none"},
};

/// A manifest of this program and its model, started now; the wall time is left to the caller.
Manifest make_manifest(std::string input_text);

/// "launchsafe 0.1.0, commit 5f8ab68e": the program of a manifest.
std::string program_of(const Manifest& manifest);

/// The time now, such as 2026-03-01T09:30:00Z.
std::string utc_now();

/// A case and where it came from.
struct StoredCase {
  Manifest manifest;
  run::CaseResult result;
};

/// Writes a case file at `path` and, when there are snapshots, its sidecar, by which ParaView opens the
/// particles, each as a cell, as a time series. Overwrites nothing. Errors: conflict, failed (a result whose
/// arrays do not fit together), write_failed.
void write_case_file(const std::filesystem::path& path, const StoredCase& stored);

/// The path with the extension .xdmf.
std::filesystem::path sidecar_of(const std::filesystem::path& path);

/// The bytes of a whole case file. Errors: failed (a result whose arrays do not fit together).
std::string case_bytes(const StoredCase& stored);

/// All that `write_case_file` was given, bit by bit. Errors: missing, unreadable, corrupt.
StoredCase read_case_file(const std::filesystem::path& path);

}  // namespace launchsafe::store
