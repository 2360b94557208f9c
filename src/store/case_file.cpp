#include "launchsafe/store/case_file.hpp"

#include "case_bytes.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/own_files.hpp"
#include "xdmf.hpp"

#include <fmt/format.h>

namespace launchsafe::store {
namespace {

/// Nothing when `path` is free or holds an answer to the same question.
MaybeError conflict_at(const std::filesystem::path& path, const Manifest& manifest) {
  const Result<Manifest> present = read_manifest(path);
  if (!present) {
    if (present.error().kind != Error::Kind::missing) return present.error();
    // A link that leads nowhere is there, and somebody's.
    if (!std::filesystem::is_symlink(path)) return {};
    return Error{Error::Kind::conflict,
                 fmt::format("{} is a symbolic link; it was left as it is", path.string())};
  }
  if (present->input_sha256 == manifest.input_sha256) return {};
  return Error{Error::Kind::conflict,
               fmt::format("{} holds the result of a different input (SHA-256 {:.12}..., not "
                           "{:.12}...); it was left as it is",
                           path.string(), present->input_sha256, manifest.input_sha256)};
}

MaybeError publish(const std::filesystem::path& path, std::string_view bytes, const Manifest& manifest) {
  if (const MaybeError conflict = conflict_at(path, manifest)) return conflict;
  const MaybeError error = write_file_atomically(path, {bytes}, IfExists::refuse);
  if (!error || error->kind != Error::Kind::conflict) return error;
  // Something is there: the same question's answer before, or since a moment ago by another process.
  if (const MaybeError conflict = conflict_at(path, manifest)) return conflict;
  return write_file_atomically(path, {bytes}, IfExists::replace);
}

/// What `parse` makes of the file at `path`. Errors: missing, unreadable, corrupt.
template <class Value>
Result<Value> read_with(const std::filesystem::path& path, Result<Value> (*parse)(std::string_view)) {
  const Result<std::string> file = read_file(path);
  if (!file) return file.error();
  Result<Value> value = parse(*file);
  if (!value) return Error{value.error().kind, fmt::format("{}: {}", path.string(), value.error().message)};
  return value;
}

}  // namespace

MaybeError write_case_file(const std::filesystem::path& path, const scene::Scene& scene,
                           const run::CaseResult& result, const Manifest& manifest) {
  const Result<std::string> bytes = case_bytes(scene, result, manifest);
  if (!bytes) {
    return Error{bytes.error().kind,
                 fmt::format("cannot write {}: {}", path.string(), bytes.error().message)};
  }
  if (MaybeError error = publish(path, *bytes, manifest)) return error;
  const auto& snapshots = result.mechanics.snapshots;
  if (snapshots.empty()) return {};
  const std::filesystem::path sidecar = sidecar_of(path);
  return write_own_file(sidecar, {xdmf_of(snapshots, path.filename().string())});
}

std::filesystem::path sidecar_of(const std::filesystem::path& path) {
  return std::filesystem::path(path).replace_extension(".xdmf");
}

Result<StoredCase> read_case_file(const std::filesystem::path& path) { return read_with(path, case_of); }

Result<Manifest> read_manifest(const std::filesystem::path& path) { return read_with(path, manifest_of); }

}  // namespace launchsafe::store
