#include "launchsafe/store/case_file.hpp"

#include "case_layout.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "posix_file.hpp"

namespace launchsafe::store {
namespace {

constexpr std::string_view format_name = "launchsafe case file";
constexpr std::string_view format_version = "1";

// --- the user block: what the bytes after it must be ---

constexpr std::size_t user_block_size = 512;

std::string user_block_of(std::string_view image) {
  std::string block =
      fmt::format("{} {}\nbytes {}\nsha256 {}\n", format_name, format_version, image.size(), sha256(image));
  block.resize(user_block_size, ' ');
  block.back() = '\n';
  return block;
}

/// The HDF5 image inside a case file's bytes. Throws where they are damaged.
std::string_view checked_image(std::string_view file) {
  const std::string_view image = file.substr(std::min(user_block_size, file.size()));
  if (!file.starts_with(format_name)) throw Error{Error::Kind::corrupt, "not a launchsafe case file"};
  if (!file.starts_with(user_block_of(image)))
    throw Error{Error::Kind::corrupt, "damaged: its SHA-256 is another one"};
  return image;
}

// --- what lies in the image ---

template <class Archive, class Title>
void lay_out_title(Archive& archive, Title& title) {
  archive.group("scene", "What was simulated is in manifest/input", [&] {
    archive.value("title", title, {"none", "title"});
  });
}

// --- files ---

/// What `parse` makes of the file at `path`. Errors: missing, unreadable, corrupt.
template <class Value>
Result<Value> read_with(const std::filesystem::path& path, Result<Value> (*parse)(std::string_view)) {
  const Result<std::string> file = read_file(path);
  if (!file) return file.error();
  Result<Value> value = parse(*file);
  return value ? value : of_file(path, value.error());
}

Result<Manifest> manifest_of(std::string_view bytes) try {
  Hdf5Reader reader(checked_image(bytes));
  Manifest manifest;
  lay_out_manifest(reader, manifest);
  return manifest;
} catch (const Error& error) {
  return error;
}

}  // namespace

Result<std::string> case_bytes(const scene::Scene& scene, const run::CaseResult& result,
                               const Manifest& manifest) try {
  Hdf5Writer writer;
  writer.attribute("format", std::string(format_name));
  writer.attribute("format_version", std::string(format_version));
  lay_out_manifest(writer, manifest);
  lay_out_title(writer, scene.title);
  lay_out_result(writer, result);
  const std::string image = writer.finish();
  return user_block_of(image) + image;
} catch (const Error& error) {
  return error;
}

Result<StoredCase> case_of(std::string_view bytes) try {
  Hdf5Reader reader(checked_image(bytes));
  StoredCase stored;
  lay_out_manifest(reader, stored.manifest);
  lay_out_title(reader, stored.title);
  lay_out_result(reader, stored.result);
  return stored;
} catch (const Error& error) {
  return error;
}

MaybeError write_case_file(const std::filesystem::path& path, const scene::Scene& scene,
                           const run::CaseResult& result, const Manifest& manifest) {
  const Result<std::string> bytes = case_bytes(scene, result, manifest);
  if (!bytes)
    return Error{bytes.error().kind,
                 fmt::format("cannot write {}: {}", path.string(), bytes.error().message)};
  const bool burns = std::ranges::any_of(result.gaps, [](const run::GapResult& gap) {
    return gap.combustion && !gap.combustion->snapshots.empty();
  });
  const bool has_sidecar = burns || !result.mechanics.snapshots.empty();
  if (MaybeError obstacle = obstacle_to_case_file(path, manifest, has_sidecar)) return obstacle;
  if (MaybeError error = write_file_atomically(path, *bytes, IfExists::replace)) return error;
  if (!has_sidecar) return {};
  return write_file_atomically(sidecar_of(path), xdmf_of(result, path.filename().string()),
                               IfExists::replace);
}

std::filesystem::path sidecar_of(const std::filesystem::path& path) {
  return std::filesystem::path(path).replace_extension(".xdmf");
}

MaybeError obstacle_to_case_file(const std::filesystem::path& path, const Manifest& manifest,
                                 bool has_sidecar) {
  std::error_code failed;
  const Result<Manifest> present = read_manifest(path);
  if (present && present->input_sha256 == manifest.input_sha256) return {};
  if (present) return refusal(path, "holds the result of a different input");
  if (present.error().kind != Error::Kind::missing) return refusal(path, "cannot be read as a case");
  if (has_sidecar && std::filesystem::exists(sidecar_of(path), failed))
    return refusal(sidecar_of(path), "is there without a case");
  return {};
}

Result<StoredCase> read_case_file(const std::filesystem::path& path) { return read_with(path, case_of); }

Result<CaseWithScene> read_case_with_scene(const std::filesystem::path& path) {
  Result<StoredCase> stored = read_case_file(path);
  if (!stored) return stored.error();
  auto file = scene::parse_scene(stored->manifest.input_text, path);
  if (!file)
    return Error{Error::Kind::corrupt, fmt::format("{}: its input is no scene to this program: {}",
                                                   path.string(), file.error().message())};
  return CaseWithScene{std::move(*stored), std::move(file->scene)};
}

Result<Manifest> read_manifest(const std::filesystem::path& path) { return read_with(path, manifest_of); }

}  // namespace launchsafe::store
