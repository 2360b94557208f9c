// One result file a case: HDF5 with units on every dataset, whole or not there, never silently replaced; and
// where a result came from: input, program, machine.
//
// The first 512 bytes are an HDF5 user block that holds, as text, the length and the SHA-256 of what follows.
// They are checked before HDF5 sees a byte, so that no damage can be read as a result.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/file.hpp"

namespace launchsafe::store {

struct Manifest {
  std::string input_text;    ///< all that determines the case, as it was read
  std::string input_sha256;  ///< of `input_text`; two results with the same one are the same question
  int model_version = 0;     ///< of the physics, see run::model_version; 0 where it was not recorded
  std::string program_version, commit, compiler, compiler_flags, build_type;
  std::string host;
  int threads = 1;
  std::string start_time;  ///< ISO 8601, UTC
  double wall_time = 0;    ///< s
  bool operator==(const Manifest&) const = default;
};

/// A manifest of this program and its model on this machine, started now; the wall time is left to the
/// caller.
Manifest make_manifest(std::string input_text, int threads);

/// "launchsafe 0.1.0, commit 5f8ab68e": what made the results that a manifest is of.
std::string program_of(const Manifest& manifest);

/// The name of this machine on its network.
std::string host_name();

/// The time now, such as 2026-03-01T09:30:00Z.
std::string utc_now();

/// Writes a case file at `path` and, when there are snapshots, `path` with the extension .xdmf beside it, by
/// which ParaView opens the particles, each as a cell, as a time series. Never overwrites a different result:
/// a file with another input hash at `path` is a conflict, and so is what is no case
/// file, or an .xdmf without one. Errors: failed (a result whose arrays do not fit together), conflict,
/// write_failed.
MaybeError write_case_file(const std::filesystem::path& path, const scene::Scene& scene,
                           const run::CaseResult& result, const Manifest& manifest);

/// The file beside a case file by which ParaView opens its snapshots.
std::filesystem::path sidecar_of(const std::filesystem::path& path);
/// Why the result of an input, with the file beside it where `has_sidecar`, may not be written there:
/// something else is, such as the result of another one. Changes nothing. Errors: conflict.
MaybeError obstacle_to_case_file(const std::filesystem::path& path, const Manifest& manifest,
                                 bool has_sidecar);

/// The bytes of a whole case file. Errors: failed (a result whose arrays do not fit together).
Result<std::string> case_bytes(const scene::Scene& scene, const run::CaseResult& result,
                               const Manifest& manifest);

struct StoredCase {
  Manifest manifest;
  std::string title;  ///< of the scene
  run::CaseResult result;
};

/// All that `case_bytes` was given but the scene, bit by bit. Errors: corrupt.
Result<StoredCase> case_of(std::string_view bytes);

/// All that `write_case_file` was given but the scene, bit by bit. Errors: missing, unreadable, corrupt.
Result<StoredCase> read_case_file(const std::filesystem::path& path);

/// A stored case and what was simulated.
struct CaseWithScene {
  StoredCase stored;
  /// Of a study's case without all that cannot influence its mechanical run.
  scene::Scene scene;
};

/// The same with the scene, from the input in the manifest. Errors: those of `read_case_file`; corrupt also
/// where the input is no scene to this program.
Result<CaseWithScene> read_case_with_scene(const std::filesystem::path& path);

/// The manifest alone; the whole file is checked all the same. Errors: missing, unreadable, corrupt.
Result<Manifest> read_manifest(const std::filesystem::path& path);

}  // namespace launchsafe::store
